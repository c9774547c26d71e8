//! The scene on the device: geometry, materials, textures. Lives as long as the scene.

use std::collections::{BTreeMap, HashMap};

use super::atlas::Atlas;
use super::clusters::{Cluster, Clustered};
use super::provoking::Provoking;
use super::records::NONE;
use super::{Error, alloc, bindings};
use crate::plan::Item;
use crate::scene::{Across, Edges, Mesh, Primitive, Scene, SceneId};

/// Where a primitive lies in the shared buffers.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Range {
    pub first_index: u32,
    /// Where the numbers start that its triangles have in the primitive.
    pub first_number: u32,
    pub base_vertex: u32,
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
    /// Adds a mesh: the versions of its primitives, by their numbers and ratios. `wanted`: the names of the numbers at
    /// vertices that filters read.
    fn add_mesh(&mut self, mesh: &Mesh, wanted: &BTreeMap<String, [f32; 2]>) -> Vec<(usize, f32, Range, Vec<Cluster>)> {
        // Of the vertices of all primitives, one after the other: where a copy of each stands.
        let mut copies = Vec::new();
        let mut added = Vec::new();
        for (number, primitive) in mesh.primitives.iter().enumerate() {
            for (version, (ratio, triangles)) in primitive.versions().enumerate() {
                let whole = (version == 0).then_some(&mut copies);
                let (range, clusters) = self.add(primitive, triangles, wanted, whole);
                added.push((number, ratio, range, clusters));
            }
        }
        for (number, ratio, range, _) in &mut added {
            range.across = self.across(mesh.primitives[*number].across_of(*ratio), range.first_number, &copies);
        }
        added
    }

    /// What lies across the edges of triangles, in the order in which they are drawn.
    fn across(&mut self, across: &[Edges], first_number: u32, copies: &[u32]) -> u32 {
        if across.is_empty() {
            return NONE;
        }
        let start = self.numbers.len();
        let word = |across: &Across| {
            let opposite = across.opposite().map_or(NO_VERTEX, |vertex| copies[vertex as usize].min(NO_VERTEX));
            opposite | if across.is_feature() { FEATURE } else { 0 }
        };
        for drawn in first_number as usize..first_number as usize + across.len() {
            let edges = &across[self.numbers[drawn] as usize];
            self.numbers.extend(edges.across.each_ref().map(word));
            self.numbers.push(edges.beyond_word());
        }
        start as u32
    }

    /// `copies`: where to append the places of the primitive's vertices.
    fn add(
        &mut self,
        primitive: &Primitive,
        triangles: &[[u32; 3]],
        wanted: &BTreeMap<String, [f32; 2]>,
        copies: Option<&mut Vec<u32>>,
    ) -> (Range, Vec<Cluster>) {
        let Clustered { order: numbers, clusters } = Clustered::new(&primitive.positions, triangles);
        let triangles: Vec<[u32; 3]> = numbers.iter().map(|number| triangles[*number as usize]).collect();
        let order = Provoking::new(primitive.positions.len(), &triangles);
        let range = Range {
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
        if let Some(copies) = copies {
            copies.extend(std::iter::repeat_n(NONE, primitive.positions.len()));
            let own = copies.len() - primitive.positions.len();
            (range.base_vertex..).zip(&order.sources).for_each(|(copy, source)| copies[own + *source as usize] = copy);
        }
        self.positions.extend_from_slice(bytemuck::cast_slice(&order.copied(&primitive.positions)));
        self.indices.extend_from_slice(bytemuck::cast_slice(&order.triangles));
        self.numbers.extend(numbers);
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
                for (p, ratio, range, clusters) in lists.add_mesh(mesh, &scene.value_ranges) {
                    primitives.insert((m, i, p, ratio.to_bits()), (range, clusters));
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
