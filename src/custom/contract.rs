//! What a filter file finds declared, and the surface that it is called for.

/// The declarations, before the user's text.
pub const WGSL: &str = include_str!("../../shaders/custom/contract.wgsl");

/// All names that [`WGSL`] declares.
pub const NAMES: [&str; 7] =
    ["Surface", "srgb_from_linear", "linear_from_srgb", "luminance", "hash3", "noise3", "stripe"];

/// The members of `Surface` in order, and how many numbers each has.
pub const MEMBERS: [(&str, usize); 12] = [
    ("position", 3),
    ("normal", 3),
    ("view", 3),
    ("base_color", 3),
    ("metallic", 1),
    ("roughness", 1),
    ("emissive", 3),
    ("occlusion", 1),
    ("opacity", 1),
    ("unlit", 1),
    ("pixel", 2),
    ("depth", 1),
];

/// Loop iterations that one call of a filter may take, all its loops and functions together; past them loops end.
pub const LOOP_BUDGET: u32 = 4096;

/// Numbers that an iteration may compute; one that computes more counts as several.
pub const NUMBERS_OF_AN_ITERATION: u64 = 64;

/// `Surface` of the contract, its numbers without gaps. Colours are linear light.
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub struct SurfaceValue {
    /// World space, scene units.
    pub position: [f32; 3],
    /// World space, unit length, on the viewer's side.
    pub normal: [f32; 3],
    /// From the surface to the eye, unit length.
    pub view: [f32; 3],
    pub base_color: [f32; 3],
    pub metallic: f32,
    /// Perceptual roughness.
    pub roughness: f32,
    pub emissive: [f32; 3],
    pub occlusion: f32,
    /// 0: removed; 1: opaque.
    pub opacity: f32,
    /// 0: lit; 1: shown in its base colour, without lighting.
    pub unlit: f32,
    /// Of the picture, from its top left corner, pixels.
    pub pixel: [f32; 2],
    /// Along the camera's forward axis, scene units.
    pub depth: f32,
}

/// Numbers in a [`SurfaceValue`].
pub const SURFACE_WORDS: usize = size_of::<SurfaceValue>() / size_of::<f32>();

#[cfg(test)]
mod tests {
    use super::*;
    use crate::custom::words;

    #[test]
    fn the_lists_say_what_the_declarations_say() {
        let module =
            naga::front::wgsl::parse_str(WGSL).unwrap_or_else(|error| panic!("{}", error.emit_to_string(WGSL)));
        let surface = module.types.iter().find(|(_, ty)| ty.name.as_deref() == Some("Surface"));
        let naga::TypeInner::Struct { members, .. } = &surface.expect("a struct").1.inner else { panic!("a struct") };
        let numbers = |ty| match module.types[ty].inner {
            naga::TypeInner::Vector { size, .. } => size as usize,
            _ => 1,
        };
        let declared: Vec<_> =
            members.iter().map(|member| (member.name.as_deref().unwrap_or(""), numbers(member.ty))).collect();
        assert_eq!(declared, MEMBERS);
        assert_eq!(MEMBERS.iter().map(|(_, count)| count).sum::<usize>(), SURFACE_WORDS);
        assert_eq!(words::top_level(WGSL).iter().map(|word| word.text).collect::<Vec<_>>(), NAMES);
    }
}
