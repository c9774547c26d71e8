//! Which points a shape contains, and where a line may cross its surface.

use glam::{DMat3, DVec3};

use super::place::{middle, of_node, turn};
use super::view::Ray;
use crate::case::{Case, Compound, Convex, Shape};

/// A shape in its own space.
#[derive(Debug, Clone)]
pub enum Solid {
    /// The ball of radius 1 in the space of the matrix.
    Ellipsoid {
        center: DVec3,
        ball_from_shape: DMat3,
    },
    /// The points with `n·p <= d` for all.
    Planes(Vec<(DVec3, f64)>),
    Cone {
        from: DVec3,
        to: DVec3,
        radii: [f64; 2],
    },
    Capsule {
        from: DVec3,
        to: DVec3,
        radius: f64,
    },
    Flat {
        corners: Vec<DVec3>,
        depth: Option<f64>,
    },
    /// A closed surface; inside is where a ray crosses it an odd number of times.
    Mesh(Vec<[DVec3; 3]>),
    Compound(Compound, Vec<Solid>),
}

/// How the eye looks, in the space of the shape.
#[derive(Debug, Clone, Copy)]
pub struct Sight {
    pub eye: DVec3,
    /// The view direction of an orthographic camera.
    pub along: Option<DVec3>,
}

impl Sight {
    /// The way from a place towards where the eye sees it from; the length of it for a perspective is that to the eye.
    fn towards_eye(&self, p: DVec3) -> DVec3 {
        self.along.map_or(self.eye - p, |along| -along)
    }
}

/// A shape and its centre, as the format's table has it.
pub fn solid(case: &Case, shape: &Shape) -> (Solid, DVec3) {
    let cone = |from: &DVec3, to: &DVec3, radii| (Solid::Cone { from: *from, to: *to, radii }, 0.5 * (*from + *to));
    match shape {
        Shape::Sphere { center, radius } => (
            Solid::Ellipsoid { center: *center, ball_from_shape: DMat3::from_diagonal(DVec3::splat(1.0 / radius)) },
            *center,
        ),
        Shape::Ellipsoid { center, radii, rotation } => {
            let ball_from_shape = DMat3::from_diagonal(1.0 / *radii) * turn(*rotation).transpose();
            (Solid::Ellipsoid { center: *center, ball_from_shape }, *center)
        }
        Shape::Box { center, size, rotation } => {
            let axes = turn(*rotation);
            let side = |i: usize, sign: f64| (axes.col(i) * sign, sign * axes.col(i).dot(*center) + 0.5 * size[i]);
            (Solid::Planes((0..3).flat_map(|i| [side(i, 1.0), side(i, -1.0)]).collect()), *center)
        }
        Shape::Cylinder { from, to, radius } => cone(from, to, [*radius; 2]),
        Shape::Cone { from, to, from_radius, to_radius } => cone(from, to, [*from_radius, *to_radius]),
        Shape::Capsule { from, to, radius } => {
            (Solid::Capsule { from: *from, to: *to, radius: *radius }, 0.5 * (*from + *to))
        }
        Shape::Polytope(planes) => {
            let planes: Vec<_> = planes.iter().map(|[x, y, z, d]| (DVec3::new(*x, *y, *z), *d)).collect();
            let center = middle(corners_of(&planes).into_iter());
            (Solid::Planes(planes), center)
        }
        Shape::Hull(points) => (Solid::Planes(hull(points)), middle(points.iter().copied())),
        Shape::Plane { point, normal, thickness } => {
            let n = normal.normalize();
            let planes = match thickness {
                None => vec![(n, n.dot(*point))],
                Some(t) => vec![(n, n.dot(*point) + 0.5 * t), (-n, 0.5 * t - n.dot(*point))],
            };
            (Solid::Planes(planes), *point)
        }
        Shape::Flat { corners, depth } => {
            let mean = corners.iter().sum::<DVec3>() / corners.len() as f64;
            (Solid::Flat { corners: corners.clone(), depth: *depth }, mean)
        }
        Shape::Mesh { solid, node, convex } => {
            let triangles = mesh(case, *solid, *node);
            let points: Vec<DVec3> = triangles.iter().flatten().copied().collect();
            let center = middle(points.iter().copied());
            (if *convex == Convex::Hull { Solid::Planes(hull(&points)) } else { Solid::Mesh(triangles) }, center)
        }
        Shape::Compound(kind, parts) => {
            let (parts, centers): (Vec<_>, Vec<DVec3>) = parts.iter().map(|part| solid(case, part)).unzip();
            let mean = centers.iter().sum::<DVec3>() / centers.len() as f64;
            (Solid::Compound(*kind, parts), mean)
        }
    }
}

