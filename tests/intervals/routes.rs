//! Four ways to a depth interval, three of them not those of the library, and how they must agree.

use glam::{DVec2, DVec3};
use lenspeel::lens::Interval;
use lenspeel::view::{Projection, Ray, View};

use crate::solid::{Facet, Solid};

/// Rounding allowed, as a share of the depths and sizes at hand.
const ROUNDING: f64 = 1e-8;

/// Between which depths a ray enters a solid and leaves it, as an inscribed mesh bounds them.
#[derive(Debug, Clone, Copy)]
pub struct Bracket {
    pub entry: [f64; 2],
    pub exit: [f64; 2],
}

/// By half-spaces: what the tangent planes along all facets leave of a ray, which is all that the solid has, or more.
pub fn by_halfspaces(solid: &Solid, ray: &Ray) -> Option<[f64; 2]> {
    let (mut entry, mut exit) = (f64::NEG_INFINITY, f64::INFINITY);
    for facet in &solid.facets {
        let (height, rate) = (facet.normal.dot(ray.origin) - facet.reach, facet.normal.dot(ray.direction));
        if rate < 0.0 {
            entry = entry.max(-height / rate);
        } else if rate > 0.0 {
            exit = exit.min(-height / rate);
        } else if height > 0.0 {
            return None;
        }
    }
    (entry < exit).then_some([entry, exit])
}

/// A depth on a facet, and the depth at which the same ray crosses the tangent plane along it: the solid's own
/// boundary lies between the two.
fn hit(facet: &Facet, depth: f64, direction: DVec3) -> Hit {
    let rate = facet.normal.dot(direction);
    Hit { depth, tangent: depth + (facet.reach - facet.offset) / rate, enters: rate < 0.0 }
}

#[derive(Clone, Copy)]
struct Hit {
    depth: f64,
    tangent: f64,
    enters: bool,
}

/// The first hit that enters and the last that leaves; before `start` nothing was looked for.
fn bracket(hits: &[Hit], start: f64) -> Option<Bracket> {
    let first = hits.iter().filter(|h| h.enters).min_by(|a, b| a.depth.total_cmp(&b.depth));
    let last = hits.iter().filter(|h| !h.enters).max_by(|a, b| a.depth.total_cmp(&b.depth))?;
    let entry = first.map_or([f64::NEG_INFINITY, start], |h| [h.tangent, h.depth]);
    Some(Bracket { entry, exit: [last.depth, last.tangent] })
}

/// By rays: against every triangle of the mesh (Möller and Trumbore).
pub fn by_mesh(solid: &Solid, ray: &Ray) -> Option<Bracket> {
    let hits: Vec<Hit> = solid.facets.iter().filter_map(|f| Some(hit(f, crossing(f, ray)?, ray.direction))).collect();
    let both = hits.iter().any(|h| h.enters) && hits.iter().any(|h| !h.enters);
    if both { bracket(&hits, f64::NEG_INFINITY) } else { None }
}

fn crossing(facet: &Facet, ray: &Ray) -> Option<f64> {
    let [a, b, c] = facet.corners;
    let (ab, ac) = (b - a, c - a);
    let across = ray.direction.cross(ac);
    let determinant = ab.dot(across);
    let from = ray.origin - a;
    let u = from.dot(across) / determinant;
    let up = from.cross(ab);
    let v = ray.direction.dot(up) / determinant;
    (determinant != 0.0 && u >= 0.0 && v >= 0.0 && u + v <= 1.0).then(|| ac.dot(up) / determinant)
}

/// By raster: the mesh drawn into a depth buffer, the nearest front and the farthest back of every pixel.
pub struct Raster {
    size: [u32; 2],
    near: f64,
    hits: Vec<Vec<Hit>>,
}

impl Raster {
    pub fn draw(solid: &Solid, view: &View) -> Self {
        let count = (view.size[0] * view.size[1]) as usize;
        let near = if view.is_perspective() { view.near } else { f64::NEG_INFINITY };
        let mut raster = Self { size: view.size, near, hits: vec![Vec::new(); count] };
        for facet in &solid.facets {
            let corners = facet.corners.map(|p| seen(view, p)).to_vec();
            let corners = if near.is_finite() { clipped(&corners, near) } else { corners };
            for i in 1..corners.len().saturating_sub(1) {
                raster.triangle(view, facet, [corners[0], corners[i], corners[i + 1]]);
            }
        }
        raster
    }

    /// What is in front of the near plane of a perspective is not drawn: a pixel with nothing but a back is entered there.
    pub fn bracket(&self, x: u32, y: u32) -> Option<Bracket> {
        bracket(&self.hits[(y * self.size[0] + x) as usize], self.near)
    }

