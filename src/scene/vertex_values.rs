//! Numbers at vertices that filters show as false colours: attributes of the file, and curvature.

use std::collections::HashMap;

use glam::{DAffine3, DVec3, Vec3};
use rayon::prelude::*;

use super::{Budget, Model, Primitive};
use crate::InputError;

/// The name of curvature among a primitive's values; attributes of a file begin with `_`.
pub const CURVATURE: &str = "curvature";

/// Vertices beyond these shares lie outside a fitted range of curvatures.
const FITTED: f64 = 0.95;

/// Bytes that a vertex and a triangle take while curvature is computed.
const PASSING_VERTEX: u64 = 128;
const PASSING_TRIANGLE: u64 = 24;

/// Adds the curvature of every primitive to its values.
pub fn add_curvature(model: &mut Model, budget: &mut Budget) -> Result<(), InputError> {
    let all = || model.meshes.iter().flat_map(|mesh| &mesh.primitives);
    let vertices: u64 = all().map(|primitive| primitive.positions.len() as u64).sum();
    let triangles: u64 = all().map(|primitive| primitive.triangles.len() as u64).sum();
    let (kept, passing) = (4 * vertices, PASSING_VERTEX * vertices + PASSING_TRIANGLE * triangles);
    budget.take(kept + passing, || format!("{}: curvature at {vertices} vertices", model.name))?;
    let primitives: Vec<&mut Primitive> = model.meshes.iter_mut().flat_map(|mesh| &mut mesh.primitives).collect();
    primitives.into_par_iter().for_each(|primitive| {
        let values = curvature(primitive);
        primitive.values.insert(CURVATURE.into(), values);
    });
    budget.give_back(passing);
    Ok(())
}

/// The range that a filter without one shows: of an attribute all values, of curvature most of them around zero. `None`
/// where no primitive has it.
pub fn fitted_range(models: &[Model], name: &str) -> Option<[f32; 2]> {
    let values = || models.iter().flat_map(|model| values_of(model, name));
    if name == CURVATURE {
        let mut sizes: Vec<f32> = values().map(f32::abs).collect();
        let last = sizes.len().checked_sub(1)?;
        let (_, end, _) = sizes.select_nth_unstable_by((FITTED * last as f64) as usize, f32::total_cmp);
        return Some([-*end, *end]);
    }
    values().fold(None, |range, value| {
        let [low, high] = range.unwrap_or([value; 2]);
        Some([low.min(value), high.max(value)])
    })
}

/// The values of every node's mesh, as they are in the scene.
fn values_of<'a>(model: &'a Model, name: &'a str) -> impl Iterator<Item = f32> + 'a {
    let nodes = model.nodes.iter().filter_map(|node| Some((node, node.mesh?)));
    nodes.flat_map(move |(node, mesh)| {
        let values = model.meshes[mesh].primitives.iter().filter_map(|primitive| primitive.values.get(name));
        let factor = scene_factor(name, &node.world_from_local);
        values.flatten().map(move |value| value * factor)
    })
}

/// What a primitive's values are multiplied by where a node shows it: curvature is one over a length.
pub fn scene_factor(name: &str, world_from_local: &DAffine3) -> f32 {
    if name == CURVATURE { (1.0 / world_from_local.matrix3.determinant().abs().cbrt()) as f32 } else { 1.0 }
}

/// Mean curvature at each vertex, one over the primitive's own units, positive where it bulges out: the mean over the edges
/// that meet there of how much the normal turns along each (Taubin's normal curvature, 1995). Vertices at one place count as
/// one, and normals are those of the triangles around it, by their angles, so that no edge is sharp.
fn curvature(primitive: &Primitive) -> Vec<f32> {
    let place: Vec<usize> = places(&primitive.positions).into_iter().map(|place| place as usize).collect();
    let count = place.iter().max().map_or(0, |last| last + 1);
    let mut points = vec![DVec3::ZERO; count];
    place.iter().zip(&primitive.positions).for_each(|(i, p)| points[*i] = p.as_dvec3());
    let triangles: Vec<[usize; 3]> =
        primitive.triangles.iter().map(|corners| corners.map(|i| place[i as usize])).collect();
    let mut normals = vec![DVec3::ZERO; count];
    for corners in &triangles {
        for i in 0..3 {
            let [a, b, c] = [0, 1, 2].map(|step| points[corners[(i + step) % 3]]);
            let (ab, ac) = (b - a, c - a);
            let across = ab.cross(ac);
            normals[corners[i]] += across.normalize_or_zero() * across.length().atan2(ab.dot(ac));
        }
    }
    normals.iter_mut().for_each(|normal| *normal = normal.normalize_or_zero());
    let mut sums = vec![(0.0, 0u32); count];
    for corners in &triangles {
        for (from, to) in [(0, 1), (1, 2), (2, 0)].map(|(i, j)| (corners[i], corners[j])) {
            let along = points[to] - points[from];
            let length = along.length_squared();
            if length > 0.0 {
                let turn = (normals[to] - normals[from]).dot(along) / length;
                // Most edges are met twice, once from each side; those of a border once.
                [from, to].iter().for_each(|i| (sums[*i].0, sums[*i].1) = (sums[*i].0 + turn, sums[*i].1 + 1));
            }
        }
    }
    place.iter().map(|i| if sums[*i].1 > 0 { (sums[*i].0 / f64::from(sums[*i].1)) as f32 } else { 0.0 }).collect()
}

