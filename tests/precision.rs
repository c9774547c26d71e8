//! Pictures do not depend on how far off their eye, their scene or parts of it are, nor on the scene's unit of length: the
//! same picture comes out of both backends wherever single precision would have been lost.

#[cfg(feature = "gpu")]
#[path = "support/gpu.rs"]
mod gpu;
#[path = "support/open.rs"]
#[allow(dead_code, reason = "these scenes are made in code")]
mod open;

use std::collections::BTreeMap;

use glam::{DAffine3, DVec3, Vec3};
use lenspeel::cpu;
use lenspeel::frame::Frame;
use lenspeel::plan::Plan;
use lenspeel::scene::{Material, Mesh, Model, Node, Primitive, Scene, Transform};
use lenspeel::spec::Spec;
use libtest_mimic::{Arguments, Failed, Trial};

use open::Opened;

type Draw = fn(&Opened) -> Result<Frame, String>;
type Check = fn(&On) -> Result<(), String>;

/// What is to be right is drawn by the CPU; what is asked, by a backend.
struct On {
    draw: Draw,
    /// Of several cases only the last: on software a device takes seconds a picture.
    few: bool,
}

impl On {
    fn some<'c, T>(&self, cases: &'c [T]) -> &'c [T] {
        if self.few { &cases[cases.len() - 1..] } else { cases }
    }
}

const ALL: [(&str, Check); 8] = [
    ("an-orthographic-eye-may-be-anywhere-on-its-axis", orthographic_eyes),
    ("a-long-lens-sees-what-an-orthographic-camera-sees", long_lens),
    ("a-scene-may-be-of-any-size-and-anywhere", sizes_and_places),
    ("nothing-large-or-far-costs-what-is-near", large_and_far),
    ("a-ground-without-end-stays-below-what-lies-on-it", endless_ground),
    ("filters-count-from-the-scene", filters_far_from_the_origin),
    ("a-face-in-a-lens-face-has-no-specks", flush_face),
    ("a-lens-may-be-a-planet", planet),
];

fn main() {
    let arguments = Arguments::from_args();
    let mut trials = Vec::new();
    #[cfg(feature = "gpu")]
    let is_ignored = gpu::is_ignored();
    for (name, check) in ALL {
        trials.push(Trial::test(format!("{name}::cpu"), move || {
            check(&On { draw: on_cpu, few: false }).map_err(Failed::from)
        }));
        #[cfg(feature = "gpu")]
        {
            let on_gpu: Draw = |opened| gpu::render(opened, gpu::ENGINES[0].0);
            let trial = Trial::test(format!("{name}::fused"), move || {
                check(&On { draw: on_gpu, few: true }).map_err(Failed::from)
            });
            trials.push(trial.with_ignored_flag(is_ignored));
        }
    }
    libtest_mimic::run(&arguments, trials).exit();
}

fn on_cpu(opened: &Opened) -> Result<Frame, String> {
    let drawn = cpu::Renderer::new(&opened.scene, &opened.plan).and_then(|cpu| cpu.render(true, &|_| ()));
    drawn.map_err(|error| error.to_string())
}

const SIZE: [usize; 2] = [96, 72];

/// Boxes and other solids, each a node that stands somewhere.
struct Stage {
    nodes: Vec<(Primitive, DAffine3)>,
    camera: String,
    lenses: String,
}

impl Stage {
    fn opened(&self) -> Result<Opened, String> {
        let [width, height] = SIZE;
        let Self { camera, lenses, .. } = self;
        let text = format!(
            "[scene]\nfile = \"made-in-code.glb\"\n[camera]\n{camera}\n[light]\nambient = 1.0\n[image]\n\
             size = [{width}, {height}]\nsamples = 1\n{lenses}"
        );
        let mut spec = Spec::parse(&text, "spec.toml", "".as_ref()).map_err(|error| error.to_string())?;
        spec.lenses.iter_mut().for_each(|lens| lens.glass = None);
        let mut model = Model { name: "made in code".into(), ..Model::default() };
        model.materials = vec![Material::default()];
        for (number, (primitive, place)) in self.nodes.iter().enumerate() {
            model.nodes.push(Node {
                name: format!("node-{number}"),
                parent: None,
                children: vec![],
                rest: Transform::Matrix(*place),
                world_from_local: *place,
                mesh: Some(model.meshes.len()),
                camera: None,
                light: None,
                drawn: true,
                hidden: false,
            });
            model.meshes.push(Mesh { name: "mesh".into(), primitives: vec![primitive.clone()] });
        }
        let mut scene = Scene::new(vec![model], vec![]);
        scene.prepare_filters(&spec).map_err(|error| error.to_string())?;
        let plan = Plan::new(&spec, &scene).map_err(|error| error.to_string())?;
        Ok(Opened { scene, plan })
    }

