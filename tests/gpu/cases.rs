//! The tests by name.

use lenspeel::cpu;
use lenspeel::frame::Frame;
use lenspeel::gpu::{Engine, Error, Headless, RenderOptions};
use lenspeel::plan::Plan;
use lenspeel::scene::Scene;

use crate::Test;
use crate::agree::agree;
use crate::scene::{ORTHOGRAPHIC, PANES, PERSPECTIVE, plan_of, planned};

pub const ALL: &[(&str, Test)] = &[
    ("plain_scene", plain_scene),
    ("every_shape_perspective", |d| every_shape(d, PERSPECTIVE)),
    ("every_shape_orthographic", |d| every_shape(d, ORTHOGRAPHIC)),
    ("every_shape_around_the_eye", |d| every_shape(d, "eye = [0.1, 0.3, 0.1]\ntarget = [1, 0, -0.5]\nfov_y = 80")),
    ("every_shape_cut_by_near_and_far", |d| every_shape(d, &format!("{PERSPECTIVE}\nnear = 3.2\nfar = 3.9"))),
    ("forty_lenses", forty_lenses),
    ("four_samples_over_nothing", four_samples_over_nothing),
    ("lists_that_overflow", lists_that_overflow),
    ("windows", windows),
    ("windows_of_the_screen", windows_of_the_screen),
    ("sixty_four_sheets", crate::panes::sixty_four_sheets),
    ("random_stacks", crate::stacks::random_stacks),
    ("filters_of_the_screen", filters_of_the_screen),
    ("soft_filters_of_the_screen", soft_filters_of_the_screen),
    ("kept_targets_of_the_screen", kept_targets_of_the_screen),
    ("custom_filters_are_brought_into_range", crate::custom::what_a_filter_makes_is_brought_into_range),
    ("custom_filters_fade_bent_normals", crate::custom::a_soft_lens_fades_bent_normals),
    ("custom_filters_may_give_no_numbers", crate::custom::a_filter_may_give_no_numbers),
    ("too_small_a_device", too_small_a_device),
    ("run_to_run", run_to_run),
    ("a_difference_is_found", a_difference_is_found),
    ("intervals_of_random_placements", crate::intervals::random_placements),
    ("an_interval_moved_is_found", crate::intervals::a_moved_lens_is_found),
    ("layers_of_random_compounds", crate::compounds::layers_of_random_compounds),
    ("pictures_of_compounds", crate::compounds::pictures_of_compounds),
    ("meshes_that_nearly_touch_the_eye", crate::compounds::meshes_that_nearly_touch_the_eye),
    ("crossings_that_overflow", crate::compounds::crossings_that_overflow),
    ("as_many_lenses_as_there_can_be", crate::limits::as_many_lenses_as_there_can_be),
    ("what_a_plan_needs_is_refused_with_numbers", crate::limits::what_a_plan_needs_is_refused_with_numbers),
    ("a_target_of_a_host", crate::host::a_target_of_a_host),
    ("frames_have_costs", crate::bench::frames_have_costs),
    ("storage_grows_with_the_lenses", crate::bench::storage_grows_with_the_lenses),
    ("what_is_drawn_is_what_may_be_seen", crate::bench::what_is_drawn_is_what_may_be_seen),
    ("bench_prints_a_table", crate::bench::the_program_prints_a_table),
    ("bench_prints_json", crate::bench::the_program_prints_json),
];

const SIZE: [u32; 2] = [120, 90];
const ENGINES: [Engine; 2] = [Engine::Fused, Engine::Peel];

pub fn on_cpu(scene: &Scene, plan: &Plan) -> Frame {
    cpu::Renderer::new(scene, plan).and_then(|cpu| cpu.render(true, &|_| ())).expect("the CPU draws it")
}

/// Both engines against the CPU.
pub fn check(device: &Headless, scene: &Scene, plan: &Plan) -> Result<(), String> {
    let expected = on_cpu(scene, plan);
    for engine in ENGINES {
        let options = RenderOptions { engine, aovs: true };
        let actual = device.render(scene, plan, options).map_err(|e| format!("{engine:?}: {e}"))?;
        agree(&expected, &actual).map_err(|e| format!("{engine:?}: {e}"))?;
    }
    Ok(())
}

fn plain_scene(device: &Headless) -> Result<(), String> {
    let (scene, plan) = planned(SIZE, 1, PERSPECTIVE, "");
    check(device, &scene, &plan)
}

