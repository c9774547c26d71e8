//! How much of a picture each region takes.

use std::collections::HashMap;

use crate::frame::{Aovs, InFront};
use crate::plan::Region;

/// Pixels of a picture by the region of their visible fragments.
#[derive(Debug, Clone, PartialEq)]
pub struct Coverage {
    pub size: [u32; 2],
    /// Who made the picture, in a word.
    pub backend: String,
    /// Pixels where nothing is.
    pub nothing: u64,
    pub in_front: InFront,
    pixels: HashMap<Region, u64>,
}

impl Coverage {
    pub fn new(size: [u32; 2], aovs: &Aovs, in_front: InFront, backend: &str) -> Self {
        let mut counts = vec![0; aovs.table.len()];
        let mut nothing = 0;
        for index in &aovs.regions {
            *counts.get_mut(*index as usize).unwrap_or(&mut nothing) += 1;
        }
        let pixels = aovs.table.iter().copied().zip(counts).collect();
        Self { size, backend: backend.into(), nothing, in_front, pixels }
    }

    /// Pixels whose visible fragment lies in a region.
    pub fn pixels(&self, region: &Region) -> u64 {
        self.pixels.get(region).copied().unwrap_or(0)
    }

    /// Pixels whose visible fragment a lens or rule acts on.
    pub fn acts(&self, rank: usize) -> u64 {
        self.pixels.iter().filter(|(region, _)| region.stack.contains(rank)).map(|(_, pixels)| pixels).sum()
    }

    /// Pixels in which something of a region is seen through.
    pub fn seen_through(&self, region: &Region) -> u64 {
        self.in_front.regions.get(region).copied().unwrap_or(0)
    }

    /// A number of pixels in percent of the picture.
    pub fn percent(&self, pixels: u64) -> f64 {
        100.0 * pixels as f64 / self.size.iter().map(|side| f64::from(*side)).product::<f64>()
    }
}
