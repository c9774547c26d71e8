//! What a backend gives back.

use std::collections::HashMap;

use crate::plan::Region;

/// Stands in the maps of indices where nothing is.
pub const NOTHING: u32 = u32::MAX;

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
    pub fn empty(size: [u32; 2]) -> Self {
        let count = size[0] as usize * size[1] as usize;
        Self {
            regions: vec![NOTHING; count],
            table: Vec::new(),
            instances: vec![NOTHING; count],
            triangles: vec![NOTHING; count],
            nodes: vec![0; count],
            depth: vec![f64::INFINITY; count],
            normals: vec![[0.0; 3]; count],
            layers: vec![1; count],
        }
    }

    /// The region of each pixel's visible fragment; `None` where nothing is.
    pub fn region(&self, pixel: usize) -> Option<Region> {
        self.table.get(self.regions[pixel] as usize).copied()
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