    fn drawn(&self, draw: Draw) -> Result<Picture, String> {
        let opened = self.opened()?;
        let frame = draw(&opened)?;
        let aovs = frame.aovs.as_ref().ok_or("the picture has no AOVs")?;
        let region =
            |at: usize| aovs.region(at).map_or("nothing".into(), |region| opened.plan.names(region.set).join("+"));
        Ok(Picture { regions: (0..frame.pixels.len()).map(region).collect(), pixels: frame.pixels })
    }
}

struct Picture {
    regions: Vec<String>,
    pixels: Vec<[u8; 4]>,
}

impl Picture {
    fn count(&self, region: &str) -> usize {
        self.regions.iter().filter(|own| *own == region).count()
    }

    /// Differs from another picture in no more than so many pixels, each of them at an edge.
    fn is_as(&self, other: &Self, most: usize, what: &str) -> Result<(), String> {
        let differ: Vec<usize> = (0..self.pixels.len())
            .filter(|at| {
                let off = |i: usize| self.pixels[*at][i].abs_diff(other.pixels[*at][i]) > 2;
                self.regions[*at] != other.regions[*at] || (0..4).any(off)
            })
            .collect();
        let inside = differ.iter().filter(|at| !self.is_at_edge(**at)).count();
        if differ.len() > most || inside > 0 {
            let regions: BTreeMap<&str, usize> = self.regions.iter().fold(BTreeMap::new(), |mut all, own| {
                *all.entry(own.as_str()).or_default() += 1;
                all
            });
            return Err(format!("{what}: {} pixels differ, {inside} of them at no edge; {regions:?}", differ.len()));
        }
        Ok(())
    }

    /// Something else is seen at a neighbour.
    fn is_at_edge(&self, at: usize) -> bool {
        let [width, height] = SIZE;
        let (x, y) = (at % width, at / width);
        let around = (y.saturating_sub(1)..(y + 2).min(height))
            .flat_map(|v| (x.saturating_sub(1)..(x + 2).min(width)).map(move |u| v * width + u));
        around.into_iter().any(|other| {
            let off = |i: usize| self.pixels[at][i].abs_diff(self.pixels[other][i]) > 2;
            self.regions[at] != self.regions[other] || (0..3).any(off)
        })
    }
}

fn text(v: DVec3) -> String {
    format!("[{:?}, {:?}, {:?}]", v.x, v.y, v.z)
}

/// A box between two corners, closed.
fn cuboid(low: Vec3, high: Vec3) -> Primitive {
    let corner = |i: u32| {
        Vec3::new(
            if i & 1 == 0 { low.x } else { high.x },
            if i & 2 == 0 { low.y } else { high.y },
            if i & 4 == 0 { low.z } else { high.z },
        )
    };
    let faces = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
    let triangles = faces.iter().flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]).collect();
    Primitive { positions: (0..8).map(corner).collect(), triangles, ..Primitive::default() }
}

fn quad(half: f32) -> Primitive {
    let positions = vec![
        Vec3::new(-half, 0.0, -half),
        Vec3::new(-half, 0.0, half),
        Vec3::new(half, 0.0, half),
        Vec3::new(half, 0.0, -half),
    ];
    Primitive { positions, triangles: vec![[0, 1, 2], [0, 2, 3]], ..Primitive::default() }
}

/// A hollow box that one lens cuts open and closes, and a tint; of size `unit` about `middle`.
fn pipe(unit: f64, middle: DVec3, camera: &str) -> Stage {
    let at = |x: f64, y: f64, z: f64| text(middle + DVec3::new(x, y, z) * unit);
    let lenses = format!(
        "[[lens]]\nname = \"cut\"\nshape.box = {{ min = {}, max = {} }}\nfilters = [{{ erase = {{ cap = \"#ff0000\" }} }}]\n\
         [[lens]]\nname = \"tint\"\nshape.sphere = {{ center = {}, radius = {:?} }}\nfilters = [{{ unlit = {{ color = \"#00ff00\" }} }}]\n",
        at(0.2, -2.0, -2.0),
        at(2.0, 2.0, 2.0),
        at(-0.6, 0.6, 0.8),
        0.35 * unit,
    );
    let place = DAffine3::from_scale_rotation_translation(DVec3::splat(unit), glam::DQuat::IDENTITY, middle);
    Stage { nodes: vec![(cuboid(Vec3::NEG_ONE, Vec3::ONE), place)], camera: camera.into(), lenses }
}

const WAY: DVec3 = DVec3::new(3.0, 2.0, 10.0);

fn orthographic(distance: f64) -> String {
    format!("eye = {}\ntarget = [0, 0, 0]\northographic_height = 4", text(WAY.normalize() * distance))
}

