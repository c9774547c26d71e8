//! The lenses and rules of a plan as records, with the lists that they point into.

use super::cells::Cells;
use super::part_data::PartData;
use super::program::{condition, is_flat, program};
use super::records::{self, LensRecord, words_of};
use crate::lens::Tree;
use crate::plan::{Lens, LensSet, Plan, Rule};
use crate::spec::By;
use crate::view::View;

/// Records of all lenses and of their parts.
#[derive(Debug, Clone, Default)]
pub struct LensData {
    /// A record and the words of the set that it hides, for each lens, then for each rule.
    pub lenses: Vec<u8>,
    pub parts: PartData,
}

impl LensData {
    /// `words`: of a set of lenses; `cells`: of each part; `crossings`: for how many crossings with one mesh a pixel has room.
    pub fn new(plan: &Plan, words: u32, cells: &[Option<Cells>], crossings: u32) -> Self {
        let mut data = Self::default();
        let moves = plan.items.iter().any(|item| !item.movers.is_empty());
        for (rank, lens) in (0u32..).zip(&plan.lenses) {
            let whole = moves || !plan.bodies.is_empty() || lens.soft > 0.0 || lens.glass.is_some();
            let record = data.lens(&plan.view, rank, lens, cells, whole, crossings);
            data.push(record, &lens.hides, words);
        }
        for rule in &plan.rules {
            let record = data.rule(rule, words);
            data.push(record, &LensSet::EMPTY, words);
        }
        data
    }

    fn push(&mut self, record: LensRecord, hides: &LensSet, words: u32) {
        self.lenses.extend_from_slice(bytemuck::bytes_of(&record));
        words_of(hides, words).for_each(|word| self.lenses.extend_from_slice(&word.to_le_bytes()));
        // Records start at multiples of 16 bytes.
        self.lenses.resize(self.lenses.len().next_multiple_of(16), 0);
    }

    fn lens(
        &mut self,
        view: &View,
        rank: u32,
        lens: &Lens,
        cells: &[Option<Cells>],
        whole: bool,
        crossings: u32,
    ) -> LensRecord {
        let first_part = self.parts.records.len() as u32;
        for solid in &lens.volume.parts {
            let cells = cells[self.parts.records.len()].as_ref();
            self.parts.add(view, rank, solid, cells, whole, crossings);
        }
        let program = if let Tree::Part(_) = lens.volume.tree { vec![] } else { program(&lens.volume.tree) };
        let mut record = LensRecord {
            first_part,
            part_count: lens.volume.parts.len() as u32,
            first_token: self.parts.words.len() as u32,
            token_count: program.len() as u32,
            first_op: lens.ops.start as u32,
            op_count: lens.ops.len() as u32,
            soft: lens.soft as f32,
            lod: lens.lod.unwrap_or(1.0),
            ..bytemuck::Zeroable::zeroed()
        };
        self.parts.words.extend(program);
        if let Some(glass) = lens.glass {
            record.glass = glass;
            record.flags |= records::LENS_GLASS;
        }
        if lens.by == By::Object {
            record.flags |= records::LENS_BY_OBJECT;
        }
        if is_flat(&lens.volume.tree) {
            record.flags |= records::LENS_FLAT;
        }
        record
    }

    fn rule(&mut self, rule: &Rule, words: u32) -> LensRecord {
        let (names, program) = condition(&rule.when);
        let first_part = self.parts.words.len() as u32;
        names.iter().for_each(|name| self.parts.words.extend(words_of(name, words)));
        let record = LensRecord {
            first_part,
            part_count: names.len() as u32,
            first_token: self.parts.words.len() as u32,
            token_count: program.len() as u32,
            first_op: rule.ops.start as u32,
            op_count: rule.ops.len() as u32,
            lod: rule.lod.unwrap_or(1.0),
            ..bytemuck::Zeroable::zeroed()
        };
        self.parts.words.extend(program);
        record
    }
}
