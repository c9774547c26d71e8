//! How long it takes to decide a spec: the order of its lenses, and the search for regions.

use divan::{Bencher, black_box};
use lenspeel::plan::Plan;
use lenspeel::scene::{Model, Scene};
use lenspeel::spec::Spec;

fn main() {
    divan::main();
}

/// `count` spheres in a row, `step` apart, each of radius 1, each declared above the one before it.
fn spec(count: usize, step: f64) -> Spec {
    let mut text = String::from("[scene]\nfile = \"none.glb\"\n[camera]\neye = [0, 0, 900]\ntarget = [0, 0, 0]\n");
    for i in 0..count {
        let x = i as f64 * step;
        text += &format!(
            "[[lens]]\nname = \"l{i}\"\nfilters = [\"invert\"]\nshape.sphere = {{ center = [{x}, 0, 0], radius = 1 }}\n"
        );
        if i > 0 {
            text += &format!("over = [\"l{}\"]\n", i - 1);
        }
    }
    Spec::parse(&text, "bench.toml", std::path::Path::new("")).expect("the spec of the benchmark is valid")
}

fn empty_scene() -> Scene {
    Scene::new(vec![Model { name: "none.glb".into(), ..Model::default() }], Vec::new())
}

const COUNTS: [usize; 4] = [8, 32, 128, 256];
/// Apart, in a chain, and all over each other.
const STEPS: [f64; 3] = [3.0, 1.5, 0.01];

#[divan::bench(args = COUNTS, consts = [0, 1, 2])]
fn decide<const STEP: usize>(bencher: Bencher, count: usize) {
    let (spec, scene) = (spec(count, STEPS[STEP]), empty_scene());
    bencher.bench(|| Plan::new(black_box(&spec), &scene).expect("the plan of the benchmark is valid"));
}

#[divan::bench(args = COUNTS, consts = [0, 1, 2])]
fn regions<const STEP: usize>(bencher: Bencher, count: usize) {
    let scene = empty_scene();
    let plan = Plan::new(&spec(count, STEPS[STEP]), &scene).expect("the plan of the benchmark is valid");
    bencher.bench(|| black_box(&plan).regions());
}
