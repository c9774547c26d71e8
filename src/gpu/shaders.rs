//! Puts the shader modules together from their files.

use super::Needs;

/// A shader module: what one pipeline or a few of them run.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Module {
    Layers,
    Visibility,
    /// Where something may be cut: what rays meet of it, and their caps.
    Caps,
    Resolve,
    Aov,
    Explain,
    Screen,
}

impl Module {
    pub const ALL: [Module; 7] = [
        Module::Layers,
        Module::Visibility,
        Module::Caps,
        Module::Resolve,
        Module::Aov,
        Module::Explain,
        Module::Screen,
    ];

    /// How labels and messages call it.
    pub fn name(self) -> &'static str {
        match self {
            Module::Layers => "layers",
            Module::Visibility => "visibility",
            Module::Caps => "caps",
            Module::Resolve => "resolve",
            Module::Aov => "aov",
            Module::Explain => "explain",
            Module::Screen => "screen",
        }
    }

    fn parts(self) -> &'static [&'static [&'static str]] {
        match self {
            Module::Layers => &[&[SET], VOLUMES, &[LAYERS]],
            Module::Visibility => &[&[LISTS, DRAWN, VISIBILITY], VOLUMES, CLASSIFYING],
            Module::Caps => &[&[LISTS, DRAWN, FIND_CAPS], VOLUMES, CLASSIFYING, &[CLOSING]],
            Module::Resolve => &[VOLUMES, CLASSIFYING, SHADING, &[GLASS, CONTACT, FINISH, SCREEN_SAMPLE, RESOLVE]],
            Module::Aov => &[VOLUMES, CLASSIFYING, SHADING, &[AOV]],
            Module::Explain => &[VOLUMES, CLASSIFYING, SHADING, &[EXPLAIN]],
            Module::Screen => &[&[SET, STEPS, SOFT], VOLUMES, &[FINISH, SCREEN_SAMPLE, SCREEN]],
        }
    }
}

/// Where rays cross lens volumes.
const VOLUMES: &[&str] = &[PLANE, PART, ROLES, MESH, PROGRAM];
/// Who acts on a fragment.
const CLASSIFYING: &[&str] = &[SET, ASKED, LAYER_LOOKUP, PLANES, GEOMETRY, STEPS, MOVED, WALK];
/// What a fragment looks like.
const SHADING: &[&str] = &[CLOSING, BOUNDARY, CAPS, TEXTURE, SOFT, STACK, CUSTOM, SHADE, FRAGMENTS];

const COMMON: &str = include_str!("../../shaders/gpu/common.wgsl");
const SET: &str = include_str!("../../shaders/gpu/set.wgsl");
const LAYER_LOOKUP: &str = include_str!("../../shaders/gpu/layer_lookup.wgsl");
const PLANES: &str = include_str!("../../shaders/gpu/planes.wgsl");
const GEOMETRY: &str = include_str!("../../shaders/gpu/geometry.wgsl");
const PART: &str = include_str!("../../shaders/gpu/part.wgsl");
const ROLES: &str = include_str!("../../shaders/gpu/roles.wgsl");
const MESH: &str = include_str!("../../shaders/gpu/mesh.wgsl");
const PROGRAM: &str = include_str!("../../shaders/gpu/program.wgsl");
const ASKED: &str = include_str!("../../shaders/gpu/asked.wgsl");
const STEPS: &str = include_str!("../../shaders/gpu/steps.wgsl");
const MOVED: &str = include_str!("../../shaders/gpu/moved.wgsl");
const WALK: &str = include_str!("../../shaders/gpu/walk.wgsl");
const SOFT: &str = include_str!("../../shaders/gpu/soft.wgsl");
const STACK: &str = include_str!("../../shaders/gpu/stack.wgsl");
const PLANE: &str = include_str!("../../shaders/gpu/plane.wgsl");
const LAYERS: &str = include_str!("../../shaders/gpu/layers.wgsl");
const LISTS: &str = include_str!("../../shaders/gpu/lists.wgsl");
const DRAWN: &str = include_str!("../../shaders/gpu/drawn.wgsl");
const FIND_CAPS: &str = include_str!("../../shaders/gpu/find_caps.wgsl");
const CLOSING: &str = include_str!("../../shaders/gpu/closing.wgsl");
const BOUNDARY: &str = include_str!("../../shaders/gpu/boundary.wgsl");
const CAPS: &str = include_str!("../../shaders/gpu/caps.wgsl");
const KEPT: &str = include_str!("../../shaders/gpu/kept.wgsl");
const KEPT_VERSIONS: &str = include_str!("../../shaders/gpu/kept_versions.wgsl");
const VISIBILITY: &str = include_str!("../../shaders/gpu/visibility.wgsl");
const TEXTURE: &str = include_str!("../../shaders/gpu/texture.wgsl");
const SHADE: &str = include_str!("../../shaders/gpu/shade.wgsl");
const GLASS: &str = include_str!("../../shaders/gpu/glass.wgsl");
const CONTACT: &str = include_str!("../../shaders/gpu/contact.wgsl");
const FRAGMENTS: &str = include_str!("../../shaders/gpu/fragments.wgsl");
const RESOLVE: &str = include_str!("../../shaders/gpu/resolve.wgsl");
const CUSTOM: &str = include_str!("../../shaders/gpu/custom.wgsl");
const FINISH: &str = include_str!("../../shaders/gpu/finish.wgsl");
const SCREEN_SAMPLE: &str = include_str!("../../shaders/gpu/screen_sample.wgsl");
const SCREEN: &str = include_str!("../../shaders/gpu/screen.wgsl");
const AOV: &str = include_str!("../../shaders/gpu/aov.wgsl");
const EXPLAIN: &str = include_str!("../../shaders/gpu/explain.wgsl");

/// The whole WGSL of a module. `custom`: the user's own filters, as [`custom::wgsl`](crate::custom::wgsl) writes them.
pub fn source(module: Module, needs: &Needs, custom: &str) -> String {
    let mut text = needs.wgsl();
    text += crate::appearance::FUNCTIONS;
    text += COMMON;
    if module.parts().iter().any(|parts| parts.contains(&CUSTOM)) {
        text += custom;
    }
    if module == Module::Visibility {
        text += if needs.versions || needs.wide { KEPT_VERSIONS } else { KEPT };
    }
    for part in module.parts().iter().copied().flatten() {
        text += part;
    }
    text
}
