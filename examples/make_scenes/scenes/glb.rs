//! A small glTF 2.0 binary writer: only what the generated scenes use. Typed JSON keeps the key order fixed.

use glam::{DMat3, DVec3};
use serde::Serialize;

use super::gltf_json::*;
use super::{det, mesh::Mesh};

const FLOAT: u32 = 5126;
const U8: u32 = 5121;
const U16: u32 = 5123;
const U32: u32 = 5125;
const VERTICES: u32 = 34962;
const INDICES: u32 = 34963;

/// Builds one file: add images, materials, meshes and nodes, then [`Glb::finish`].
#[derive(Default)]
pub struct Glb {
    json: Document,
    binary: Vec<u8>,
}

/// Metallic-roughness material; colours in linear light.
#[derive(Clone)]
pub struct Look {
    pub name: &'static str,
    pub color: [f32; 4],
    pub metallic: f32,
    pub roughness: f32,
    pub emissive: [f32; 3],
    /// Index from [`Glb::texture`].
    pub texture: Option<usize>,
    pub normal_map: Option<usize>,
    pub alpha: Alpha,
}

#[derive(Clone, Copy, PartialEq)]
pub enum Alpha {
    Opaque,
    Mask(f32),
    Blend,
}

impl Look {
    /// An opaque surface of an sRGB colour `0xrrggbb`.
    pub fn new(name: &'static str, hex: u32, metallic: f32, roughness: f32) -> Self {
        let [r, g, b] = det::rgb(hex);
        let (emissive, texture, normal_map, alpha) = ([0.0; 3], None, None, Alpha::Opaque);
        Self { name, color: [r, g, b, 1.0], metallic, roughness, emissive, texture, normal_map, alpha }
    }

    pub fn blended(mut self, alpha: f32) -> Self {
        self.color[3] = alpha;
        self.alpha = Alpha::Blend;
        self
    }

    pub fn glowing(mut self, hex: u32) -> Self {
        self.emissive = det::rgb(hex);
        self
    }

    pub fn textured(mut self, texture: usize) -> Self {
        self.texture = Some(texture);
        self
    }
}

/// Where a node is and what it holds.
#[derive(Clone, Copy, Default)]
pub struct Place {
    pub parent: Option<usize>,
    pub mesh: Option<usize>,
    pub at: DVec3,
    /// Identity where left out.
    pub turn: Option<DMat3>,
    pub scale: Option<DVec3>,
}

impl Place {
    pub fn mesh(mesh: usize) -> Self {
        Self { mesh: Some(mesh), ..Self::default() }
    }

    pub fn under(mut self, parent: usize) -> Self {
        self.parent = Some(parent);
        self
    }

    pub fn at(mut self, x: f64, y: f64, z: f64) -> Self {
        self.at = DVec3::new(x, y, z);
        self
    }

    pub fn turned(mut self, turn: DMat3) -> Self {
        self.turn = Some(turn);
        self
    }

    pub fn scaled(mut self, scale: DVec3) -> Self {
        self.scale = Some(scale);
        self
    }
}

/// Texture filtering and wrapping as glTF numbers them.
#[derive(Clone, Copy, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Sampling {
    pub mag_filter: u32,
    pub min_filter: u32,
    pub wrap_s: u32,
    pub wrap_t: u32,
}

impl Sampling {
    pub const REPEAT: u32 = 10497;
    pub const MIRROR: u32 = 33648;
    pub const CLAMP: u32 = 33071;
    /// Trilinear, repeated in u, clamped in v: for maps of a globe.
    pub const GLOBE: Self = Self { mag_filter: 9729, min_filter: 9987, wrap_s: Self::REPEAT, wrap_t: Self::CLAMP };
    pub const SMOOTH: Self = Self { mag_filter: 9729, min_filter: 9987, wrap_s: Self::CLAMP, wrap_t: Self::CLAMP };
}

/// A light of `KHR_lights_punctual`.
#[derive(Clone, Serialize)]
pub struct Light {
    pub name: &'static str,
    #[serde(rename = "type")]
    pub kind: &'static str,
    pub color: [f32; 3],
    pub intensity: f32,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub range: Option<f32>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub spot: Option<Spot>,
}

/// Half angles in radians.
#[derive(Clone, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Spot {
    pub inner_cone_angle: f32,
    pub outer_cone_angle: f32,
}

impl Glb {
    /// Embeds an encoded PNG or JPEG and returns a texture that samples it.
    pub fn texture(&mut self, name: &'static str, encoded: &[u8], sampling: Sampling) -> usize {
        let view = self.view(encoded, None);
        let mime_type = if encoded.starts_with(b"\x89PNG") { "image/png" } else { "image/jpeg" };
        self.json.images.push(ImageJson { name, buffer_view: view, mime_type });
        self.json.samplers.push(sampling);
        self.json
            .textures
            .push(TextureJson { source: self.json.images.len() - 1, sampler: self.json.samplers.len() - 1 });
        self.json.textures.len() - 1
    }

