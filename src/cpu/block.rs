//! The rays of a block of samples against triangles, together.
//!
//! Neighbouring rays meet the same triangles. So one walk down the BVH visits what the block's pyramid (a box, for an
//! orthographic camera) meets, nearest first, and each triangle is tested only with the rays whose samples its
//! projection's bounds cover. The test itself is exact and watertight; bounds are taken with room to spare, so nothing
//! depends on how samples are put together. After Reshetov and others, "Multi-Level Ray Tracing Algorithm" (2005), and
//! Wald and others, "Ray Tracing Deformable Scenes Using Dynamic Bounding Volume Hierarchies" (2007).

use glam::{Mat3A, Vec3A, Vec4};
use obvhs::bvh2::node::Bvh2Node;

use super::geometry::{self, Geometry, Triangle};
use super::intersect::{ShearedRay, TriangleHit};
use crate::lens::PixelRect;
use crate::view::{Projection, View};

/// Pixels of a rectangle with a square grid of samples in each.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Block {
    pub rect: PixelRect,
    /// Samples along each side of a pixel.
    pub side: u32,
}

impl Block {
    pub fn columns(&self) -> u32 {
        (self.rect.max[0] - self.rect.min[0]) * self.side
    }

    pub fn rows(&self) -> u32 {
        (self.rect.max[1] - self.rect.min[1]) * self.side
    }

    /// Samples, row by row.
    pub fn len(&self) -> usize {
        (self.columns() * self.rows()) as usize
    }

    /// All its samples, by column and row.
    pub fn all(&self) -> PixelRect {
        PixelRect { min: [0, 0], max: [self.columns(), self.rows()] }
    }

    /// Where a sample lies in the picture, in pixels from its top left corner.
    pub fn point(&self, sample: usize) -> (f64, f64) {
        let [column, row] = self.place(sample);
        let along = |first: u32, number: u32| {
            f64::from(first + number / self.side) + (f64::from(number % self.side) + 0.5) / f64::from(self.side)
        };
        (along(self.rect.min[0], column), along(self.rect.min[1], row))
    }

    /// Column and row of a sample.
    pub fn place(&self, sample: usize) -> [u32; 2] {
        [sample as u32 % self.columns(), sample as u32 / self.columns()]
    }

    /// The samples of a pixel, by its place in the picture.
    pub fn samples_of(&self, [x, y]: [u32; 2]) -> impl Iterator<Item = usize> + use<> {
        let (columns, side) = (self.columns(), self.side);
        let first = [(x - self.rect.min[0]) * side, (y - self.rect.min[1]) * side];
        (0..side * side).map(move |i| ((first[1] + i / side) * columns + first[0] + i % side) as usize)
    }
}

/// How much rounding may shift coordinates, as a share of them: some ulp of f32.
const ROUNDING: f32 = 2e-6;
/// Room around bounds in the picture, in pixels.
const MARGIN: f32 = 0.01;

/// From the space of the geometry to the picture.
#[derive(Debug, Clone, Copy)]
pub struct Camera {
    /// Along the camera's right, up and forward axes.
    camera_from_traced: Mat3A,
    /// Pixels per unit: at depth 1 for a perspective camera.
    scale: f32,
    /// The pixel that the eye looks at.
    center: [f32; 2],
    perspective: bool,
    /// How far the eye of a perspective camera is before the anchor.
    eye: f32,
}

impl Camera {
    pub fn new(view: &View) -> Self {
        let traced = geometry::scale(view);
        let height = f64::from(view.size[1]);
        let scale = match view.projection {
            Projection::Perspective { tan_half_y } => 0.5 * height / tan_half_y,
            Projection::Orthographic { half_height } => 0.5 * height / half_height / traced,
        };
        let rows = [view.right, view.up, view.forward].map(|axis| Vec3A::from(axis.as_vec3()));
        Self {
            camera_from_traced: Mat3A::from_cols(rows[0], rows[1], rows[2]).transpose(),
            scale: scale as f32,
            center: view.size.map(|length| 0.5 * length as f32),
            perspective: view.is_perspective(),
            eye: if view.is_perspective() { (view.anchor.depth * traced) as f32 } else { 0.0 },
        }
    }

