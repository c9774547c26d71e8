//! Lenses with `lod`: that where simplified surfaces begin no gap opens, and what a version is.

use std::path::Path;

use lenspeel::cpu;
use lenspeel::plan::Plan;
use lenspeel::scene::Scene;
use lenspeel::spec::Spec;

/// A scene with a simplifying lens: where its whole and its simplified surfaces lie, and which is seen.
struct Case {
    model: &'static str,
    camera: &'static str,
    shape: &'static str,
    ratio: f32,
}

const CASES: [Case; 5] = [
    Case {
        model: "hand",
        camera: "eye = [0.3, 1.3, 3.2]\ntarget = [-0.1, 1.0, -0.1]\nfov_y = 36",
        shape: "sphere = { center = [0.05, 1.3, -0.1], radius = 0.5 }",
        ratio: 0.02,
    },
    // Grazing rays.
    Case {
        model: "hand",
        camera: "eye = [0.3, 3.4, 0.6]\ntarget = [-0.1, 1.0, -0.1]\nfov_y = 36",
        shape: "box = { center = [0.05, 1.2, -0.1], size = [3, 0.5, 3], rotation = [20, 10, 30] }",
        ratio: 0.02,
    },
    Case {
        model: "terrain",
        camera: "eye = [2.7, 1.2, 4.3]\ntarget = [-0.02, 0.06, 0.12]\nfov_y = 38",
        shape: "cylinder = { from = [0, -1, 0], to = [0, 2, 0], radius = 1.1 }",
        ratio: 0.01,
    },
    Case {
        model: "planet",
        camera: "eye = [1.2, 1.0, 3.0]\ntarget = [0, 0, 0]\nfov_y = 40",
        shape: "sphere = { center = [0.3, 0.2, 0.8], radius = 0.7 }",
        ratio: 0.01,
    },
    Case {
        model: "gearbox",
        camera: "eye = [2.9, 3.4, 6.9]\ntarget = [0.05, -0.1, 0]\nfov_y = 30",
        shape: "union = [{ sphere = { center = [1, 0.4, 0.6], radius = 0.9 } }, { sphere = { center = [-0.6, 0.2, 0.7], radius = 0.8 } }]",
        ratio: 0.05,
    },
];

const EVERYWHERE: &str = "sphere = { center = [0, 0, 0], radius = 1000 }";
const SIZE: [u32; 2] = [320, 240];

/// The plan of a case; `shape` `None`: without the lens.
fn planned(case: &Case, shape: Option<&str>) -> (Scene, Plan) {
    let lens = shape.map_or(String::new(), |shape| {
        format!("[[lens]]\nname = \"coarse\"\nshape.{shape}\nfilters = [{{ lod = {{ ratio = {} }} }}]\n", case.ratio)
    });
    let Case { model, camera, .. } = case;
    let text = format!(
        "[scene]\nfile = \"models/{model}.glb\"\n[camera]\n{camera}\n[image]\nsize = {SIZE:?}\nsamples = 1\n{lens}"
    );
    let spec = Spec::parse(&text, "versions.toml", Path::new("lens-specs")).expect("the specs are valid");
    let scene = Scene::open(&spec).expect("the models are there");
    let plan = Plan::new(&spec, &scene).expect("the specs are valid");
    (scene, plan)
}

fn depths((scene, plan): &(Scene, Plan)) -> Vec<f32> {
    cpu::Renderer::new(scene, plan)
        .and_then(|cpu| cpu.render(true, &|_| ()))
        .expect("the CPU draws it")
        .aovs
        .expect("they were asked for")
        .depth
}

/// How far versions of what is seen may lie from each other: at the rim of a part what lies behind it is seen in one of them.
fn spreads((scene, plan): &(Scene, Plan)) -> Vec<f32> {
    let instances = cpu::Renderer::new(scene, plan)
        .and_then(|cpu| cpu.render(true, &|_| ()))
        .expect("the CPU draws it")
        .aovs
        .expect("they were asked for")
        .instances;
    let spread = |instance: u32| plan.instances.get(instance as usize).map_or(0.0, |instance| instance.spread as f32);
    instances.into_iter().map(spread).collect()
}

/// Pixels that show something farther than both the whole and the simplified surface, and pixels where those differ.
fn gaps(case: &Case, change: impl Fn(&mut Plan)) -> (usize, usize) {
    let everywhere = planned(case, Some(EVERYWHERE));
    let (whole, simplified) = (depths(&planned(case, None)), depths(&everywhere));
    let mut mixed = planned(case, Some(case.shape));
    change(&mut mixed.1);
    let slack = spreads(&everywhere);
    let mixed = depths(&mixed);
    let gaps = mixed.iter().zip(whole.iter().zip(&simplified).zip(&slack));
    let gaps = gaps.filter(|(seen, ((a, b), slack))| **seen > a.max(**b) + **slack).count();
    (gaps, whole.iter().zip(&simplified).filter(|(a, b)| a != b).count())
}

#[test]
fn no_gap_opens_where_simplified_surfaces_begin() {
    for case in &CASES {
        let (gaps, differ) = gaps(case, |_| ());
        assert!(differ > 2000, "{}: the versions are hardly different, at {differ} pixels", case.model);
        assert_eq!(gaps, 0, "{}", case.model);
    }
}

/// The control: were the whole surface not seen a little way into the lens, there would be gaps.
#[test]
fn gaps_would_be_noticed() {
    let found = |case| gaps(case, |plan| plan.instances.iter_mut().for_each(|instance| instance.spread = 0.0)).0;
    let found: Vec<usize> = CASES.iter().map(found).collect();
    assert!(found.iter().filter(|gaps| **gaps > 0).count() >= 3, "{found:?}");
}

#[test]
fn the_whole_surface_ends_soon_after_the_boundary() {
    for case in &CASES {
        let (scene, plan) = planned(case, Some(case.shape));
        let aovs = cpu::Renderer::new(&scene, &plan)
            .and_then(|cpu| cpu.render(true, &|_| ()))
            .expect("the CPU draws it")
            .aovs
            .expect("they were asked for");
        let is_inside = |region: u32| aovs.table.get(region as usize).is_some_and(|region| !region.set.is_empty());
        let inside = aovs.instances.iter().zip(&aovs.regions).filter(|(_, region)| is_inside(**region));
        let (mut whole, mut simplified) = (0, 0);
        for (instance, _) in inside {
            let item = &plan.items[plan.instances[*instance as usize].item];
            *(if item.is_simplified() { &mut simplified } else { &mut whole }) += 1;
        }
        assert!(simplified > 12 * whole, "{}: {whole} against {simplified} pixels", case.model);
    }
}
