//! What a stack makes of a fragment's colour, opacity and coverage, as far as unlit surfaces tell.

use glam::DVec3;

use super::look::{Hit, Stage};
use super::walk::{Actor, Met, Stack};
use crate::case::{Color, Filter};

/// A fragment as it goes into the picture.
#[derive(Debug, Clone)]
pub struct Shade {
    /// Linear light; `None` where light, or a fade, decides.
    pub color: Option<DVec3>,
    pub opacity: f64,
    /// `None` on the rim of a wire.
    pub covered: Option<bool>,
}

/// Pixels around the rim of a wire where its coverage is in doubt.
const RIM: f64 = 1.0;

pub fn shade(stage: &Stage, hit: &Hit, met: &Met, pixel: [f64; 2]) -> Shade {
    let subject = &stage.subjects[hit.subject];
    let model = &stage.case.models[subject.model];
    let primitive = &model.nodes[subject.node].primitives[subject.primitive];
    let material = &model.materials[primitive.material];
    let [r, g, b, alpha] = material.color;
    let mut base = DVec3::new(r, g, b);
    let mut unlit = material.unlit;
    let mut known = true;
    let mut opacity = alpha;
    let filters: Vec<&Filter> = match &met.stack {
        Stack::Rule(rule) => stage.case.rules[*rule].filters.iter().collect(),
        Stack::Lenses(lenses) => lenses.iter().flat_map(|lens| &stage.case.lenses[*lens].filters).collect(),
    };
    for filter in &filters {
        match filter {
            Filter::Unlit(color) => {
                unlit = true;
                if let Some(color) = color {
                    (base, known) = (linear(*color), true);
                }
                opacity *= color.map_or(1.0, alpha_of);
            }
            Filter::Material(color) => {
                (base, known) = (linear(*color), true);
                opacity *= alpha_of(*color);
            }
            Filter::Normals => (unlit, known) = (true, false),
            Filter::Opacity(value) => opacity *= value,
            Filter::Tint(color, _) => opacity *= alpha_of(*color),
            _ => {}
        }
    }
    let mut color = (unlit && known).then_some(base);
    for filter in &filters {
        color = match filter {
            Filter::Tint(tint, amount) => color.map(|c| c.lerp(linear(*tint), *amount)),
            Filter::Grayscale(amount) => {
                color.map(|c| c.lerp(DVec3::splat(c.dot(DVec3::new(0.2126, 0.7152, 0.0722))), *amount))
            }
            Filter::Invert(amount) => color.map(|c| {
                let inverted = c.to_array().map(|x| to_linear(1.0 - to_srgb(x)));
                c.lerp(DVec3::from_array(inverted), *amount)
            }),
            _ => color,
        };
    }
    let mut covered = Some(true);
    let distance = wire_distance(stage, hit, pixel);
    for filter in &filters {
        let Filter::Wireframe { width, color: wire, filled } = filter else { continue };
        // Whether a magnifier above makes the lines wider is not said: both count as a rim.
        let widest = width * magnified(stage, met);
        let on = match distance {
            d if d < 0.5 * width - RIM => Some(true),
            d if d > 0.5 * widest + RIM => Some(false),
            _ => None,
        };
        if *filled {
            color = on.and_then(|on| if on { wire.map(linear).or(color) } else { color });
        } else {
            if let (Some(true), Some(wire)) = (on, wire) {
                color = Some(linear(*wire));
            }
            covered = covered.and_then(|before| on.map(|on| before && on));
        }
    }
    Shade { color, opacity, covered }
}

/// Pixels from a place of the picture to the nearest edge of a triangle, where it is shown.
fn wire_distance(stage: &Stage, hit: &Hit, [x, y]: [f64; 2]) -> f64 {
    let distance = |i: usize| {
        let (a, b) = (hit.triangle[i], hit.triangle[(i + 1) % 3]);
        let [a, b] = [a, b].map(|p| stage.view.project(p));
        let (along, from) = ([b[0] - a[0], b[1] - a[1]], [x - a[0], y - a[1]]);
        (along[0] * from[1] - along[1] * from[0]).abs() / along[0].hypot(along[1])
    };
    (0..3).map(distance).fold(f64::INFINITY, f64::min)
}

/// How many times larger than it is a fragment is shown; at least once.
fn magnified(stage: &Stage, met: &Met) -> f64 {
    let factors = met.moves.iter().map(|act| match (act.by, stage.composition.filter(*act)) {
        (Actor::Lens(_), Filter::Magnify { factor, .. }) => factor.max(1.0),
        _ => 1.0,
    });
    factors.product()
}

fn alpha_of(color: Color) -> f64 {
    f64::from(color[3]) / 255.0
}

pub fn linear([r, g, b, _]: Color) -> DVec3 {
    DVec3::from_array([r, g, b].map(|c| to_linear(f64::from(c) / 255.0)))
}

/// The transfer function of IEC 61966-2-1.
fn to_linear(c: f64) -> f64 {
    if c <= 0.04045 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) }
}

pub fn to_srgb(c: f64) -> f64 {
    if c <= 0.003_130_8 { 12.92 * c } else { 1.055 * c.powf(1.0 / 2.4) - 0.055 }
}
