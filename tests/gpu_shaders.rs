//! Every assembled shader is valid, follows our own lints, and agrees with Rust about the layout of records.
#![cfg(feature = "gpu")]

use std::mem::{offset_of, size_of};

use lenspeel::gpu::layout::{FrameRecord, ItemRecord, LensRecord, PartRecord, StepRecord, TextureInfo, sample_bytes};
use lenspeel::gpu::{Module, Needs, source};
use lenspeel::plan::{GlassRecord, LightRecord, Op};
use lenspeel::scene::{MaterialRecord, TextureSlot};
use naga::{Handle, ShaderStage, Type, TypeInner};

/// A plan that needs little, one of two words, and the most that there can be.
const NEEDS: [Needs; 4] = [LITTLE, TWO_WORDS, TWO_WORDS_OF_LAYERS, MOST];
const LITTLE: Needs = Needs {
    set_words: 1,
    part_words: 1,
    lenses: false,
    rules: false,
    layers: false,
    taken_away: false,
    compounds: false,
    forms: [false; 4],
    movers: false,
    versions: false,
    caps: false,
    soft: false,
    glass: false,
    contact: false,
    translucent: false,
    textures: false,
    vertex_colors: false,
    lights: 0,
    stages: [false; 3],
    filters: 0,
    quantities: false,
    hidden_lines: false,
    wide: false,
    channels: 0,
    screen: false,
    planes: false,
    accounts: false,
};
const TWO_WORDS: Needs = Needs { set_words: 2, lenses: true, ..LITTLE };
const TWO_WORDS_OF_LAYERS: Needs = Needs { layers: true, ..TWO_WORDS };
const MOST: Needs = Needs {
    rules: true,
    set_words: 12,
    part_words: 3,
    lenses: true,
    layers: true,
    taken_away: true,
    compounds: true,
    forms: [true; 4],
    movers: true,
    versions: true,
    caps: true,
    soft: true,
    glass: true,
    contact: true,
    translucent: true,
    textures: true,
    vertex_colors: true,
    lights: 3,
    stages: [true; 3],
    filters: u64::MAX,
    quantities: true,
    hidden_lines: true,
    wide: true,
    channels: 3,
    screen: true,
    planes: true,
    accounts: false,
};
/// Twin of the limit that `caps.rs` asks for.
const STORAGE_BUFFERS: usize = 21;

fn parsed(module: Module, needs: Needs) -> naga::Module {
    let text = source(module, &needs, &lenspeel::custom::wgsl(&[]));
    naga::front::wgsl::parse_str(&text)
        .unwrap_or_else(|e| panic!("{} with {needs:?}: {}", module.name(), e.emit_to_string(&text)))
}

fn validated(module: Module, needs: Needs) -> (naga::Module, naga::valid::ModuleInfo) {
    let parsed = parsed(module, needs);
    let mut validator =
        naga::valid::Validator::new(naga::valid::ValidationFlags::all(), naga::valid::Capabilities::empty());
    let info = validator.validate(&parsed).unwrap_or_else(|e| {
        panic!("{}: {}", module.name(), e.emit_to_string(&source(module, &needs, &lenspeel::custom::wgsl(&[]))))
    });
    (parsed, info)
}

#[test]
fn every_module_is_valid_for_every_plan() {
    for module in Module::ALL {
        for needs in NEEDS {
            assert!(!validated(module, needs).0.entry_points.is_empty());
        }
    }
}

/// What the driver sees.
#[test]
fn every_module_is_valid_without_what_a_plan_does_not_need() {
    for module in Module::ALL {
        for needs in NEEDS {
            let whole = parsed(module, needs);
            let count = |module: &naga::Module| module.functions.len();
            let entries: Vec<&str> = whole.entry_points.iter().map(|entry| entry.name.as_str()).collect();
            let pruned = lenspeel::gpu::pruned(whole.clone(), &entries);
            assert!(needs == MOST || count(&pruned) < count(&whole), "{} stays whole", module.name());
            assert_eq!(pruned.entry_points.len(), whole.entry_points.len());
            let all = naga::valid::ValidationFlags::all();
            let outcome = naga::valid::Validator::new(all, naga::valid::Capabilities::empty()).validate(&pruned);
            assert!(outcome.is_ok(), "{} with {needs:?}: {outcome:?}", module.name());
        }
    }
}

/// Browsers refuse `textureSample` where control flow is not uniform, and naga lets it pass: texels are loaded.
fn samples_textures(module: &naga::Module) -> bool {
    let functions = module.functions.iter().map(|(_, f)| f).chain(module.entry_points.iter().map(|e| &e.function));
    functions
        .flat_map(|f| f.expressions.iter())
        .any(|(_, e)| matches!(e, naga::Expression::ImageSample { .. } | naga::Expression::Derivative { .. }))
}

