//! Simplified versions of primitives, for lenses with `lod`: fewer triangles over the same vertices.

use std::collections::BTreeSet;

use meshopt::{SimplifyOptions, simplify_decoder, simplify_scale_decoder};
use rayon::prelude::*;

use super::vertex_values::places;
use super::{Edges, Model, Primitive, Scene, Selections, Subject};
use crate::InputError;
use crate::spec::{At, Filter, LensSpec, Spec, lod};
use crate::words::count_of;

/// A primitive with fewer triangles.
#[derive(Debug, Clone, PartialEq)]
pub struct Simplified {
    /// The share of the triangles that was asked for, below 1; more are left where fewer would be far off.
    pub ratio: f32,
    /// Corners are vertices of the primitive; borders are where they were.
    pub triangles: Vec<[u32; 3]>,
    /// How far its surface is from the primitive's, about, in the primitive's own units.
    pub error: f32,
    /// As of [`Primitive::across`].
    pub across: Vec<Edges>,
}

/// So much more than what was asked for may be left before edges where vertices part (in normals, in texture coordinates)
/// are given up, too.
const MOST_LEFT: f32 = 1.5;
/// How far a surface may move, as a share of its mesh's longest side: a box stays a box.
const LARGEST_ERROR: f32 = 0.05;

/// Bytes of a triangle of a version, and of one of a primitive while its versions are made.
const KEPT: u64 = 12;
const PASSING: u64 = 256;

impl Simplified {
    /// Collapses edges in the order of their quadric errors (Garland and Heckbert 1997, as meshoptimizer has it), until the
    /// ratio is reached or the error too large. Borders stay, so that primitives which meet there go on to.
    fn new(primitive: &Primitive, ratio: f32) -> Self {
        let corners = primitive.triangles.as_flattened();
        let positions: Vec<[f32; 3]> = primitive.positions.iter().map(|p| p.to_array()).collect();
        let wanted = (primitive.triangles.len() as f32 * ratio) as usize;
        let attempt = |options: SimplifyOptions| {
            let mut error = 0.0;
            let left = simplify_decoder(corners, &positions, 3 * wanted, LARGEST_ERROR, options, Some(&mut error));
            (left, error)
        };
        let (mut left, mut error) = attempt(SimplifyOptions::LockBorder);
        if left.len() as f32 > MOST_LEFT * 3.0 * wanted as f32 {
            (left, error) = attempt(SimplifyOptions::LockBorder | SimplifyOptions::Permissive);
        }
        let mut triangles = left.as_chunks().0.to_vec();
        fit_normals(primitive, &mut triangles);
        Self { ratio, triangles, error: error * simplify_scale_decoder(&positions), across: Vec::new() }
    }
}

/// Where the normal of a corner is farther than this from its triangle's, by its cosine, another vertex may fit better.
const FITS: f32 = 0.5;

/// Gives corners, of the vertices at their place, the one whose normal is nearest the triangle's: where edges are sharp, each
/// side has vertices of its own, and a collapse may have taken the other side's.
fn fit_normals(primitive: &Primitive, triangles: &mut [[u32; 3]]) {
    let Some(normals) = &primitive.normals else { return };
    let place = places(&primitive.positions);
    let mut at_place = vec![Vec::new(); place.iter().max().map_or(0, |last| *last as usize + 1)];
    (0u32..).zip(&place).for_each(|(vertex, place)| at_place[*place as usize].push(vertex));
    for corners in triangles {
        let [a, b, c] = corners.map(|corner| primitive.positions[corner as usize]);
        let across = (b - a).cross(c - a).normalize_or_zero();
        for corner in corners {
            let fit = |vertex: &u32| normals[*vertex as usize].dot(across);
            if fit(corner) < FITS
                && let Some(best) =
                    at_place[place[*corner as usize] as usize].iter().max_by(|a, b| fit(a).total_cmp(&fit(b)))
            {
                *corner = *best;
            }
        }
    }
}

impl Primitive {
    /// The triangles of a version of it; `None` where that has not been made. A ratio of 1 is all of it.
    pub fn version(&self, ratio: f32) -> Option<&[[u32; 3]]> {
        self.versions().find(|(own, _)| *own == ratio).map(|(_, triangles)| triangles)
    }

    /// What lies across the edges of the triangles of a version; empty where no filter has asked for it.
    pub fn across_of(&self, ratio: f32) -> &[Edges] {
        let simplified = self.simplified.iter().find(|version| version.ratio == ratio);
        simplified.map_or(&self.across, |version| &version.across)
    }

