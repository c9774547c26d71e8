//! One property a test, on files of a few triangles.

use glam::{DVec3, Vec2, Vec3, Vec4};
use lenspeel::scene::{AlphaMode, Camera, LightKind, Mips, Model, Primitive, Wrap};
use lenspeel::spec::SceneChoice;
use serde_json::json;

use super::builder::*;

fn first(model: &Model) -> &Primitive {
    &model.meshes[0].primitives[0]
}

#[test]
fn triangles_without_indices_normals_or_material() {
    let mut doc = Doc::new();
    let position = doc.square();
    doc.show(json!({"attributes": {"POSITION": position}}));
    let model = doc.model();
    assert_eq!(first(&model).triangles, [[0, 1, 2]], "the fourth corner makes no triangle");
    assert_eq!(first(&model).normals, None);
    assert_eq!(first(&model).material, 0);
    assert_eq!(model.materials.len(), 1, "glTF's default material");
    assert_eq!(model.warnings, ["mesh 0 `Shape`, primitive 0: 1 corner after the last whole triangle left out"]);
}

#[test]
fn indices_of_every_width() {
    for (component, bytes) in
        [(U8, vec![2, 1, 0]), (U16, vec![2, 0, 1, 0, 0, 0]), (U32, vec![2, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0])]
    {
        let mut doc = Doc::new();
        let (position, indices) = (doc.square(), doc.accessor(&bytes, component, "SCALAR", 3));
        doc.show(json!({"attributes": {"POSITION": position}, "indices": indices}));
        assert_eq!(first(&doc.model()).triangles, [[2, 1, 0]], "{component}");
    }
}

#[test]
fn strips_alternate_and_fans_share_their_first_corner() {
    for (mode, expected) in [(5, [[0, 1, 2], [1, 3, 2]]), (6, [[1, 2, 0], [2, 3, 0]])] {
        let mut doc = Doc::new();
        let position = doc.square();
        doc.show(json!({"attributes": {"POSITION": position}, "mode": mode}));
        assert_eq!(first(&doc.model()).triangles, expected, "mode {mode}");
    }
}

#[test]
fn strip_joints_vanish_silently_and_repeated_corners_of_lists_with_a_warning() {
    for (mode, indices, expected, warnings) in
        [(5, vec![0u8, 1, 2, 2, 3], vec![[0, 1, 2]], 0), (4, vec![0, 1, 2, 3, 3, 0], vec![[0, 1, 2]], 1)]
    {
        let mut doc = Doc::new();
        let position = doc.square();
        let indices = doc.accessor(&indices, U8, "SCALAR", indices.len());
        doc.show(json!({"attributes": {"POSITION": position}, "indices": indices, "mode": mode}));
        let model = doc.model();
        assert_eq!(first(&model).triangles, expected, "mode {mode}");
        assert_eq!(model.warnings.len(), warnings, "{:?}", model.warnings);
    }
}

#[test]
fn points_and_lines_are_left_out_by_name() {
    let mut doc = Doc::new();
    let position = doc.square();
    for mode in [0, 1] {
        doc.show(json!({"attributes": {"POSITION": position}, "mode": mode}));
    }
    let model = doc.model();
    assert!(model.meshes.iter().all(|m| m.primitives.is_empty()));
    assert_eq!(
        model.warnings,
        [
            "mesh 0 `Shape`, primitive 0: points left out, only triangles are drawn",
            "mesh 1 `Shape`, primitive 0: lines left out, only triangles are drawn",
            "there is nothing to see: 2 nodes in the scene, and no triangles that are shown"
        ]
    );
}

