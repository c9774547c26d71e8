//! Metallic-roughness materials with their textures.

use gltf::json;
use gltf::json::extensions::texture::TextureTransform;
use gltf::json::material::{NormalTexture, OcclusionTexture};
use gltf::json::texture::Info;

use super::texture::{Use, reference};
use super::warnings::Warnings;
use super::{File, object};
use crate::InputError;
use crate::scene::{AlphaMode, Material, TextureRef};

/// The file's materials, then glTF's default one.
pub fn load(file: &File<'_>, warnings: &mut Warnings) -> Result<Vec<Material>, InputError> {
    let mut materials = Vec::with_capacity(file.root().materials.len() + 1);
    for source in file.document.materials() {
        materials.push(material(file, &source, warnings)?);
    }
    materials.push(Material::default());
    Ok(materials)
}

fn material(file: &File<'_>, source: &gltf::Material<'_>, warnings: &mut Warnings) -> Result<Material, InputError> {
    let index = source.index().unwrap_or_default();
    let json = &file.root().materials[index];
    let label = object("material", index, source.name());
    let pbr = &json.pbr_metallic_roughness;
    let mut slots = Slots { file, label: &label, warnings };
    let material = Material {
        name: source.name().unwrap_or_default().to_string(),
        base_color: pbr.base_color_factor.0,
        base_color_texture: slots.plain(&pbr.base_color_texture)?,
        metallic: pbr.metallic_factor.0,
        roughness: pbr.roughness_factor.0,
        metallic_roughness_texture: slots.plain(&pbr.metallic_roughness_texture)?,
        normal_texture: slots.normal(&json.normal_texture)?,
        normal_scale: json.normal_texture.as_ref().map_or(1.0, |t| t.scale),
        occlusion_texture: slots.occlusion(&json.occlusion_texture)?,
        occlusion_strength: json.occlusion_texture.as_ref().map_or(1.0, |t| t.strength.0),
        emissive: json.emissive_factor.0.map(|c| c * source.emissive_strength().unwrap_or(1.0)),
        emissive_texture: slots.plain(&json.emissive_texture)?,
        alpha_mode: alpha_mode(source),
        double_sided: source.double_sided(),
        unlit: source.unlit(),
    };
    check_numbers(file, &label, &material)?;
    Ok(material)
}

fn alpha_mode(source: &gltf::Material<'_>) -> AlphaMode {
    match source.alpha_mode() {
        gltf::material::AlphaMode::Opaque => AlphaMode::Opaque,
        gltf::material::AlphaMode::Mask => AlphaMode::Mask(source.alpha_cutoff().unwrap_or(0.5)),
        gltf::material::AlphaMode::Blend => AlphaMode::Blend,
    }
}

fn check_numbers(file: &File<'_>, label: &str, material: &Material) -> Result<(), InputError> {
    let cutoff = if let AlphaMode::Mask(cutoff) = material.alpha_mode { cutoff } else { 0.0 };
    let single = [material.metallic, material.roughness, material.normal_scale, material.occlusion_strength, cutoff];
    let all = material.base_color.iter().chain(&material.emissive).chain(&single);
    if all.copied().all(f32::is_finite) { Ok(()) } else { Err(file.error(label, "one of its factors is not finite")) }
}

/// Reads the texture slots of one material.
struct Slots<'s, 'f> {
    file: &'s File<'f>,
    label: &'s str,
    warnings: &'s mut Warnings,
}

impl Slots<'_, '_> {
    fn plain(&mut self, info: &Option<Info>) -> Result<Option<TextureRef>, InputError> {
        let Some(info) = info else { return Ok(None) };
        let transform = info.extensions.as_ref().and_then(|e| e.texture_transform.as_ref());
        self.slot(info.index, info.tex_coord, transform)
    }

    fn normal(&mut self, info: &Option<NormalTexture>) -> Result<Option<TextureRef>, InputError> {
        let Some(info) = info else { return Ok(None) };
        let transform = self.transform(info.extensions.as_ref().map(|e| &e.others))?;
        self.slot(info.index, info.tex_coord, transform.as_ref())
    }

    fn occlusion(&mut self, info: &Option<OcclusionTexture>) -> Result<Option<TextureRef>, InputError> {
        let Some(info) = info else { return Ok(None) };
        let transform = self.transform(info.extensions.as_ref().map(|e| &e.others))?;
        self.slot(info.index, info.tex_coord, transform.as_ref())
    }

    /// The crate reads texture transforms of plain slots only; here they come as raw JSON.
    fn transform(
        &self,
        others: Option<&serde_json::Map<String, serde_json::Value>>,
    ) -> Result<Option<TextureTransform>, InputError> {
        let Some(value) = others.and_then(|o| o.get("KHR_texture_transform")) else { return Ok(None) };
        serde_json::from_value(value.clone())
            .map(Some)
            .map_err(|e| self.file.error(self.label, format!("its KHR_texture_transform does not read: {e}")))
    }

    fn slot(
        &mut self,
        texture: json::Index<json::Texture>,
        tex_coord: u32,
        transform: Option<&TextureTransform>,
    ) -> Result<Option<TextureRef>, InputError> {
        let used = Use { texture: texture.value(), tex_coord, transform };
        reference(self.file, self.label, used, self.warnings)
    }
}
