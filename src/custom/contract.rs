//! What a filter file finds declared, and the surface that it is called for.

/// The declarations, before the user's text.
pub const WGSL: &str = include_str!("../../shaders/custom/contract.wgsl");

/// All names that [`WGSL`] declares.
pub const NAMES: [&str; 7] =
    ["Surface", "srgb_from_linear", "linear_from_srgb", "luminance", "hash3", "noise3", "stripe"];

/// The member names of `Surface`, in order.
pub const MEMBERS: [&str; 12] = [
    "position",
    "normal",
    "view",
    "base_color",
    "metallic",
    "roughness",
    "emissive",
    "occlusion",
    "opacity",
    "unlit",
    "pixel",
    "depth",
];

/// Loop iterations that one call of a filter may take, all its loops and functions together; past them loops end.
pub const LOOP_BUDGET: u32 = 4096;

/// `Surface` of the contract. Colours are linear light.
#[derive(Debug, Clone, Copy, PartialEq)]
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
pub const SURFACE_WORDS: usize = 23;

impl SurfaceValue {
    /// All numbers in the order of the members.
    pub fn numbers(&self) -> [f32; SURFACE_WORDS] {
        let mut numbers = [0.0; SURFACE_WORDS];
        let parts: [&[f32]; 12] = [
            &self.position,
            &self.normal,
            &self.view,
            &self.base_color,
            &[self.metallic],
            &[self.roughness],
            &self.emissive,
            &[self.occlusion],
            &[self.opacity],
            &[self.unlit],
            &self.pixel,
            &[self.depth],
        ];
        let all = parts.iter().flat_map(|part| part.iter());
        numbers.iter_mut().zip(all).for_each(|(number, value)| *number = *value);
        numbers
    }

    /// The inverse of [`SurfaceValue::numbers`].
    pub fn from_numbers(n: &[f32; SURFACE_WORDS]) -> Self {
        Self {
            position: [n[0], n[1], n[2]],
            normal: [n[3], n[4], n[5]],
            view: [n[6], n[7], n[8]],
            base_color: [n[9], n[10], n[11]],
            metallic: n[12],
            roughness: n[13],
            emissive: [n[14], n[15], n[16]],
            occlusion: n[17],
            opacity: n[18],
            unlit: n[19],
            pixel: [n[20], n[21]],
            depth: n[22],
        }
    }
}