#[test]
fn sparse_values_replace_stored_ones_and_zeros() {
    for with_base in [true, false] {
        let mut doc = Doc::new();
        let position = doc.square();
        let (indices, values) = (doc.view(&[1, 0, 3, 0]), doc.view(&float_bytes(&[[5.0, 6.0, 7.0], [8.0, 9.0, 1.0]])));
        let accessor = &mut doc.json["accessors"][position];
        accessor["sparse"] = json!({
            "count": 2,
            "indices": {"bufferView": indices, "componentType": U16},
            "values": {"bufferView": values},
        });
        if !with_base {
            accessor.as_object_mut().expect("an object").remove("bufferView");
        }
        doc.show(json!({"attributes": {"POSITION": position}}));
        let third = if with_base { Vec3::new(1.0, 1.0, 0.0) } else { Vec3::ZERO };
        let expected = [Vec3::ZERO, Vec3::new(5.0, 6.0, 7.0), third, Vec3::new(8.0, 9.0, 1.0)];
        assert_eq!(first(&doc.model()).positions, expected, "base: {with_base}");
    }
}

#[test]
fn interleaved_attributes_follow_their_stride() {
    let mut doc = Doc::new();
    let rows = [[0.0, 0.0, 0.0, 0.25, 0.5], [1.0, 0.0, 0.0, 0.75, 0.5], [0.0, 1.0, 0.0, 0.0, 1.0]];
    let view = doc.view(&float_bytes(&rows));
    doc.json["bufferViews"][view]["byteStride"] = json!(20);
    let mut part = |offset: u32, kind: &str| {
        let json = json!({"bufferView": view, "byteOffset": offset, "componentType": F32, "type": kind, "count": 3});
        doc.push("accessors", json)
    };
    let (position, uv) = (part(0, "VEC3"), part(12, "VEC2"));
    doc.show(json!({"attributes": {"POSITION": position, "TEXCOORD_0": uv}}));
    let model = doc.model();
    assert_eq!(first(&model).positions[1], Vec3::X);
    assert_eq!(first(&model).uv[0].as_deref(), Some(&[Vec2::new(0.25, 0.5), Vec2::new(0.75, 0.5), Vec2::Y][..]));
}

#[test]
fn colours_of_every_kind() {
    let half = Vec4::new(1.0, 0.0, 0.2, 1.0);
    for (component, kind, bytes) in [
        (U8, "VEC3", [255u8, 0, 51].repeat(4)),
        (U8, "VEC4", [255u8, 0, 51, 255].repeat(4)),
        (U16, "VEC4", [0xffu8, 0xff, 0, 0, 0x33, 0x33, 0xff, 0xff].repeat(4)),
        (F32, "VEC3", float_bytes(&[[1.0, 0.0, 0.2]; 4])),
        (F32, "VEC4", float_bytes(&[[1.0, 0.0, 0.2, 1.0]; 4])),
    ] {
        let mut doc = Doc::new();
        let (position, color) = (doc.square(), doc.accessor(&bytes, component, kind, 4));
        doc.json["accessors"][color]["normalized"] = json!(component != F32);
        doc.show(json!({"attributes": {"POSITION": position, "COLOR_0": color}}));
        let model = doc.model();
        assert_eq!(first(&model).colors.as_deref(), Some(&[half; 4][..]), "{component} {kind}");
    }
}

#[test]
fn normals_are_unit_and_broken_ones_rebuilt() {
    let mut doc = Doc::new();
    let position = doc.square();
    let normal = doc.floats(&[[0.0, 3.0, 0.0], [0.0; 3], [f32::NAN, 0.0, 0.0], [0.0; 3]]);
    let tangent = doc.floats(&[[2.0, 0.0, 0.0, -1.0], [0.0, 0.0, 0.0, 1.0], [1.0, 0.0, 0.0, 1.0], [1.0; 4]]);
    doc.show(json!({"attributes": {"POSITION": position, "NORMAL": normal, "TANGENT": tangent}, "mode": 4}));
    let model = doc.model();
    assert_eq!(first(&model).normals.as_deref(), Some(&[Vec3::Y, Vec3::Z, Vec3::Z, Vec3::Z][..]));
    let tangents = first(&model).tangents.as_ref().expect("tangents");
    assert_eq!(tangents[0], Vec4::new(1.0, 0.0, 0.0, -1.0));
    assert!(tangents[1].truncate().is_normalized() && tangents[1].z == 0.0);
    assert!(model.warnings.iter().any(|w| w.ends_with("3 normals of zero length rebuilt")), "{:?}", model.warnings);
}

