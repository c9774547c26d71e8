//! Many see-through sheets over lenses that overlap, against the closed form of what is seen.

use glam::{DAffine3, DVec3, Vec3};
use lenspeel::cpu;
use lenspeel::gpu::{Engine, Headless, RenderOptions};
use lenspeel::plan::Plan;
use lenspeel::scene::{AlphaMode, Material, Mesh, Model, Node, Primitive, Scene, Transform};
use lenspeel::spec::Spec;

const PANES: usize = 64;
const ALPHA: f32 = 0.06;
const BACKGROUND: f32 = 0.2;

/// Depth of a pane on the axis, from the eye on.
fn depth(pane: usize) -> f64 {
    2.0 + 0.1 * pane as f64
}

fn gray(pane: usize) -> f32 {
    0.1 + 0.8 * (pane * 37 % PANES) as f32 / PANES as f32
}

/// Unlit squares one behind the other, in an order of the file that is not that of depth.
fn model() -> Model {
    let mut model = Model { name: "panes".into(), ..Model::default() };
    let corner = |x: f32, y: f32| Vec3::new(x, y, 0.0);
    for number in 0..PANES {
        let pane = number * 29 % PANES;
        let place = DAffine3::from_translation(DVec3::new(0.0, 0.0, -depth(pane)));
        model.materials.push(Material {
            name: format!("pane {pane}"),
            base_color: [gray(pane), 0.5, 1.0 - gray(pane), ALPHA],
            alpha_mode: AlphaMode::Blend,
            unlit: true,
            ..Material::default()
        });
        model.nodes.push(Node {
            name: format!("pane {pane}"),
            parent: None,
            children: vec![],
            rest: Transform::Matrix(place),
            world_from_local: place,
            mesh: Some(number),
            camera: None,
            light: None,
            drawn: true,
            hidden: false,
        });
        let primitive = Primitive {
            positions: vec![corner(-8.0, -8.0), corner(8.0, -8.1), corner(8.0, 8.0), corner(-8.0, 8.1)],
            triangles: vec![[0, 1, 2], [0, 2, 3]],
            material: number,
            ..Primitive::default()
        };
        model.meshes.push(Mesh { name: String::new(), primitives: vec![primitive] });
    }
    model
}

/// Three slabs: panes 8 to 39 at half their opacity, 24 to 55 white, 32 to 63 at a quarter.
const SLABS: [(usize, usize, &str); 3] = [
    (8, 40, "{ opacity = { value = 0.5 } }"),
    (24, 56, "{ unlit = { color = \"white\" } }"),
    (32, 64, "{ opacity = { value = 0.25 } }"),
];

fn lenses() -> String {
    let lens = |(first, last, filter): &(usize, usize, &str)| {
        let [near, far] = [first, last].map(|pane| depth(*pane) - 0.05);
        let shape = format!("box = {{ min = [-9, -9, {}], max = [9, 9, {}] }}", -far, -near);
        format!("[[lens]]\nname = \"from{first}\"\nshape.{shape}\nfilters = [{filter}]\nglass = false\n")
    };
    SLABS.iter().map(lens).collect()
}

/// Linear colour of a pixel in the middle.
fn expected() -> [f32; 3] {
    let (mut sum, mut rest) = ([0.0f32; 3], 1.0f32);
    for pane in 0..PANES {
        let inside = SLABS.map(|(first, last, _)| (first..last).contains(&pane));
        let alpha = ALPHA * if inside[0] { 0.5 } else { 1.0 } * if inside[2] { 0.25 } else { 1.0 };
        let color = if inside[1] { [1.0; 3] } else { [gray(pane), 0.5, 1.0 - gray(pane)] };
        (0..3).for_each(|channel| sum[channel] += rest * alpha * color[channel]);
        rest *= 1.0 - alpha;
    }
    sum.map(|channel| channel + rest * BACKGROUND)
}

/// In true depth order across layers, on every engine and the CPU.
pub fn sixty_four_sheets(device: &Headless) -> Result<(), String> {
    let background = (lenspeel::appearance::srgb_from_linear(BACKGROUND) * 255.0).round() as u8;
    let text = format!(
        "[scene]\nfile = \"made-in-code.glb\"\n[camera]\neye = [0, 0, 0]\ntarget = [0, 0, -1]\n[image]\nsize = [32, 24]\n\
         samples = 1\nbackground = \"#{background:02x}{background:02x}{background:02x}\"\n{}",
        lenses()
    );
    let spec = Spec::parse(&text, "spec of a test", "".as_ref()).map_err(|e| e.to_string())?;
    let scene = Scene::new(vec![model()], vec![]);
    let plan = Plan::new(&spec, &scene).map_err(|e| e.to_string())?;
    let wanted = expected().map(|c| (lenspeel::appearance::srgb_from_linear(c) * 255.0).round());
    let check = |name: &str, pixels: &[[u8; 4]]| {
        for (place, pixel) in pixels.iter().enumerate() {
            if (0..3).any(|channel| (f32::from(pixel[channel]) - wanted[channel]).abs() > 1.0) {
                return Err(format!("{name}: {pixel:?} at {place}, expected {wanted:?}"));
            }
        }
        Ok(())
    };
    check(
        "cpu",
        &cpu::Renderer::new(&scene, &plan).and_then(|cpu| cpu.render(false, &|_| ())).expect("the CPU draws it").pixels,
    )?;
    for engine in [Engine::Fused, Engine::Peel] {
        let options = RenderOptions { engine, aovs: false };
        let frame = device.render(&scene, &plan, options).map_err(|e| format!("{engine:?}: {e}"))?;
        check(&format!("{engine:?}"), &frame.pixels)?;
    }
    Ok(())
}
