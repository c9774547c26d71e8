//! What the product makes of a case, pixel by pixel, in the words of the oracle.

use std::path::Path;

use lenspeel::cpu;
use lenspeel::frame::Frame;
use lenspeel::pixel::cap_maker;
use lenspeel::plan::LensSet;

use crate::open::{Opened, open};
use crate::oracle::{Actor, Stack};

/// Who makes the picture.
#[derive(Debug, Clone, Copy)]
pub enum Party {
    Cpu,
    #[cfg(feature = "gpu")]
    Gpu(lenspeel::gpu::Engine),
}

impl Party {
    pub fn name(self) -> &'static str {
        match self {
            Party::Cpu => "cpu",
            #[cfg(feature = "gpu")]
            Party::Gpu(lenspeel::gpu::Engine::Fused) => "fused",
            #[cfg(feature = "gpu")]
            Party::Gpu(lenspeel::gpu::Engine::Peel) => "peel",
        }
    }
}

/// A finished picture of an opened case.
pub struct Picture {
    opened: Opened,
    frame: Frame,
}

/// A pixel as the product has it.
#[derive(Debug)]
pub struct Pixel {
    pub visible: Option<Visible>,
    pub layers: usize,
    pub color: [u8; 4],
}

/// Lenses by their places in the file, as the oracle has them.
#[derive(Debug)]
pub struct Visible {
    pub set: Vec<usize>,
    pub stack: Stack,
    /// Who closes a solid there.
    pub cap_by: Option<Actor>,
    pub node: usize,
    pub depth: f64,
}

impl Picture {
    /// Opens a spec file and renders it.
    pub fn new(spec: &Path, party: Party) -> Result<Self, String> {
        let text = std::fs::read_to_string(spec).map_err(|error| error.to_string())?;
        let (_, opened) = open(spec, &text, |_| ())?;
        let frame = match party {
            Party::Cpu => cpu::Renderer::new(&opened.scene, &opened.plan)
                .and_then(|cpu| cpu.render(true, &|_| ()))
                .expect("the CPU draws it"),
            #[cfg(feature = "gpu")]
            Party::Gpu(engine) => crate::gpu::render(&opened, engine)?,
        };
        Ok(Self { opened, frame })
    }

    pub fn pixel(&self, x: u32, y: u32) -> Pixel {
        let at = (y * self.frame.size[0] + x) as usize;
        let aovs = self.frame.aovs.as_ref().expect("AOVs were asked for");
        let visible = aovs.table.get(aovs.regions[at] as usize).map(|region| Visible {
            set: self.files(region.set),
            stack: self.stack(region.stack),
            cap_by: cap_maker(aovs.triangles[at]).map(|maker| self.actor(maker)),
            node: (aovs.nodes[at] as usize).wrapping_sub(1),
            depth: aovs.depth[at],
        });
        Pixel { visible, layers: aovs.layers[at].into(), color: self.frame.pixels[at] }
    }

    /// A rule stands alone in its stack, after all lenses.
    fn stack(&self, stack: LensSet) -> Stack {
        match stack.top().map(|top| self.actor(top)) {
            Some(Actor::Rule(rule)) => Stack::Rule(rule),
            _ => Stack::Lenses(self.files(stack)),
        }
    }

    fn actor(&self, rank: usize) -> Actor {
        let lenses = &self.opened.plan.lenses;
        lenses.get(rank).map_or_else(|| Actor::Rule(rank - lenses.len()), |lens| Actor::Lens(lens.index))
    }

    fn files(&self, set: LensSet) -> Vec<usize> {
        set.iter().map(|rank| self.opened.plan.lenses[rank].index).collect()
    }
}