fn orthographic_eyes(on: &On) -> Result<(), String> {
    let near = pipe(1.0, DVec3::ZERO, &orthographic(10.0)).drawn(on_cpu)?;
    if near.count("tint") < 20 {
        return Err("the lens is hardly seen".into());
    }
    for distance in on.some(&[0.1, 300.0, 1e5, 1e8, 1e6]).iter().copied() {
        let far = pipe(1.0, DVec3::ZERO, &orthographic(distance)).drawn(on.draw)?;
        far.is_as(&near, 8, &format!("from {distance}"))?;
    }
    Ok(())
}

fn long_lens(on: &On) -> Result<(), String> {
    let flat = pipe(1.0, DVec3::ZERO, &orthographic(10.0)).drawn(on_cpu)?;
    for distance in on.some(&[1e6f64, 1e5]).iter().copied() {
        let degrees = (2.0 * (2.0 / distance).atan()).to_degrees();
        let camera = format!("eye = {}\ntarget = [0, 0, 0]\nfov_y = {degrees:?}", text(WAY.normalize() * distance));
        pipe(1.0, DVec3::ZERO, &camera).drawn(on.draw)?.is_as(&flat, 20, &format!("from {distance}"))?;
    }
    Ok(())
}

fn sizes_and_places(on: &On) -> Result<(), String> {
    let camera = |unit: f64, middle: DVec3| {
        format!("eye = {}\ntarget = {}\nfov_y = 30", text(middle + WAY * 0.7 * unit), text(middle))
    };
    let stage = |unit: f64, middle: DVec3| pipe(unit, middle, &camera(unit, middle));
    let plain = stage(1.0, DVec3::ZERO).drawn(on_cpu)?;
    for unit in on.some(&[1e6, 1e-6]).iter().copied() {
        stage(unit, DVec3::ZERO).drawn(on.draw)?.is_as(&plain, 8, &format!("scaled by {unit}"))?;
    }
    for far in on.some(&[DVec3::new(1e6, 0.0, 0.0), DVec3::new(-6e6, 1e7, 2e6)]).iter().copied() {
        stage(1.0, far).drawn(on.draw)?.is_as(&plain, 8, &format!("moved by {far}"))?;
    }
    Ok(())
}

fn large_and_far(on: &On) -> Result<(), String> {
    let camera = "eye = [4, 3, 6]\ntarget = [0, 0, 0]\nfov_y = 30";
    let cut = |size: f64| {
        format!(
            "[[lens]]\nname = \"half\"\nshape.box = {{ min = [0, {0:?}, {0:?}], max = [{1:?}, {1:?}, {1:?}] }}\n\
             filters = [{{ erase = {{ cap = \"#ff0000\" }} }}]\n",
            -size, size
        )
    };
    let cube = || (cuboid(Vec3::NEG_ONE, Vec3::ONE), DAffine3::IDENTITY);
    let plain = Stage { nodes: vec![cube()], camera: camera.into(), lenses: cut(10.0) }.drawn(on_cpu)?;
    for size in on.some(&[1e9, 1e7]).iter().copied() {
        let huge = Stage { nodes: vec![cube()], camera: camera.into(), lenses: cut(size) }.drawn(on.draw)?;
        huge.is_as(&plain, 8, &format!("a lens of {size}"))?;
    }
    // A sliver that nobody sees reaches very far behind the eye, and before it.
    for far in on.some(&[1e7, 1e12, -1e7, -1e20, 1e20]).iter().copied() {
        let tip = Vec3::new(3.0, 40.0, far as f32);
        let sliver = Primitive {
            positions: vec![tip, tip * 1.01, Vec3::new(3.0, 40.0, 0.0)],
            triangles: vec![[0, 1, 2]],
            ..Primitive::default()
        };
        let cameras = [camera, "eye = [4, 3, 6]\ntarget = [0, 0, 0]\northographic_height = 4"];
        for camera in on.some(&cameras).iter().copied() {
            let stage = |nodes| Stage { nodes, camera: camera.into(), lenses: cut(10.0) };
            let plain = stage(vec![cube()]).drawn(on_cpu)?;
            let both = stage(vec![cube(), (sliver.clone(), DAffine3::IDENTITY)]).drawn(on.draw)?;
            both.is_as(&plain, 8, &format!("a sliver to {far} with {camera}"))?;
        }
    }
    Ok(())
}