/// All triangles of a model, or of one node with its descendants.
fn mesh(case: &Case, solid: usize, only: Option<usize>) -> Vec<[DVec3; 3]> {
    let model = &case.solids[solid];
    let is_part = |node: usize| {
        let mut line = std::iter::successors(Some(node), |n| model.nodes[*n].parent);
        only.is_none_or(|root| line.any(|n| n == root))
    };
    let nodes = (0..model.nodes.len()).filter(|node| is_part(*node));
    let placed = |node: usize| {
        let world = of_node(model, node);
        let triangles = model.nodes[node].primitives.iter().flat_map(|p| &p.triangles);
        triangles.map(move |t| t.map(|p| world.transform_point3(p)))
    };
    nodes.flat_map(placed).collect()
}

/// Every plane through three points that has all on one side.
fn hull(points: &[DVec3]) -> Vec<(DVec3, f64)> {
    let mut distinct: Vec<DVec3> = Vec::new();
    points.iter().for_each(|p| {
        if distinct.iter().all(|q| q.distance(*p) > 1e-9) {
            distinct.push(*p)
        }
    });
    let count = distinct.len();
    let mut planes: Vec<(DVec3, f64)> = Vec::new();
    for (i, j, k) in (0..count).flat_map(|i| (i + 1..count).flat_map(move |j| (j + 1..count).map(move |k| (i, j, k)))) {
        let (a, b, c) = (distinct[i], distinct[j], distinct[k]);
        let across = (b - a).cross(c - a);
        if across.length() < 1e-9 {
            continue;
        }
        for n in [across.normalize(), -across.normalize()] {
            let d = n.dot(a);
            let known = planes.iter().any(|(m, e)| m.distance(n) < 1e-9 && (e - d).abs() < 1e-9);
            if !known && distinct.iter().all(|p| n.dot(*p) <= d + 1e-9) {
                planes.push((n, d));
            }
        }
    }
    planes
}

/// Where three planes meet inside all others.
fn corners_of(planes: &[(DVec3, f64)]) -> Vec<DVec3> {
    let mut corners = Vec::new();
    for (i, (a, d)) in planes.iter().enumerate() {
        for (j, (b, e)) in planes.iter().enumerate().skip(i + 1) {
            for (c, f) in planes.iter().skip(j + 1) {
                let system = DMat3::from_cols(*a, *b, *c).transpose();
                if system.determinant().abs() < 1e-12 {
                    continue;
                }
                let p = system.inverse() * DVec3::new(*d, *e, *f);
                if planes.iter().all(|(n, d)| n.dot(p) <= d + 1e-9) {
                    corners.push(p);
                }
            }
        }
    }
    corners
}

fn newell(corners: &[DVec3]) -> DVec3 {
    let next = |i: usize| corners[(i + 1) % corners.len()];
    (0..corners.len()).map(|i| corners[i].cross(next(i))).sum::<DVec3>().normalize()
}

impl Solid {
    /// Whether some of it goes on for ever: no fewer than four planes bound anything.
    pub fn has_endless_part(&self) -> bool {
        match self {
            Solid::Flat { .. } => true,
            Solid::Planes(planes) => planes.len() < 4,
            Solid::Compound(_, parts) => parts.iter().any(Solid::has_endless_part),
            _ => false,
        }
    }

