//! Pictures of a case held against the oracle at sampled pixels.

use std::path::Path;

use crate::case::Case;
use crate::oracle::{Expected, Oracle, Stack, Visible};
use crate::product::{Party, Picture, Pixel};
use crate::random::Random;

/// Sampled pixels of a case.
const PIXELS: usize = 200;
/// Steps of 255 by which a colour may differ (SEMANTICS 7), and what rounding to whole steps adds.
const COLOR_STEPS: f64 = 2.5;
/// Relative; depths below 1 are compared absolutely.
const DEPTH: f64 = 1e-4;

/// What the oracle says of some pixels; doubtful ones have nothing.
pub struct Answers(Vec<([u32; 2], Option<Expected>)>);

/// How many pixels were compared, and how many of them in which respect.
#[derive(Debug, Default, Clone, Copy)]
pub struct Tally {
    pub pixels: usize,
    pub doubtful: usize,
    pub colors: usize,
    pub layers: usize,
    /// With something visible inside at least one lens; two.
    pub in_lens: usize,
    pub in_lenses: usize,
    pub moved: usize,
    pub ruled: usize,
    /// With a cap visible.
    pub capped: usize,
}

impl std::ops::AddAssign for Tally {
    fn add_assign(&mut self, other: Self) {
        self.pixels += other.pixels;
        self.doubtful += other.doubtful;
        self.colors += other.colors;
        self.layers += other.layers;
        self.in_lens += other.in_lens;
        self.in_lenses += other.in_lenses;
        self.moved += other.moved;
        self.ruled += other.ruled;
        self.capped += other.capped;
    }
}

impl Answers {
    pub fn new(case: &Case, seed: u64) -> Self {
        let mut random = Random::new(seed);
        let oracle = Oracle::new(case);
        let answer = |_| {
            let at = case.camera.size.map(|side| random.index(side as usize) as u32);
            (at, oracle.pixel(f64::from(at[0]) + 0.5, f64::from(at[1]) + 0.5))
        };
        Self((0..PIXELS).map(answer).collect())
    }

    pub fn tally(&self) -> Tally {
        let clear: Vec<&Expected> = self.0.iter().filter_map(|(_, answer)| answer.as_ref()).collect();
        let visible = |is: &dyn Fn(&Visible) -> bool| {
            clear.iter().filter_map(|e| e.visible.as_ref()).filter(|visible| is(visible)).count()
        };
        Tally {
            pixels: self.0.len(),
            doubtful: self.0.len() - clear.len(),
            colors: clear.iter().filter(|e| e.color.is_some()).count(),
            layers: clear.iter().filter(|e| e.layers.is_some()).count(),
            in_lens: visible(&|v| !v.set.is_empty()),
            in_lenses: visible(&|v| v.set.len() > 1),
            moved: visible(&|v| v.is_moved),
            ruled: visible(&|v| matches!(v.stack, Stack::Rule(_))),
            capped: visible(&|v| v.cap_by.is_some()),
        }
    }

    /// The most lenses around something visible, lowest first.
    pub fn most_lenses(&self) -> Vec<usize> {
        let sets = self.0.iter().filter_map(|(_, answer)| Some(&answer.as_ref()?.visible.as_ref()?.set));
        sets.max_by_key(|set| set.len()).cloned().unwrap_or_default()
    }

    /// The first pixel on which a picture differs, in words.
    pub fn difference(&self, picture: &Picture) -> Option<String> {
        self.0.iter().find_map(|([x, y], answer)| {
            let (expected, got) = (answer.as_ref()?, picture.pixel(*x, *y));
            let what = differs(expected, &got)?;
            Some(format!("{what} at {x},{y}: {expected:?} is expected, {got:?} is there"))
        })
    }
}

/// Renders the spec of a case and holds it against the oracle's answers.
pub fn check(spec: &Path, answers: &Answers, party: Party) -> Result<(), String> {
    match answers.difference(&Picture::new(spec, party)?) {
        None => Ok(()),
        Some(difference) => Err(difference),
    }
}

/// The property in which a pixel differs.
fn differs(expected: &Expected, got: &Pixel) -> Option<&'static str> {
    match (&expected.visible, &got.visible) {
        (None, None) => {}
        (Some(want), Some(there)) => {
            if want.cap_by != there.cap_by {
                return Some("what closes it");
            }
            if want.set != there.set {
                return Some("the region");
            }
            if want.stack != there.stack {
                return Some("the stack");
            }
            if want.node != there.node {
                return Some("the node");
            }
            if (want.depth - there.depth).abs() > DEPTH * want.depth.abs().max(1.0) {
                return Some("the depth");
            }
        }
        _ => return Some("what is visible"),
    }
    if expected.layers.is_some_and(|layers| layers != got.layers) {
        return Some("the number of layers");
    }
    let steps = |color: [f64; 4]| color.iter().zip(got.color).any(|(a, b)| (a - f64::from(b)).abs() > COLOR_STEPS);
    expected.color.is_some_and(steps).then_some("the colour")
}
