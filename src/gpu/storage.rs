//! How much memory lenses take on the device.

use super::headless::smaller;
use super::lens_data::LensData;
use super::renderer::Renderer;
use super::targets::ScreenTargets;
use super::{Error, Headless, RenderOptions, Window};
use crate::plan::Plan;
use crate::scene::Scene;

/// Bytes that lenses take on the device: of a picture in several windows those of the largest.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct LensStorage {
    /// The layers of the pixels of tiles that lenses touch.
    pub layers: u64,
    /// Fragments that may be translucent.
    pub fragments: u64,
    /// The newest fragment of each pixel.
    pub heads: u64,
    /// Samples and sums, where there are filters of the screen.
    pub screen: u64,
    /// Which lenses touch which tiles, and with which faces.
    pub tiles: u64,
    /// Lenses, their parts, planes, programs and meshes.
    pub records: u64,
}

impl LensStorage {
    /// Each amount and what it is for.
    pub fn parts(&self) -> [(&'static str, u64); 6] {
        let Self { layers, fragments, heads, screen, tiles, records } = *self;
        [
            ("layers", layers),
            ("fragments", fragments),
            ("heads", heads),
            ("screen", screen),
            ("tiles", tiles),
            ("lens records", records),
        ]
    }

    pub fn total(&self) -> u64 {
        self.parts().iter().map(|(_, bytes)| bytes).sum()
    }
}

impl Headless {
    /// What the frames of a plan keep for its lenses. A renderer keeps what earlier plans needed; one that has only
    /// rendered this plan gives what this one needs.
    pub fn lens_storage(
        &self,
        renderer: &mut Renderer,
        scene: &Scene,
        plan: &Plan,
        options: RenderOptions,
    ) -> Result<LensStorage, Error> {
        let mut largest = LensStorage::default();
        let mut windows = vec![Window::whole(&plan.view)];
        while let Some(window) = windows.pop() {
            match renderer.prepare(&self.device, scene, plan, window, options) {
                Err(error) => windows.extend(smaller(&window, error)?),
                Ok(job) => {
                    let records = LensData::new(plan, job.words, &job.tiles.cells, job.room.crossings);
                    let storage = LensStorage {
                        layers: job.targets.layers.size(),
                        fragments: job.targets.fragments.size(),
                        heads: job.targets.heads.size(),
                        screen: job.targets.screen.as_ref().map_or(0, ScreenTargets::bytes),
                        tiles: 4 * job.tiles.words.len() as u64,
                        records: record_bytes(&records),
                    };
                    if storage.total() > largest.total() {
                        largest = storage;
                    }
                }
            }
        }
        Ok(largest)
    }
}

fn record_bytes(data: &LensData) -> u64 {
    let parts = &data.parts;
    let bytes = data.lenses.len()
        + size_of_val(parts.records.as_slice())
        + size_of_val(parts.vectors.as_slice())
        + size_of_val(parts.words.as_slice());
    bytes as u64
}