/// A number for each vertex, the same for all at one place.
pub(super) fn places(positions: &[Vec3]) -> Vec<u32> {
    let mut known = HashMap::new();
    let number = |p: &Vec3| {
        let next = known.len() as u32;
        // -0 is 0.
        *known.entry((*p + Vec3::ZERO).to_array().map(f32::to_bits)).or_insert(next)
    };
    positions.iter().map(number).collect()
}

#[cfg(test)]
mod tests {
    use std::f32::consts::{PI, TAU};

    use super::super::{Mesh, Node, Transform};
    use super::*;

    /// A grid of quads over (u, v), cut in triangles.
    fn grid(columns: u32, rows: u32, point: impl Fn(f32, f32) -> Vec3) -> Primitive {
        let at = |i: u32| (i % (columns + 1), i / (columns + 1));
        let share = |i: u32, of: u32| i as f32 / of as f32;
        let positions = (0..(columns + 1) * (rows + 1)).map(at).map(|(x, y)| point(share(x, columns), share(y, rows)));
        let positions = positions.collect();
        let quads = (0..columns * rows).map(|i| i / columns * (columns + 1) + i % columns);
        let triangles =
            quads.flat_map(|i| [[i, i + columns + 1, i + 1], [i + 1, i + columns + 1, i + columns + 2]]).collect();
        Primitive { positions, triangles, ..Primitive::default() }
    }

    fn ball(radius: f32, side: f32) -> Primitive {
        grid(64, 48, |u, v| {
            let (turn, tilt) = (TAU * u.fract(), PI * (0.05 + 0.9 * v));
            radius * Vec3::new(tilt.sin() * turn.sin() * side, tilt.cos(), tilt.sin() * turn.cos())
        })
    }

    #[test]
    fn a_ball_bulges_by_one_over_its_radius() {
        for (radius, side, sign) in [(0.5, 1.0, 1.0), (2.0, 1.0, 1.0), (2.0, -1.0, -1.0)] {
            let values = curvature(&ball(radius, side));
            let inner = &values[5 * 65..44 * 65];
            assert!(inner.iter().all(|k| (k * radius - sign).abs() < 0.02), "{radius}");
        }
    }

    #[test]
    fn a_plane_is_flat_and_a_cylinder_bulges_half_as_much_as_a_ball_at_least() {
        let flat = curvature(&grid(8, 8, |u, v| Vec3::new(u, 0.0, v)));
        assert!(flat.iter().all(|k| k.abs() < 1e-6), "{flat:?}");
        let tube = curvature(&grid(64, 8, |u, v| Vec3::new((TAU * u.fract()).sin(), 2.0 * v, (TAU * u.fract()).cos())));
        let inner = &tube[2 * 65..7 * 65];
        assert!(inner.iter().all(|k| (0.3..0.7).contains(&k.abs())), "{inner:?}");
    }

    #[test]
    fn fitted_ranges_hold_what_there_is() {
        let mesh = Mesh { name: String::new(), primitives: vec![ball(0.5, 1.0)] };
        let node = |scale: f64| Node {
            name: "ball".into(),
            parent: None,
            children: vec![],
            rest: Transform::Matrix(DAffine3::IDENTITY),
            world_from_local: DAffine3::from_scale(DVec3::splat(scale)),
            mesh: Some(0),
            camera: None,
            light: None,
            drawn: true,
            hidden: false,
        };
        let mut model = Model { meshes: vec![mesh], nodes: vec![node(2.0)], ..Model::default() };
        assert_eq!(fitted_range(std::slice::from_ref(&model), CURVATURE), None);
        add_curvature(&mut model, &mut Budget::default()).expect("it is small");
        model.meshes[0].primitives[0].values.insert("_HEAT".into(), vec![3.0, -1.0, 2.0]);
        let models = [model];
        assert_eq!(fitted_range(&models, "_HEAT"), Some([-1.0, 3.0]));
        let [low, high] = fitted_range(&models, CURVATURE).expect("it has been added");
        assert!(low == -high && (0.95..2.0).contains(&high), "a ball twice as large: {low} to {high}");
    }
}
