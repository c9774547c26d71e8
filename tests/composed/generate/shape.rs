//! Random lens shapes about a place.

use glam::{DMat3, DVec3};

use super::{direction, pick, point, rounded, tidy};
use crate::case::{Case, Compound, Convex, Rotation, Shape};
use crate::random::Random;

/// How deep compounds are nested.
const DEPTH: usize = 2;

pub fn shape(case: &Case, random: &mut Random) -> Shape {
    // Some lenses hold everything.
    if random.chance(0.08) {
        let center = rounded(point(random, 0.3));
        return Shape::Box { center, size: DVec3::splat(tidy(random.between(6.0, 12.0))), rotation: rotation(random) };
    }
    any(case, 0, random)
}

/// Compounds and meshes only in a case that has meshes to make lenses of.
fn any(case: &Case, depth: usize, random: &mut Random) -> Shape {
    if !case.solids.is_empty() && depth < DEPTH && random.chance(0.25) {
        let kind = *pick(random, &[Compound::Union, Compound::Intersection, Compound::Difference]);
        let count = 2 + random.index(2);
        return Shape::Compound(kind, (0..count).map(|_| any(case, depth + 1, random)).collect());
    }
    if !case.solids.is_empty() && random.chance(0.15) {
        return mesh(case, random);
    }
    simple(random)
}

pub fn simple(random: &mut Random) -> Shape {
    let center = rounded(point(random, 0.5));
    let radius = tidy(random.between(0.25, 0.8));
    let to = rounded(center + direction(random) * random.between(0.3, 1.2));
    let three = |random: &mut Random| rounded(DVec3::from_array(std::array::from_fn(|_| random.between(0.25, 0.8))));
    match random.index(11) {
        0 => Shape::Sphere { center, radius },
        1 => Shape::Ellipsoid { center, radii: three(random), rotation: rotation(random) },
        2 | 3 => Shape::Box { center, size: rounded(2.0 * three(random)), rotation: rotation(random) },
        4 => Shape::Cylinder { from: center, to, radius },
        5 => {
            let other = if random.chance(0.5) { 0.0 } else { tidy(random.between(0.1, 0.8)) };
            let (from_radius, to_radius) = if random.chance(0.5) { (radius, other) } else { (other, radius) };
            Shape::Cone { from: center, to, from_radius, to_radius }
        }
        6 => Shape::Capsule { from: center, to: if random.chance(0.2) { center } else { to }, radius: 0.6 * radius },
        7 => polytope(random),
        8 => Shape::Hull((0..5 + random.index(4)).map(|_| rounded(center + point(random, 0.7))).collect()),
        9 => {
            let normal = rounded(direction(random) * random.between(0.5, 2.0));
            Shape::Plane { point: center, normal, thickness: random.chance(0.5).then_some(radius) }
        }
        _ => flat(center, random),
    }
}

pub fn rotation(random: &mut Random) -> Rotation {
    match random.index(3) {
        0 => Rotation::Euler([0.0; 3]),
        1 => Rotation::Euler(std::array::from_fn(|_| tidy(random.between(-180.0, 180.0)))),
        _ => {
            let axis = direction(random) * random.between(0.5, 2.0);
            Rotation::Quaternion([axis.x, axis.y, axis.z, random.between(-1.5, 1.5)].map(tidy))
        }
    }
}

/// A skewed box about the origin with a few corners cut off.
fn polytope(random: &mut Random) -> Shape {
    let axes = DVec3::AXES.into_iter().flat_map(|axis| [axis, -axis]);
    let mut normals: Vec<DVec3> = axes.map(|axis| axis + point(random, 0.3)).collect();
    normals.extend((0..random.index(4)).map(|_| direction(random)));
    let plane = |n: DVec3| {
        let n = rounded(n * random.between(0.5, 2.0));
        [n.x, n.y, n.z, tidy(n.length() * random.between(0.3, 0.8))]
    };
    Shape::Polytope(normals.into_iter().map(plane).collect())
}

/// Points of an ellipse in their order around it, kept exact: the polygon must be planar.
fn flat(center: DVec3, random: &mut Random) -> Shape {
    let normal = direction(random);
    let x = normal.any_orthonormal_vector();
    let axes = DMat3::from_cols(x, normal.cross(x), normal);
    let (a, b, count) = (random.between(0.4, 0.9), random.between(0.4, 0.9), 3 + random.index(4));
    let corner = |i: usize| {
        let angle = std::f64::consts::TAU * (i as f64 + random.between(-0.3, 0.3)) / count as f64;
        center + axes * DVec3::new(a * angle.cos(), b * angle.sin(), 0.0)
    };
    let corners = (0..count).map(corner).collect();
    Shape::Flat { corners, depth: random.chance(0.4).then(|| tidy(random.between(0.3, 2.0))) }
}

/// The first solid is convex, the others are not.
fn mesh(case: &Case, random: &mut Random) -> Shape {
    let solid = random.index(case.solids.len());
    let convex = match solid {
        0 => *pick(random, &[Convex::AsItIs, Convex::Hull, Convex::Decompose]),
        _ => *pick(random, &[Convex::Decompose, Convex::Decompose, Convex::Hull]),
    };
    let nodes = case.solids[solid].nodes.len();
    let node = (nodes == 1 && random.chance(0.5)).then_some(0);
    Shape::Mesh { solid, node, convex }
}