/// Lenses of all shapes that overlap each other, with filters of all stages.
fn every_shape(device: &Headless, camera: &str) -> Result<(), String> {
    let (scene, plan) = planned(SIZE, 1, camera, &every_shape_text());
    check(device, &scene, &plan)
}

fn every_shape_text() -> String {
    let lens = |name: &str, rest: &str| format!("[[lens]]\nname = \"{name}\"\n{rest}\n");
    // A hull with so many faces that a cell lists few of them.
    let points: Vec<String> = (0..40)
        .map(|i| {
            let (turn, y) = (f64::from(i) * 2.4, f64::from(i) / 39.0 * 2.0 - 1.0);
            let r = (1.0 - y * y).sqrt() * 0.4;
            format!("[{:.4}, {:.4}, {:.4}]", 0.3 + r * turn.cos(), 0.15 + 0.4 * y, r * turn.sin())
        })
        .collect();
    [
        lens("ball", "shape.sphere = { center = [-0.3, 0.1, 0.2], radius = 0.4 }\nfilters = [{ tint = { color = \"red\", amount = 0.5 } }]"),
        lens("egg", "shape.ellipsoid = { center = [-0.5, 0, -0.4], radii = [0.5, 0.2, 0.3], rotation = [20, 30, 40] }\nfilters = [\"invert\"]"),
        lens("box", "shape.box = { center = [0.1, 0, 0.4], size = [0.6, 0.5, 0.4], rotation = [0, 30, 10] }\nfilters = [{ opacity = { value = 0.6 } }]"),
        lens("rod", "shape.cylinder = { from = [-0.8, 0, 0.7], to = [0.8, 0.2, 0.5], radius = 0.15 }\nfilters = [\"wireframe\"]"),
        lens("horn", "shape.cone = { from = [0.5, -0.3, -0.6], to = [0.4, 0.6, -0.4], from_radius = 0.4, to_radius = 0.05 }\nfilters = [\"normals\"]"),
        lens("pill", "shape.capsule = { from = [-0.6, 0.1, 0.1], to = [0, 0.2, -0.5], radius = 0.18 }\nfilters = [\"grayscale\"]\nhides = [\"egg\"]"),
        lens("gem", &format!("shape.hull = {{ points = [{}] }}\nfilters = [{{ erase = {{ nodes = [\"pane\"] }} }}]", points.join(", "))),
        lens("glance", "shape.flat = { corners = [[0.2, 0.5, 0.9], [0.9, 0.5, 0.6], [0.9, 0, 0.6], [0.2, 0, 0.9]], depth = 1.2 }\nfilters = [{ unlit = { color = \"gold\" } }]"),
        lens("whole", "shape.sphere = { center = [-0.7, 0, 0.7], radius = 0.3 }\nby = \"object\"\nonly = { nodes = [\"sheet\"] }\nfilters = [{ material = { metallic = 1.0 } }]"),
    ]
    .concat()
}

/// More lenses than one word of a set has bits.
fn forty_lenses(device: &Headless) -> Result<(), String> {
    let lenses: Vec<String> = (0..40)
        .map(|i| {
            let (x, z) = (f64::from(i % 8) * 0.25 - 0.9, f64::from(i / 8) * 0.4 - 0.8);
            let hides = if i % 7 == 3 { format!("hides = [\"l{}\"]\n", i / 2) } else { String::new() };
            format!(
                "[[lens]]\nname = \"l{i}\"\nshape.sphere = {{ center = [{x}, 0, {z}], radius = 0.3 }}\n\
                 filters = [{{ tint = {{ color = \"#{:02x}80{:02x}\", amount = 0.3 }} }}]\nglass = false\n{hides}",
                6 * i,
                255 - 6 * i
            )
        })
        .collect();
    let (scene, plan) = planned(SIZE, 1, PERSPECTIVE, &lenses.concat());
    check(device, &scene, &plan)
}

fn four_samples_over_nothing(device: &Headless) -> Result<(), String> {
    let (scene, mut plan) = planned(SIZE, 4, PERSPECTIVE, &every_shape_text());
    plan.background = [0.0; 4];
    check(device, &scene, &plan)
}

