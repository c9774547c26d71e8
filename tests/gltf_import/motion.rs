//! Animated nodes: values between keys against closed forms, what is left out, and what is wrong with a file.

use std::f64::consts::FRAC_PI_2;

use glam::{DQuat, DVec3};
use lenspeel::scene::{Camera, Model};
use serde_json::{Value, json};

use super::builder::*;

const NO_MESHES: &str = "there is nothing to see: 2 nodes in the scene, and no triangles that are shown";
const TIMES: [[f32; 1]; 3] = [[1.0], [2.0], [4.0]];

/// A file whose node 0, `Wheel`, has one child one unit along its x axis.
fn wheel() -> Doc {
    let mut doc = Doc::new();
    let rim = doc.push("nodes", json!({"name": "Rim", "translation": [1, 0, 0]}));
    doc.node(json!({"name": "Wheel", "translation": [0, 0, 5], "scale": [1, 2, 1], "children": [rim]}));
    doc
}
const RIM: usize = 0;
const WHEEL: usize = 1;

/// Adds an animation of one channel.
fn animate(doc: &mut Doc, path: &str, interpolation: &str, input: usize, output: usize) {
    doc.push(
        "animations",
        json!({
            "name": "Turn",
            "samplers": [{"input": input, "output": output, "interpolation": interpolation}],
            "channels": [{"sampler": 0, "target": {"node": WHEEL, "path": path}}],
        }),
    );
}

fn animated<const N: usize>(path: &str, interpolation: &str, values: &[[f32; N]]) -> Model {
    let mut doc = wheel();
    let (input, output) = (doc.floats(&TIMES), doc.floats(values));
    animate(&mut doc, path, interpolation, input, output);
    doc.model()
}

fn place(model: &mut Model, node: usize, time: f64) -> DVec3 {
    model.pose(Some(time)).expect("finite");
    model.nodes[node].world_from_local.translation
}

#[track_caller]
fn assert_near(found: DVec3, expected: DVec3) {
    assert!(found.distance(expected) < 1e-6, "{found}, expected {expected}");
}

#[test]
fn steps_hold_their_value_until_the_next_key() {
    let mut model = animated("translation", "STEP", &[[1.0, 0.0, 0.0], [2.0, 0.0, 0.0], [3.0, 0.0, 0.0]]);
    for (time, x) in [(0.0, 1.0), (1.0, 1.0), (1.999, 1.0), (2.0, 2.0), (3.999, 2.0), (4.0, 3.0), (100.0, 3.0)] {
        assert_near(place(&mut model, WHEEL, time), DVec3::X * x);
    }
}

#[test]
fn lines_are_straight_and_hold_still_outside_their_keys() {
    let mut model = animated("translation", "LINEAR", &[[1.0, 0.0, 0.0], [2.0, 0.0, 4.0], [8.0, 2.0, 4.0]]);
    for (time, expected) in [
        (0.0, DVec3::new(1.0, 0.0, 0.0)),
        (1.25, DVec3::new(1.25, 0.0, 1.0)),
        (2.0, DVec3::new(2.0, 0.0, 4.0)),
        (3.0, DVec3::new(5.0, 1.0, 4.0)),
        (9.0, DVec3::new(8.0, 2.0, 4.0)),
    ] {
        assert_near(place(&mut model, WHEEL, time), expected);
    }
}

#[test]
fn rotations_turn_evenly_the_shorter_way() {
    let half = (FRAC_PI_2 / 2.0).sin() as f32;
    // The second key is a quarter turn about z, written with the other sign; the third is not of unit length.
    let keys = [[0.0, 0.0, 0.0, 1.0], [0.0, 0.0, -half, -half], [0.0, 0.0, 3.0, 0.0]];
    let mut model = animated("rotation", "LINEAR", &keys);
    for (time, turn) in [(0.5, 0.0), (1.0, 0.0), (1.25, 0.25), (1.9, 0.9), (2.0, 1.0), (3.5, 1.75), (5.0, 2.0)] {
        // The wheel is twice as high as wide, and at (0, 0, 5).
        let spoke = DQuat::from_rotation_z(turn * FRAC_PI_2) * DVec3::X;
        assert_near(place(&mut model, RIM, time), DVec3::Z * 5.0 + spoke);
    }
}

#[test]
fn splines_follow_a_cubic_with_their_tangents() {
    // x = t^3 - t, y = t^2: values and slopes at t = 1, 2, 4 determine the curve.
    let key = |t: f32| {
        let slope = [3.0 * t * t - 1.0, 2.0 * t, 0.0];
        [slope, [t * t * t - t, t * t, 0.0], slope]
    };
    let mut model = animated("translation", "CUBICSPLINE", [key(1.0), key(2.0), key(4.0)].as_flattened());
    for time in [1.0, 1.3, 2.0, 2.5, 3.9, 4.0] {
        assert_near(place(&mut model, WHEEL, time), DVec3::new(time * time * time - time, time * time, 0.0));
    }
    assert_near(place(&mut model, WHEEL, 0.0), DVec3::new(0.0, 1.0, 0.0));
    assert_near(place(&mut model, WHEEL, 7.0), DVec3::new(60.0, 16.0, 0.0));
}