    /// What a range of a block's samples sees.
    fn beam(&self, block: &Block, range: &PixelRect) -> Beam {
        let first = |axis: usize| block.rect.min[axis] as f32 - self.center[axis];
        let side = block.side as f32;
        let low = |axis: usize| first(axis) + (range.min[axis] as f32 + 0.5) / side - MARGIN;
        let high = |axis: usize| first(axis) + (range.max[axis] as f32 - 0.5) / side + MARGIN;
        // Rows run downwards, the camera's second axis up.
        let limits = [[low(0), high(0)], [-high(1), -low(1)]];
        let axes = self.camera_from_traced.transpose();
        let (right, up, forward) = (axes.x_axis * self.scale, axes.y_axis * self.scale, axes.z_axis);
        let plane = |axis: Vec3A, limit: f32, sign: f32| {
            // The sides of a pyramid go through the eye.
            match self.perspective {
                true => (axis - forward * limit).extend(-limit * self.eye) * sign,
                false => axis.extend(-limit) * sign,
            }
        };
        let planes = [
            plane(right, limits[0][0], 1.0),
            plane(right, limits[0][1], -1.0),
            plane(up, limits[1][0], 1.0),
            plane(up, limits[1][1], -1.0),
        ];
        let column = |i: usize| Vec4::new(planes[0][i], planes[1][i], planes[2][i], planes[3][i]);
        let offset = column(3);
        Beam { normals: [column(0), column(1), column(2)], offset: offset + offset.abs() * ROUNDING, forward }
    }
}

/// The four sides of a block's pyramid or box: inside, `normals·p + offset` is not negative. Component i belongs to
/// side i.
struct Beam {
    normals: [Vec4; 3],
    offset: Vec4,
    forward: Vec3A,
}

impl Beam {
    /// The least depth of a box, unless it lies outside.
    fn nearest(&self, node: &Bvh2Node) -> Option<f32> {
        let bounds = node.aabb();
        let center = 0.5 * (bounds.min + bounds.max);
        let half = 0.5 * (bounds.max - bounds.min);
        let half = half + (center.abs() + half) * ROUNDING;
        let [x, y, z] = self.normals;
        let farthest = self.offset
            + (x * center.x + y * center.y + z * center.z)
            + (x.abs() * half.x + y.abs() * half.y + z.abs() * half.z);
        let is_outside = farthest.cmplt(Vec4::ZERO).any();
        (!is_outside).then(|| self.forward.dot(center) - self.forward.abs().dot(half))
    }
}

/// The rays of a block, and where each of them ends; keeps its allocations from block to block.
#[derive(Default)]
pub struct BlockRays {
    rays: Vec<ShearedRay>,
    /// Parameters; beyond them nothing is looked for.
    ends: Vec<f32>,
    /// Nodes to visit, and their least parameters.
    stack: Vec<(u32, f32)>,
}

/// So many rays must have come to an earlier end before the latest end is looked for again.
const STALE: u32 = 48;

impl BlockRays {
    /// Starts over with rays that all end at a parameter.
    pub fn start(&mut self, rays: impl Iterator<Item = ShearedRay>, end: f32) {
        self.rays.clear();
        self.rays.extend(rays);
        self.ends.clear();
        self.ends.resize(self.rays.len(), end);
    }

    /// Meets a range of the rays with triangles. `met` is told the ray's number, the triangle and the hit, in no
    /// certain order, and says where the ray ends from then on, if that is to change.
    pub fn trace(
        &mut self,
        geometry: &Geometry,
        camera: &Camera,
        block: &Block,
        range: &PixelRect,
        mut met: impl FnMut(usize, &Triangle, &TriangleHit) -> Option<f32>,
    ) {
        let beam = camera.beam(block, range);
        let nodes = &geometry.bvh.nodes;
        self.stack.clear();
        self.stack.extend(nodes.first().and_then(|root| beam.nearest(root)).map(|nearest| (0, nearest)));
        let mut latest = self.latest();
        let mut shortened = 0;
        while let Some((number, nearest)) = self.stack.pop() {
            if shortened > STALE {
                (latest, shortened) = (self.latest(), 0);
            }
            if nearest > latest {
                continue;
            }
            let node = &nodes[number as usize];
            if !node.is_leaf() {
                let place = |child: u32| {
                    let nearest = beam.nearest(&nodes[child as usize])?;
                    Some((child, nearest)).filter(|(_, nearest)| *nearest <= latest)
                };
                let (a, b) = (place(node.first_index), place(node.first_index + 1));
                let swap = matches!((a, b), (Some(a), Some(b)) if a.1 < b.1);
                let (later, sooner) = if swap { (b, a) } else { (a, b) };
                self.stack.extend(later.into_iter().chain(sooner));
                continue;
            }
            let leaf = node.first_index as usize..(node.first_index + node.prim_count) as usize;
            for triangle in &geometry.triangles[leaf] {
                let Some((covered, nearest)) = camera.covered(triangle, block, range) else { continue };
                for row in covered.min[1]..covered.max[1] {
                    for column in covered.min[0]..covered.max[0] {
                        let ray = (row * block.columns() + column) as usize;
                        if nearest > self.ends[ray] {
                            continue;
                        }
                        let Some(hit) = geometry.hit(&self.rays[ray], triangle) else { continue };
                        if hit.t > self.ends[ray] {
                            continue;
                        }
                        if let Some(end) = met(ray, triangle, &hit) {
                            self.ends[ray] = end;
                            shortened += 1;
                        }
                    }
                }
            }
        }
    }