fn endless_ground(on: &On) -> Result<(), String> {
    for half in on.some(&[10.0, 1e4, 1e6, 1e5]).iter().copied() {
        let stage = Stage {
            nodes: vec![(quad(half), DAffine3::IDENTITY)],
            camera: "eye = [0.7, 1.7, 2]\ntarget = [0, 0.3, 0]\nfov_y = 60".into(),
            lenses: "[[lens]]\nname = \"in\"\nshape.box = { min = [-1, -0.005, -1], max = [0, 0.005, 1] }\n\
                     filters = [{ unlit = { color = \"#ff0000\" } }]\n\
                     [[lens]]\nname = \"above\"\nshape.box = { min = [0.01, 0.001, -1], max = [1, 0.5, 1] }\n\
                     filters = [{ unlit = { color = \"#00ff00\" } }]\n"
                .into(),
        };
        let picture = stage.drawn(on.draw)?;
        let (within, above) = (picture.count("in"), picture.count("above"));
        if above > 0 || within < 300 {
            return Err(format!("a ground of {half}: {within} pixels in the lens, {above} in that above"));
        }
    }
    Ok(())
}

fn filters_far_from_the_origin(on: &On) -> Result<(), String> {
    let stage = |middle: DVec3| {
        let at = |x: f64, y: f64, z: f64| text(middle + DVec3::new(x, y, z));
        let lenses = format!(
            "[[lens]]\nname = \"lines\"\nshape.box = {{ min = {}, max = {} }}\nfilters = [{{ contours = {{ spacing = 1.0 }} }}]\n\
             [[lens]]\nname = \"height\"\nshape.box = {{ min = {}, max = {} }}\nfilters = [\"height\"]\n",
            at(-40.0, -9.0, -40.0),
            at(0.0, 9.0, 40.0),
            at(0.0, -9.0, -40.0),
            at(40.0, 9.0, 40.0),
        );
        let slope = DAffine3::from_translation(middle) * DAffine3::from_rotation_x(0.2);
        let camera = format!("eye = {}\ntarget = {}\nfov_y = 40", at(50.0, 45.0, 70.0), text(middle));
        Stage { nodes: vec![(quad(35.0), slope)], camera, lenses }
    };
    let plain = stage(DVec3::ZERO).drawn(on_cpu)?;
    let places = [DVec3::new(1e7, 1e7, -1e7), DVec3::new(1_334_982.0, -4_653_953.0, 4_138_370.0)];
    for far in on.some(&places).iter().copied() {
        stage(far).drawn(on.draw)?.is_as(&plain, 20, &format!("moved by {far}"))?;
    }
    Ok(())
}

fn flush_face(on: &On) -> Result<(), String> {
    // The cube's front face lies in the lens's, and the eye's plane is that, too.
    let stage = Stage {
        nodes: vec![(cuboid(Vec3::NEG_ONE, Vec3::ONE), DAffine3::IDENTITY)],
        camera: "eye = [0, 0, 1]\ntarget = [0, 0, 0]\northographic_height = 3.6".into(),
        lenses: "[[lens]]\nname = \"cut\"\nshape.box = { min = [-1, -1, 0], max = [1, 1, 1] }\n\
                 filters = [{ erase = { cap = \"#ff0000\" } }]\n"
            .into(),
    };
    let picture = stage.drawn(on.draw)?;
    let (seen, rest) = (picture.pixels[SIZE[0] * SIZE[1] / 2 + SIZE[0] / 2], picture.pixels[0]);
    let specks = picture.pixels.iter().filter(|pixel| **pixel != seen && **pixel != rest).count();
    if specks > 0 || seen == rest {
        return Err(format!("{specks} specks on {seen:?}"));
    }
    Ok(())
}

fn planet(on: &On) -> Result<(), String> {
    // The ground of a ball so large is a plane through the scene, tilted by less than a pixel.
    for (shape, radius) in on.some(&[("sphere", 1e7), ("cylinder", 1e7), ("sphere", 1e9)]).iter().copied() {
        let ends = format!("from = [0, {0:?}, -1e3], to = [0, {0:?}, 1e3]", -radius);
        let place = if shape == "sphere" { format!("center = [0, {:?}, 0]", -radius) } else { ends };
        let stage = |lens: String| Stage {
            nodes: vec![(cuboid(Vec3::NEG_ONE, Vec3::ONE), DAffine3::IDENTITY)],
            camera: "eye = [4, 3, 6]\ntarget = [0, 0, 0]\nfov_y = 30".into(),
            lenses: format!("[[lens]]\nname = \"low\"\n{lens}\nfilters = [{{ unlit = {{ color = \"#ff0000\" }} }}]\n"),
        };
        let flat = stage("shape.box = { min = [-50, -50, -50], max = [50, 0, 50] }".into()).drawn(on_cpu)?;
        let round = stage(format!("shape.{shape} = {{ {place}, radius = {radius:?} }}")).drawn(on.draw)?;
        round.is_as(&flat, 20, &format!("a {shape} of {radius}"))?;
    }
    Ok(())
}