/// Every pixel of a wide view of the panes needs more fragments than are made room for at first.
fn lists_that_overflow(device: &Headless) -> Result<(), String> {
    let close = "eye = [0.35, 0.15, 3]\ntarget = [0.35, 0.15, 0]\nfov_y = 6";
    let (scene, plan) = planned(SIZE, 1, close, "");
    let mut renderer = device.renderer(&scene).map_err(|e| e.to_string())?;
    let options = RenderOptions { engine: Engine::Fused, aovs: true };
    let expected = on_cpu(&scene, &plan);
    let fragments = expected.pixels.len() * PANES;
    for _ in 0..2 {
        let actual = device.render_with(&mut renderer, &scene, &plan, options, &mut None).map_err(|e| e.to_string())?;
        agree(&expected, &actual)?;
        let reserved = renderer.reserved().fragments;
        if reserved < fragments as u64 {
            return Err(format!("{reserved} fragments in the lists, and the view has {fragments}"));
        }
    }
    Ok(())
}

/// With little memory the picture is drawn in parts, and is the same.
fn windows(device: &Headless) -> Result<(), String> {
    in_windows(device, &every_shape_text(), 100_000)
}

/// Filters of the screen look over the edges of windows.
fn windows_of_the_screen(device: &Headless) -> Result<(), String> {
    let filters = "{ edges = { width = 3 } }, { blur = { radius = 6 } }, { pixelate = { radius = 2 } }";
    let lens = "shape.sphere = { center = [0, 0.1, 0.1], radius = 0.7 }\nglass = false";
    in_windows(device, &format!("[[lens]]\nname = \"a\"\n{lens}\nfilters = [{filters}]\n"), 300_000)
}

/// A picture whose buffers may have so many bytes against the whole one.
fn in_windows(device: &Headless, lenses: &str, bytes: u64) -> Result<(), String> {
    let (scene, plan) = planned(SIZE, 1, PERSPECTIVE, lenses);
    for engine in ENGINES {
        let options = RenderOptions { engine, aovs: true };
        let whole = device.render(&scene, &plan, options).map_err(|e| e.to_string())?;
        let mut renderer = device.renderer(&scene).map_err(|e| e.to_string())?;
        renderer.limit_buffers(bytes);
        let parts = device.render_with(&mut renderer, &scene, &plan, options, &mut None).map_err(|e| e.to_string())?;
        agree(&whole, &parts).map_err(|e| format!("{engine:?}: {e}"))?;
    }
    Ok(())
}

/// In stack order, over regions that overlap, with several samples a pixel, and by a rule.
fn filters_of_the_screen(device: &Headless) -> Result<(), String> {
    let lens = |name: &str, x: f64, filters: &str| {
        let shape = format!("shape.sphere = {{ center = [{x}, 0.1, 0.2], radius = 0.45 }}");
        format!("[[lens]]\nname = \"{name}\"\n{shape}\nfilters = [{filters}]\nglass = false\n")
    };
    let lenses = [
        lens("a", -0.3, "{ blur = { radius = 3 } }, \"invert\""),
        lens("b", 0.2, "\"edges\", { opacity = { value = 0.6 } }"),
        lens("c", 0.5, "{ pixelate = { radius = 2 } }"),
        "[[overlap]]\nwhen = \"b & c\"\nfilters = [\"blur\", { edges = { color = \"red\", width = 2 } }]\n".into(),
    ];
    for (camera, samples) in [(PERSPECTIVE, 4), (ORTHOGRAPHIC, 1)] {
        let (scene, plan) = planned(SIZE, samples, camera, &lenses.concat());
        check(device, &scene, &plan)?;
    }
    Ok(())
}

/// They fade in where their lenses are soft: by the point that is shown, by where a magnifier takes it from, and by the
/// whole object.
fn soft_filters_of_the_screen(device: &Headless) -> Result<(), String> {
    let lens = |name: &str, x: f64, rest: &str| {
        let shape = format!("shape.sphere = {{ center = [{x}, 0.1, 0.2], radius = 0.5 }}");
        format!("[[lens]]\nname = \"{name}\"\n{shape}\nglass = false\n{rest}\n")
    };
    let lenses = [
        lens("a", -0.4, "soft = 0.3\nfilters = [\"invert\", { blur = { radius = 4 } }]"),
        lens("b", 0.3, "soft = 0.4\nby = \"object\"\nfilters = [{ pixelate = { radius = 3 } }]"),
        lens("c", 0.2, "soft = 0.2\nfilters = [{ edges = { color = \"red\", width = 4 } }]"),
        lens("d", 0.0, "filters = [{ magnify = { factor = 1.5 } }]"),
    ];
    for (camera, samples) in [(PERSPECTIVE, 4), (ORTHOGRAPHIC, 1)] {
        let (scene, plan) = planned(SIZE, samples, camera, &lenses.concat());
        check(device, &scene, &plan)?;
        let (hard_scene, hard) = planned(SIZE, samples, camera, &lenses.concat().replace("soft", "priority = 0\n# "));
        if agree(&on_cpu(&scene, &plan), &on_cpu(&hard_scene, &hard)).is_ok() {
            return Err("lenses that are not soft look the same".into());
        }
    }
    Ok(())
}