    pub fn contains(&self, p: DVec3, sight: &Sight) -> bool {
        match self {
            Solid::Ellipsoid { center, ball_from_shape } => (*ball_from_shape * (p - *center)).length() <= 1.0,
            Solid::Planes(planes) => planes.iter().all(|(n, d)| n.dot(p) <= *d),
            Solid::Cone { from, to, radii } => {
                let axis = *to - *from;
                let share = (p - *from).dot(axis) / axis.length_squared();
                let radius = radii[0] + (radii[1] - radii[0]) * share;
                (0.0..=1.0).contains(&share) && p.distance(*from + axis * share) <= radius
            }
            Solid::Capsule { from, to, radius } => {
                let axis = *to - *from;
                let share = if axis == DVec3::ZERO { 0.0 } else { (p - *from).dot(axis) / axis.length_squared() };
                p.distance(*from + axis * share.clamp(0.0, 1.0)) <= *radius
            }
            Solid::Flat { corners, depth } => is_seen_through(corners, *depth, p, sight),
            Solid::Mesh(triangles) => {
                // No axis: no ray runs along a face or through an edge of anything made by hand.
                let ray = Ray { origin: p, direction: DVec3::new(0.613, 0.377, 0.691) };
                triangles.iter().filter(|t| hit(&ray, t).is_some_and(|t| t > 0.0)).count() % 2 == 1
            }
            Solid::Compound(kind, parts) => {
                let inside = |part: &Solid| part.contains(p, sight);
                match kind {
                    Compound::Union => parts.iter().any(inside),
                    Compound::Intersection => parts.iter().all(inside),
                    Compound::Difference => inside(&parts[0]) && !parts[1..].iter().any(inside),
                }
            }
        }
    }

    /// Distance from a point inside to the surface in the units of the world; of balls that are round there, of
    /// half-spaces, and of intersections of both.
    pub fn depth_inside(&self, p: DVec3, shape_from_world: &DMat3) -> Option<f64> {
        match self {
            Solid::Ellipsoid { center, ball_from_shape } => {
                let ball_from_world = *ball_from_shape * *shape_from_world;
                let squares = ball_from_world.transpose() * ball_from_world;
                let square = squares.x_axis.x;
                let is_round = squares.abs_diff_eq(DMat3::from_diagonal(DVec3::splat(square)), 1e-9 * square);
                is_round.then(|| (1.0 - (*ball_from_shape * (p - *center)).length()) / square.sqrt())
            }
            Solid::Planes(planes) => {
                let height = |(n, d): &(DVec3, f64)| (d - n.dot(p)) / (shape_from_world.transpose() * *n).length();
                planes.iter().map(height).reduce(f64::min)
            }
            Solid::Compound(Compound::Intersection, parts) => {
                let depths: Option<Vec<f64>> =
                    parts.iter().map(|part| part.depth_inside(p, shape_from_world)).collect();
                depths?.into_iter().reduce(f64::min)
            }
            _ => None,
        }
    }