    /// The ratio and the triangles of each version: all of it, then those that have been made.
    pub fn versions(&self) -> impl Iterator<Item = (f32, &[[u32; 3]])> {
        let simplified = self.simplified.iter().map(|simplified| (simplified.ratio, &simplified.triangles[..]));
        std::iter::once((1.0, &self.triangles[..])).chain(simplified)
    }
}

impl Scene {
    /// Makes the versions that lenses and rules with `lod` may show; those that are there already stay.
    pub(super) fn simplify(&mut self, spec: &Spec) -> Result<(), InputError> {
        let ratios: Vec<_> = lods(spec).collect();
        for model in &mut self.models {
            let wanted: Vec<_> = wanted(model, &ratios).into_iter().collect();
            let triangles = |mesh: usize, number: usize| model.meshes[mesh].primitives[number].triangles.len() as u64;
            let all: u64 = wanted.iter().map(|(mesh, number, _)| triangles(*mesh, *number)).sum();
            let primitives: BTreeSet<_> = wanted.iter().map(|(mesh, number, _)| (*mesh, *number)).collect();
            let passing = PASSING * primitives.into_iter().map(|(mesh, number)| triangles(mesh, number)).sum::<u64>();
            let versions = count_of(wanted.len(), "simplified version");
            let what = || format!("{}: {versions} of {all} triangles", model.name);
            self.budget.take(KEPT * all + passing, what)?;
            let make = |(mesh, number, ratio): &(usize, usize, u32)| {
                Simplified::new(&model.meshes[*mesh].primitives[*number], f32::from_bits(*ratio))
            };
            let made: Vec<Simplified> = wanted.par_iter().map(make).collect();
            for ((mesh, number, _), simplified) in wanted.into_iter().zip(made) {
                model.meshes[mesh].primitives[number].simplified.push(simplified);
            }
            self.budget.give_back(passing);
        }
        Ok(())
    }
}

/// The mesh, the primitive and the bits of the ratio of each version that is missing.
fn wanted(model: &Model, ratios: &[(f32, Option<&LensSpec>)]) -> BTreeSet<(usize, usize, u32)> {
    let known = Selections::default();
    let drawn = (0..model.nodes.len()).filter(|node| model.nodes[*node].drawn);
    let with_mesh = drawn.filter_map(|node| Some((node, model.nodes[node].mesh?)));
    let mut wanted = BTreeSet::new();
    for (node, mesh) in with_mesh {
        for (number, primitive) in model.meshes[mesh].primitives.iter().enumerate() {
            let subject = Subject { model, node, material: primitive.material, known: &known };
            let own = ratios.iter().filter(|(_, scope)| scope.is_none_or(|lens| subject.is_in_scope_of(lens)));
            let own = own.filter(|(ratio, _)| primitive.version(*ratio).is_none());
            wanted.extend(own.map(|(ratio, _)| (mesh, number, ratio.to_bits())));
        }
    }
    wanted
}

/// The ratio of each `lod` below 1, and the lens that limits it: a rule limits none, nor does a lens limit what it shows.
fn lods(spec: &Spec) -> impl Iterator<Item = (f32, Option<&LensSpec>)> {
    let ratio = |filters: &[At<Filter>]| lod(filters.iter().map(|filter| &filter.value));
    let shows = |lens: &LensSpec| lens.filters.iter().any(|filter| matches!(filter.value, Filter::Show(_)));
    let lenses = spec.lenses.iter().filter(|lens| lens.enabled);
    let of_lenses =
        lenses.filter_map(move |lens| Some((ratio(&lens.filters)?, Some(lens).filter(|lens| !shows(lens)))));
    let of_rules = spec.overlaps.iter().filter_map(move |rule| Some((ratio(&rule.filters)?, None)));
    of_lenses.chain(of_rules).filter(|(ratio, _)| *ratio < 1.0)
}

#[cfg(test)]
mod tests {
    use glam::Vec3;

    use super::super::{Closure, Mesh};
    use super::*;

