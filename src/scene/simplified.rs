//! Simplified versions of primitives, for lenses with `lod`: fewer triangles over the same vertices.

use std::collections::BTreeSet;

use meshopt::{SimplifyOptions, simplify_decoder, simplify_scale_decoder};
use rayon::prelude::*;

use super::vertex_values::places;
use super::{Model, Primitive, Scene, Subject};
use crate::spec::{At, Filter, LensSpec, Spec, lod};

/// A primitive with fewer triangles.
#[derive(Debug, Clone, PartialEq)]
pub struct Simplified {
    /// The share of the triangles that was asked for, below 1; more are left where fewer would be far off.
    pub ratio: f32,
    /// Corners are vertices of the primitive; borders are where they were.
    pub triangles: Vec<[u32; 3]>,
    /// How far its surface is from the primitive's, about, in the primitive's own units.
    pub error: f32,
}

/// So much more than what was asked for may be left before edges where vertices part (in normals, in texture coordinates)
/// are given up, too.
const MOST_LEFT: f32 = 1.5;
/// How far a surface may move, as a share of its mesh's longest side: a box stays a box.
const LARGEST_ERROR: f32 = 0.05;

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
        Self { ratio, triangles, error: error * simplify_scale_decoder(&positions) }
    }
}

/// Where the normal of a corner is farther than this from its triangle's, by its cosine, another vertex may fit better.
const FITS: f32 = 0.5;

/// Gives corners, of the vertices at their place, the one whose normal is nearest the triangle's: where edges are sharp, each
/// side has vertices of its own, and a collapse may have taken the other side's.
fn fit_normals(primitive: &Primitive, triangles: &mut [[u32; 3]]) {
    let Some(normals) = &primitive.normals else { return };
    let place = places(primitive);
    let mut at_place = vec![Vec::new(); place.iter().max().map_or(0, |last| last + 1)];
    (0u32..).zip(&place).for_each(|(vertex, place)| at_place[*place].push(vertex));
    for corners in triangles {
        let [a, b, c] = corners.map(|corner| primitive.positions[corner as usize]);
        let across = (b - a).cross(c - a).normalize_or_zero();
        for corner in corners {
            let fit = |vertex: &u32| normals[*vertex as usize].dot(across);
            if fit(corner) < FITS
                && let Some(best) = at_place[place[*corner as usize]].iter().max_by(|a, b| fit(a).total_cmp(&fit(b)))
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

    /// The ratio and the triangles of each version: all of it, then those that have been made.
    pub fn versions(&self) -> impl Iterator<Item = (f32, &[[u32; 3]])> {
        let simplified = self.simplified.iter().map(|simplified| (simplified.ratio, &simplified.triangles[..]));
        std::iter::once((1.0, &self.triangles[..])).chain(simplified)
    }
}

impl Scene {
    /// Makes the versions that lenses and rules with `lod` may show; those that are there already stay.
    pub(super) fn simplify(&mut self, spec: &Spec) {
        let ratios: Vec<_> = lods(spec).collect();
        let wanted = |model: &Model| {
            let drawn = (0..model.nodes.len()).filter(|node| model.nodes[*node].drawn);
            let with_mesh = drawn.filter_map(|node| Some((node, model.nodes[node].mesh?)));
            let mut wanted: BTreeSet<(usize, usize, u32)> = BTreeSet::new();
            for (node, mesh) in with_mesh {
                for (number, primitive) in model.meshes[mesh].primitives.iter().enumerate() {
                    let subject = Subject { model, node, material: &model.materials[primitive.material].name };
                    let own = ratios.iter().filter(|(_, scope)| scope.is_none_or(|lens| subject.is_in_scope_of(lens)));
                    let own = own.filter(|(ratio, _)| primitive.version(*ratio).is_none());
                    wanted.extend(own.map(|(ratio, _)| (mesh, number, ratio.to_bits())));
                }
            }
            wanted
        };
        for model in &mut self.models {
            let wanted: Vec<_> = wanted(model).into_iter().collect();
            let make = |(mesh, number, ratio): &(usize, usize, u32)| {
                Simplified::new(&model.meshes[*mesh].primitives[*number], f32::from_bits(*ratio))
            };
            let made: Vec<Simplified> = wanted.par_iter().map(make).collect();
            for ((mesh, number, _), simplified) in wanted.into_iter().zip(made) {
                model.meshes[mesh].primitives[number].simplified.push(simplified);
            }
        }
    }
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