    pub fn material(&mut self, look: Look) -> usize {
        let (alpha_mode, alpha_cutoff) = match look.alpha {
            Alpha::Opaque => (None, None),
            Alpha::Mask(cutoff) => (Some("MASK"), Some(cutoff)),
            Alpha::Blend => (Some("BLEND"), None),
        };
        self.json.materials.push(MaterialJson {
            name: look.name,
            pbr_metallic_roughness: PbrJson {
                base_color_factor: look.color,
                base_color_texture: look.texture.map(|index| TextureUse { index }),
                metallic_factor: look.metallic,
                roughness_factor: look.roughness,
            },
            normal_texture: look.normal_map.map(|index| TextureUse { index }),
            emissive_factor: (look.emissive != [0.0; 3]).then_some(look.emissive),
            alpha_mode,
            alpha_cutoff,
        });
        self.json.materials.len() - 1
    }

    /// A mesh of one primitive.
    pub fn mesh(&mut self, name: &str, mesh: &Mesh, material: usize) -> usize {
        self.mesh_of(name, &[(mesh, material)])
    }

    pub fn mesh_of(&mut self, name: &str, parts: &[(&Mesh, usize)]) -> usize {
        let primitives = parts.iter().map(|(mesh, material)| self.primitive(mesh, *material)).collect();
        self.json.meshes.push(MeshJson { name: name.to_owned(), primitives });
        self.json.meshes.len() - 1
    }

    pub fn node(&mut self, name: &str, place: Place) -> usize {
        let index = self.json.nodes.len();
        self.json.nodes.push(NodeJson {
            name: name.to_owned(),
            children: Vec::new(),
            mesh: place.mesh,
            camera: None,
            translation: (place.at != DVec3::ZERO).then(|| short(place.at.to_array())),
            rotation: place.turn.map(|m| short(det::quaternion(m))),
            scale: place.scale.map(|s| short(s.to_array())),
            extensions: None,
        });
        match place.parent {
            Some(parent) => self.json.nodes[parent].children.push(index),
            None => self.json.scenes[0].nodes.push(index),
        }
        index
    }

    /// A node with a light that shines along its -z.
    pub fn light(&mut self, place: Place, light: Light) {
        let node = self.node(light.name, place);
        let lights = self.json.extensions.get_or_insert_default();
        self.json.nodes[node].extensions = Some(NodeLights { lights: LightRef { light: lights.lights.lights.len() } });
        lights.lights.lights.push(light);
        self.json.extensions_used = vec!["KHR_lights_punctual"];
    }

    /// A node with a camera that looks along its -z.
    pub fn camera(&mut self, name: &str, place: Place, yfov: f64) -> usize {
        let node = self.node(name, place);
        self.json.nodes[node].camera = Some(self.json.cameras.len());
        self.json.cameras.push(CameraJson { kind: "perspective", perspective: Perspective { yfov, znear: 0.1 } });
        node
    }

    pub fn animation(&mut self, name: &'static str) {
        self.json.animations.push(AnimationJson { name, samplers: Vec::new(), channels: Vec::new() });
    }

    /// Adds a channel to the last animation: `values` at `times` in seconds, three a time for a `CUBICSPLINE`.
    pub fn channel<const N: usize>(
        &mut self,
        node: usize,
        path: &'static str,
        interpolation: &'static str,
        times: &[f32],
        values: &[[f32; N]],
    ) {
        let input = self.floats(&times.iter().map(|t| [*t]).collect::<Vec<_>>(), "SCALAR", None);
        self.json.accessors[input].min = times.first().map(|t| vec![*t]);
        self.json.accessors[input].max = times.last().map(|t| vec![*t]);
        let output = self.floats(values, if N == 3 { "VEC3" } else { "VEC4" }, None);
        let animation = self.json.animations.last_mut().expect("an animation to add to");
        let sampler = animation.samplers.len();
        animation.samplers.push(SamplerJson { input, output, interpolation });
        animation.channels.push(ChannelJson { sampler, target: Target { node, path } });
    }

