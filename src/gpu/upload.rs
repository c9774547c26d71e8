//! The scene on the device: geometry, materials, textures. Lives as long as the scene.

use std::collections::HashMap;

use wgpu::util::{BufferInitDescriptor, DeviceExt};

use super::atlas::Atlas;
use super::provoking::Provoking;
use super::records::NONE;
use super::{Error, bindings};
use crate::plan::Item;
use crate::scene::{Aabb, Primitive, Scene};

/// Where a primitive lies in the shared buffers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Range {
    pub first_index: u32,
    pub base_vertex: u32,
    /// Floats, or [`NONE`].
    pub normals: u32,
    pub tangents: u32,
    pub colors: u32,
    pub uv: [u32; 2],
}

/// Consecutive triangles of a primitive, drawn by one call.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Chunk {
    pub first_triangle: u32,
    pub triangles: u32,
    /// In the node's local space.
    pub bounds: Aabb,
}

/// So many triangles at the most are drawn by one call: of a large mesh only the part that a lens reaches then pays
/// for fragments that find their layer. Small enough to follow a lens's outline, large enough to keep calls few.
const CHUNK: usize = 8192;

fn chunks(primitive: &Primitive) -> Vec<Chunk> {
    let corner = |i: &u32| primitive.positions[*i as usize].as_dvec3();
    (0u32..)
        .zip(primitive.triangles.chunks(CHUNK))
        .map(|(number, triangles)| Chunk {
            first_triangle: number * CHUNK as u32,
            triangles: triangles.len() as u32,
            bounds: Aabb::from_points(triangles.iter().flatten().map(corner)),
        })
        .collect()
}

/// Model, mesh and primitive.
type Place = (usize, usize, usize);

/// Everything of a scene that no plan changes.
#[derive(Debug)]
pub struct SceneData {
    pub positions: wgpu::Buffer,
    pub indices: wgpu::Buffer,
    pub bind_group: wgpu::BindGroup,
    primitives: HashMap<Place, (Range, Vec<Chunk>)>,
}

/// The shared buffers while they are filled.
#[derive(Default)]
struct Lists {
    positions: Vec<f32>,
    indices: Vec<u32>,
    attributes: Vec<f32>,
}

impl Lists {
    fn add(&mut self, primitive: &Primitive) -> Range {
        let order = Provoking::new(primitive.positions.len(), &primitive.triangles);
        let range = Range {
            first_index: self.indices.len() as u32,
            base_vertex: (self.positions.len() / 3) as u32,
            normals: self.attribute(&order, primitive.normals.as_deref()),
            tangents: self.attribute(&order, primitive.tangents.as_deref()),
            colors: self.attribute(&order, primitive.colors.as_deref()),
            uv: [0, 1].map(|set| self.attribute(&order, primitive.uv[set].as_deref())),
        };
        self.positions.extend_from_slice(bytemuck::cast_slice(&order.copied(&primitive.positions)));
        self.indices.extend_from_slice(bytemuck::cast_slice(&order.triangles));
        range
    }

    fn attribute<T: bytemuck::Pod>(&mut self, order: &Provoking, values: Option<&[T]>) -> u32 {
        let Some(values) = values else { return NONE };
        let start = self.attributes.len() as u32;
        self.attributes.extend_from_slice(bytemuck::cast_slice(&order.copied(values)));
        start
    }
}

impl SceneData {
    pub fn new(
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        layout: &wgpu::BindGroupLayout,
        scene: &Scene,
    ) -> Result<Self, Error> {
        let mut lists = Lists::default();
        let mut primitives = HashMap::new();
        for (m, model) in scene.models.iter().enumerate() {
            for (i, mesh) in model.meshes.iter().enumerate() {
                for (p, primitive) in mesh.primitives.iter().enumerate() {
                    primitives.insert((m, i, p), (lists.add(primitive), chunks(primitive)));
                }
            }
        }
        let storage = |label: &str, bytes: &[u8], more: wgpu::BufferUsages| {
            storage_buffer(device, label, bytes, wgpu::BufferUsages::STORAGE | more)
        };
        let none = wgpu::BufferUsages::empty();
        let positions = storage("positions", bytemuck::cast_slice(&lists.positions), wgpu::BufferUsages::VERTEX)?;
        let indices = storage("indices", bytemuck::cast_slice(&lists.indices), wgpu::BufferUsages::INDEX)?;
        let attributes = storage("attributes", bytemuck::cast_slice(&lists.attributes), none)?;
        let materials = storage("materials", bytemuck::cast_slice(&scene.materials), none)?;
        let atlas = Atlas::new(device, queue, &scene.textures)?;
        let textures = storage("textures", bytemuck::cast_slice(&atlas.infos), none)?;
        let bind_group = bindings::group(
            device,
            "scene",
            layout,
            &[
                positions.as_entire_binding(),
                indices.as_entire_binding(),
                attributes.as_entire_binding(),
                materials.as_entire_binding(),
                textures.as_entire_binding(),
                wgpu::BindingResource::TextureView(&atlas.linear),
                wgpu::BindingResource::TextureView(&atlas.srgb),
            ],
        );
        Ok(Self { positions, indices, bind_group, primitives })
    }

    /// Where an item's primitive lies, and its chunks.
    pub fn primitive(&self, item: &Item) -> (Range, &[Chunk]) {
        let (range, chunks) = &self.primitives[&(item.model, item.mesh, item.primitive)];
        (*range, chunks)
    }
}

/// The smallest a storage buffer is made: larger than any record, so that an empty list can be bound, too.
const SMALLEST: usize = 1024;

/// A storage buffer with contents, checked against the device's limits.
fn storage_buffer(
    device: &wgpu::Device,
    label: &str,
    bytes: &[u8],
    usage: wgpu::BufferUsages,
) -> Result<wgpu::Buffer, Error> {
    check_size(largest_buffer(device), &format!("the scene's {label}"), bytes.len() as u64)?;
    let padded;
    let contents = if bytes.len() < SMALLEST {
        padded = [bytes, &vec![0; SMALLEST - bytes.len()]].concat();
        &padded
    } else {
        bytes
    };
    Ok(device.create_buffer_init(&BufferInitDescriptor { label: Some(label), contents, usage }))
}

/// Fails with numbers when a buffer is larger than allowed.
pub fn check_size(allowed: u64, what: &str, needed: u64) -> Result<(), Error> {
    if needed > allowed {
        return Err(Error::TooLarge { what: what.into(), needed, allowed });
    }
    Ok(())
}

/// The largest storage buffer, in bytes.
pub fn largest_buffer(device: &wgpu::Device) -> u64 {
    let limits = device.limits();
    limits.max_storage_buffer_binding_size.min(limits.max_buffer_size)
}
