//! What a stack makes of a fragment's colour, opacity and coverage, as far as unlit surfaces tell.

use glam::DVec3;

use super::look::{Hit, Stage, Surface};
use super::walk::{Actor, Met, Stack};
use crate::case::{Cap, Color, Filter};

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

/// The sine up to which a triangle is seen edge on.
const EDGE_ON: f64 = 1e-3;

/// How much farther than `soft` a boundary must be for a lens to act in full whatever its shape: distances are only of
/// first order where it is stretched.
const SURELY: f64 = 4.0;

/// A filter of a stack and how much of it acts: all but where its lens fades (5.6), and there not always known.
type Acting<'a> = (&'a Filter, Option<f64>);

fn acting<'a>(stage: &Stage<'a>, hit: &Hit, met: &Met) -> Vec<Acting<'a>> {
    let lenses = match &met.stack {
        // Whose cap it is does nothing else to it.
        Stack::Rule(rule) if hit.cap_by() == Some(Actor::Rule(*rule)) => return Vec::new(),
        Stack::Rule(rule) => return stage.case.rules[*rule].filters.iter().map(|filter| (filter, Some(1.0))).collect(),
        Stack::Lenses(lenses) => lenses,
    };
    let amount = |lens: usize| {
        let (spec, placed) = (&stage.case.lenses[lens], &stage.composition.lenses[lens]);
        if spec.soft == 0.0 {
            return Some(1.0);
        }
        let at = if spec.by_object { stage.subjects[hit.subject].center } else { met.asked_at(lens) };
        let exact = placed.depth_inside(at).map(|depth| (depth / spec.soft).clamp(0.0, 1.0));
        exact.or_else(|| placed.contains_ball(at, SURELY * spec.soft).then_some(1.0))
    };
    let of = |lens: &usize| {
        let amount = amount(*lens);
        stage.case.lenses[*lens].filters.iter().map(move |filter| (filter, amount))
    };
    lenses.iter().filter(|lens| hit.cap_by() != Some(Actor::Lens(**lens))).flat_map(of).collect()
}

/// From what was to what a filter makes of it, as far as both are known.
fn faded(before: Option<DVec3>, after: Option<DVec3>, amount: Option<f64>) -> Option<DVec3> {
    if amount == Some(1.0) { after } else { Some(before?.lerp(after?, amount?)) }
}

pub fn shade(stage: &Stage, hit: &Hit, met: &Met, pixel: [f64; 2]) -> Shade {
    let filters = acting(stage, hit, met);
    let (color, opacity) = surface(stage, hit, &filters);
    // A lens that fades out all there is: somewhere nothing is left.
    let may_be_gone = filters.iter().any(|(filter, amount)| amount.is_none() && alpha_of(filter) == 0.0);
    let shade = Shade { color: colored(color, &filters), opacity, covered: (!may_be_gone).then_some(true) };
    wired(stage, met, shade, &filters, &edges(stage, hit, met, pixel))
}

/// Colour before colour filters, and opacity.
fn surface(stage: &Stage, hit: &Hit, filters: &[Acting]) -> (Option<DVec3>, f64) {
    let subject = &stage.subjects[hit.subject];
    let model = &stage.case.models[subject.model];
    let material = &model.materials[model.nodes[subject.node].primitives[subject.primitive].material];
    let [r, g, b, mut opacity] = material.color;
    let mut base = Some(DVec3::new(r, g, b));
    let mut lit = if material.unlit { 0.0 } else { 1.0 };
    if let Surface::Cap(_, Cap::Color(color) | Cap::Hatch(color)) = hit.surface {
        (base, lit, opacity) = (None, 1.0, f64::from(color[3]) / 255.0);
        if let Surface::Cap(_, Cap::Color(_)) = hit.surface {
            base = Some(linear(color));
        }
    }
    let mut opacity_is_known = true;
    for (filter, amount) in filters {
        match filter {
            Filter::Unlit(Some(color)) | Filter::Material(color) => base = faded(base, Some(linear(*color)), *amount),
            Filter::Normals => base = faded(base, None, *amount),
            _ => {}
        }
        if matches!(filter, Filter::Unlit(_) | Filter::Normals) {
            lit *= 1.0 - amount.unwrap_or(0.0);
        }
        // Where the amount is not known some of it is: less than opaque is all that counts then.
        let alpha = alpha_of(filter);
        opacity *= 1.0 + (alpha - 1.0) * amount.unwrap_or(0.5);
        opacity_is_known &= amount.is_some() || alpha == 1.0;
    }
    (base.filter(|_| lit == 0.0 && opacity_is_known), opacity)
}

