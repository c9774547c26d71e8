//! What has no caps, and that the areas would tell.

use glam::Vec3;
use libtest_mimic::{Failed, Trial};

use crate::cases::{ABOVE, CAP, SIDE, above, pixels};
use crate::open::Opened;
use crate::solids::{ball, cuboid, planned, sheet, with};
use crate::{cap_pixels, has_area, maps, on_cpu};

pub fn trials() -> Vec<Trial> {
    let trial = |name: &str, check: fn() -> Result<(), String>| {
        Trial::test(format!("{name}::cpu"), move || check().map_err(Failed::from))
    };
    vec![
        trial("an-open-mesh-is-named-and-left-open", open_mesh),
        trial("open-and-turned-and-touching-edges-are-told-apart", told_apart),
        trial("an-open-mesh-that-the-lens-is-not-there-for-is-not-named", open_mesh_out_of_scope),
        trial("an-open-mesh-that-the-lens-does-not-reach-is-not-named", open_mesh_out_of_reach),
        trial("an-eraser-without-a-cap-closes-nothing", without_cap),
        trial("what-takes-whole-objects-closes-nothing", by_object),
        trial("a-hole-turned-the-wrong-way-changes-the-area", turned_hole),
        trial("a-lens-shifted-by-a-hundredth-changes-the-area", shifted),
    ]
}

/// The caps of node 0 in pixels.
fn caps(opened: &Opened) -> Result<usize, String> {
    let frame = on_cpu(opened)?;
    Ok(cap_pixels(maps(&frame)?, 0))
}

/// Half a ball, and a bare sheet.
fn open_mesh() -> Result<(), String> {
    let mut bowl = ball(1.0, 64);
    let positions = bowl.positions.clone();
    bowl.triangles.retain(|triangle| triangle.iter().all(|corner| positions[*corner as usize].x < 0.01));
    let opened = planned(vec![("bowl", vec![bowl])], SIDE, ABOVE, &above(0.3, CAP));
    let warning = "`cap` of lens `cut` leaves open what is not closed: bowl (66 of ";
    match (&opened.plan.warnings[..], caps(&opened)?) {
        ([only], 0) if only.starts_with("spec.toml:13: ") && only.contains(warning) => Ok(()),
        (warnings, count) => Err(format!("{count} pixels, and {warnings:?}")),
    }
}

/// Each kind of edge is told with its count.
fn told_apart() -> Result<(), String> {
    let mut torn = ball(1.0, 64);
    // One at the equator: those at the poles have no area.
    torn.triangles.remove(64 * 31 + 32);
    let mut some_turned = ball(0.3, 64);
    some_turned.triangles[64 * 31 + 32].swap(0, 1);
    let (a, b) = (cuboid(Vec3::ZERO, Vec3::splat(0.2)), cuboid(Vec3::new(0.4, 0.4, 0.0), Vec3::splat(0.2)));
    let flap = sheet([[0.2, 0.2, -0.2], [0.2, 0.2, 0.2], [-0.2, 0.6, 0.2], [-0.2, 0.6, -0.2]]);
    let parts = vec![
        ("torn", vec![torn]),
        ("turned", vec![some_turned]),
        ("touching", vec![with(a.clone(), b.clone())]),
        ("flap", vec![with(with(a, b), flap)]),
    ];
    let opened = planned(parts, SIDE, ABOVE, &above(0.1, CAP));
    let expected = [
        "closes some pieces and leaves open those that are not closed: flap (3 of 39 edges are open, 1 self-touching)",
        "takes for whole what has small holes: torn (3 of 5952 edges are open)",
        "takes for one side what has triangles turned against each other: turned (0 of 5952 edges are open, 3 turned)",
    ];
    let warnings = &opened.plan.warnings;
    let is_told = |text: &&str| warnings.iter().any(|warning| warning.contains(*text));
    match expected.iter().find(|text| !is_told(text)) {
        None if warnings.len() == 3 => Ok(()),
        _ => Err(format!("{warnings:?}")),
    }
}

fn open_mesh_out_of_scope() -> Result<(), String> {
    let mut torn = ball(0.2, 64);
    torn.triangles.remove(64 * 31 + 32);
    let parts = vec![("ball", vec![ball(1.0, 64)]), ("torn", vec![torn])];
    let opened = planned(parts, SIDE, ABOVE, &(above(0.3, CAP) + "except = { nodes = [\"torn\"] }\n"));
    if opened.plan.warnings.is_empty() && caps(&opened)? > 0 {
        Ok(())
    } else {
        Err(format!("{:?}", opened.plan.warnings))
    }
}

fn open_mesh_out_of_reach() -> Result<(), String> {
    let mut torn = ball(0.2, 64);
    torn.triangles.remove(64 * 31 + 32);
    let parts = || vec![("ball", vec![ball(1.0, 64)]), ("torn", vec![torn.clone()])];
    let warnings = |lenses: &str| planned(parts(), SIDE, ABOVE, lenses).plan.warnings;
    let moved = above(0.3, CAP)
        + "[[lens]]\nname = \"up\"\nshape.sphere = { center = [0, 0, 0], radius = 3 }\n\
        filters = [{ displace = { nodes = [\"torn\"], offset = [0, 0, 0.3] } }]\n";
    match (warnings(&above(0.3, CAP)).len(), warnings(&moved).len()) {
        (0, 1) => Ok(()),
        (out_of_reach, moved) => Err(format!("{out_of_reach} warnings, and {moved} where it is moved there")),
    }
}

fn without_cap() -> Result<(), String> {
    let opened = planned(vec![("ball", vec![ball(1.0, 64)])], SIDE, ABOVE, &above(0.3, "\"erase\""));
    if caps(&opened)? == 0 && opened.plan.bodies.is_empty() { Ok(()) } else { Err("something is closed".into()) }
}

fn by_object() -> Result<(), String> {
    let lens = above(0.3, CAP) + "by = \"object\"\n";
    let opened = planned(vec![("ball", vec![ball(1.0, 64)])], SIDE, ABOVE, &lens);
    let is_told = opened.plan.warnings.iter().any(|warning| warning.contains("`cap` of lens `cut` closes nothing"));
    if caps(&opened)? == 0 && is_told { Ok(()) } else { Err(format!("{:?}", opened.plan.warnings)) }
}

/// The wall of a hole that is not turned inside out makes no hole: the surface winds twice around it.
fn turned_hole() -> Result<(), String> {
    let filled = with(cuboid(Vec3::ZERO, Vec3::ONE), cuboid(Vec3::ZERO, Vec3::splat(0.8)));
    let camera = format!("{ABOVE}\nup = [0.31, 1, 0]");
    let opened = planned(vec![("housing", vec![filled])], SIDE, &camera, &above(0.2, CAP));
    let frame = on_cpu(&opened)?;
    has_area(maps(&frame)?, 0, pixels(4.0))?;
    must_differ(has_area(maps(&frame)?, 0, pixels(4.0 - 2.56)))
}

fn shifted() -> Result<(), String> {
    let opened = planned(vec![("ball", vec![ball(1.0, 192)])], SIDE, ABOVE, &above(0.31, CAP));
    let frame = on_cpu(&opened)?;
    must_differ(has_area(maps(&frame)?, 0, pixels(std::f64::consts::PI * (1.0 - 0.09))))
}

fn must_differ(same: Result<(), String>) -> Result<(), String> {
    if same.is_err() { Ok(()) } else { Err("the area does not tell".into()) }
}
