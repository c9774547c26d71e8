//! Lenses of several parts and of meshes: the device against the CPU.

use std::f64::consts::TAU;
use std::sync::Arc;

use glam::{DAffine3, DVec3};
use lenspeel::gpu::{Headless, RenderOptions, Room, Window};
use lenspeel::lens::{Form, MeshSolid, Solid, Tree, Volume};
use lenspeel::plan::Plan;

use crate::cases::check;
use crate::intervals::{Random, SIZE, compare_layers, shapes};
use crate::scene::{ORTHOGRAPHIC, PERSPECTIVE, planned};

const TREES: u32 = 6;

/// Any tree over any parts, a torus among them, next to lenses that stand alone.
pub fn layers_of_random_compounds(device: &Headless) -> Result<(), String> {
    let inside = "eye = [0.1, 0.3, 0.1]\ntarget = [1, 0, -0.5]\nfov_y = 80";
    let cut = format!("{PERSPECTIVE}\nnear = 3.3\nfar = 3.8");
    for (number, camera) in [PERSPECTIVE, ORTHOGRAPHIC, inside, &cut].into_iter().enumerate() {
        for seed in 0..TREES {
            let random = &mut Random(u64::from(seed) * 100 + number as u64);
            let (scene, mut plan) = planned(SIZE, 1, camera, &shapes(random));
            let parts: Vec<Solid> = plan.lenses.iter().flat_map(|lens| lens.volume.parts.clone()).collect();
            for lens in 0..2 {
                let pose = DAffine3::from_rotation_x(random.range(0.0, TAU));
                let parts = [parts.clone(), vec![torus(pose)]].concat();
                let tree = Tree::Union(vec![tree(random, 3, parts.len())]);
                replace(&mut plan, lens, Volume { center: DVec3::ZERO, parts, tree });
            }
            compare_layers(device, &scene, &plan).map_err(|e| format!("camera {number}, seed {seed}: {e}"))?;
        }
    }
    Ok(())
}

/// Surfaces and outlines of lens glass, too.
pub fn pictures_of_compounds(device: &Headless) -> Result<(), String> {
    let lens = |name: &str, shape: &str, filter: &str| {
        let glass = "glass = { opacity = 0.3, rim = 0.5, outline = 2 }";
        format!("[[lens]]\nname = \"{name}\"\nshape.{shape}\nfilters = [\"{filter}\"]\n{glass}\n")
    };
    let lenses = [
        lens("ring", "sphere = { center = [0, 0, 0], radius = 0.5 }", "invert"),
        lens(
            "bitten",
            "box = { center = [-0.2, 0.1, 0.4], size = [0.9, 0.6, 0.5], rotation = [0, 30, 10] }",
            "normals",
        ),
        lens("tooth", "cylinder = { from = [-0.4, 0.4, 0.2], to = [0, 0.1, 0.9], radius = 0.2 }", "grayscale"),
    ];
    for camera in [PERSPECTIVE, ORTHOGRAPHIC] {
        let (scene, mut plan) = planned([120, 90], 1, camera, &lenses.concat());
        let [bitten, tooth] = [1, 2].map(|rank| plan.lenses[rank].volume.parts[0].clone());
        replace(&mut plan, 0, of(torus(DAffine3::from_rotation_x(1.2))));
        let tree = Tree::Difference(vec![Tree::Part(0), Tree::Part(1)]);
        replace(&mut plan, 1, Volume { center: DVec3::ZERO, parts: vec![bitten, tooth], tree });
        check(device, &scene, &plan)?;
    }
    Ok(())
}

/// A mesh of many faces whose nearest corner lies before the eye at a small part of the mesh's size: its projection
/// reaches far beyond the picture.
pub fn meshes_that_nearly_touch_the_eye(device: &Headless) -> Result<(), String> {
    let camera = "eye = [0, 0, 0]\ntarget = [0, 0, -1]\nfov_y = 70\nnear = 1e-6\nfar = 10";
    let lens = "[[lens]]\nname = \"a\"\nshape.sphere = { center = [0, 0, -1], radius = 0.5 }\nfilters = [\"invert\"]\n";
    for gap in [1e-3, 1e-4, 1e-5] {
        for side in [0.0, 0.6] {
            let (scene, mut plan) = planned(SIZE, 1, camera, lens);
            let turned = DAffine3::from_rotation_y(side) * DAffine3::from_rotation_x(0.4);
            let solid = torus_of(60, 24, turned);
            let nearest = solid.hull.iter().map(|p| p.z).fold(f64::NEG_INFINITY, f64::max);
            let moved = DAffine3::from_translation(DVec3::new(0.0, 0.0, -gap - nearest));
            replace(&mut plan, 0, of(torus_of(60, 24, moved * turned)));
            compare_layers(device, &scene, &plan).map_err(|e| format!("gap {gap}, turned by {side}: {e}"))?;
        }
    }
    Ok(())
}