    /// The latest end of all rays.
    fn latest(&self) -> f32 {
        let later = |a: f32, b: f32| if a > b { a } else { b };
        let mut lanes = [f32::NEG_INFINITY; 8];
        let (chunks, rest) = self.ends.as_chunks::<8>();
        for chunk in chunks {
            for (lane, end) in lanes.iter_mut().zip(chunk) {
                *lane = later(*lane, *end);
            }
        }
        lanes.iter().chain(rest).copied().fold(f32::NEG_INFINITY, later)
    }
}

impl Camera {
    /// The samples of a range that a triangle may cover, if any, and its least depth.
    fn covered(&self, triangle: &Triangle, block: &Block, range: &PixelRect) -> Option<(PixelRect, f32)> {
        let corners = triangle.corners.map(|p| self.camera_from_traced * Vec3A::from(p));
        let min = corners[0].min(corners[1]).min(corners[2]);
        let max = corners[0].max(corners[1]).max(corners[2]);
        let room = min.abs().max(max.abs()).element_sum() * ROUNDING;
        let depth = min.z - room;
        let from_eye = depth + self.eye;
        if self.perspective && from_eye <= ROUNDING * self.eye {
            // It may reach behind the eye: anywhere.
            return (max.z + self.eye + room >= 0.0).then_some((*range, depth));
        }
        let (low, high, room) = if self.perspective {
            let flat = corners.map(|p| p * (self.scale / (p.z + self.eye)));
            let low = flat[0].min(flat[1]).min(flat[2]);
            let high = flat[0].max(flat[1]).max(flat[2]);
            (low, high, room * self.scale / from_eye)
        } else {
            (min * self.scale, max * self.scale, room * self.scale)
        };
        let room = (room + MARGIN) * block.side as f32;
        // Rows run downwards, the camera's second axis up.
        let mut covered = *range;
        for (axis, ends) in [[low.x, high.x], [-high.y, -low.y]].into_iter().enumerate() {
            let first = block.rect.min[axis] as f32 - self.center[axis];
            let [low, high] = ends.map(|at| (at - first) * block.side as f32 - 0.5);
            // Casts saturate, and what is not a number covers nothing.
            covered.min[axis] = covered.min[axis].max((low - room).ceil() as u32);
            covered.max[axis] = covered.max[axis].min(((high + room).floor() + 1.0) as u32);
        }
        (!covered.is_empty()).then_some((covered, depth))
    }
}

#[cfg(test)]
mod tests {
    use glam::{DVec3, Vec3};

    use super::*;
    use crate::cpu::geometry::NONE;
    use crate::view::Anchor;

    fn view(projection: Projection) -> View {
        let forward = DVec3::new(0.3, -0.2, -1.0).normalize();
        let right = forward.cross(DVec3::Y).normalize();
        View {
            eye: DVec3::ZERO,
            right,
            up: right.cross(forward),
            forward,
            projection,
            anchor: Anchor::default(),
            near: 0.01,
            far: 50.0,
            size: [61, 37],
        }
    }

    /// Triangles of all sizes around the eye, before and behind it.
    fn cloud(count: u32, scale: f32) -> Vec<Triangle> {
        let mut state = 1u32;
        let mut random = move || {
            state = state.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
            (state >> 8) as f32 / (1 << 24) as f32 - 0.5
        };
        let mut point = move |size: f32| size * Vec3::new(random(), random(), random());
        (0..count)
            .map(|index| {
                let (center, size) = (point(16.0), if index % 5 == 0 { 8.0 } else { 0.5 });
                let corners = [0; 3].map(|_| scale * (center + point(size)));
                Triangle { corners, instance: 0, index, exact: NONE }
            })
            .collect()
    }

