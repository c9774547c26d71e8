//! The wgpu backend: the scene is drawn once for each content (`fused`) or once for each layer (`peel`), and a
//! compute pass composites every pixel's fragments exactly.
//!
//! [`Renderer`] borrows device, queue, encoder and target and never submits; [`Headless`] owns a device.

mod alloc;
mod aov;
mod atlas;
mod bindings;
mod caps;
mod cells;
mod clusters;
mod cost;
mod cut_data;
mod draws;
mod error;
mod explain;
mod frame;
mod headless;
mod item_data;
mod job;
mod lens_data;
mod needs;
mod part_data;
mod pipelines;
mod plan_group;
mod planes;
mod program;
mod provoking;
mod prune;
mod readback;
mod records;
mod renderer;
mod room;
mod screen_job;
mod shader;
mod shaders;
mod storage;
mod targets;
mod tiles;
mod upload;
mod window;

pub use caps::{AdapterChoice, adapters, choose_hardware, choose_named, describe, required_limits};
pub use cost::{FrameCost, STAGES, Triangles};
pub use error::Error;
pub use headless::{Headless, Timings};
pub use needs::Needs;
pub use prune::pruned;
pub use renderer::{Encoded, Renderer};
pub use room::Room;
pub use shaders::{Module, source};
pub use storage::LensStorage;
pub use window::Window;

pub mod layout {
    //! The records shared with WGSL, for tests that compare their layouts.
    pub use super::records::{FrameRecord, ItemRecord, LensRecord, PartRecord, StepRecord, TextureInfo};
    pub use super::targets::sample_bytes;
}

/// How the scene meets the layers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Engine {
    /// The scene is drawn once for each content; a fragment finds its layer, its region and its stack itself.
    #[default]
    Fused,
    /// The scene is drawn once for each layer, farthest first, kept between that layer's two depths.
    Peel,
}

/// What a render gives beside the picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct RenderOptions {
    pub engine: Engine,
    /// Also what lies at the centre of each pixel.
    pub aovs: bool,
}
