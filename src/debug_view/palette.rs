//! Colours that can be told apart.

use std::collections::HashMap;

use csscolorparser::Color;

use crate::drawing::Rgb;
use crate::frame::Aovs;
use crate::plan::{Plan, Region};

pub const GROUND: Rgb = [22, 24, 28];
pub const TEXT: Rgb = [228, 230, 234];
pub const DIM_TEXT: Rgb = [150, 156, 166];

fn oklch(lightness: f32, chroma: f32, hue: f32) -> Rgb {
    let [r, g, b, _] = Color::from_oklcha(lightness, chroma, hue, 1.0).clamp().to_rgba8();
    [r, g, b]
}

/// The n-th of any number of colours: neighbours in number lie a golden angle apart in hue, and differ in lightness.
pub fn distinct(n: usize) -> Rgb {
    const GOLDEN_ANGLE: f32 = 2.399_963_2;
    let lightness = [0.72, 0.60, 0.82][n % 3];
    oklch(lightness, 0.15, 0.5 + GOLDEN_ANGLE * n as f32)
}

/// From dark blue to light yellow for `t` from 0 to 1, evenly in lightness.
pub fn sequential(t: f32) -> Rgb {
    let mix = |from: f32, to: f32| from + (to - from) * t;
    oklch(mix(0.30, 0.94), 0.13, mix(5.2, 1.9))
}

/// `share` of the second colour.
pub fn mix(a: Rgb, b: Rgb, share: f32) -> Rgb {
    std::array::from_fn(|i| (f32::from(a[i]) + (f32::from(b[i]) - f32::from(a[i])) * share).round() as u8)
}

/// A pixel of a picture, gray and dark enough for what is drawn over it; transparent ones show the ground.
pub fn dimmed([r, g, b, a]: [u8; 4]) -> Rgb {
    let gray = 0.2126 * f32::from(r) + 0.7152 * f32::from(g) + 0.0722 * f32::from(b);
    mix(GROUND, [(0.75 * gray) as u8 + 16; 3], f32::from(a) / 255.0)
}

/// The regions that occur, each with its number in region maps and its colour.
pub struct RegionColors {
    known: HashMap<Region, (Option<usize>, Rgb)>,
}

impl RegionColors {
    /// Those of the plan and of a picture are numbered as in `explain`; `more` have a colour only.
    pub fn new(plan: &Plan, aovs: &Aovs, more: impl Iterator<Item = Region>) -> Self {
        let numbered = crate::output::numbered(plan, &plan.regions().regions, &aovs.table);
        let mut known = HashMap::from([(Region::PLAIN, (Some(0), [92, 97, 106]))]);
        for (id, region) in numbered {
            known.entry(region).or_insert((Some(id), distinct(id)));
        }
        for region in more {
            let next = distinct(known.len());
            known.entry(region).or_insert((None, next));
        }
        Self { known }
    }

    pub fn color(&self, region: &Region) -> Rgb {
        self.known.get(region).map_or(TEXT, |(_, color)| *color)
    }

    /// The number in region maps.
    pub fn id(&self, region: &Region) -> Option<usize> {
        self.known.get(region).and_then(|(id, _)| *id)
    }
}
