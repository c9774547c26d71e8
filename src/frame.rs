//! What a backend gives back.

use std::collections::HashMap;

use crate::plan::{LensSet, Region};

/// Stands in the maps of indices where nothing is.
pub const NOTHING: u32 = u32::MAX;

/// There is no memory for what was asked for.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("there is no memory for {bytes} bytes of a picture of {pixels} pixels")]
pub struct NoMemory {
    pub pixels: u64,
    pub bytes: u64,
}

/// So many values, or that there is no memory for them.
pub(crate) fn filled<T: Clone>(count: usize, value: T) -> Result<Vec<T>, NoMemory> {
    let mut list = Vec::new();
    let bytes = (count as u64).saturating_mul(size_of::<T>() as u64);
    list.try_reserve_exact(count).map_err(|_| NoMemory { pixels: count as u64, bytes })?;
    list.resize(count, value);
    Ok(list)
}

/// Fails before any work where there is no memory for a picture, with its maps or without.
pub(crate) fn check_memory(size: [u32; 2], aovs: bool) -> Result<(), NoMemory> {
    let pixels = u64::from(size[0]) * u64::from(size[1]);
    let bytes = pixels * (4 + if aovs { Aovs::BYTES } else { 0 });
    let no_memory = NoMemory { pixels, bytes };
    let count = usize::try_from(bytes).map_err(|_| no_memory.clone())?;
    Vec::<u8>::new().try_reserve_exact(count).map_err(|_| no_memory)
}

/// A finished picture.
#[derive(Debug, Clone, PartialEq)]
pub struct Frame {
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// sRGB, straight alpha, row 0 at the top.
    pub pixels: Vec<[u8; 4]>,
    pub aovs: Option<Aovs>,
}

/// What lies at the centre of each pixel; each list has one entry a pixel, row 0 at the top.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Aovs {
    /// The region of the visible fragment, into `table`; [`NOTHING`] where nothing is.
    pub regions: Vec<u32>,
    /// The regions that the picture has, in the order in which they were met.
    pub table: Vec<Region>,
    /// What is visible, into [`Plan::instances`](crate::plan::Plan::instances); [`NOTHING`] where nothing is.
    pub instances: Vec<u32>,
    /// Which of its item's triangles; [`NOTHING`] where nothing is.
    pub triangles: Vec<u32>,
    /// Node index in its file plus one; 0 where nothing is.
    pub nodes: Vec<u32>,
    /// From the eye along the forward axis, scene units; infinite where nothing is.
    pub depth: Vec<f64>,
    /// World space; zero where nothing is.
    pub normals: Vec<[f32; 3]>,
    /// One more than the distinct lens boundaries between near and far.
    pub layers: Vec<u16>,
}

impl Aovs {
    /// Maps of a picture where nothing is.
    ///
    /// # Errors
    /// There is no memory for them.
    pub fn empty(size: [u32; 2]) -> Result<Self, NoMemory> {
        let count = size[0] as usize * size[1] as usize;
        Ok(Self {
            regions: filled(count, NOTHING)?,
            table: Vec::new(),
            instances: filled(count, NOTHING)?,
            triangles: filled(count, NOTHING)?,
            nodes: filled(count, 0)?,
            depth: filled(count, f64::INFINITY)?,
            normals: filled(count, [0.0; 3])?,
            layers: filled(count, 1)?,
        })
    }

    /// Bytes a pixel.
    pub const BYTES: u64 = 4 * 4 + 8 + 12 + 2;

    /// The region of each pixel's visible fragment; `None` where nothing is.
    pub fn region(&self, pixel: usize) -> Option<Region> {
        self.table.get(self.regions[pixel] as usize).copied()
    }
}

/// What lies in front of the visible fragments, at the centres of a picture's pixels.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct InFront {
    /// By rank, of lenses and rules: the pixels in which it takes something away in front of what is visible, or where
    /// nothing is left.
    pub removes: Vec<u64>,
    /// By rank: the pixels in which it acts on something that is seen through.
    pub seen_through: Vec<u64>,
    /// The pixels in which something of a region is seen through.
    pub regions: HashMap<Region, u64>,
    /// For each pixel the region of the nearest surface that lenses leave, opaque or not, into `table`; [`NOTHING`] where
    /// nothing is.
    pub nearest: Vec<u32>,
    pub table: Vec<Region>,
}

impl InFront {
    /// Of so many lenses and rules, with these nearest surfaces.
    pub(crate) fn of(ranks: usize, nearest: Vec<u32>) -> Self {
        Self { removes: vec![0; ranks], seen_through: vec![0; ranks], nearest, ..Self::default() }
    }

    /// Adds the counts of other pixels.
    pub(crate) fn add(&mut self, other: Self) {
        self.removes.iter_mut().zip(other.removes).for_each(|(all, own)| *all += own);
        self.seen_through.iter_mut().zip(other.seen_through).for_each(|(all, own)| *all += own);
        other.regions.into_iter().for_each(|(region, own)| *self.regions.entry(region).or_default() += own);
    }

    /// Takes one pixel: who takes away in front of it, and the regions of what is seen through, each once.
    pub(crate) fn count(&mut self, removers: LensSet, seen_through: &[Region]) {
        removers.iter().for_each(|rank| self.removes[rank] += 1);
        let acting = seen_through.iter().fold(LensSet::EMPTY, |all, region| all | region.stack);
        acting.iter().for_each(|rank| self.seen_through[rank] += 1);
        seen_through.iter().for_each(|region| *self.regions.entry(*region).or_default() += 1);
    }

    /// The maps of a picture with the nearest surfaces' regions in place of those of the visible fragments.
    pub fn nearest_regions(&self, aovs: &Aovs) -> Aovs {
        Aovs { regions: self.nearest.clone(), table: self.table.clone(), ..aovs.clone() }
    }
}

/// Numbers regions as they are met.
#[derive(Debug, Default)]
pub struct RegionTable {
    numbers: HashMap<Region, u32>,
    pub table: Vec<Region>,
}

impl RegionTable {
    pub fn number(&mut self, region: Region) -> u32 {
        *self.numbers.entry(region).or_insert_with(|| {
            self.table.push(region);
            self.table.len() as u32 - 1
        })
    }
}
