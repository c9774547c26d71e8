//! What a backend gives back.

use crate::plan::LensSet;

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
    /// The lenses around the visible fragment (S); `None` where nothing is.
    pub sets: Vec<Option<LensSet>>,
    /// Node index in its file plus one; 0 where nothing is.
    pub nodes: Vec<u32>,
    /// Along the forward axis, scene units; infinite where nothing is.
    pub depth: Vec<f32>,
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
            sets: vec![None; count],
            nodes: vec![0; count],
            depth: vec![f32::INFINITY; count],
            normals: vec![[0.0; 3]; count],
            layers: vec![1; count],
        }
    }
}
