//! Depth intervals as the device finds them (closed forms in f32, faces listed for the cells of tiles) against the
//! closed forms in f64, on random placements.

use std::f64::consts::TAU;

use lenspeel::gpu::{Headless, Window};
use lenspeel::lens::{Form, LayerStart, RayLayers};
use lenspeel::plan::Plan;
use lenspeel::scene::Scene;

use crate::scene::{ORTHOGRAPHIC, PERSPECTIVE, planned};

pub const SIZE: [u32; 2] = [72, 54];
/// Share of the rays that may differ: those that graze an edge or a silhouette.
const GRAZING: f64 = 0.01;
const PLACEMENTS: u32 = 6;

/// A small generator (splitmix64), so that placements are the same everywhere.
pub struct Random(pub u64);

impl Random {
    /// Evenly from `low` to `high`.
    pub fn range(&mut self, low: f64, high: f64) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        low + (high - low) * ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    fn point(&mut self) -> String {
        format!("[{:.4}, {:.4}, {:.4}]", self.range(-0.8, 0.8), self.range(-0.4, 0.4), self.range(-0.8, 0.8))
    }
}

pub fn random_placements(device: &Headless) -> Result<(), String> {
    let inside = "eye = [0.1, 0.3, 0.1]\ntarget = [1, 0, -0.5]\nfov_y = 80";
    let cut = format!("{PERSPECTIVE}\nnear = 3.3\nfar = 3.8");
    let cut_orthographic = format!("{ORTHOGRAPHIC}\nnear = 3.3\nfar = 3.8");
    for (number, camera) in [PERSPECTIVE, ORTHOGRAPHIC, inside, &cut, &cut_orthographic].into_iter().enumerate() {
        for seed in 0..PLACEMENTS {
            let mut random = Random(u64::from(seed) * 100 + number as u64);
            let lenses = shapes(&mut random) + &large_hulls(&mut random);
            compare(device, camera, &lenses).map_err(|e| format!("camera {number}, seed {seed}: {e}"))?;
        }
    }
    Ok(())
}

/// A lens of each convex shape.
pub fn shapes(random: &mut Random) -> String {
    let turn = |random: &mut Random| {
        format!("[{:.1}, {:.1}, {:.1}]", random.range(0.0, 360.0), random.range(0.0, 360.0), random.range(0.0, 360.0))
    };
    let shapes = [
        format!("sphere = {{ center = {}, radius = {:.4} }}", random.point(), random.range(0.1, 0.6)),
        format!("ellipsoid = {{ center = {}, radii = [0.5, 0.15, 0.3], rotation = {} }}", random.point(), turn(random)),
        format!("box = {{ center = {}, size = [0.7, 0.3, 0.5], rotation = {} }}", random.point(), turn(random)),
        format!("cylinder = {{ from = {}, to = {}, radius = 0.2 }}", random.point(), random.point()),
        format!("cone = {{ from = {}, to = {}, from_radius = 0.3, to_radius = 0.05 }}", random.point(), random.point()),
        format!("capsule = {{ from = {}, to = {}, radius = 0.15 }}", random.point(), random.point()),
        format!("hull = {{ points = [{}] }}", hull(random, 30)),
    ];
    let lens = |(i, shape): (usize, &String)| format!("[[lens]]\nname = \"l{i}\"\nshape.{shape}\nfilters = []\n");
    shapes.iter().enumerate().map(lens).collect()
}

/// Hulls with more faces: of the first the planes are asked, of the second the triangles.
fn large_hulls(random: &mut Random) -> String {
    let lens = |points| {
        format!(
            "[[lens]]\nname = \"h{points}\"\nshape.hull = {{ points = [{}] }}\nfilters = []\n",
            hull(random, points)
        )
    };
    [100, 400].map(lens).concat()
}

