//! The lenses of a plan as records, with the lists that they point into.

use super::depth_maps::DepthMaps;
use super::part_data::PartData;
use super::program::program;
use super::records::{self, LensRecord, words_of};
use crate::plan::Plan;

/// Records of all lenses and of their parts.
#[derive(Debug, Clone, Default)]
pub struct LensData {
    /// A record and the words of the set that it hides, for each lens.
    pub lenses: Vec<u8>,
    pub parts: PartData,
}

impl LensData {
    /// `words`: of a set of lenses; `crossings`: for how many crossings with one mesh a pixel has room.
    pub fn new(plan: &Plan, words: u32, maps: &DepthMaps, crossings: u32) -> Self {
        let mut data = Self::default();
        for (rank, lens) in (0u32..).zip(&plan.lenses) {
            let first_part = data.parts.records.len() as u32;
            for solid in &lens.volume.parts {
                data.parts.add(&plan.view, rank, solid, maps, crossings);
            }
            let program = if lens.volume.lone().is_some() { vec![] } else { program(&lens.volume.tree) };
            let mut record = LensRecord {
                first_part,
                part_count: lens.volume.parts.len() as u32,
                first_token: data.parts.words.len() as u32,
                token_count: program.len() as u32,
                first_op: lens.ops.start as u32,
                op_count: lens.ops.len() as u32,
                ..bytemuck::Zeroable::zeroed()
            };
            if let Some(glass) = lens.glass {
                record.glass = glass;
                record.flags |= records::LENS_GLASS;
            }
            data.parts.words.extend(program);
            data.lenses.extend_from_slice(bytemuck::bytes_of(&record));
            words_of(&lens.hides, words).for_each(|word| data.lenses.extend_from_slice(&word.to_le_bytes()));
            // Records start at multiples of 16 bytes.
            data.lenses.resize(data.lenses.len().next_multiple_of(16), 0);
        }
        data
    }
}