/// What a filter multiplies the opacity by.
fn alpha_of(filter: &Filter) -> f64 {
    match filter {
        Filter::Opacity(value) => *value,
        Filter::Unlit(Some(color)) | Filter::Material(color) | Filter::Tint(color, _) => f64::from(color[3]) / 255.0,
        _ => 1.0,
    }
}

fn colored(mut color: Option<DVec3>, filters: &[Acting]) -> Option<DVec3> {
    for (filter, amount) in filters {
        let after = |c: DVec3| match filter {
            Filter::Tint(tint, share) => c.lerp(linear(*tint), *share),
            Filter::Grayscale(share) => c.lerp(DVec3::splat(c.dot(DVec3::new(0.2126, 0.7152, 0.0722))), *share),
            Filter::Invert(share) => {
                c.lerp(DVec3::from_array(c.to_array().map(|x| to_linear(1.0 - to_srgb(x)))), *share)
            }
            _ => c,
        };
        let is_of_this_stage = matches!(filter, Filter::Tint(..) | Filter::Grayscale(_) | Filter::Invert(_));
        if is_of_this_stage {
            color = faded(color, color.map(after), *amount);
        }
    }
    color
}

/// After the coverage filters.
fn wired(stage: &Stage, met: &Met, mut shade: Shade, filters: &[Acting], edges: &[Edge]) -> Shade {
    for (filter, amount) in filters {
        let Filter::Wireframe { width, color, filled } = filter else { continue };
        // Whether a magnifier above makes the lines wider is not said: both count as a rim.
        let widest = width * magnified(stage, met);
        let least = |edge: &Edge| if edge.goes_on == Some(false) { *width } else { 0.5 * width };
        let most = |edge: &Edge| if edge.goes_on == Some(true) { 0.5 * widest } else { widest };
        // A line that grows inwards from a border may reach over a triangle that meets the border with a corner alone.
        let is_off = |edge: &Edge| edge.away > most(edge) + RIM && edge.end_away > widest + RIM;
        let on_wire = match edges {
            edges if edges.iter().any(|edge| edge.away < least(edge) - RIM) => Some(true),
            edges if edges.iter().all(is_off) => Some(false),
            _ => None,
        };
        match on_wire {
            Some(true) => shade.color = faded(shade.color, color.map(linear).or(shade.color), *amount),
            Some(false) if *filled => {}
            // Between the wires a lens that fades leaves some of the surface.
            Some(false) => shade.covered = shade.covered.filter(|_| *amount == Some(1.0)).map(|_| false),
            None if *filled => shade.color = None,
            None => shade.covered = None,
        }
    }
    shade
}

/// An edge of a triangle as it is shown.
struct Edge {
    /// Pixels from a place of the picture to it, and to its first end.
    away: f64,
    end_away: f64,
    /// Whether the picture shows another triangle of the mesh beyond it; `None` where that is not sure.
    goes_on: Option<bool>,
}

/// A cap has none.
fn edges(stage: &Stage, hit: &Hit, met: &Met, [x, y]: [f64; 2]) -> Vec<Edge> {
    let Surface::Triangle(triangle) = hit.surface else { return Vec::new() };
    let edge = |i: usize| {
        let [a, b, c] = [0, 1, 2].map(|step| triangle[(i + step) % 3]);
        let [p, q] = [a, b].map(|p| stage.view.project(p));
        let (along, from) = ([q[0] - p[0], q[1] - p[1]], [x - p[0], y - p[1]]);
        let away = (along[0] * from[1] - along[1] * from[0]) / along[0].hypot(along[1]);
        // On which side of the edge a corner is seen, which may lie behind the eye: its sine from the plane through both.
        let across = stage.view.towards(a).cross(b - a).normalize();
        let side = |corner: DVec3| across.dot((corner - a).normalize());
        let own = side(c);
        let others = stage.across(hit.subject, &met.moves, [a, b], c).into_iter();
        let others: Vec<f64> = others.map(side).collect();
        let goes_on = match others[..] {
            [] => Some(false),
            [other] if other.abs() > EDGE_ON && own.abs() > EDGE_ON => Some(other * own < 0.0),
            _ => None,
        };
        let end_away = if stage.view.is_in_front(a) { (x - p[0]).hypot(y - p[1]) } else { f64::INFINITY };
        Edge { away: away.abs(), end_away, goes_on }
    };
    (0..3).map(edge).collect()
}

/// How many times larger than it is a fragment is shown; at least once.
fn magnified(stage: &Stage, met: &Met) -> f64 {
    let factors = met.moves.iter().map(|act| match (act.by, stage.composition.filter(*act)) {
        (Actor::Lens(_), Filter::Magnify { factor, .. }) => factor.max(1.0),
        _ => 1.0,
    });
    factors.product()
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
