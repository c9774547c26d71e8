//! SEMANTICS read directly and slowly, in f64: every triangle, every lens, every way a mover may show something. It
//! shares no code with the library.

mod caps;
mod look;
mod names;
mod order;
mod place;
mod shade;
mod solid;
mod view;
mod walk;

use glam::DVec3;

use crate::case::Case;
use look::{DOUBT, Hit, Stage};
use shade::Shade;
use walk::{Act, Met, SAME};

pub use names::matches;
pub use walk::{Actor, Stack};

/// What one pixel must show.
#[derive(Debug, Clone)]
pub struct Expected {
    /// The visible fragment (6.4).
    pub visible: Option<Visible>,
    /// One more than the distinct lens boundaries; `None` where rounding decides.
    pub layers: Option<usize>,
    /// sRGB with straight alpha, of 255; `None` where light or glass decides.
    pub color: Option<[f64; 4]>,
}

#[derive(Debug, Clone)]
pub struct Visible {
    /// S and the stack, by places in the file.
    pub set: Vec<usize>,
    pub stack: Stack,
    /// Whether a mover brought it where it is shown.
    pub is_moved: bool,
    /// Who closes a solid there.
    pub cap_by: Option<Actor>,
    pub node: usize,
    pub depth: f64,
}

/// The oracle of one case.
pub struct Oracle<'a> {
    stage: Stage<'a>,
}

/// What a ray has in front of what ends it.
struct Sight {
    fragments: Vec<(Hit, Met, Shade)>,
    /// Into the fragments.
    visible: Option<usize>,
}

/// A fragment's part in a picture: neighbours that have the same see the same things.
type Part<'a> = (usize, &'a [Act], &'a [usize], &'a Stack, Option<Actor>);

impl<'a> Oracle<'a> {
    pub fn new(case: &'a Case) -> Self {
        Self { stage: Stage::new(case) }
    }

    /// The pixel with this centre; `None` where rounding decides, or SEMANTICS does not.
    pub fn pixel(&self, x: f64, y: f64) -> Option<Expected> {
        let neighbours = [(0.5, 0.0), (-0.5, 0.0), (0.0, 0.5), (0.0, -0.5)].map(|(dx, dy)| (x + dx, y + dy));
        let sight = self.sight(x, y)?;
        let mut layers = self.layers(x, y);
        for (x, y) in neighbours {
            let other = self.sight(x, y)?;
            if !sight.parts().eq(other.parts()) || sight.visible != other.visible {
                return None;
            }
            if layers.is_some() && self.layers(x, y) != layers {
                layers = None;
            }
        }
        let visible = sight.visible.map(|at| {
            let (hit, met, _) = &sight.fragments[at];
            let node = self.stage.subjects[hit.subject].node;
            let is_moved = !met.moves.is_empty();
            let (set, stack) = (met.set.clone(), met.stack.clone());
            Visible { set, stack, is_moved, cap_by: hit.cap_by(), node, depth: hit.depth }
        });
        let color = self.color(&sight, x, y);
        Some(Expected { visible, layers, color })
    }

    fn sight(&self, x: f64, y: f64) -> Option<Sight> {
        let ray = self.stage.view.ray(x, y);
        let mut sight = Sight { fragments: Vec::new(), visible: None };
        let mut end = f64::INFINITY;
        for hit in self.stage.hits(&ray) {
            if hit.depth > end {
                break;
            }
            let near = DOUBT * hit.depth.abs().max(1.0);
            let too_near = |other: &(Hit, Met, Shade)| hit.depth - other.0.depth < near;
            let is_cut =
                (hit.depth - self.stage.view.near).abs() < near || (hit.depth - self.stage.view.far).abs() < near;
            let met = hit.met.clone()?;
            let shade = shade::shade(&self.stage, &hit, &met, [x, y]);
            if is_cut || sight.fragments.last().is_some_and(too_near) {
                return None;
            }
            if !shade.covered? || shade.opacity == 0.0 {
                continue;
            }
            let is_opaque = shade.opacity > 0.9999;
            if is_opaque || sight.visible.is_none() {
                sight.visible = Some(sight.fragments.len());
            }
            if is_opaque && end == f64::INFINITY {
                // What lies only a little behind it may come out in front of it.
                end = hit.depth + near;
            }
            sight.fragments.push((hit, met, shade));
        }
        Some(sight)
    }

    /// The number of layers of a ray, unless two boundaries are nearly one.
    fn layers(&self, x: f64, y: f64) -> Option<usize> {
        let ray = self.stage.view.ray(x, y);
        if self.stage.may_be_left_out(&ray) {
            return None;
        }
        let boundaries = self.stage.boundaries(&ray);
        let gap = |pair: &[f64]| (pair[1] - pair[0]) / pair[0].abs().max(1e-3);
        let planes = [self.stage.view.near, self.stage.view.far];
        let is_cut = |depth: &f64| planes.iter().any(|plane| (depth - plane).abs() < DOUBT * depth.abs().max(1.0));
        let unclear =
            boundaries.windows(2).any(|pair| (SAME..DOUBT).contains(&gap(pair))) || boundaries.iter().any(is_cut);
        let merged = boundaries.windows(2).filter(|pair| gap(pair) < SAME).count();
        (!unclear).then(|| 1 + boundaries.len() - merged)
    }

    /// Whether a lens whose surface is drawn is near the ray, or may be moved there.
    fn may_meet_glass(&self, x: f64, y: f64) -> bool {
        let composition = &self.stage.composition;
        let drawn = || composition.order.iter().filter(|lens| self.stage.case.lenses[**lens].glass);
        let near = [(0.0, 0.0), (1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0)];
        let rays = || near.iter().map(|(dx, dy)| self.stage.view.ray(x + dx, y + dy));
        let meets = |lens: &usize| rays().any(|ray| !composition.lenses[*lens].boundaries(&ray).is_empty());
        drawn().next().is_some() && (!composition.movers().is_empty() || drawn().any(meets))
    }

    /// Composited in linear light, the nearest first (6.3).
    fn color(&self, sight: &Sight, x: f64, y: f64) -> Option<[f64; 4]> {
        let case = self.stage.case;
        if self.may_meet_glass(x, y) {
            return None;
        }
        let (mut sum, mut rest) = (DVec3::ZERO, 1.0);
        for (_, _, shade) in &sight.fragments {
            sum += shade.color? * shade.opacity * rest;
            rest *= 1.0 - shade.opacity;
        }
        let back = f64::from(case.background[3]) / 255.0;
        sum += shade::linear(case.background) * back * rest;
        let alpha = 1.0 - rest * (1.0 - back);
        // Colours of what is hardly there are rounded away.
        let straight = if alpha < 0.2 { return None } else { sum / alpha };
        let [r, g, b] = straight.to_array().map(|c| 255.0 * shade::to_srgb(c));
        Some([r, g, b, 255.0 * alpha])
    }
}

impl Sight {
    fn parts(&self) -> impl Iterator<Item = Part<'_>> {
        fn part((hit, met, _): &(Hit, Met, Shade)) -> Part<'_> {
            (hit.subject, &met.moves, &met.set, &met.stack, hit.cap_by())
        }
        self.fragments.iter().map(part)
    }
}