    /// A bumpy ball, in quads cut in triangles; `sharp`: each triangle with corners and a normal of its own.
    fn ball(sharp: bool) -> Primitive {
        const COLUMNS: u32 = 64;
        const ROWS: u32 = 32;
        let point = |x: u32, y: u32| {
            let (turn, tilt) = ((x % COLUMNS) as f32 / COLUMNS as f32, y as f32 / ROWS as f32);
            let (turn, tilt) = (std::f32::consts::TAU * turn, std::f32::consts::PI * tilt);
            let radius = 1.0 + 0.02 * (5.0 * turn).sin() * (4.0 * tilt).sin();
            // The poles are one place each.
            let round = if y.is_multiple_of(ROWS) { 0.0 } else { tilt.sin() };
            radius * Vec3::new(round * turn.sin(), tilt.cos(), round * turn.cos())
        };
        let quads = (0..ROWS).flat_map(|y| (0..COLUMNS).map(move |x| (x, y)));
        let triangles =
            quads.flat_map(|(x, y)| [[(x, y), (x, y + 1), (x + 1, y)], [(x + 1, y), (x, y + 1), (x + 1, y + 1)]]);
        let triangles: Vec<[Vec3; 3]> = triangles.map(|corners| corners.map(|(x, y)| point(x, y))).collect();
        let positions: Vec<Vec3> = triangles.concat();
        let flat = |[a, b, c]: &[Vec3; 3]| [(*b - *a).cross(*c - *a).normalize_or(Vec3::Y); 3];
        let normals = if sharp {
            triangles.iter().flat_map(flat).collect()
        } else {
            positions.iter().map(|p| p.normalize()).collect()
        };
        let triangles = (0..triangles.len() as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
        Primitive { positions, normals: Some(normals), triangles, ..Primitive::default() }
    }

    #[test]
    fn the_share_that_was_asked_for_is_left() {
        for (sharp, ratio) in [(false, 0.5), (false, 0.1), (true, 0.2)] {
            let ball = ball(sharp);
            let Simplified { triangles, error, .. } = Simplified::new(&ball, ratio);
            let left = triangles.len() as f32 / ball.triangles.len() as f32;
            assert!(left <= ratio + 0.001 && left > 0.9 * ratio, "{left} for {ratio}");
            assert!(error > 0.0 && error < 0.1, "{error}");
            let far = |corner: &u32| (ball.positions[*corner as usize].length() - 1.0).abs() > 0.03;
            assert!(!triangles.as_flattened().iter().any(far), "corners are corners of the ball");
        }
    }

    #[test]
    fn a_closed_mesh_stays_closed() {
        let Simplified { triangles, .. } = Simplified::new(&ball(false), 0.05);
        let simplified = Primitive { triangles, ..ball(false) };
        let closure = Closure::new(&Mesh { name: String::new(), primitives: vec![simplified] }, 1.0);
        assert!(closure.is_closed(), "{closure:?}");
    }

    #[test]
    fn a_box_stays_a_box_and_a_border_stays_where_it_is() {
        let corner = |i: u32| Vec3::new((i & 1) as f32, (i >> 1 & 1) as f32, (i >> 2) as f32);
        let faces = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        let cube = Primitive {
            positions: (0..8).map(corner).collect(),
            triangles: faces.iter().flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]).collect(),
            ..Primitive::default()
        };
        assert_eq!(Simplified::new(&cube, 0.01).triangles.len(), 12);
        let half: Vec<[u32; 3]> = ball(false).triangles[..2048].to_vec();
        let bowl = Primitive { triangles: half, ..ball(false) };
        let rim = |triangles: &[[u32; 3]]| {
            let places: BTreeSet<[u32; 3]> = triangles
                .as_flattened()
                .iter()
                .map(|corner| bowl.positions[*corner as usize])
                .filter(|p| p.y.abs() < 0.03)
                .map(|p| p.to_array().map(f32::to_bits))
                .collect();
            places
        };
        let simplified = Simplified::new(&bowl, 0.1).triangles;
        assert!(simplified.len() < 300 && rim(&simplified) == rim(&bowl.triangles));
    }

    #[test]
    fn corners_take_the_normal_that_fits() {
        let ball = ball(true);
        let normals = ball.normals.clone().unwrap_or_default();
        let worst = |triangles: &[[u32; 3]]| {
            let fits = triangles.iter().flat_map(|corners| {
                let [a, b, c] = corners.map(|corner| ball.positions[corner as usize]);
                // At the poles some have no area, and nothing fits them.
                let across = (b - a).cross(c - a).try_normalize();
                corners.map(|corner| across.map_or(1.0, |across| normals[corner as usize].dot(across)))
            });
            fits.fold(1.0, f32::min)
        };
        // Each corner turned to the vertex at its place that fits least, and back.
        let place = places(&ball.positions);
        let mut turned = ball.triangles.clone();
        let last_at: std::collections::HashMap<u32, u32> = place.iter().copied().zip(0u32..).collect();
        turned.as_flattened_mut().iter_mut().for_each(|corner| *corner = last_at[&place[*corner as usize]]);
        let before = worst(&turned);
        fit_normals(&ball, &mut turned);
        assert!(before < FITS && worst(&turned) >= FITS, "{before} and {}", worst(&turned));
    }
}
