//! The scene on the device: geometry, materials, textures. Lives as long as the scene.

use std::collections::{BTreeMap, HashMap};

use glam::Vec3;

use super::atlas::Atlas;
use super::clusters::{Cluster, Clustered};
use super::provoking::Provoking;
use super::records::NONE;
use super::{Error, alloc, bindings};
use crate::plan::Item;
use crate::scene::{Mesh, Primitive, Scene, SceneId};

/// Where a primitive lies in the shared buffers.
#[derive(Debug, Clone, PartialEq)]
pub struct Range {
    pub first_index: u32,
    /// Where the numbers start that its triangles have in the primitive.
    pub first_number: u32,
    pub base_vertex: u32,
    /// Its positions are relative to this: a mesh far from its own origin keeps its digits.
    pub middle: Vec3,
    /// Floats, or [`NONE`].
    pub normals: u32,
    pub tangents: u32,
    pub colors: u32,
    pub uv: [u32; 2],
    /// Where what lies across the edges of its triangles starts, among the numbers, or [`NONE`].
    pub across: u32,
    /// Of other numbers at vertices, by name.
    pub values: BTreeMap<String, u32>,
}

/// Of the bounds of points; none where they have no middle that is a number.
fn middle(points: &[Vec3]) -> Vec3 {
    let ends = (Vec3::INFINITY, Vec3::NEG_INFINITY);
    let (low, high) = points.iter().fold(ends, |(low, high), p| (low.min(*p), high.max(*p)));
    let middle = 0.5 * low + 0.5 * high;
    if middle.is_finite() { middle } else { Vec3::ZERO }
}

/// Model, mesh, primitive, and the bits of the ratio of its version.
type Place = (usize, usize, usize, u32);

/// In a word of what lies across an edge: no triangle, and that the surface turns there. Twins of `shade.wgsl`.
const NO_VERTEX: u32 = FEATURE - 1;
const FEATURE: u32 = 1 << 31;

/// Everything of a scene that no plan changes.
#[derive(Debug)]
pub struct SceneData {
    pub positions: wgpu::Buffer,
    pub indices: wgpu::Buffer,
    pub bind_group: wgpu::BindGroup,
    /// Which scene it is.
    pub id: SceneId,
    primitives: HashMap<Place, (Range, Vec<Cluster>)>,
    /// Of each triangle in the order in which they are drawn, its number in its primitive.
    numbers: Vec<u32>,
}

/// The shared buffers while they are filled.
#[derive(Default)]
struct Lists {
    positions: Vec<f32>,
    indices: Vec<u32>,
    attributes: Vec<f32>,
    numbers: Vec<u32>,
}

impl Lists {
    /// What lies across the edges of a primitive's triangles, in the order in which they are drawn. `copies`: where a copy of
    /// each of its vertices stands; those of other primitives are appended, around `middle` like its own.
    fn across(&mut self, mesh: &Mesh, number: usize, ratio: f32, drawn: &[u32], copies: &[u32], middle: Vec3) -> u32 {
        let across = mesh.primitives[number].across_of(ratio);
        if across.is_empty() {
            return NONE;
        }
        let first = mesh.primitives[number].first_vertex as usize;
        let start = self.numbers.len() as u32;
        let mut others: HashMap<u32, u32> = HashMap::new();
        for number in drawn {
            let edges = &across[*number as usize];
            for across in &edges.across {
                let place = across.opposite().map(|vertex| {
                    let own = (vertex as usize).checked_sub(first).and_then(|own| copies.get(own));
                    own.copied().unwrap_or_else(|| {
                        *others.entry(vertex).or_insert_with(|| {
                            let p = mesh.vertex(vertex).unwrap_or_default() - middle;
                            self.positions.extend(p.to_array());
                            (self.positions.len() / 3 - 1) as u32
                        })
                    })
                });
                let feature = if across.is_feature() { FEATURE } else { 0 };
                self.numbers.push(place.map_or(NO_VERTEX, |place| place.min(NO_VERTEX)) | feature);
            }
            self.numbers.push(edges.beyond_word());
        }
        start
    }