#[test]
fn no_module_samples_textures_or_takes_derivatives() {
    for module in Module::ALL {
        assert!(!samples_textures(&parsed(module, MOST)), "{} must use textureLoad", module.name());
    }
}

#[test]
fn the_sampling_lint_finds_what_it_looks_for() {
    let text = "@group(0) @binding(0) var t: texture_2d<f32>; @group(0) @binding(1) var s: sampler;
        @fragment fn f(@location(0) p: vec2f) -> @location(0) vec4f { return textureSample(t, s, p); }";
    assert!(samples_textures(&naga::front::wgsl::parse_str(text).unwrap()));
}

/// Whether a vertex entry point's position is `@invariant`: pipelines that share it then agree on depth.
fn position_is_invariant(module: &naga::Module, entry: &naga::EntryPoint) -> bool {
    let result = entry.function.result.as_ref().expect("a vertex function has a result");
    let invariant = |binding: &Option<naga::Binding>| {
        matches!(binding, Some(naga::Binding::BuiltIn(naga::BuiltIn::Position { invariant: true })))
    };
    match &module.types[result.ty].inner {
        TypeInner::Struct { members, .. } => members.iter().any(|m| invariant(&m.binding)),
        _ => invariant(&result.binding),
    }
}

#[test]
fn the_scene_is_drawn_at_invariant_positions() {
    let module = parsed(Module::Visibility, MOST);
    let vertex: Vec<_> = module.entry_points.iter().filter(|e| e.stage == ShaderStage::Vertex).collect();
    assert_eq!(vertex.len(), 1, "all pipelines share one vertex function");
    assert!(position_is_invariant(&module, vertex[0]));
}

#[test]
fn no_stage_binds_more_storage_buffers_than_are_asked_for() {
    for module in Module::ALL {
        let (module_ir, info) = validated(module, MOST);
        for (index, entry) in module_ir.entry_points.iter().enumerate() {
            let used = module_ir
                .global_variables
                .iter()
                .filter(|(_, v)| matches!(v.space, naga::AddressSpace::Storage { .. }))
                .filter(|(handle, _)| !info.get_entry_point(index)[*handle].is_empty())
                .count();
            assert!(used <= STORAGE_BUFFERS, "`{}` uses {used} storage buffers", entry.name);
        }
    }
}

/// Name and offset of each member, and the size, of a struct in WGSL.
fn wgsl_layout(module: &naga::Module, name: &str) -> (Vec<(String, u32)>, u32) {
    let is_named = |(_, t): &(Handle<Type>, &Type)| t.name.as_deref() == Some(name);
    let (_, found) = module.types.iter().find(is_named).unwrap_or_else(|| panic!("there is no struct `{name}`"));
    let TypeInner::Struct { members, span } = &found.inner else { panic!("`{name}` is no struct") };
    (members.iter().map(|m| (m.name.clone().unwrap_or_default(), m.offset)).collect(), *span)
}

/// Compares a record of Rust with its twin: every listed field at the same offset.
macro_rules! same_layout {
    ($module:expr, $wgsl:literal, $rust:ty, [$($field:ident),* $(,)?]) => {{
        let (members, _) = wgsl_layout($module, $wgsl);
        $(
            let name = stringify!($field);
            let (_, offset) = members.iter().find(|(n, _)| n == name)
                .unwrap_or_else(|| panic!("`{}` has no `{name}` in WGSL", $wgsl));
            assert_eq!(offset_of!($rust, $field) as u32, *offset, "`{}::{name}`", $wgsl);
        )*
    }};
}