    fn geometry(triangles: &[Triangle]) -> Geometry {
        Geometry::of_triangles(triangles.to_vec(), Vec::new())
    }

    fn sheared(view: &View, (x, y): (f64, f64)) -> ShearedRay {
        let ray = view.ray(x, y);
        ShearedRay::new((ray.origin - view.origin()) * geometry::scale(view), ray.direction)
    }

    /// All hits of a block's rays, and those that are found one ray and one triangle at a time.
    fn both(view: &View, block: &Block, range: &PixelRect) -> [Vec<(usize, u32)>; 2] {
        let triangles = cloud(400, geometry::scale(view) as f32);
        let rays: Vec<ShearedRay> = (0..block.len()).map(|sample| sheared(view, block.point(sample))).collect();
        let mut bundle = BlockRays::default();
        bundle.start(rays.iter().copied(), f32::MAX);
        let mut found = Vec::new();
        bundle.trace(&geometry(&triangles), &Camera::new(view), block, range, |ray, triangle, hit| {
            if hit.t > 0.0 {
                found.push((ray, triangle.index));
            }
            None
        });
        found.sort_unstable();
        let is_in = |sample: usize| (0..2).all(|i| (range.min[i]..range.max[i]).contains(&block.place(sample)[i]));
        let samples = (0..block.len()).filter(|sample| is_in(*sample));
        let meets = |ray: usize, triangle: &Triangle| rays[ray].hit(&triangle.corners).is_some_and(|hit| hit.t > 0.0);
        let mut expected: Vec<(usize, u32)> = samples
            .flat_map(|ray| triangles.iter().filter(move |t| meets(ray, t)).map(move |t| (ray, t.index)))
            .collect();
        expected.sort_unstable();
        [found, expected]
    }

    #[test]
    fn a_block_meets_what_its_rays_meet() {
        let projections = [
            Projection::Perspective { tan_half_y: 0.4 },
            Projection::Perspective { tan_half_y: 3.0 },
            Projection::Perspective { tan_half_y: 1e-4 },
            Projection::Orthographic { half_height: 3.0 },
        ];
        let mut hits = 0;
        for view in projections.map(view) {
            for (min, side) in [([0, 0], 1), ([45, 21], 1), ([16, 16], 2), ([40, 3], 3)] {
                let block = Block { rect: PixelRect { min, max: [min[0] + 16, min[1] + 16] }, side };
                let [found, expected] = both(&view, &block, &block.all());
                assert_eq!(found, expected, "{view:?} {block:?}");
                hits += found.len();
            }
        }
        assert!(hits > 10_000, "{hits}");
    }

    #[test]
    fn only_the_rays_of_a_range_are_met() {
        let view = view(Projection::Perspective { tan_half_y: 0.4 });
        let block = Block { rect: PixelRect { min: [20, 10], max: [36, 26] }, side: 1 };
        let range = PixelRect { min: [3, 5], max: [9, 6] };
        let [found, expected] = both(&view, &block, &range);
        assert_eq!(found, expected);
        assert!(!found.is_empty());
    }

    #[test]
    fn rays_end_where_they_are_told_to() {
        let view = view(Projection::Perspective { tan_half_y: 0.4 });
        let block = Block { rect: PixelRect { min: [20, 10], max: [36, 26] }, side: 1 };
        let triangles = cloud(4000, 1.0);
        let rays: Vec<ShearedRay> = (0..block.len()).map(|sample| sheared(&view, block.point(sample))).collect();
        let mut bundle = BlockRays::default();
        bundle.start(rays.iter().copied(), 50.0);
        let mut nearest = vec![50.0; rays.len()];
        let mut met = 0;
        bundle.trace(&geometry(&triangles), &Camera::new(&view), &block, &block.all(), |ray, _, hit| {
            met += 1;
            (hit.t > 0.0).then(|| {
                nearest[ray] = hit.t;
                hit.t
            })
        });
        let first = |ray: &ShearedRay| {
            let hits = triangles.iter().filter_map(|triangle| ray.hit(&triangle.corners)).map(|hit| hit.t);
            hits.filter(|t| *t > 0.0).fold(50.0, f32::min)
        };
        assert_eq!(nearest, rays.iter().map(first).collect::<Vec<_>>());
        let all: usize =
            rays.iter().map(|ray| triangles.iter().filter(|t| ray.hit(&t.corners).is_some()).count()).sum();
        assert!(2 * met < all, "of {all} hits {met} were looked at");
    }
}