    /// Adds a version of a mesh's primitive. `wanted`: the names of the numbers at vertices that filters read.
    fn add(
        &mut self,
        mesh: &Mesh,
        number: usize,
        (ratio, triangles): (f32, &[[u32; 3]]),
        wanted: &BTreeMap<String, [f32; 2]>,
    ) -> (Range, Vec<Cluster>) {
        let primitive = &mesh.primitives[number];
        let Clustered { order: numbers, clusters } = Clustered::new(&primitive.positions, triangles);
        let triangles: Vec<[u32; 3]> = numbers.iter().map(|number| triangles[*number as usize]).collect();
        let order = Provoking::new(primitive.positions.len(), &triangles);
        let middle = middle(&primitive.positions);
        let around: Vec<Vec3> = primitive.positions.iter().map(|p| *p - middle).collect();
        let mut range = Range {
            middle,
            first_index: self.indices.len() as u32,
            first_number: self.numbers.len() as u32,
            base_vertex: (self.positions.len() / 3) as u32,
            normals: self.attribute(&order, primitive.normals.as_deref()),
            tangents: self.attribute(&order, primitive.tangents.as_deref()),
            colors: self.attribute(&order, primitive.colors.as_deref()),
            uv: [0, 1].map(|set| self.attribute(&order, primitive.uv[set].as_deref())),
            across: NONE,
            values: self.values(&order, primitive, wanted),
        };
        self.positions.extend_from_slice(bytemuck::cast_slice(&order.copied(&around)));
        self.indices.extend_from_slice(bytemuck::cast_slice(&order.triangles));
        self.numbers.extend_from_slice(&numbers);
        let mut copies = vec![NONE; primitive.positions.len()];
        (range.base_vertex..).zip(&order.sources).for_each(|(copy, source)| copies[*source as usize] = copy);
        range.across = self.across(mesh, number, ratio, &numbers, &copies, middle);
        (range, clusters)
    }

    fn values(
        &mut self,
        order: &Provoking,
        primitive: &Primitive,
        wanted: &BTreeMap<String, [f32; 2]>,
    ) -> BTreeMap<String, u32> {
        let values = primitive.values.iter().filter(|(name, _)| wanted.contains_key(*name));
        values.map(|(name, values)| (name.clone(), self.attribute(order, Some(values)))).collect()
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
                    for version in primitive.versions() {
                        let added = lists.add(mesh, p, version, &scene.value_ranges);
                        primitives.insert((m, i, p, version.0.to_bits()), added);
                    }
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
        let numbers = storage("numbers of triangles", bytemuck::cast_slice(&lists.numbers), none)?;
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
                numbers.as_entire_binding(),
            ],
        );
        Ok(Self { positions, indices, bind_group, id: scene.id, primitives, numbers: lists.numbers })
    }

    /// Of each triangle of an item's version of its primitive, its place in the order in which they are drawn.
    pub fn drawn_places(&self, item: &Item) -> Vec<u32> {
        let mut places = vec![0; item.triangles as usize];
        (0u32..).zip(self.order(item)).for_each(|(place, number)| places[*number as usize] = place);
        places
    }

    /// Where an item's version of its primitive lies, and its clusters.
    pub fn primitive(&self, item: &Item) -> (&Range, &[Cluster]) {
        let (range, clusters) = &self.primitives[&(item.model, item.mesh, item.primitive, item.ratio.to_bits())];
        (range, clusters)
    }

    /// The number in its primitive of each of an item's drawn triangles.
    pub fn order(&self, item: &Item) -> &[u32] {
        let first = self.primitive(item).0.first_number as usize;
        &self.numbers[first..first + item.triangles as usize]
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
    let what = format!("the scene's {label}");
    check_size(largest_buffer(device), &what, bytes.len() as u64)?;
    let padded;
    let contents = if bytes.len() < SMALLEST {
        padded = [bytes, &vec![0; SMALLEST - bytes.len()]].concat();
        &padded
    } else {
        bytes
    };
    alloc::filled_buffer(device, &what, contents, usage)
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
