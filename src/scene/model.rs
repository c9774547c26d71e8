//! The plain data of one glTF file.

use std::collections::BTreeMap;

use glam::{DAffine3, DVec3, Vec2, Vec3, Vec4};

use super::{Animation, BoundsCache, ClosureCache, Edges, Simplified, Transform};

/// One glTF file, with one of its scenes chosen. Indices are those of the file.
#[derive(Debug, Clone, Default)]
pub struct Model {
    /// How messages name the file.
    pub name: String,
    /// All nodes of the file, in its order; those outside the chosen scene have `drawn == false`.
    pub nodes: Vec<Node>,
    pub meshes: Vec<Mesh>,
    /// The file's materials, then one more: the default material of glTF.
    pub materials: Vec<Material>,
    pub textures: Vec<Texture>,
    /// Those that no material uses are not decoded: one white pixel each.
    pub images: Vec<Image>,
    pub lights: Vec<Light>,
    pub cameras: Vec<Camera>,
    /// Those of the file, in its order; see [`Model::pose`].
    pub animations: Vec<Animation>,
    /// Names of the file's scenes and which one is shown.
    pub scenes: Vec<Option<String>>,
    pub scene: usize,
    /// Extensions in use, sorted.
    pub extensions: Vec<String>,
    /// What was left out or repaired, one line each, with the object named.
    pub warnings: Vec<String>,
    /// To be replaced with an empty one where a mesh is changed in place.
    pub bounds_cache: BoundsCache,
    /// Likewise.
    pub closure_cache: ClosureCache,
}

#[derive(Debug, Clone)]
pub struct Node {
    /// Empty where the file gives none.
    pub name: String,
    pub parent: Option<usize>,
    pub children: Vec<usize>,
    /// Its place in its parent when nothing is animated.
    pub rest: Transform,
    /// As the model was last posed.
    pub world_from_local: DAffine3,
    pub mesh: Option<usize>,
    pub camera: Option<usize>,
    pub light: Option<usize>,
    /// In the chosen scene.
    pub drawn: bool,
    /// The file hides it or an ancestor of it (`KHR_node_visibility`): only a `show` that names it brings it in.
    pub hidden: bool,
}

#[derive(Debug, Clone, Default)]
pub struct Mesh {
    pub name: String,
    pub primitives: Vec<Primitive>,
}

/// A triangle list in its node's local space. Attribute lists are as long as `positions`.
#[derive(Debug, Clone, Default)]
pub struct Primitive {
    pub positions: Vec<Vec3>,
    /// Unit length; `None`: each triangle is flat.
    pub normals: Option<Vec<Vec3>>,
    /// `xyz` the tangent, `w` the sign of the bitangent.
    pub tangents: Option<Vec<Vec4>>,
    pub uv: [Option<Vec<Vec2>>; 2],
    /// Linear-light colour and alpha, which multiply the material's.
    pub colors: Option<Vec<Vec4>>,
    /// Other numbers at vertices, by name: the file's own attributes (`_NAME`; the length of those with several parts),
    /// and [`super::CURVATURE`] where it has been asked for.
    pub values: BTreeMap<String, Vec<f32>>,
    pub triangles: Vec<[u32; 3]>,
    /// Those that some `lod` has asked for, one a ratio.
    pub simplified: Vec<Simplified>,
    /// What lies across the edges of each triangle, where a filter has asked for it; else empty.
    pub across: Vec<Edges>,
    /// The number of its first vertex through all primitives of its mesh, where a filter has asked for its edges.
    pub first_vertex: u32,
    /// Into [`Model::materials`].
    pub material: usize,
}

/// Metallic-roughness material of glTF 2.0.
#[derive(Debug, Clone, PartialEq)]
pub struct Material {
    pub name: String,
    /// Linear light and alpha.
    pub base_color: [f32; 4],
    pub base_color_texture: Option<TextureRef>,
    pub metallic: f32,
    pub roughness: f32,
    /// Green: roughness, blue: metallic.
    pub metallic_roughness_texture: Option<TextureRef>,
    pub normal_texture: Option<TextureRef>,
    pub normal_scale: f32,
    pub occlusion_texture: Option<TextureRef>,
    pub occlusion_strength: f32,
    /// Linear light, emissive strength multiplied in.
    pub emissive: [f32; 3],
    pub emissive_texture: Option<TextureRef>,
    pub alpha_mode: AlphaMode,
    pub double_sided: bool,
    /// `KHR_materials_unlit`.
    pub unlit: bool,
}

impl Default for Material {
    fn default() -> Self {
        Self {
            name: String::new(),
            base_color: [1.0; 4],
            base_color_texture: None,
            metallic: 1.0,
            roughness: 1.0,
            metallic_roughness_texture: None,
            normal_texture: None,
            normal_scale: 1.0,
            occlusion_texture: None,
            occlusion_strength: 1.0,
            emissive: [0.0; 3],
            emissive_texture: None,
            alpha_mode: AlphaMode::Opaque,
            double_sided: false,
            unlit: false,
        }
    }
}