#[test]
fn splined_rotations_are_rotations() {
    let flat = [0.0; 4];
    let keys = [flat, [0.0, 0.0, 0.0, 1.0], flat, flat, [1.0, 0.0, 0.0, 0.0], flat, flat, [1.0, 0.0, 0.0, 0.0], flat];
    let mut model = animated("rotation", "CUBICSPLINE", &keys);
    model.pose(Some(1.5)).expect("finite");
    // Halfway between no turn and a half turn about x, by symmetry.
    let matrix = model.nodes[WHEEL].world_from_local.matrix3;
    assert_near(matrix.y_axis, DVec3::Z * 2.0);
    assert_near(matrix.z_axis, DVec3::NEG_Y);
}

#[test]
fn scales_act_on_the_children() {
    let mut model = animated("scale", "LINEAR", &[[1.0, 1.0, 1.0], [3.0, 1.0, 1.0], [0.0, 1.0, 1.0]]);
    assert_near(place(&mut model, RIM, 1.5), DVec3::new(2.0, 0.0, 5.0));
    assert_near(place(&mut model, RIM, 4.0), DVec3::new(0.0, 0.0, 5.0));
}

#[test]
fn the_rest_pose_is_not_a_time() {
    let mut model = animated("translation", "LINEAR", &[[1.0; 3]; 3]);
    let rest = DVec3::new(1.0, 0.0, 5.0);
    assert_near(model.nodes[RIM].world_from_local.translation, rest);
    assert_near(place(&mut model, RIM, 0.0), DVec3::new(2.0, 1.0, 1.0));
    model.pose(None).expect("finite");
    assert_near(model.nodes[RIM].world_from_local.translation, rest);
    assert_eq!(model.warnings, [NO_MESHES]);
}

#[test]
fn of_two_animations_the_later_wins_where_both_act() {
    let mut doc = wheel();
    let input = doc.floats(&TIMES);
    let (near, far) = (doc.floats(&[[1.0; 3]; 3]), doc.floats(&[[7.0; 3]; 3]));
    animate(&mut doc, "translation", "LINEAR", input, near);
    animate(&mut doc, "scale", "LINEAR", input, far);
    animate(&mut doc, "translation", "LINEAR", input, far);
    assert_near(place(&mut doc.model(), RIM, 3.0), DVec3::new(14.0, 7.0, 7.0));
    doc.json["animations"].as_array_mut().expect("a list").swap(0, 2);
    assert_near(place(&mut doc.model(), RIM, 3.0), DVec3::new(8.0, 1.0, 1.0));
}

#[test]
fn sparse_and_normalised_values_are_read() {
    let mut doc = wheel();
    let input = doc.floats(&TIMES);
    let output = doc.floats(&[[0.0; 3]; 3]);
    let (places, values) = (doc.view(&[2]), doc.view(&float_bytes(&[[6.0f32, 0.0, 0.0]])));
    doc.json["accessors"][output]["sparse"] = json!({
        "count": 1, "indices": {"bufferView": places, "componentType": U8}, "values": {"bufferView": values}});
    animate(&mut doc, "translation", "LINEAR", input, output);
    let turns: Vec<u8> = [[0i16, 0, 0, 32767], [0, 0, 32767, 0], [0, 0, 32767, 0]]
        .as_flattened()
        .iter()
        .flat_map(|v| v.to_le_bytes())
        .collect();
    let output = doc.accessor(&turns, 5122, "VEC4", 3);
    doc.json["accessors"][output]["normalized"] = json!(true);
    animate(&mut doc, "rotation", "STEP", input, output);
    assert_near(place(&mut doc.model(), RIM, 3.0), DVec3::new(3.0 - 1.0, 0.0, 0.0));
}