/// A renderer that goes from one picture to another makes what a new one makes of each.
fn kept_targets_of_the_screen(device: &Headless) -> Result<(), String> {
    let lens = |number: usize, filters: &str| {
        let shape = format!("shape.sphere = {{ center = [{}, 0.1, 0.2], radius = 0.4 }}", 0.02 * number as f64 - 0.3);
        format!("[[lens]]\nname = \"l{number}\"\n{shape}\nfilters = [{filters}]\nglass = false\n")
    };
    // Sets of one word, none, sets of two.
    let one = lens(0, "\"edges\", { blur = { radius = 3 } }");
    let many: String = (0..33).map(|number| lens(number, if number == 32 { "\"pixelate\"" } else { "" })).collect();
    let (mut scene, _) = planned(SIZE, 1, PERSPECTIVE, "");
    let mut renderer = device.renderer(&scene).map_err(|e| e.to_string())?;
    for (step, (size, lenses)) in
        [(SIZE, one.as_str()), (SIZE, ""), (SIZE, &many), (SIZE, &one), ([90, 40], &many)].into_iter().enumerate()
    {
        let plan = plan_of(&mut scene, size, 1, PERSPECTIVE, lenses);
        let options = RenderOptions::default();
        let kept = device.render_with(&mut renderer, &scene, &plan, options, &mut None).map_err(|e| e.to_string())?;
        let new = device.render(&scene, &plan, options).map_err(|e| e.to_string())?;
        if kept.pixels != new.pixels {
            return Err(format!("picture {step} is another one than a new renderer's"));
        }
    }
    Ok(())
}

/// Where not even one pixel fits, the error says what is needed and what is allowed.
fn too_small_a_device(device: &Headless) -> Result<(), String> {
    let (scene, plan) = planned(SIZE, 1, PERSPECTIVE, &every_shape_text());
    let mut renderer = device.renderer(&scene).map_err(|e| e.to_string())?;
    renderer.limit_buffers(8);
    match device.render_with(&mut renderer, &scene, &plan, RenderOptions::default(), &mut None) {
        Err(Error::TooLarge { needed, allowed: 8, .. }) if needed > 8 => Ok(()),
        Err(error) => Err(format!("another error: {error}")),
        Ok(_) => Err("a picture was made in eight bytes".into()),
    }
}

fn run_to_run(device: &Headless) -> Result<(), String> {
    let (scene, plan) = planned(SIZE, 4, PERSPECTIVE, &every_shape_text());
    let render = || device.render(&scene, &plan, RenderOptions { engine: Engine::Fused, aovs: true });
    let first = render().map_err(|e| e.to_string())?;
    for _ in 0..3 {
        if render().map_err(|e| e.to_string())? != first {
            return Err("two runs differ".into());
        }
    }
    Ok(())
}

/// Negative control: a lens moved by a hundredth, and two lenses in the other order, are seen.
fn a_difference_is_found(device: &Headless) -> Result<(), String> {
    let (scene, plan) = planned(SIZE, 1, PERSPECTIVE, &every_shape_text());
    let expected = on_cpu(&scene, &plan);
    let changes =
        [("center = [-0.3, 0.1, 0.2]", "center = [-0.31, 0.1, 0.2]"), ("hides = [\"egg\"]", "under = [\"egg\"]")];
    for (from, to) in changes {
        let text = every_shape_text();
        assert!(text.contains(from));
        let (scene, plan) = planned(SIZE, 1, PERSPECTIVE, &text.replace(from, to));
        let actual = device
            .render(&scene, &plan, RenderOptions { engine: Engine::Fused, aovs: true })
            .map_err(|e| e.to_string())?;
        if agree(&expected, &actual).is_ok() {
            return Err(format!("`{to}` instead of `{from}` went unnoticed"));
        }
    }
    Ok(())
}
