//! Puts the shader modules together from their files.

/// 32-bit words of sets, which shaders are compiled for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct SetWords {
    /// Of the lenses of a plan.
    pub lenses: u32,
    /// Of the parts of one lens.
    pub parts: u32,
}

/// A shader module: what one pipeline or a few of them run.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Module {
    DepthMap,
    Layers,
    Visibility,
    Resolve,
    Aov,
    Finish,
}

impl Module {
    pub const ALL: [Module; 6] =
        [Module::DepthMap, Module::Layers, Module::Visibility, Module::Resolve, Module::Aov, Module::Finish];

    /// How labels and messages call it.
    pub fn name(self) -> &'static str {
        match self {
            Module::DepthMap => "depth map",
            Module::Layers => "layers",
            Module::Visibility => "visibility",
            Module::Resolve => "resolve",
            Module::Aov => "aov",
            Module::Finish => "finish",
        }
    }

    fn parts(self) -> &'static [&'static str] {
        match self {
            Module::DepthMap => &[PLANE, DEPTH_MAP],
            Module::Layers => &[SET, PLANE, PART, MESH, PROGRAM, LAYERS],
            Module::Visibility => &[VISIBILITY, SET, LAYER_LOOKUP, GEOMETRY],
            Module::Resolve => {
                &[SET, LAYER_LOOKUP, GEOMETRY, TEXTURE, SHADE, PLANE, PART, MESH, PROGRAM, GLASS, FRAGMENTS, RESOLVE]
            }
            Module::Aov => &[SET, LAYER_LOOKUP, GEOMETRY, TEXTURE, SHADE, FRAGMENTS, AOV],
            Module::Finish => &[FINISH],
        }
    }
}

const COMMON: &str = include_str!("../../shaders/gpu/common.wgsl");
const SET: &str = include_str!("../../shaders/gpu/set.wgsl");
const LAYER_LOOKUP: &str = include_str!("../../shaders/gpu/layer_lookup.wgsl");
const GEOMETRY: &str = include_str!("../../shaders/gpu/geometry.wgsl");
const PART: &str = include_str!("../../shaders/gpu/part.wgsl");
const MESH: &str = include_str!("../../shaders/gpu/mesh.wgsl");
const PROGRAM: &str = include_str!("../../shaders/gpu/program.wgsl");
const PLANE: &str = include_str!("../../shaders/gpu/plane.wgsl");
const DEPTH_MAP: &str = include_str!("../../shaders/gpu/depth_map.wgsl");
const LAYERS: &str = include_str!("../../shaders/gpu/layers.wgsl");
const VISIBILITY: &str = include_str!("../../shaders/gpu/visibility.wgsl");
const TEXTURE: &str = include_str!("../../shaders/gpu/texture.wgsl");
const SHADE: &str = include_str!("../../shaders/gpu/shade.wgsl");
const GLASS: &str = include_str!("../../shaders/gpu/glass.wgsl");
const FRAGMENTS: &str = include_str!("../../shaders/gpu/fragments.wgsl");
const RESOLVE: &str = include_str!("../../shaders/gpu/resolve.wgsl");
const AOV: &str = include_str!("../../shaders/gpu/aov.wgsl");
const FINISH: &str = include_str!("../../shaders/gpu/finish.wgsl");

/// The whole WGSL of a module for sets of so many 32-bit words.
pub fn source(module: Module, words: SetWords) -> String {
    // Extensions are enabled ahead of everything else.
    let enable = match module {
        Module::Visibility => "enable primitive_index;\n",
        _ => "",
    };
    let mut text =
        format!("{enable}const WORDS: u32 = {}u;\nconst PART_WORDS: u32 = {}u;\n", words.lenses, words.parts);
    text += crate::appearance::WGSL;
    text += COMMON;
    for part in module.parts() {
        text += part;
    }
    text
}