    fn triangle(&mut self, view: &View, facet: &Facet, corners: [DVec3; 3]) {
        let screen = corners.map(|p| on_screen(view, p));
        let area = (screen[1] - screen[0]).perp_dot(screen[2] - screen[0]);
        let (low, high) = (screen[0].min(screen[1]).min(screen[2]), screen[0].max(screen[1]).max(screen[2]));
        let size = DVec2::new(f64::from(self.size[0]), f64::from(self.size[1]));
        let (low, high) = ((low - 0.5).floor().max(DVec2::ZERO), (high + 0.5).ceil().min(size));
        for y in low.y as u32..high.y.max(0.0) as u32 {
            for x in low.x as u32..high.x.max(0.0) as u32 {
                let pixel = DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5);
                let weight = |i: usize| {
                    let (a, b) = (screen[(i + 1) % 3], screen[(i + 2) % 3]);
                    (b - a).perp_dot(pixel - a) / area
                };
                let weights = [weight(0), weight(1), weight(2)];
                if area != 0.0 && weights.iter().all(|w| *w >= 0.0) {
                    let depth = depth(view, weights, corners.map(|p| p.z));
                    let direction = view.ray(pixel.x, pixel.y).direction;
                    self.hits[(y * self.size[0] + x) as usize].push(hit(facet, depth, direction));
                }
            }
        }
    }
}

/// Right, up and forward of the eye.
fn seen(view: &View, p: DVec3) -> DVec3 {
    let offset = p - view.eye;
    DVec3::new(view.right.dot(offset), view.up.dot(offset), view.forward.dot(offset))
}

fn on_screen(view: &View, p: DVec3) -> DVec2 {
    let (width, height) = (f64::from(view.size[0]), f64::from(view.size[1]));
    let half = match view.projection {
        Projection::Perspective { tan_half_y } => p.z * tan_half_y,
        Projection::Orthographic { half_height } => half_height,
    };
    DVec2::new(width * 0.5 + p.x / half * height * 0.5, height * 0.5 - p.y / half * height * 0.5)
}

/// Depth is linear over the screen for an orthographic camera; for a perspective its reciprocal is.
fn depth(view: &View, weights: [f64; 3], depths: [f64; 3]) -> f64 {
    let mean = |value: &dyn Fn(f64) -> f64| (0..3).map(|i| weights[i] * value(depths[i])).sum::<f64>();
    if view.is_perspective() { 1.0 / mean(&|z| 1.0 / z) } else { mean(&|z| z) }
}

/// The part of a polygon beyond a depth.
fn clipped(corners: &[DVec3], near: f64) -> Vec<DVec3> {
    let mut kept = Vec::new();
    for (i, &p) in corners.iter().enumerate() {
        let q = corners[(i + 1) % corners.len()];
        if p.z >= near {
            kept.push(p);
        }
        if (p.z >= near) != (q.z >= near) {
            kept.push(p + (q - p) * ((near - p.z) / (q.z - p.z)));
        }
    }
    kept
}

/// What a route allows of an interval, between two planes.
pub struct Bounds {
    /// Not more than this.
    pub outer: Option<[f64; 2]>,
    /// And not other than this.
    pub inner: Option<Bracket>,
    pub near: f64,
    pub far: f64,
    /// Scale of the numbers, for what rounding may do.
    pub scale: f64,
}

impl Bounds {
    /// What is wrong with an interval that the closed form found.
    pub fn check(&self, closed: Option<Interval>) -> Result<(), String> {
        let clip = |[entry, exit]: [f64; 2]| [entry.max(self.near), exit.min(self.far)];
        let length = |[entry, exit]: [f64; 2]| exit - entry;
        let outer = self.outer.map(clip).filter(|o| length(*o) > 0.0);
        let least = self.inner.map(|b| clip([b.entry[1], b.exit[0]]));
        let Some(Interval { entry, exit }) = closed else {
            return match least.filter(|l| length(*l) > self.slack(*l)) {
                Some(missed) => Err(format!("no interval, and the mesh has {missed:?}")),
                None => Ok(()),
            };
        };
        let outer = outer.ok_or(format!("{entry} to {exit}, and half-spaces have nothing"))?;
        let slack = self.slack([entry, exit]);
        let within = |what: &str, x: f64, low: f64, high: f64| {
            if x >= low - slack && x <= high + slack {
                Ok(())
            } else {
                Err(format!("{what} {x} is not in {low} .. {high}"))
            }
        };
        if !(entry >= self.near && exit <= self.far && entry < exit) {
            return Err(format!("{entry} to {exit} is no interval between {} and {}", self.near, self.far));
        }
        within("entry", entry, outer[0], self.far)?;
        within("exit", exit, self.near, outer[1])?;
        let Some(bracket) = self.inner else { return Ok(()) };
        let [first, last] = clip([bracket.entry[0], bracket.exit[1]]);
        let [entered, left] = clip([bracket.entry[1], bracket.exit[0]]);
        within("entry", entry, first, entered.max(first))?;
        within("exit", exit, left.min(last), last)
    }

    fn slack(&self, [entry, exit]: [f64; 2]) -> f64 {
        ROUNDING * (self.scale + entry.abs() + exit.abs())
    }
}