#[test]
fn records_have_the_same_layout_in_rust_and_in_wgsl() {
    let module = parsed(Module::Resolve, TWO_WORDS);
    let size = |name| wgsl_layout(&module, name).1 as usize;
    same_layout!(
        &module,
        "Frame",
        FrameRecord,
        [
            ray_dx,
            ray_dy,
            right,
            up,
            forward,
            clip_scale,
            clip_shift,
            middle,
            shares,
            near,
            far,
            perspective,
            layer,
            window_min,
            window_size,
            sample,
            sample_index,
            samples,
            ambient,
            texture_space,
            background,
            fragment_capacity,
            active_tiles,
            target_is_srgb,
            lens_count,
            rule_count,
            after_depth,
            after_key,
            after_item,
            tone_mapping,
            drawn_from_eye,
            origin,
            anchor,
            merge_most,
            merge_across,
            picture_scale,
            by_pixel,
            translucent,
            passed
        ]
    );
    assert_eq!(size("Frame"), size_of::<FrameRecord>());
    same_layout!(
        &module,
        "Item",
        ItemRecord,
        [
            row_x,
            row_y,
            row_z,
            material,
            first_triangle,
            flags,
            first_index,
            first_number,
            base_vertex,
            normals,
            tangents,
            colors,
            uv0,
            uv1,
            slots,
            center,
            first_step,
            step_count,
            body,
            caps,
            node,
            ratio,
            spread,
            planes,
            group,
            roles,
            lids,
            across,
        ]
    );
    // Six masks of two words each follow, then a channel of two words, then padding to 16 bytes.
    assert_eq!(size("Item"), (size_of::<ItemRecord>() + 6 * 2 * 4 + 2 * 4).next_multiple_of(16));
    same_layout!(&module, "Step", StepRecord, [row_x, row_y, row_z, rank]);
    assert_eq!(size("Step"), size_of::<StepRecord>());
    same_layout!(
        &module,
        "Lens",
        LensRecord,
        [glass, flags, first_part, part_count, first_token, token_count, first_op, op_count, soft]
    );
    // One set of two words follows, then padding to 16 bytes.
    assert_eq!(size("Lens"), (size_of::<LensRecord>() + 2 * 4).next_multiple_of(16));
    same_layout!(
        &module,
        "Part",
        PartRecord,
        [
            ray_origin,
            ray_direction,
            ray_dx,
            ray_dy,
            normal_x,
            normal_y,
            normal_z,
            local_x,
            local_y,
            local_z,
            lens,
            form,
            flags,
            first_plane,
            plane_count,
            hidden,
            first_corner,
            corner_count,
            r0,
            r1,
            length,
            first_node,
            node_count,
            first_triangle,
            first_vertex,
            crossing_room,
            first_projected,
            reference,
            origin
        ]
    );
    assert_eq!(size("Part"), size_of::<PartRecord>());
    same_layout!(&module, "TextureInfo", TextureInfo, [wrap_u, wrap_v, filter_bits, srgb, level_count, levels]);
    assert_eq!(size("TextureInfo"), size_of::<TextureInfo>());
}

#[test]
fn samples_of_the_screen_have_the_size_that_is_made_room_for() {
    for needs in NEEDS {
        let wgsl = wgsl_layout(&parsed(Module::Screen, needs), "ScreenSample").1;
        assert_eq!(u64::from(wgsl), sample_bytes(needs.set_words));
    }
}

#[test]
fn records_of_the_plan_and_the_scene_have_the_same_layout_in_wgsl() {
    let module = parsed(Module::Resolve, LITTLE);
    let size = |name| wgsl_layout(&module, name).1 as usize;
    same_layout!(&module, "Op", Op, [kind, texture, flags, a, b, c]);
    assert_eq!(size("Op"), size_of::<Op>());
    same_layout!(&module, "Light", LightRecord, [kind, range, cos_inner, cos_outer, position, direction, color]);
    assert_eq!(size("Light"), size_of::<LightRecord>());
    same_layout!(&module, "Glass", GlassRecord, [color, opacity, rim, outline, contact]);
    assert_eq!(size("Glass"), size_of::<GlassRecord>());
    same_layout!(&module, "TextureSlot", TextureSlot, [texture, uv_set, offset, matrix]);
    assert_eq!(size("TextureSlot"), size_of::<TextureSlot>());
    same_layout!(
        &module,
        "Material",
        MaterialRecord,
        [
            base_color,
            emissive,
            alpha_cutoff,
            metallic,
            roughness,
            normal_scale,
            occlusion_strength,
            alpha_mode,
            double_sided,
            unlit
        ]
    );
    assert_eq!(size("Material"), size_of::<MaterialRecord>());
    // The five slots of Rust's record are one list in WGSL.
    let (members, _) = wgsl_layout(&module, "Material");
    let slots = members.iter().find(|(name, _)| name == "slots").expect("`Material` has slots").1 as usize;
    let rust = [
        offset_of!(MaterialRecord, base_color_texture),
        offset_of!(MaterialRecord, metallic_roughness_texture),
        offset_of!(MaterialRecord, normal_texture),
        offset_of!(MaterialRecord, occlusion_texture),
        offset_of!(MaterialRecord, emissive_texture),
    ];
    for (i, offset) in rust.into_iter().enumerate() {
        assert_eq!(offset, slots + i * size_of::<TextureSlot>());
    }
}
