//! Attachment to the camera and to nodes gives the picture of the same world transform written by hand.

use std::path::Path;

use glam::{DQuat, DVec3};
use lenspeel::cpu;
use lenspeel::frame::{Aovs, Frame};
use lenspeel::plan::Plan;
use lenspeel::scene::Scene;
use lenspeel::spec::Spec;

/// One of each kind, about the origin of its space, all different from every side.
const SHAPES: [&str; 14] = [
    "sphere = { center = [0.1, 0, 0], radius = 0.4 }",
    "ellipsoid = { center = [0, 0.1, 0], radii = [0.5, 0.3, 0.4], rotation = [0, 20, 40] }",
    "box = { min = [-0.4, -0.3, -0.3], max = [0.5, 0.3, 0.4] }",
    "cylinder = { from = [-0.4, 0, 0], to = [0.4, 0.2, 0], radius = 0.3 }",
    "cone = { from = [0, -0.4, 0], to = [0.1, 0.5, 0], from_radius = 0.5, to_radius = 0.1 }",
    "capsule = { from = [-0.3, 0, 0], to = [0.3, 0.1, 0.1], radius = 0.2 }",
    "polytope = { planes = [[1, 1, 0, 0.4], [-1, 1, 0, 0.3], [0, -1, 0, 0.4], [0, 0, 1, 0.4], [0, 0, -1, 0.4]] }",
    "hull = { points = [[0, 0, 0.5], [0.4, 0, 0], [0, 0.6, 0], [-0.5, 0, 0], [0, -0.3, 0], [0, 0, -0.4]] }",
    "flat = { corners = [[-0.4, -0.3, 0], [0.5, -0.3, 0], [0.3, 0.4, 0], [-0.3, 0.3, 0]], depth = 0.5 }",
    "halfspace = { point = [0.1, 0.1, 0], normal = [1, 2, 0.5] }",
    "slab = { point = [0, 0.1, 0], normal = [1, -2, 0.5], thickness = 0.3 }",
    "union = [{ sphere = { center = [-0.3, 0, 0], radius = 0.3 } }, { box = { min = [0.1, -0.2, -0.3], max = [0.5, 0.4, 0.2] } }]",
    "difference = [{ box = { min = [-0.5, -0.4, -0.4], max = [0.5, 0.4, 0.4] } }, { sphere = { center = [0.1, 0.1, 0.3], radius = 0.3 } }]",
    "mesh = { file = \"solids.glb\", node = \"letter\", convex = \"decompose\" }",
];

/// A transform without shear.
#[derive(Clone, Copy)]
struct Place {
    translation: DVec3,
    rotation: DQuat,
    scale: DVec3,
}

impl Place {
    fn text(&self) -> String {
        let Place { translation: t, rotation: r, scale: s } = self;
        format!(
            "translation = [{:?}, {:?}, {:?}]\nrotation = [{:?}, {:?}, {:?}, {:?}]\nscale = [{:?}, {:?}, {:?}]",
            t.x, t.y, t.z, r.x, r.y, r.z, r.w, s.x, s.y, s.z
        )
    }

    /// This place in a space that is at `outer`: without shear if `outer` does not stretch, or this is not turned.
    fn within(&self, outer: &Place) -> Place {
        let unturned = self.rotation == DQuat::IDENTITY;
        assert!(unturned || outer.scale == DVec3::ONE, "turned and then stretched");
        Place {
            translation: outer.translation + outer.rotation * (outer.scale * self.translation),
            rotation: outer.rotation * self.rotation,
            scale: outer.scale * self.scale,
        }
    }
}

fn degrees(x: f64, y: f64, z: f64) -> DQuat {
    DQuat::from_euler(glam::EulerRot::XYZ, x.to_radians(), y.to_radians(), z.to_radians())
}

/// A lens of this shape over the moving model.
fn render(shape: &str, attach: &str, place: &Place) -> Frame {
    let text = format!(
        "[scene]\nfile = \"motion.glb\"\ntime = 1.25\n\
         [camera]\neye = [1, 0.5, 4]\ntarget = [1, 0.5, 0]\n\
         [image]\nsize = [128, 96]\nsamples = 1\n\
         [[lens]]\nname = \"lens\"\nshape.{shape}\nfilters = [\"invert\"]\nglass = false\nattach = {attach}\n{}\n",
        place.text()
    );
    let models = Path::new(env!("CARGO_MANIFEST_DIR")).join("lens-specs/models");
    let spec = Spec::parse(&text, "lens.toml", &models).unwrap_or_else(|e| panic!("{e}\n{text}"));
    let scene = Scene::open(&spec).expect("the model is part of the project");
    let plan = Plan::new(&spec, &scene).unwrap_or_else(|e| panic!("{e}\n{text}"));
    cpu::Renderer::new(&scene, &plan).and_then(|cpu| cpu.render(true, &|_| ())).expect("the CPU draws it")
}

