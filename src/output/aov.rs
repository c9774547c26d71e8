//! AOV files: 16-bit gray PNG for numbers, EXR for floats.

use std::io::Cursor;
use std::path::Path;

use exr::prelude::{
    AnyChannel, AnyChannels, Encoding, FlatSamples, Image as ExrImage, Layer, LayerAttributes, LineOrder, WritableImage,
};

use super::png::write_gray16;
use super::{RegionMap, write_whole};
use crate::InputError;
use crate::frame::Aovs;
use crate::plan::Plan;

/// Which map.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Aov {
    Region,
    Depth,
    Normal,
    Node,
    Layers,
}

impl Aov {
    pub const ALL: [(&'static str, Aov); 5] = [
        ("region", Aov::Region),
        ("depth", Aov::Depth),
        ("normal", Aov::Normal),
        ("node", Aov::Node),
        ("layers", Aov::Layers),
    ];

    pub fn name(self) -> &'static str {
        Self::ALL.into_iter().find(|(_, aov)| *aov == self).map_or("", |(name, _)| name)
    }
}

/// Writes one map; for regions its table, too, with the extension `.json`.
pub fn write_aov(path: &Path, aov: Aov, plan: &Plan, aovs: &Aovs) -> Result<(), InputError> {
    let size = plan.view.size;
    match aov {
        Aov::Node => {
            let narrow: Result<Vec<u16>, _> = aovs.nodes.iter().map(|node| u16::try_from(*node)).collect();
            let nodes = narrow.map_err(|_| {
                InputError::new("the picture shows a node of number 65535 or more, and a node map has 16 bits a pixel")
                    .help("leave out `--aov node`")
            })?;
            write_gray16(path, &nodes, size)
        }
        Aov::Layers => write_gray16(path, &aovs.layers, size),
        Aov::Region => {
            let map = RegionMap::new(plan, &plan.regions().regions, aovs)?;
            write_gray16(path, &map.ids, size)?;
            let table = serde_json::to_string_pretty(&map.json()).unwrap_or_default();
            write_whole(&path.with_extension("json"), (table + "\n").as_bytes())
        }
        Aov::Depth => write_exr(path, size, &[("Z", aovs.depth.iter().map(|depth| *depth as f32).collect())]),
        Aov::Normal => {
            let axis = |i: usize| aovs.normals.iter().map(|n| n[i]).collect();
            write_exr(path, size, &[("R", axis(0)), ("G", axis(1)), ("B", axis(2))])
        }
    }
}

/// Tiles in rows from the top: without an order each stands in the file when its thread is done, another way every time.
const ENCODING: Encoding = Encoding { line_order: LineOrder::Increasing, ..Encoding::FAST_LOSSLESS };

fn write_exr(path: &Path, size: [u32; 2], channels: &[(&str, Vec<f32>)]) -> Result<(), InputError> {
    let bytes =
        exr_bytes(size, channels).map_err(|e| InputError::new(format!("{} cannot be encoded: {e}", path.display())))?;
    write_whole(path, &bytes)
}

fn exr_bytes(size: [u32; 2], channels: &[(&str, Vec<f32>)]) -> exr::error::Result<Vec<u8>> {
    let channel = |(name, values): &(&str, Vec<f32>)| AnyChannel::new(*name, FlatSamples::F32(values.clone()));
    let layer = Layer::new(
        (size[0] as usize, size[1] as usize),
        LayerAttributes::default(),
        ENCODING,
        AnyChannels::sort(channels.iter().map(channel).collect()),
    );
    let mut bytes = Cursor::new(Vec::new());
    ExrImage::from_layer(layer).write().to_buffered(&mut bytes)?;
    Ok(bytes.into_inner())
}

#[cfg(test)]
mod tests {
    use exr::prelude::{ReadChannels, ReadLayers, read};

    use super::*;

    #[test]
    fn the_bytes_of_a_map_are_the_same_whatever_thread_is_first() {
        let (width, height) = (1000, 700);
        // Tiles that take threads a longer and a shorter time.
        let values: Vec<f32> = (0..width * height).map(|i| if i / width % 128 < 64 { 1.0 } else { i as f32 }).collect();
        let write = || exr_bytes([width, height], &[("Z", values.clone())]).expect("a map");
        let first = write();
        (0..20).for_each(|run| assert!(write() == first, "run {run}"));
        let channels = read().no_deep_data().largest_resolution_level().all_channels();
        let image = channels.first_valid_layer().all_attributes().from_buffered(Cursor::new(first)).expect("a file");
        let read_back: Vec<f32> = image.layer_data.channel_data.list[0].sample_data.values_as_f32().collect();
        assert!(read_back == values, "the map is another one when it is read");
    }
}
