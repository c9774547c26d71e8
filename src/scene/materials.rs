//! Materials as both backends read them.

use super::{AlphaMode, Material, Model, TextureRef, TextureSet};

/// Stands for "no texture" in a [`TextureSlot`].
pub const NO_TEXTURE: u32 = u32::MAX;

/// A use of a texture; the layout of WGSL's `TextureSlot`.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct TextureSlot {
    /// Into the scene's [`TextureSet`], or [`NO_TEXTURE`].
    pub texture: u32,
    /// Coordinate set, 0 or 1.
    pub uv_set: u32,
    pub offset: [f32; 2],
    /// Columns of the matrix that turns and scales coordinates.
    pub matrix: [f32; 4],
}

/// A material with its textures; the layout of WGSL's `Material`.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct MaterialRecord {
    /// Linear light and alpha.
    pub base_color: [f32; 4],
    pub emissive: [f32; 3],
    pub alpha_cutoff: f32,
    pub metallic: f32,
    pub roughness: f32,
    pub normal_scale: f32,
    pub occlusion_strength: f32,
    /// An `ALPHA_...` constant of the shaders.
    pub alpha_mode: u32,
    pub double_sided: u32,
    pub unlit: u32,
    pub pad: u32,
    pub base_color_texture: TextureSlot,
    pub metallic_roughness_texture: TextureSlot,
    pub normal_texture: TextureSlot,
    pub occlusion_texture: TextureSlot,
    pub emissive_texture: TextureSlot,
}

impl MaterialRecord {
    pub fn new(material: &Material, model: &Model, textures: &mut TextureSet) -> Self {
        let (alpha_mode, alpha_cutoff) = match material.alpha_mode {
            AlphaMode::Opaque => (crate::appearance::ALPHA_OPAQUE.0, 0.0),
            AlphaMode::Mask(cutoff) => (crate::appearance::ALPHA_MASK.0, cutoff),
            AlphaMode::Blend => (crate::appearance::ALPHA_BLEND.0, 0.0),
        };
        let mut slot =
            |reference: &Option<TextureRef>, srgb| TextureSlot::new(reference.as_ref(), srgb, model, textures);
        Self {
            base_color: material.base_color,
            emissive: material.emissive,
            alpha_cutoff,
            metallic: material.metallic,
            roughness: material.roughness,
            normal_scale: material.normal_scale,
            occlusion_strength: material.occlusion_strength,
            alpha_mode,
            double_sided: u32::from(material.double_sided),
            unlit: u32::from(material.unlit),
            pad: 0,
            base_color_texture: slot(&material.base_color_texture, true),
            metallic_roughness_texture: slot(&material.metallic_roughness_texture, false),
            normal_texture: slot(&material.normal_texture, false),
            occlusion_texture: slot(&material.occlusion_texture, false),
            emissive_texture: slot(&material.emissive_texture, true),
        }
    }

    /// Whether its fragments may be less than opaque.
    pub fn may_be_translucent(&self) -> bool {
        self.alpha_mode != crate::appearance::ALPHA_OPAQUE.0
    }
}

impl TextureSlot {
    fn new(reference: Option<&TextureRef>, srgb: bool, model: &Model, textures: &mut TextureSet) -> Self {
        let used = reference.and_then(|r| Some((r, model.textures[r.texture], model.textures[r.texture].image?)));
        let Some((reference, texture, image)) = used else {
            return Self { texture: NO_TEXTURE, uv_set: 0, offset: [0.0; 2], matrix: [1.0, 0.0, 0.0, 1.0] };
        };
        let (sin, cos) = reference.rotation.sin_cos();
        let [sx, sy] = reference.scale;
        Self {
            texture: textures.add(&model.images[image], srgb, texture.sampler),
            uv_set: reference.uv_set as u32,
            offset: reference.offset,
            matrix: [cos * sx, sin * sx, -sin * sy, cos * sy],
        }
    }
}