#[test]
fn negative_scale_and_matrices_place_nodes() {
    let mut doc = Doc::new();
    let position = doc.square();
    doc.show(json!({"attributes": {"POSITION": position}}));
    doc.json["nodes"][0]["scale"] = json!([-2, 1, 1]);
    let half = std::f32::consts::FRAC_1_SQRT_2;
    let child = doc.push("nodes", json!({"rotation": [0, 0, half, half], "translation": [1, 0, 0], "mesh": 0}));
    doc.json["nodes"][0]["children"] = json!([child]);
    doc.node(json!({"matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, 0, 3, 4, 5, 1], "mesh": 0}));
    let model = doc.model();
    assert!(model.nodes[0].world_from_local.matrix3.determinant() < 0.0);
    let bounds = model.node_bounds(0);
    assert_eq!((bounds.min.x, bounds.max.x), (-2.0, 0.0));
    // (1, 0, 0) turns to (0, 1, 0), moves to (1, 1, 0), and is mirrored and stretched to (-2, 1, 0).
    let moved = model.nodes[child].world_from_local.transform_point3(DVec3::X);
    assert!(moved.distance(DVec3::new(-2.0, 1.0, 0.0)) < 1e-6, "{moved}");
    assert_eq!(model.nodes[2].world_from_local.transform_point3(DVec3::Z), DVec3::new(3.0, 4.0, 4.0));
    assert_eq!(model.nodes[child].parent, Some(0));
    assert!(model.nodes.iter().all(|n| n.drawn));
}

fn two_scenes() -> Vec<u8> {
    let mut doc = Doc::new();
    let position = doc.square();
    doc.show(json!({"attributes": {"POSITION": position}}));
    let other = doc.push("nodes", json!({"name": "Other", "mesh": 0}));
    doc.json["scenes"][0]["name"] = json!("Outside");
    doc.push("scenes", json!({"name": "Inside", "nodes": [other]}));
    doc.gltf()
}

#[test]
fn scenes_are_chosen_by_name_or_index() {
    let drawn = |choice: Option<&SceneChoice>| -> (usize, Vec<bool>) {
        let model = load(&two_scenes(), choice).expect("valid");
        (model.scene, model.nodes.iter().map(|n| n.drawn).collect())
    };
    assert_eq!(drawn(None), (0, vec![true, false]));
    assert_eq!(drawn(Some(&SceneChoice::Name("Inside".into()))), (1, vec![false, true]));
    assert_eq!(drawn(Some(&SceneChoice::Index(1))), (1, vec![false, true]));
    for (choice, what) in
        [(SceneChoice::Index(2), "no scene 2"), (SceneChoice::Name("inside".into()), "no scene named `inside`")]
    {
        let error = load(&two_scenes(), Some(&choice)).expect_err("there is none");
        assert_eq!(error.message, format!("test.gltf: {what}"));
        assert_eq!(error.help.as_deref(), Some("its scenes: 0 `Outside`, 1 `Inside`"));
    }
}

#[test]
fn a_file_without_scenes_shows_all_its_nodes() {
    let mut doc = Doc::new();
    let position = doc.square();
    doc.show(json!({"attributes": {"POSITION": position}}));
    for key in ["scene", "scenes"] {
        doc.json.as_object_mut().expect("an object").remove(key);
    }
    assert!(doc.model().nodes[0].drawn);
}

#[test]
fn glb_and_data_uris_and_external_files_give_the_same() {
    let mut doc = Doc::new();
    let position = doc.square();
    doc.show(json!({"attributes": {"POSITION": position}, "mode": 6}));
    let from_uri = doc.model();
    let from_glb = load(&doc.glb(), None).expect("valid");
    let mut external = doc.json.clone();
    external["buffers"] = json!([{"byteLength": doc.bin.len(), "uri": "a%20b.bin"}]);
    let mut asked = Vec::new();
    let from_file = Model::from_bytes(&serde_json::to_vec(&external).expect("JSON"), "x", None, &mut |uri| {
        asked.push(uri.to_string());
        Ok(doc.bin.clone())
    })
    .expect("valid");
    assert_eq!(asked, ["a b.bin"]);
    for model in [from_glb, from_file] {
        assert_eq!(first(&model).positions, first(&from_uri).positions);
        assert_eq!(first(&model).triangles, first(&from_uri).triangles);
    }
}

#[test]
fn alpha_modes_sidedness_unlit_and_emissive_strength() {
    let mut doc = Doc::new();
    for material in [
        json!({"name": "plain"}),
        json!({"alphaMode": "MASK"}),
        json!({"alphaMode": "MASK", "alphaCutoff": 0.25, "doubleSided": true}),
        json!({"alphaMode": "BLEND", "pbrMetallicRoughness": {"baseColorFactor": [1, 0, 0, 0.5], "metallicFactor": 0}}),
        json!({"emissiveFactor": [1, 0.5, 0], "extensions": {
            "KHR_materials_unlit": {}, "KHR_materials_emissive_strength": {"emissiveStrength": 4}}}),
    ] {
        doc.push("materials", material);
    }
    let materials = doc.model().materials;
    let modes: Vec<AlphaMode> = materials.iter().map(|m| m.alpha_mode).collect();
    use AlphaMode::*;
    assert_eq!(modes, [Opaque, Mask(0.5), Mask(0.25), Blend, Opaque, Opaque]);
    assert!(materials[2].double_sided && !materials[1].double_sided);
    assert_eq!((materials[3].base_color, materials[3].metallic), ([1.0, 0.0, 0.0, 0.5], 0.0));
    assert_eq!((materials[4].emissive, materials[4].unlit), ([4.0, 2.0, 0.0], true));
}

#[test]
fn texture_transforms_in_every_slot() {
    let mut doc = Doc::new();
    let image = png(image::DynamicImage::new_rgb8(1, 1));
    doc.push("images", json!({"uri": data_uri(&image)}));
    doc.push("samplers", json!({"magFilter": 9728, "minFilter": 9984, "wrapS": 33071, "wrapT": 33648}));
    doc.push("textures", json!({"source": 0, "sampler": 0}));
    doc.push("textures", json!({"source": 0}));
    let slot = json!({"index": 0, "texCoord": 0, "extensions": {
        "KHR_texture_transform": {"offset": [0.5, 0.25], "rotation": 1.5, "scale": [2, 3], "texCoord": 1}}});
    doc.push(
        "materials",
        json!({
            "pbrMetallicRoughness": {"baseColorTexture": slot, "metallicRoughnessTexture": slot},
            "normalTexture": slot, "occlusionTexture": slot, "emissiveTexture": {"index": 1}
        }),
    );
    let model = doc.model();
    let roles: Vec<_> = model.materials[0].textures().collect();
    assert_eq!(roles.len(), 5);
    for (role, texture) in &roles[..4] {
        let found = (texture.offset, texture.rotation, texture.scale, texture.uv_set);
        assert_eq!(found, ([0.5, 0.25], -1.5, [2.0, 3.0], 1), "{role}");
    }
    assert_eq!((roles[4].1.scale, roles[4].1.uv_set), ([1.0, 1.0], 0));
    let sampler = model.textures[0].sampler;
    assert_eq!(sampler.wrap, [Wrap::ClampToEdge, Wrap::MirroredRepeat]);
    assert_eq!((sampler.mag_linear, sampler.min_linear, sampler.mips), (false, false, Mips::Nearest));
    assert_eq!(model.textures[1].sampler, Default::default());
}

#[test]
fn images_of_every_depth_become_rgba8() {
    use image::{DynamicImage, ImageBuffer, Luma, LumaA, Rgb};
    let gray16: ImageBuffer<Luma<u16>, _> = ImageBuffer::from_pixel(2, 1, Luma([0x8080u16]));
    let rgb16: ImageBuffer<Rgb<u16>, _> = ImageBuffer::from_pixel(2, 1, Rgb([0xffffu16, 0, 0x8080]));
    let gray_alpha: ImageBuffer<LumaA<u8>, _> = ImageBuffer::from_pixel(2, 1, LumaA([10u8, 20]));
    for (image, expected) in [
        (DynamicImage::ImageLuma16(gray16), [128, 128, 128, 255]),
        (DynamicImage::ImageRgb16(rgb16), [255, 0, 128, 255]),
        (DynamicImage::ImageLumaA8(gray_alpha), [10, 10, 10, 20]),
    ] {
        let mut doc = Doc::new();
        let view = doc.view(&png(image));
        doc.push("images", json!({"name": "picture", "bufferView": view, "mimeType": "image/png"}));
        doc.push("images", json!({"uri": "nobody-asks.ktx2"}));
        doc.push("textures", json!({"source": 0}));
        doc.push("materials", json!({"emissiveTexture": {"index": 0}}));
        let model = doc.model();
        assert_eq!((model.images[0].width, model.images[0].height), (2, 1));
        assert_eq!(model.images[0].pixels, [expected; 2]);
        assert_eq!(model.images[1].pixels, [[255; 4]], "not used, not opened");
        assert_eq!(model.used_images(), [0]);
    }
}

#[test]
fn lights_and_cameras() {
    let mut doc = Doc::new();
    doc.json["extensions"] = json!({"KHR_lights_punctual": {"lights": [
        {"type": "directional", "color": [1, 0.5, 0], "intensity": 3},
        {"type": "point", "range": 7},
        {"type": "spot", "name": "lamp", "spot": {"innerConeAngle": 0.25, "outerConeAngle": 0.5}},
    ]}});
    doc.json["extensionsUsed"] = json!(["KHR_lights_punctual"]);
    doc.json["extensionsRequired"] = json!(["KHR_lights_punctual"]);
    doc.push("cameras", json!({"type": "perspective", "perspective": {"yfov": 1, "znear": 0.5}}));
    doc.push("cameras", json!({"type": "orthographic", "orthographic": {"xmag": 3, "ymag": 2, "znear": 0, "zfar": 9}}));
    doc.node(json!({"camera": 1, "extensions": {"KHR_lights_punctual": {"light": 2}}}));
    let model = doc.model();
    let kinds: Vec<LightKind> = model.lights.iter().map(|l| l.kind).collect();
    let spot = LightKind::Spot { inner: 0.25, outer: 0.5 };
    assert_eq!(kinds, [LightKind::Directional, LightKind::Point, spot]);
    assert_eq!((model.lights[0].color, model.lights[0].intensity), ([1.0, 0.5, 0.0], 3.0));
    assert_eq!((model.lights[0].range, model.lights[1].range), (None, Some(7.0)));
    let perspective = Camera::Perspective { fov_y: 1.0, near: 0.5, far: None };
    assert_eq!(model.cameras, [perspective, Camera::Orthographic { half_height: 2.0, near: 0.0, far: 9.0 }]);
    assert_eq!((model.nodes[0].camera, model.nodes[0].light), (Some(1), Some(2)));
    assert_eq!(model.extensions, ["KHR_lights_punctual"]);
    assert_eq!(model.warnings, ["there is nothing to see: 1 node in the scene, and no triangles that are shown"]);
}

#[test]
fn rest_pose_and_unknown_extensions_are_told() {
    let mut doc = Doc::new();
    let position = doc.square();
    doc.show(json!({"attributes": {"POSITION": position, "CUSTOM": position}, "mode": 6, "targets": [{"POSITION": position}]}));
    doc.push("skins", json!({"joints": [0]}));
    doc.json["nodes"][0]["skin"] = json!(0);
    doc.json["extensionsUsed"] = json!(["KHR_materials_sheen"]);
    assert_eq!(
        doc.model().warnings,
        [
            "extensions left out: KHR_materials_sheen",
            "skins of 1 of 1 node with a mesh not applied: shown as stored",
            "mesh 0 `Shape`: 1 morph target not applied"
        ]
    );
}