    /// Parameters at which a line may enter or leave: every crossing of the surface is among them.
    pub fn crossings(&self, ray: &Ray, sight: &Sight) -> Vec<f64> {
        let Ray { origin: o, direction: d } = *ray;
        let plane = |n: DVec3, e: f64| (e - n.dot(o)) / n.dot(d);
        match self {
            Solid::Ellipsoid { center, ball_from_shape } => {
                let (o, d) = (*ball_from_shape * (o - *center), *ball_from_shape * d);
                roots(d.length_squared(), o.dot(d), o.length_squared() - 1.0)
            }
            Solid::Planes(planes) => planes.iter().map(|(n, e)| plane(*n, *e)).collect(),
            Solid::Cone { from, to, radii } => {
                let axis = (*to - *from).normalize();
                let mut all = side(ray, *from, axis, radii[0], (radii[1] - radii[0]) / from.distance(*to));
                all.extend([plane(axis, axis.dot(*from)), plane(axis, axis.dot(*to))]);
                all
            }
            Solid::Capsule { from, to, radius } => {
                let ball = |center: DVec3| {
                    let w = o - center;
                    roots(d.length_squared(), w.dot(d), w.length_squared() - radius * radius)
                };
                let mut all = [ball(*from), ball(*to)].concat();
                if from != to {
                    all.extend(side(ray, *from, (*to - *from).normalize(), *radius, 0.0));
                }
                all
            }
            Solid::Flat { corners, depth } => {
                let n = newell(corners);
                let away = if n.dot(sight.towards_eye(corners[0])) > 0.0 { -n } else { n };
                let start = away.dot(corners[0]);
                let mut all: Vec<f64> =
                    depth.iter().map(|depth| start + depth).chain([start]).map(|e| plane(away, e)).collect();
                // A view ray crosses no side, for those are planes through the eye; one that a mover brings does.
                let from_eye = sight.along.unwrap_or(o - sight.eye);
                if from_eye.cross(d).length() > 1e-9 * from_eye.length() * d.length() {
                    let edges = (0..corners.len()).map(|i| (corners[i], corners[(i + 1) % corners.len()]));
                    let side = |(a, b): (DVec3, DVec3)| (b - a).cross(sight.towards_eye(a));
                    all.extend(edges.map(|(a, b)| plane(side((a, b)), side((a, b)).dot(a))));
                }
                all
            }
            Solid::Mesh(triangles) => triangles.iter().filter_map(|t| hit(ray, t)).collect(),
            Solid::Compound(_, parts) => parts.iter().flat_map(|part| part.crossings(ray, sight)).collect(),
        }
    }
}

/// Whether the line of sight to a point comes through a polygon, not more than `depth` before the point.
fn is_seen_through(corners: &[DVec3], depth: Option<f64>, p: DVec3, sight: &Sight) -> bool {
    let n = newell(corners);
    let back = sight.towards_eye(p);
    // The share of the way back from the point at which the polygon's plane is met.
    let share = n.dot(corners[0] - p) / n.dot(back);
    let in_reach = share >= 0.0 && (sight.along.is_some() || share <= 1.0);
    let at = p + back * share;
    let is_left = |i: usize| n.dot((corners[(i + 1) % corners.len()] - corners[i]).cross(at - corners[i])) >= 0.0;
    in_reach && (0..corners.len()).all(is_left) && depth.is_none_or(|depth| n.dot(p - corners[0]).abs() <= depth)
}

/// The side of a cone with its radius at `from` and what that grows by along the axis; both halves of it.
fn side(ray: &Ray, from: DVec3, axis: DVec3, radius: f64, growth: f64) -> Vec<f64> {
    let (w, d) = (ray.origin - from, ray.direction);
    let (wa, da) = (w.dot(axis), d.dot(axis));
    let at = radius + growth * wa;
    roots(
        d.length_squared() - da * da - growth * growth * da * da,
        w.dot(d) - wa * da - growth * da * at,
        w.length_squared() - wa * wa - at * at,
    )
}

/// Of `a t² + 2 b t + c`.
fn roots(a: f64, b: f64, c: f64) -> Vec<f64> {
    if a.abs() < 1e-12 {
        return vec![-0.5 * c / b];
    }
    let root = (b * b - a * c).sqrt();
    if root.is_nan() { Vec::new() } else { vec![(-b - root) / a, (-b + root) / a] }
}

/// Where a line meets a triangle (Möller and Trumbore 1997).
pub fn hit(ray: &Ray, [a, b, c]: &[DVec3; 3]) -> Option<f64> {
    let (ab, ac) = (*b - *a, *c - *a);
    let across = ray.direction.cross(ac);
    let determinant = ab.dot(across);
    let from = ray.origin - *a;
    let u = from.dot(across) / determinant;
    let up = from.cross(ab);
    let v = ray.direction.dot(up) / determinant;
    (determinant != 0.0 && u >= 0.0 && v >= 0.0 && u + v <= 1.0).then(|| ac.dot(up) / determinant)
}
