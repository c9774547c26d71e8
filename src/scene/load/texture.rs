//! Textures, samplers, and the uses of textures in materials.

use gltf::json::extensions::texture::TextureTransform;
use gltf::texture::{MagFilter, MinFilter, WrappingMode};

use super::warnings::Warnings;
use super::{File, losses, object};
use crate::InputError;
use crate::scene::{Mips, Sampler, Texture, TextureRef, Wrap};

/// All textures, in the file's order.
pub fn load(file: &File<'_>, warnings: &mut Warnings) -> Vec<Texture> {
    let texture = |t: gltf::Texture<'_>| {
        let json = &file.root().textures[t.index()];
        // The crate puts a number in the place of a source that is not there.
        let image = Some(json.source.value()).filter(|index| *index < file.root().images.len());
        if image.is_none() {
            let label = object("texture", t.index(), json.name.as_deref());
            warnings.add(
                label,
                match losses::texture_source(json) {
                    Some(extension) => {
                        format!("its image is of {extension}, which is not read: materials are drawn without")
                    }
                    None => "it has no image: materials are drawn without".into(),
                },
            );
        }
        Texture { image, sampler: sampler(&t.sampler()) }
    };
    file.document.textures().map(texture).collect()
}

fn sampler(json: &gltf::texture::Sampler<'_>) -> Sampler {
    use MinFilter::*;
    let (min_linear, mips) = match json.min_filter() {
        Some(Nearest) => (false, Mips::None),
        Some(Linear) => (true, Mips::None),
        Some(NearestMipmapNearest) => (false, Mips::Nearest),
        Some(LinearMipmapNearest) => (true, Mips::Nearest),
        Some(NearestMipmapLinear) => (false, Mips::Linear),
        Some(LinearMipmapLinear) | None => (true, Mips::Linear),
    };
    Sampler {
        wrap: [wrap(json.wrap_s()), wrap(json.wrap_t())],
        mag_linear: json.mag_filter() != Some(MagFilter::Nearest),
        min_linear,
        mips,
    }
}

fn wrap(mode: WrappingMode) -> Wrap {
    match mode {
        WrappingMode::ClampToEdge => Wrap::ClampToEdge,
        WrappingMode::MirroredRepeat => Wrap::MirroredRepeat,
        WrappingMode::Repeat => Wrap::Repeat,
    }
}

/// A use of a texture as a material writes it.
pub struct Use<'a> {
    pub texture: usize,
    pub tex_coord: u32,
    pub transform: Option<&'a TextureTransform>,
}

/// Coordinates are read for sets 0 and 1; a texture on another set is left out with a warning.
pub fn reference(
    file: &File<'_>,
    material: &str,
    used: Use<'_>,
    warnings: &mut Warnings,
) -> Result<Option<TextureRef>, InputError> {
    let (offset, scale, rotation) =
        used.transform.map_or(([0.0; 2], [1.0; 2], 0.0), |t| (t.offset.0, t.scale.0, t.rotation.0));
    if !offset.iter().chain(&scale).chain([&rotation]).all(|v| v.is_finite()) {
        return Err(file.error(material, "a texture transform is not finite"));
    }
    let set = used.transform.and_then(|t| t.tex_coord).unwrap_or(used.tex_coord);
    if set > 1 {
        warnings.add(material, format!("texture {} uses coordinate set {set}; left out", used.texture));
        return Ok(None);
    }
    // glTF turns counter-clockwise with v pointing down, which in (u, v) is a rotation by the negative angle.
    Ok(Some(TextureRef { texture: used.texture, uv_set: set as usize, offset, scale, rotation: -rotation }))
}