/// Points all over a bent ball, so that its hull has many faces.
fn hull(random: &mut Random, points: u32) -> String {
    let (x, z) = (random.range(-0.4, 0.4), random.range(-0.4, 0.4));
    let points: Vec<String> = (0..points)
        .map(|_| {
            let (turn, y) = (random.range(0.0, TAU), random.range(-1.0, 1.0));
            let r = (1.0 - y * y).sqrt();
            format!("[{:.4}, {:.4}, {:.4}]", x + 0.5 * r * turn.cos(), 0.3 * y, z + 0.4 * r * turn.sin())
        })
        .collect();
    points.join(", ")
}

fn compare(device: &Headless, camera: &str, lenses: &str) -> Result<(), String> {
    let (scene, plan) = planned(SIZE, 1, camera, lenses);
    let faces = |lens: &lenspeel::plan::Lens| match &lens.volume.parts[0].form {
        Form::HalfSpaces { planes, .. } => planes.len(),
        Form::Mesh(mesh) => mesh.tree.triangles.len(),
        _ => 0,
    };
    let mut most: Vec<usize> = plan.lenses.iter().map(faces).collect();
    most.sort_unstable();
    if !matches!(most[..], [.., 20..=64, 65..=256, 257..=usize::MAX]) {
        return Err(format!("the hulls should have other numbers of faces: {most:?}"));
    }
    compare_layers(device, &scene, &plan)
}

/// The layers of all pixels as the device and as the CPU find them.
pub fn compare_layers(device: &Headless, scene: &Scene, plan: &Plan) -> Result<(), String> {
    let mut renderer = device.renderer(scene).map_err(|e| e.to_string())?;
    let found = device.layers(&mut renderer, scene, plan, Window::whole(&plan.view)).map_err(|e| e.to_string())?;
    let bad: Vec<usize> = (0..found.len()).filter(|i| !same(&found[*i], &expected(plan, *i))).collect();
    let allowed = (GRAZING * found.len() as f64) as usize;
    match bad.first() {
        Some(first) if bad.len() > allowed => Err(format!(
            "{} rays of {} differ, first {:?} for {:?}",
            bad.len(),
            found.len(),
            found[*first],
            expected(plan, *first)
        )),
        _ => Ok(()),
    }
}

fn expected(plan: &Plan, pixel: usize) -> Vec<LayerStart> {
    let (x, y) = (pixel as u32 % SIZE[0], pixel as u32 / SIZE[0]);
    let ray = plan.view.ray(f64::from(x) + 0.5, f64::from(y) + 0.5);
    let mut layers = RayLayers::default();
    let volumes = plan.lenses.iter().enumerate().map(|(rank, lens)| (rank, &lens.volume));
    layers.find(volumes, &ray, plan.view.near, plan.view.far);
    layers.starts
}

fn same(a: &[LayerStart], b: &[LayerStart]) -> bool {
    a.len() == b.len()
        && a.iter().zip(b).all(|(a, b)| a.set == b.set && (a.depth - b.depth).abs() <= 1e-4 * b.depth.abs().max(1.0))
}

/// Negative control: a lens moved by a hundredth is seen.
pub fn a_moved_lens_is_found(device: &Headless) -> Result<(), String> {
    let lens = |x: f64| {
        format!("[[lens]]\nname = \"a\"\nshape.sphere = {{ center = [{x}, 0, 0], radius = 0.6 }}\nfilters = []\n")
    };
    let (scene, plan) = planned(SIZE, 1, PERSPECTIVE, &lens(0.0));
    let (_, moved) = planned(SIZE, 1, PERSPECTIVE, &lens(0.01));
    let mut renderer = device.renderer(&scene).map_err(|e| e.to_string())?;
    let found = device.layers(&mut renderer, &scene, &plan, Window::whole(&plan.view)).map_err(|e| e.to_string())?;
    let bad = (0..found.len()).filter(|i| !same(&found[*i], &expected(&moved, *i))).count();
    if bad as f64 > GRAZING * found.len() as f64 { Ok(()) } else { Err(format!("only {bad} rays differ")) }
}