#[test]
fn cameras_and_bounds_follow() {
    let mut doc = wheel();
    let position = doc.square();
    let mesh = doc.push("meshes", json!({"primitives": [{"attributes": {"POSITION": position}, "mode": 6}]}));
    doc.json["nodes"][RIM]["mesh"] = json!(mesh);
    doc.push("cameras", json!({"type": "perspective", "perspective": {"yfov": 1, "znear": 0.5}}));
    doc.json["nodes"][RIM]["camera"] = json!(0);
    let (input, output) = (doc.floats(&TIMES), doc.floats(&[[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [4.0, 0.0, 0.0]]));
    animate(&mut doc, "translation", "LINEAR", input, output);
    let mut model = doc.model();
    assert!(matches!(model.cameras[0], Camera::Perspective { .. }));
    assert_near(place(&mut model, RIM, 1.5), DVec3::new(3.0, 0.0, 0.0));
    assert_near(model.bounds().min, DVec3::new(3.0, 0.0, 0.0));
    assert_near(model.bounds().max, DVec3::new(4.0, 2.0, 0.0));
}

#[test]
fn what_is_not_played_is_told() {
    let mut doc = wheel();
    let (input, output) = (doc.floats(&TIMES), doc.floats(&[[1.0; 3]; 3]));
    animate(&mut doc, "translation", "LINEAR", input, output);
    let pointer = json!({"sampler": 0, "target": {"path": "pointer", "extensions": {"KHR_animation_pointer": {}}}});
    let channels = doc.json["animations"][0]["channels"].as_array_mut().expect("a list");
    channels.push(json!({"sampler": 0, "target": {"node": WHEEL, "path": "weights"}}));
    channels.push(pointer);
    doc.json["extensionsUsed"] = json!(["KHR_animation_pointer"]);
    let mut model = doc.model();
    assert_eq!(
        model.warnings,
        [
            "1 animation channel without a target node left out",
            "extensions left out: KHR_animation_pointer",
            "animation 0 `Turn`: 1 channel of weights not played: morph targets are not applied",
            NO_MESHES
        ]
    );
    assert_near(place(&mut model, WHEEL, 0.0), DVec3::ONE);
}

/// A file with a sound animation that is then broken.
fn broken(change: impl Fn(&mut Value)) -> Vec<u8> {
    let mut doc = wheel();
    let (input, output) = (doc.floats(&TIMES), doc.floats(&[[0.0, 0.0, 0.0, 1.0]; 3]));
    animate(&mut doc, "rotation", "LINEAR", input, output);
    doc.floats(&[[1.0f32], [2.0], [1.5]]);
    doc.floats(&[[1.0f32], [f32::NAN], [3.0]]);
    doc.floats(&[[0.0f32, 0.0, 0.0, 1.0], [0.0; 4], [0.0, 0.0, f32::INFINITY, 0.0]]);
    doc.floats(&[[1e30f32; 3]; 3]);
    change(&mut doc.json);
    doc.gltf()
}

#[test]
fn each_fault_is_named() {
    let animation = |pointer: &'static str, value: Value| {
        broken(move |json| *json["animations"][0].pointer_mut(pointer).expect(pointer) = value.clone())
    };
    let cases = [
        ("node-out-of-range", animation("/channels/0/target/node", json!(9))),
        (
            "node-with-a-matrix",
            broken(|json| json["nodes"][WHEEL] = json!({"matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]})),
        ),
        ("path-unknown", animation("/channels/0/target/path", json!("colour"))),
        ("path-of-another-type", animation("/channels/0/target/path", json!("scale"))),
        ("sampler-out-of-range", animation("/channels/0/sampler", json!(1))),
        ("interpolation-unknown", animation("/samplers/0/interpolation", json!("BEZIER"))),
        ("input-out-of-range", animation("/samplers/0/input", json!(77))),
        ("input-of-vectors", animation("/samplers/0/input", json!(1))),
        ("times-that-fall", animation("/samplers/0/input", json!(2))),
        ("time-not-a-number", animation("/samplers/0/input", json!(3))),
        ("no-times", broken(|json| json["accessors"][0]["count"] = json!(0))),
        ("too-few-values", broken(|json| json["accessors"][1]["count"] = json!(2))),
        ("spline-without-tangents", animation("/samplers/0/interpolation", json!("CUBICSPLINE"))),
        ("value-not-finite", animation("/samplers/0/output", json!(4))),
        ("more-than-the-bytes", broken(|json| json["accessors"][1]["bufferView"] = json!(0))),
    ];
    let mut texts = String::new();
    for (name, bytes) in cases {
        let error = load(&bytes, None).err().unwrap_or_else(|| panic!("{name} loads"));
        texts.push_str(&format!("{name}\n    {error}\n"));
    }
    insta::assert_snapshot!(texts);
    assert!(load(&broken(|_| ()), None).is_ok(), "the unbroken file loads");
}

#[test]
fn a_rotation_of_zero_is_named() {
    let mut doc = wheel();
    let (input, output) = (doc.floats(&TIMES), doc.floats(&[[0.0, 0.0, 0.0, 1.0], [0.0; 4], [1.0; 4]]));
    animate(&mut doc, "rotation", "LINEAR", input, output);
    let error = doc.load().expect_err("no rotation").to_string();
    assert!(error.ends_with("the rotation of key 1 is zero, expected a quaternion"), "{error}");
}

#[test]
fn a_pose_beyond_all_numbers_names_the_node() {
    let mut doc = wheel();
    for n in 0..12 {
        let parent = doc.json["nodes"].as_array().expect("a list").len() - 1;
        let node = doc.push("nodes", json!({"name": format!("Deep.{n}"), "scale": [1e30, 1e30, 1e30]}));
        if n > 0 {
            doc.json["nodes"][parent]["children"] = json!([node]);
        }
    }
    doc.json["nodes"][2]["scale"] = json!([0, 0, 0]);
    let (input, output) = (doc.floats(&TIMES), doc.floats(&[[1e30f32; 3]; 3]));
    animate(&mut doc, "scale", "LINEAR", input, output);
    doc.json["animations"][0]["channels"][0]["target"]["node"] = json!(2);
    let mut model = doc.model();
    let error = model.pose(Some(2.0)).expect_err("1e360").to_string();
    assert_eq!(error, "test.gltf: node 12 `Deep.10`: its transform, with those of its ancestors, is not finite");
}