    /// The bytes of the file.
    pub fn finish(mut self) -> Vec<u8> {
        self.json.buffers.push(BufferJson { byte_length: self.binary.len() });
        let mut json = serde_json::to_vec(&self.json).expect("plain data serialises");
        json.resize(json.len().next_multiple_of(4), b' ');
        let total = 12 + 8 + json.len() + 8 + self.binary.len();
        let mut out = Vec::with_capacity(total);
        out.extend(b"glTF");
        out.extend(2u32.to_le_bytes());
        out.extend((total as u32).to_le_bytes());
        for (kind, chunk) in [(b"JSON", &json), (b"BIN\0", &self.binary)] {
            out.extend((chunk.len() as u32).to_le_bytes());
            out.extend(kind);
            out.extend(chunk);
        }
        out
    }

    fn primitive(&mut self, mesh: &Mesh, material: usize) -> PrimitiveJson {
        let positions: Vec<[f32; 3]> = mesh.positions.iter().map(|p| p.as_vec3().to_array()).collect();
        let position = self.floats(&positions, "VEC3", Some(VERTICES));
        let (min, max) = bounds(&positions);
        self.json.accessors[position].min = Some(min.to_vec());
        self.json.accessors[position].max = Some(max.to_vec());
        let normals: Vec<[f32; 3]> = mesh.normals.iter().map(|n| n.as_vec3().to_array()).collect();
        let tangents: Vec<[f32; 4]> = mesh.tangents.iter().map(|t| t.as_vec4().to_array()).collect();
        let uv: Vec<[f32; 2]> = mesh.uv.iter().map(|t| t.as_vec2().to_array()).collect();
        let attributes = Attributes {
            position,
            normal: (!normals.is_empty()).then(|| self.floats(&normals, "VEC3", Some(VERTICES))),
            tangent: (!tangents.is_empty()).then(|| self.floats(&tangents, "VEC4", Some(VERTICES))),
            texcoord: (!uv.is_empty()).then(|| self.floats(&uv, "VEC2", Some(VERTICES))),
            color: (!mesh.colors.is_empty()).then(|| self.colors(&mesh.colors)),
            temperature: (!mesh.temperatures.is_empty())
                .then(|| self.floats(&mesh.temperatures, "SCALAR", Some(VERTICES))),
        };
        PrimitiveJson { attributes, indices: self.indices(mesh), material }
    }

    fn floats<const N: usize>(&mut self, values: &[[f32; N]], kind: &'static str, target: Option<u32>) -> usize {
        let bytes: Vec<u8> = values.iter().flatten().flat_map(|v| v.to_le_bytes()).collect();
        self.accessor(&bytes, target, FLOAT, values.len(), kind)
    }

    fn colors(&mut self, values: &[[u8; 4]]) -> usize {
        let accessor = self.accessor(values.as_flattened(), Some(VERTICES), U8, values.len(), "VEC4");
        self.json.accessors[accessor].normalized = Some(true);
        accessor
    }

    fn indices(&mut self, mesh: &Mesh) -> usize {
        let indices = mesh.triangles.as_flattened();
        // 65535 is the restart index of 16 bits.
        let narrow = mesh.positions.len() < 65535;
        let bytes: Vec<u8> = if narrow {
            indices.iter().flat_map(|i| (*i as u16).to_le_bytes()).collect()
        } else {
            indices.iter().flat_map(|i| i.to_le_bytes()).collect()
        };
        self.accessor(&bytes, Some(INDICES), if narrow { U16 } else { U32 }, indices.len(), "SCALAR")
    }

    fn accessor(
        &mut self,
        bytes: &[u8],
        target: Option<u32>,
        component: u32,
        count: usize,
        kind: &'static str,
    ) -> usize {
        let buffer_view = self.view(bytes, target);
        self.json.accessors.push(AccessorJson {
            buffer_view,
            component_type: component,
            normalized: None,
            count,
            kind,
            min: None,
            max: None,
        });
        self.json.accessors.len() - 1
    }

    fn view(&mut self, bytes: &[u8], target: Option<u32>) -> usize {
        let view = ViewJson { buffer: 0, byte_offset: self.binary.len(), byte_length: bytes.len(), target };
        self.binary.extend(bytes);
        self.binary.resize(self.binary.len().next_multiple_of(4), 0);
        self.json.buffer_views.push(view);
        self.json.buffer_views.len() - 1
    }
}

fn bounds(positions: &[[f32; 3]]) -> ([f32; 3], [f32; 3]) {
    let start = ([f32::MAX; 3], [f32::MIN; 3]);
    positions.iter().fold(start, |(min, max), p| {
        (std::array::from_fn(|i| min[i].min(p[i])), std::array::from_fn(|i| max[i].max(p[i])))
    })
}

/// Six decimals are enough for a node's place and keep the JSON readable.
fn short<const N: usize>(values: [f64; N]) -> [f64; N] {
    // Adding zero turns -0 into 0.
    values.map(|v| (v * 1e6).round() / 1e6 + 0.0)
}