fn maps(frame: &Frame) -> &Aovs {
    frame.aovs.as_ref().expect("asked for")
}

/// Every shape at `own` in a space which is at `outer` in the world.
fn check(attach: &str, outer: Place, own: Place) {
    for shape in SHAPES {
        let attached = render(shape, attach, &own);
        let by_hand = render(shape, "\"scene\"", &own.within(&outer));
        let is_inside = |id: &&u32| maps(&attached).table.get(**id as usize).is_some_and(|r| !r.set.is_empty());
        let inside = maps(&attached).regions.iter().filter(is_inside).count();
        assert!(inside > 20, "{shape}: only {inside} pixels of the scene are inside, attached to {attach}");
        assert!(maps(&attached).regions == maps(&by_hand).regions, "other regions: {shape} attached to {attach}");
        assert!(maps(&attached).layers == maps(&by_hand).layers, "other layers: {shape} attached to {attach}");
        assert!(attached.pixels == by_hand.pixels, "other colours: {shape} attached to {attach}");
        let wrong = Place { rotation: outer.rotation * degrees(0.0, 0.0, 10.0), ..outer };
        let elsewhere = render(shape, "\"scene\"", &own.within(&wrong));
        assert!(attached.pixels != elsewhere.pixels, "{shape}: ten degrees make no difference");
    }
}

#[test]
fn the_camera_is_a_space_at_the_eye() {
    let eye = Place { translation: DVec3::new(1.0, 0.5, 4.0), rotation: DQuat::IDENTITY, scale: DVec3::ONE };
    let own = Place {
        translation: DVec3::new(-0.6, 0.2, -4.4),
        rotation: degrees(10.0, -20.0, 30.0),
        scale: DVec3::new(1.4, -1.0, 1.2),
    };
    check("\"camera\"", eye, own);
}

#[test]
fn a_node_at_rest_is_a_space() {
    let wall = Place { translation: DVec3::ZERO, rotation: DQuat::IDENTITY, scale: DVec3::ONE };
    let own = Place {
        translation: DVec3::new(0.8, 0.4, -0.4),
        rotation: degrees(-10.0, 20.0, 50.0),
        scale: DVec3::new(1.2, 1.5, 1.0),
    };
    check("{ node = \"wall\" }", wall, own);
}

/// At 1.25 s the arm has turned by 112.5 degrees, and its child goes along.
#[test]
fn a_node_in_motion_is_a_space() {
    let turn = degrees(0.0, 0.0, 112.5);
    let arm = Place { translation: DVec3::new(-0.6, 0.2, 0.0), rotation: turn, scale: DVec3::ONE };
    let own = Place {
        translation: DVec3::new(0.5, -0.1, -0.3),
        rotation: degrees(15.0, -10.0, 40.0),
        scale: DVec3::new(1.5, 1.1, -1.0),
    };
    check("{ node = \"arm\" }", arm, own);
    let ball = Place { translation: arm.translation + turn * (DVec3::X * 0.9), ..arm };
    check("{ node = \"ball\" }", ball, own);
}

/// The box is a quarter of the way from its second key to its third, and as high as that second key says.
#[test]
fn a_node_that_stretches_stretches_its_lenses() {
    let (t, from, to) = (0.25, DVec3::new(0.0, -0.9, 0.4), DVec3::new(1.4, -0.9, 0.0));
    let leaving = DVec3::X * 1.4;
    // The cubic with slope `leaving` at its start and none at its end.
    let translation =
        from + leaving * t + (3.0 * (to - from) - 2.0 * leaving) * t * t + (leaving - 2.0 * (to - from)) * t * t * t;
    let stretched = Place { translation, rotation: DQuat::IDENTITY, scale: DVec3::new(1.0, 1.4, 1.0) };
    let own =
        Place { translation: DVec3::new(0.15, 0.1, 0.3), rotation: DQuat::IDENTITY, scale: DVec3::new(0.6, 0.5, -0.7) };
    check("{ node = \"box\" }", stretched, own);
}
