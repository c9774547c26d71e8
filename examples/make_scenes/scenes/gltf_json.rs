//! The JSON half of a glTF file as typed data: the parts that [`super::glb`] writes, in a fixed order.

use serde::Serialize;

use super::glb::{Light, Sampling};

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Document {
    pub asset: Asset,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub extensions_used: Vec<&'static str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub extensions: Option<DocumentLights>,
    pub scene: usize,
    pub scenes: Vec<SceneJson>,
    pub nodes: Vec<NodeJson>,
    pub meshes: Vec<MeshJson>,
    pub materials: Vec<MaterialJson>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub textures: Vec<TextureJson>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub images: Vec<ImageJson>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub samplers: Vec<Sampling>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub cameras: Vec<CameraJson>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub animations: Vec<AnimationJson>,
    pub accessors: Vec<AccessorJson>,
    pub buffer_views: Vec<ViewJson>,
    pub buffers: Vec<BufferJson>,
}

impl Default for Document {
    fn default() -> Self {
        Self {
            asset: Asset { version: "2.0", generator: "lenspeel examples/make_scenes" },
            extensions_used: Vec::new(),
            extensions: None,
            scene: 0,
            scenes: vec![SceneJson { nodes: Vec::new() }],
            nodes: Vec::new(),
            meshes: Vec::new(),
            materials: Vec::new(),
            textures: Vec::new(),
            images: Vec::new(),
            samplers: Vec::new(),
            cameras: Vec::new(),
            animations: Vec::new(),
            accessors: Vec::new(),
            buffer_views: Vec::new(),
            buffers: Vec::new(),
        }
    }
}

#[derive(Serialize)]
pub struct Asset {
    pub version: &'static str,
    pub generator: &'static str,
}

#[derive(Serialize)]
pub struct SceneJson {
    pub nodes: Vec<usize>,
}

#[derive(Serialize)]
pub struct NodeJson {
    pub name: String,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub children: Vec<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mesh: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub camera: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub translation: Option<[f64; 3]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rotation: Option<[f64; 4]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub scale: Option<[f64; 3]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub extensions: Option<NodeLights>,
}

#[derive(Serialize)]
pub struct NodeLights {
    #[serde(rename = "KHR_lights_punctual")]
    pub lights: LightRef,
}

#[derive(Serialize)]
pub struct LightRef {
    pub light: usize,
}

#[derive(Serialize, Default)]
pub struct DocumentLights {
    #[serde(rename = "KHR_lights_punctual")]
    pub lights: LightList,
}

#[derive(Serialize, Default)]
pub struct LightList {
    pub lights: Vec<Light>,
}

#[derive(Serialize)]
pub struct MeshJson {
    pub name: String,
    pub primitives: Vec<PrimitiveJson>,
}

#[derive(Serialize)]
pub struct PrimitiveJson {
    pub attributes: Attributes,
    pub indices: usize,
    pub material: usize,
}

#[derive(Serialize)]
pub struct Attributes {
    #[serde(rename = "POSITION")]
    pub position: usize,
    #[serde(rename = "NORMAL", skip_serializing_if = "Option::is_none")]
    pub normal: Option<usize>,
    #[serde(rename = "TANGENT", skip_serializing_if = "Option::is_none")]
    pub tangent: Option<usize>,
    #[serde(rename = "TEXCOORD_0", skip_serializing_if = "Option::is_none")]
    pub texcoord: Option<usize>,
    #[serde(rename = "COLOR_0", skip_serializing_if = "Option::is_none")]
    pub color: Option<usize>,
    #[serde(rename = "_TEMPERATURE", skip_serializing_if = "Option::is_none")]
    pub temperature: Option<usize>,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
pub struct MaterialJson {
    pub name: &'static str,
    pub pbr_metallic_roughness: PbrJson,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub normal_texture: Option<TextureUse>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub emissive_factor: Option<[f32; 3]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub alpha_mode: Option<&'static str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub alpha_cutoff: Option<f32>,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
pub struct PbrJson {
    pub base_color_factor: [f32; 4],
    #[serde(skip_serializing_if = "Option::is_none")]
    pub base_color_texture: Option<TextureUse>,
    pub metallic_factor: f32,
    pub roughness_factor: f32,
}

#[derive(Serialize)]
pub struct TextureUse {
    pub index: usize,
}

#[derive(Serialize)]
pub struct TextureJson {
    pub source: usize,
    pub sampler: usize,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
pub struct ImageJson {
    pub name: &'static str,
    pub buffer_view: usize,
    pub mime_type: &'static str,
}

#[derive(Serialize)]
pub struct CameraJson {
    #[serde(rename = "type")]
    pub kind: &'static str,
    pub perspective: Perspective,
}

/// Radians and scene units.
#[derive(Serialize)]
pub struct Perspective {
    pub yfov: f64,
    pub znear: f64,
}

#[derive(Serialize)]
pub struct AnimationJson {
    pub name: &'static str,
    pub samplers: Vec<SamplerJson>,
    pub channels: Vec<ChannelJson>,
}

#[derive(Serialize)]
pub struct SamplerJson {
    pub input: usize,
    pub output: usize,
    pub interpolation: &'static str,
}

#[derive(Serialize)]
pub struct ChannelJson {
    pub sampler: usize,
    pub target: Target,
}

#[derive(Serialize)]
pub struct Target {
    pub node: usize,
    pub path: &'static str,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
pub struct AccessorJson {
    pub buffer_view: usize,
    pub component_type: u32,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub normalized: Option<bool>,
    pub count: usize,
    #[serde(rename = "type")]
    pub kind: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub min: Option<Vec<f32>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub max: Option<Vec<f32>>,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
pub struct ViewJson {
    pub buffer: usize,
    pub byte_offset: usize,
    pub byte_length: usize,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub target: Option<u32>,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
pub struct BufferJson {
    pub byte_length: usize,
}