impl Material {
    /// The textures in use, each with its role as messages name it.
    pub fn textures(&self) -> impl Iterator<Item = (&'static str, &TextureRef)> {
        [
            ("base colour", &self.base_color_texture),
            ("metallic-roughness", &self.metallic_roughness_texture),
            ("normal", &self.normal_texture),
            ("occlusion", &self.occlusion_texture),
            ("emissive", &self.emissive_texture),
        ]
        .into_iter()
        .filter_map(|(role, texture)| Some((role, texture.as_ref()?)))
    }
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub enum AlphaMode {
    Opaque,
    /// Removed below the cutoff, opaque above it.
    Mask(f32),
    Blend,
}

/// A use of a texture: which, with what coordinates.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TextureRef {
    /// Into [`Model::textures`].
    pub texture: usize,
    /// Coordinate set, 0 or 1.
    pub uv_set: usize,
    /// `uv' = offset + rotate(rotation) * (scale * uv)` (`KHR_texture_transform`); rotation in radians, from +u to +v
    /// (glTF counts the other way; the loader turns it).
    pub offset: [f32; 2],
    pub scale: [f32; 2],
    pub rotation: f32,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Texture {
    /// Into [`Model::images`]; `None` where the file gives none, or none that could be read: then materials are without.
    pub image: Option<usize>,
    pub sampler: Sampler,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Sampler {
    pub wrap: [Wrap; 2],
    /// Linear rather than nearest when magnified.
    pub mag_linear: bool,
    /// Linear rather than nearest within a mip level when minified.
    pub min_linear: bool,
    pub mips: Mips,
}

impl Default for Sampler {
    fn default() -> Self {
        Self { wrap: [Wrap::Repeat; 2], mag_linear: true, min_linear: true, mips: Mips::Linear }
    }
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Wrap {
    Repeat,
    MirroredRepeat,
    ClampToEdge,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mips {
    None,
    Nearest,
    Linear,
}

/// Decoded pixels as stored in the file: 8 bits a channel, row 0 at the top, straight alpha.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Image {
    pub name: String,
    pub width: u32,
    pub height: u32,
    /// `width * height` pixels. Whether they are sRGB is said by the use, not by the image.
    pub pixels: Vec<[u8; 4]>,
}

/// `KHR_lights_punctual`; placed by the node that names it, shining along its local -z.
#[derive(Debug, Clone, PartialEq)]
pub struct Light {
    pub name: String,
    /// Linear light.
    pub color: [f32; 3],
    /// Candela for point and spot lights, lux for directional ones.
    pub intensity: f32,
    /// Scene units; `None` is unlimited.
    pub range: Option<f32>,
    pub kind: LightKind,
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub enum LightKind {
    Directional,
    Point,
    /// Half angles, radians.
    Spot {
        inner: f32,
        outer: f32,
    },
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Camera {
    /// Vertical field of view in radians.
    Perspective { fov_y: f64, near: f64, far: Option<f64> },
    /// Half the height of the view in scene units.
    Orthographic { half_height: f64, near: f64, far: f64 },
}

/// An axis-aligned box; empty when `min > max`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Aabb {
    pub min: DVec3,
    pub max: DVec3,
}

impl Aabb {
    pub const EMPTY: Aabb = Aabb { min: DVec3::INFINITY, max: DVec3::NEG_INFINITY };

    pub const EVERYWHERE: Aabb = Aabb { min: DVec3::NEG_INFINITY, max: DVec3::INFINITY };

    pub fn from_points(points: impl IntoIterator<Item = DVec3>) -> Self {
        points.into_iter().fold(Self::EMPTY, |b, p| Aabb { min: b.min.min(p), max: b.max.max(p) })
    }

    pub fn is_empty(&self) -> bool {
        self.min.cmpgt(self.max).any()
    }

    pub fn union(self, other: Self) -> Self {
        Aabb { min: self.min.min(other.min), max: self.max.max(other.max) }
    }

    pub fn intersection(self, other: Self) -> Self {
        Aabb { min: self.min.max(other.min), max: self.max.min(other.max) }
    }

    pub fn overlaps(&self, other: &Self) -> bool {
        self.min.cmple(other.max).all() && other.min.cmple(self.max).all()
    }

    pub fn center(&self) -> DVec3 {
        (self.min + self.max) * 0.5
    }

    pub fn size(&self) -> DVec3 {
        self.max - self.min
    }

    pub fn corners(&self) -> [DVec3; 8] {
        std::array::from_fn(|i| {
            DVec3::new(
                if i & 1 == 0 { self.min.x } else { self.max.x },
                if i & 2 == 0 { self.min.y } else { self.max.y },
                if i & 4 == 0 { self.min.z } else { self.max.z },
            )
        })
    }
}

impl Node {
    /// Whether its model shows it unasked.
    pub fn is_shown(&self) -> bool {
        self.drawn && !self.hidden
    }
}

impl Model {
    /// Its warnings, each with the file that it is about.
    pub fn named_warnings(&self) -> impl Iterator<Item = String> {
        self.warnings.iter().map(|warning| format!("{}: {warning}", self.name))
    }

    /// Images that texture slots of materials use, ascending. The others are one white pixel each.
    pub fn used_images(&self) -> Vec<usize> {
        let references = self.materials.iter().flat_map(Material::textures);
        let mut images: Vec<usize> = references.filter_map(|(_, r)| self.textures[r.texture].image).collect();
        images.sort_unstable();
        images.dedup();
        images
    }
}