/// A row of boxes in one mesh, seen from its end: more crossings than there is room for at first.
pub fn crossings_that_overflow(device: &Headless) -> Result<(), String> {
    const BOXES: u32 = 7;
    let lens = "[[lens]]\nname = \"row\"\nshape.sphere = { center = [0, 0, 0], radius = 1 }\nfilters = [\"invert\"]\n";
    let (scene, mut plan) = planned(SIZE, 1, "eye = [0, 0.3, 4]\ntarget = [0, 0.3, 0]\nfov_y = 20", lens);
    replace(&mut plan, 0, of(row(BOXES)));
    const { assert!(2 * BOXES > Room::FIRST.crossings) };
    compare_layers(device, &scene, &plan)?;
    check(device, &scene, &plan)?;
    let mut renderer = device.renderer(&scene).map_err(|e| e.to_string())?;
    for _ in 0..2 {
        device
            .render_with(&mut renderer, &scene, &plan, RenderOptions::default(), &mut None)
            .map_err(|e| e.to_string())?;
        let room = renderer.reserved().crossings;
        if room != 2 * BOXES {
            return Err(format!("room for {room} crossings, and the row has {}", 2 * BOXES));
        }
    }
    let layers = device.layers(&mut renderer, &scene, &plan, Window::whole(&plan.view)).map_err(|e| e.to_string())?;
    match layers.iter().map(Vec::len).max() {
        Some(most) if most as u32 == 2 * BOXES + 1 => Ok(()),
        most => Err(format!("{most:?} layers at the most")),
    }
}

/// A volume of one part.
pub fn of(solid: Solid) -> Volume {
    Volume { center: solid.center, parts: vec![solid], tree: Tree::Part(0) }
}

/// Gives a lens another volume.
pub fn replace(plan: &mut Plan, rank: usize, volume: Volume) {
    let lens = &mut plan.lenses[rank];
    lens.rect = volume.pixel_rect(&plan.view);
    lens.volume = volume;
}

fn tree(random: &mut Random, depth: u32, parts: usize) -> Tree {
    if depth == 0 || random.range(0.0, 1.0) < 0.2 {
        return Tree::Part(random.range(0.0, parts as f64) as usize);
    }
    let count = 1 + random.range(0.0, 3.0) as usize;
    let list = (0..count).map(|_| tree(random, depth - 1, parts)).collect();
    match random.range(0.0, 3.0) as u32 {
        0 => Tree::Union(list),
        1 => Tree::Intersection(list),
        _ => Tree::Difference(list),
    }
}

/// A mesh between -1 and 1 in a pose that makes it a little smaller than that.
fn placed(mesh: MeshSolid, pose: DAffine3) -> Solid {
    let world_from_local = pose * DAffine3::from_scale(DVec3::splat(0.8));
    let hull = mesh.tree.vertices.iter().map(|v| world_from_local.transform_point3(*v)).collect();
    Solid::new(Form::Mesh(Arc::new(mesh)), world_from_local, hull, pose.translation, false)
}

fn torus(pose: DAffine3) -> Solid {
    torus_of(24, 10, pose)
}

/// Around the z axis, with so many corners around it and across.
pub fn torus_of(around: u32, across: u32, pose: DAffine3) -> Solid {
    let corner = |i: u32, j: u32| {
        let (u, v) = (TAU * f64::from(i) / f64::from(around), TAU * f64::from(j) / f64::from(across));
        let radius = 0.7 + 0.3 * v.cos();
        DVec3::new(radius * u.cos(), radius * u.sin(), 0.3 * v.sin())
    };
    let vertices = (0..around * across).map(|n| corner(n / across, n % across)).collect();
    let at = |i: u32, j: u32| (i % around) * across + j % across;
    let quads = (0..around * across).map(|n| (n / across, n % across));
    let triangles: Vec<[u32; 3]> = quads
        .flat_map(|(i, j)| {
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            [[a, b, c], [a, c, d]]
        })
        .collect();
    placed(MeshSolid::new(vertices, &triangles), pose)
}

/// Boxes one behind the other along the z axis.
fn row(boxes: u32) -> Solid {
    // Triangles of the cube whose corner i is at the bits of i.
    const CUBE: [[u32; 3]; 12] = [
        [0, 2, 1],
        [1, 2, 3],
        [4, 5, 6],
        [5, 7, 6],
        [0, 1, 4],
        [1, 5, 4],
        [2, 6, 3],
        [3, 6, 7],
        [0, 4, 2],
        [2, 4, 6],
        [1, 3, 5],
        [3, 7, 5],
    ];
    let step = 2.0 / f64::from(boxes);
    let corner = |n: u32| {
        let (number, i) = (n / 8, n % 8);
        let side = |bit: u32| if i >> bit & 1 == 1 { 0.5 } else { -0.5 };
        let z = -1.0 + step * (f64::from(number) + 0.5) + 0.5 * step * side(2);
        DVec3::new(side(0), side(1), z)
    };
    let triangles: Vec<[u32; 3]> = (0..boxes).flat_map(|n| CUBE.map(|t| t.map(|i| 8 * n + i))).collect();
    placed(MeshSolid::new((0..8 * boxes).map(corner).collect(), &triangles), DAffine3::IDENTITY)
}
