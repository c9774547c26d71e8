//! Which faces of a part may matter to which pixels: the window's tiles are cut into cells, and each cell lists the
//! planes or triangles whose projection touches it.
//!
//! A ray in a cell then asks those few faces and gets what all faces would give it. For a closed mesh that is plain: a
//! ray crosses no triangle whose projection it is not in. For half-spaces, let P be the projection of their solid and
//! suppose that some face touches the cell. A ray in P enters and leaves through listed faces. A ray r of the cell outside P
//! is seen from a point of P in the cell across an edge of P between them, which lies in the cell; the two faces at
//! that edge are listed, and their planes alone keep r out. A cell that no face touches has no ray in P. So that
//! rounding breaks none of this, a cell lists faces within [`LISTED`] pixels of it, and none at all unless one is within
//! [`TOUCHING`].

use glam::{DVec2, DVec3};
use rayon::prelude::*;

use super::Window;
use super::tiles::TILE;
use crate::lens::{Form, MeshSolid, PixelRect, Polyhedron, Solid};
use crate::view::View;

const LISTED: f64 = 0.05;
const TOUCHING: f64 = 0.02;
/// Tiles are cut until so few of a part's faces are left to a cell, on average, or cells have two pixels a side.
const FACES: usize = 2;
const MOST_CELLS: u32 = 8;
/// In so few cells a small triangle is listed unseen: to look costs more than it spares.
const FEW_CELLS: u64 = 4;
/// So many faces one thread takes at a time.
const CHUNK: u32 = 4096;

/// So many planes a ray may have to ask, where no cells list them.
const MOST_PLANES: usize = 256;

/// Whether a mesh is asked as the half-spaces of its triangles' planes.
pub fn has_planes(mesh: &MeshSolid) -> bool {
    mesh.is_convex && mesh.tree.triangles.len() <= MOST_PLANES
}

/// Whether a ray enters and leaves a part once at the most, as the device asks it.
pub fn is_convex(form: &Form) -> bool {
    form.is_convex() || matches!(form, Form::Mesh(mesh) if has_planes(mesh))
}

/// The faces of one part by cells.
#[derive(Debug, Clone, PartialEq)]
pub struct Cells {
    /// Cells along each side of a tile.
    pub side: u32,
    /// Of the window, in cells.
    rect: PixelRect,
    /// Where the faces of each cell of `rect` start, row by row, and where those of the last one end.
    starts: Vec<u32>,
    faces: Vec<u32>,
    /// Of a mesh.
    pub projected: Option<ProjectedMesh>,
}

/// Tells of each cell of a rectangle near to a face, by its number in the rectangle, and whether the face touches it.
fn find_cells(corners: &[DVec2], is_mesh: bool, size: u32, rect: &PixelRect, mut tell: impl FnMut(u32, bool)) {
    let start = |p: DVec2| ((p - LISTED) / f64::from(size)).floor().max(DVec2::ZERO).as_uvec2().to_array();
    let [low, high] = bounds(corners);
    let (first, last) = (start(low), start(high + 2.0 * LISTED));
    let range = PixelRect {
        min: std::array::from_fn(|axis| first[axis].max(rect.min[axis])),
        max: std::array::from_fn(|axis| (last[axis] + 1).min(rect.max[axis])),
    };
    // What reaches into no other cell is in this one; and triangles of a mesh may be listed in vain.
    let is_within = first == last && low.min_element() >= 0.0;
    let is_known = is_within || (is_mesh && range.area() <= FEW_CELLS);
    for (x, y) in cells_of(&range) {
        let corner = DVec2::new(f64::from(x * size), f64::from(y * size));
        let gap = if is_known { 0.0 } else { gap(corners, corner, f64::from(size)) };
        if gap <= LISTED {
            tell((y - rect.min[1]) * (rect.max[0] - rect.min[0]) + x - rect.min[0], gap <= TOUCHING);
        }
    }
}

/// The triangles of a mesh as functions of the point of the picture.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct ProjectedMesh {
    /// The point that the functions start from.
    pub origin: [f32; 2],
    /// Of a perspective camera: the depth from the eye behind which, as a share of it, a depth from the eye is linear over
    /// the picture. 0: inverse depths are taken, where a part has near and far places.
    pub reference: f32,
    /// Four a triangle: the three sides (coefficients of x, of y, and the value at the origin; positive on their left)
    /// with, last, the point from which the depth is counted (x, y) and the least depth; and the depth or, for a
    /// perspective camera, its inverse (the same coefficients) with the largest depth.
    pub vectors: Vec<[f32; 4]>,
}

impl Cells {
    /// Those of a part with planes or triangles, within the pixels of the window that it covers. `None` where every ray
    /// asks all faces: of flat parts, which are open to the far side, and where a part does not all lie behind the near
    /// plane of a perspective camera, or reaches very far out of the picture.
    pub fn new(view: &View, window: &Window, solid: &Solid, rect: &PixelRect) -> Option<Self> {
        let faces = Projected::new(view, window, solid)?;
        let tiles = |axis: usize| (rect.max[axis].div_ceil(TILE) - rect.min[axis] / TILE) as usize;
        let tiles = (tiles(0) * tiles(1)).max(1);
        // Small faces touch about two cells, and a ray is covered at least twice.
        let a_tile = 2 * faces.count() / tiles;
        let side = [1, 2, 4].into_iter().find(|side| a_tile <= FACES * (side * side) as usize).unwrap_or(MOST_CELLS);
        let size = TILE / side;
        let rect =
            PixelRect { min: rect.min.map(|at| at / TILE * side), max: rect.max.map(|at| at.div_ceil(TILE) * side) };
        let cells = Self::gather(&faces, side, size, rect);
        let Form::Mesh(mesh) = &solid.form else { return Some(cells) };
        if has_planes(mesh) {
            return Some(cells);
        }
        let projected = ProjectedMesh::new(&faces, &mesh.tree.triangles, view, window);
        Some(Self { projected: Some(projected), ..cells })
    }

    fn gather(faces: &Projected, side: u32, size: u32, rect: PixelRect) -> Self {
        let chunks = (faces.count() as u32).div_ceil(CHUNK);
        let of_chunk = |chunk: u32| {
            let (mut found, mut corners) = (Vec::new(), Vec::new());
            for face in chunk * CHUNK..((chunk + 1) * CHUNK).min(faces.count() as u32) {
                faces.corners(face as usize, &mut corners);
                find_cells(&corners, faces.is_mesh, size, &rect, |cell, touches| {
                    found.push((cell, faces.numbers[face as usize], touches));
                });
            }
            found
        };
        let mut found: Vec<(u32, u32, bool)> = (0..chunks).into_par_iter().flat_map_iter(of_chunk).collect();
        let mut touched = vec![false; rect.area() as usize];
        found.iter().for_each(|(cell, _, touches)| touched[*cell as usize] |= touches);
        found.retain(|(cell, ..)| touched[*cell as usize]);
        let mut starts = vec![0u32; touched.len() + 1];
        found.iter().for_each(|(cell, ..)| starts[*cell as usize + 1] += 1);
        (1..starts.len()).for_each(|cell| starts[cell] += starts[cell - 1]);
        let mut next = starts.clone();
        let mut sorted = vec![0; found.len()];
        for (cell, face, _) in found {
            sorted[next[cell as usize] as usize] = face;
            next[cell as usize] += 1;
        }
        Self { side, rect, starts, faces: sorted, projected: None }
    }

    /// The faces of each cell of a tile, given its column and row, row by row.
    pub fn of_tile(&self, [x, y]: [u32; 2]) -> impl Iterator<Item = &[u32]> {
        let columns = self.rect.max[0] - self.rect.min[0];
        let first = [x * self.side - self.rect.min[0], y * self.side - self.rect.min[1]];
        (0..self.side * self.side).map(move |i| {
            let cell = ((first[1] + i / self.side) * columns + first[0] + i % self.side) as usize;
            &self.faces[self.starts[cell] as usize..self.starts[cell + 1] as usize]
        })
    }
}

impl ProjectedMesh {
    fn new(faces: &Projected, triangles: &[[u32; 3]], view: &View, window: &Window) -> Self {
        let reference = if view.is_perspective() { faces.reference(view) } else { 0.0 };
        // In the middle of what is seen: numbers stay small where pixels are, however far off corners lie.
        let size = DVec2::from_array(window.size.map(f64::from));
        let [low, high] = bounds(&faces.points).map(|p| p.clamp(DVec2::ZERO, size));
        let origin = (0.5 * (low + high)).round();
        let vectors = triangles.par_iter().map(|corners| {
            let points = corners.map(|i| faces.points[i as usize] - origin);
            let depths = corners.map(|i| faces.depths[i as usize]);
            let [b, c] = [points[1] - points[0], points[2] - points[0]];
            let counted = depths.map(|depth| match view.is_perspective() {
                // (t - reference) / t, without a difference of large numbers.
                true if reference > 0.0 => (depth - (reference - view.anchor.depth)) / view.from_eye(depth),
                true => 1.0 / view.from_eye(depth),
                false => depth,
            });
            let [rise_b, rise_c] = [counted[1] - counted[0], counted[2] - counted[0]];
            // Seen edge on it has any slope: the depth stays between its corners' anyway.
            let area = b.perp_dot(c);
            let slope = if area == 0.0 { DVec2::ZERO } else { (c.perp() * -rise_b + b.perp() * rise_c) / area };
            let sides = [0, 1, 2].map(|i| side(corners, &points, i));
            // From the deepest corner, where the inverse is least: nothing cancels.
            let from = (0..3).fold(0, |from, i| if depths[i] > depths[from] { i } else { from });
            let [least, most] = [f64::min, f64::max].map(|pick| depths.into_iter().reduce(pick).unwrap_or_default());
            let vector = |v: DVec2, z: f64, w: f64| [v.x, v.y, z, w].map(|x| x.clamp(-1e30, 1e30) as f32);
            [
                vector(sides[0].0, sides[0].1, points[from].x),
                vector(sides[1].0, sides[1].1, points[from].y),
                vector(sides[2].0, sides[2].1, least),
                vector(slope, counted[from], most),
            ]
        });
        let place = origin + DVec2::from_array(window.min.map(f64::from));
        Self {
            origin: place.as_vec2().to_array(),
            reference: reference as f32,
            vectors: vectors.collect::<Vec<_>>().into_flattened(),
        }
    }
}

/// A side of a triangle as a function of the point: its coefficients, and its value at the origin. Taken along the side
/// from its lower corner to its higher, so that the triangles at both sides of it have the same numbers with other signs.
fn side(corners: &[u32; 3], points: &[DVec2; 3], from: usize) -> (DVec2, f64) {
    let to = (from + 1) % 3;
    let (low, high) = if corners[from] < corners[to] { (from, to) } else { (to, from) };
    let normal = (points[high] - points[low]).perp();
    let sign = if low == from { 1.0 } else { -1.0 };
    (normal * sign, -normal.dot(points[low]) * sign)
}

/// The faces of a part in the picture.
struct Projected {
    /// In pixels of the window.
    points: Vec<DVec2>,
    /// Of the points.
    depths: Vec<f64>,
    /// The corners of all faces, in `points`; where those of each face start, and the last one's end.
    corners: Vec<u32>,
    starts: Vec<u32>,
    /// Of each face, among the part's.
    numbers: Vec<u32>,
    is_mesh: bool,
}

impl Projected {
    fn new(view: &View, window: &Window, solid: &Solid) -> Option<Self> {
        let origin = DVec2::from_array(window.min.map(f64::from));
        let project = |local: &DVec3| {
            let world = solid.world_from_local.transform_point3(*local);
            // A point almost at the eye's plane projects to anywhere.
            let p = view.project(world).filter(|p| p.abs().max_element() < 1e7)?;
            let depth = view.depth(world);
            (!view.is_perspective() || depth >= view.near).then_some((p - origin, depth))
        };
        match &solid.form {
            Form::HalfSpaces { planes, .. } if solid.is_bounded() => {
                let Polyhedron { faces } = Polyhedron::from_planes(planes).ok()?;
                let corners: Option<Vec<_>> = faces.iter().flat_map(|(_, corners)| corners).map(project).collect();
                let (points, depths): (Vec<DVec2>, Vec<f64>) = corners?.into_iter().unzip();
                let mut starts = vec![0];
                starts.extend(faces.iter().scan(0, |end, (_, corners)| {
                    *end += corners.len() as u32;
                    Some(*end)
                }));
                let numbers = faces.iter().map(|(number, _)| *number as u32).collect();
                Some(Self {
                    corners: (0..points.len() as u32).collect(),
                    points,
                    depths,
                    starts,
                    numbers,
                    is_mesh: false,
                })
            }
            Form::Mesh(mesh) => {
                let vertices: Option<Vec<_>> = mesh.tree.vertices.par_iter().map(project).collect();
                let (points, depths) = vertices?.into_iter().unzip();
                let count = mesh.tree.triangles.len() as u32;
                Some(Self {
                    points,
                    depths,
                    corners: mesh.tree.triangles.as_flattened().to_vec(),
                    starts: (0..=count).map(|face| 3 * face).collect(),
                    numbers: (0..count).collect(),
                    is_mesh: !has_planes(mesh),
                })
            }
            _ => None,
        }
    }

    fn count(&self) -> usize {
        self.numbers.len()
    }

    /// See [`ProjectedMesh::reference`].
    fn reference(&self, view: &View) -> f64 {
        let ends = (f64::INFINITY, f64::NEG_INFINITY);
        let (low, high) = self.depths.iter().fold(ends, |(low, high), depth| (low.min(*depth), high.max(*depth)));
        let middle = view.from_eye(0.5 * (low + high));
        if high - low < 0.5 * middle { middle } else { 0.0 }
    }

    /// Replaces `out` with the corners of a face.
    fn corners(&self, face: usize, out: &mut Vec<DVec2>) {
        let own = self.starts[face] as usize..self.starts[face + 1] as usize;
        out.clear();
        out.extend(self.corners[own].iter().map(|corner| self.points[*corner as usize]));
    }
}

fn bounds(points: &[DVec2]) -> [DVec2; 2] {
    let ends = (DVec2::INFINITY, DVec2::NEG_INFINITY);
    let (low, high) = points.iter().fold(ends, |(low, high), p| (low.min(*p), high.max(*p)));
    [low, high]
}

fn cells_of(rect: &PixelRect) -> impl Iterator<Item = (u32, u32)> + use<> {
    let PixelRect { min, max } = *rect;
    (min[1]..max[1]).flat_map(move |y| (min[0]..max[0]).map(move |x| (x, y)))
}

/// The widest gap between a convex polygon and a square that an axis shows, of those across their sides: none (not above
/// zero) where they touch, and never more than their distance, nor less than that by the square root of two.
fn gap(corners: &[DVec2], low: DVec2, size: f64) -> f64 {
    let [first, last] = bounds(corners);
    let beside = (low - last).max(first - low - size).max_element();
    let middle = low + 0.5 * size;
    let sides = (0..corners.len()).map(|i| corners[(i + 1) % corners.len()] - corners[i]);
    let across = sides.filter_map(|side| side.perp().try_normalize()).map(|axis| {
        let heights = corners.iter().map(|p| axis.dot(*p - middle));
        let (low, high) = heights.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), at| (l.min(at), h.max(at)));
        low.max(-high) - 0.5 * size * axis.abs().element_sum()
    });
    across.fold(beside, f64::max)
}

#[cfg(test)]
mod tests {
    use glam::Vec2;

    use super::*;
    use crate::view::{Anchor, Projection};

    const SQUARE: (DVec2, f64) = (DVec2::new(8.0, 8.0), 8.0);

    #[test]
    fn gaps_are_those_of_the_axes() {
        let gap = |corners: &[[f64; 2]]| {
            let corners: Vec<DVec2> = corners.iter().map(|p| DVec2::from_array(*p)).collect();
            gap(&corners, SQUARE.0, SQUARE.1)
        };
        assert!(gap(&[[9.0, 9.0], [10.0, 9.0], [9.0, 10.0]]) < 0.0);
        assert_eq!(gap(&[[0.0, 0.0], [5.0, 10.0], [0.0, 20.0]]), 3.0);
        // Its bounds overlap the square, it does not.
        let beside = gap(&[[4.0, 12.0], [4.0, 4.0], [12.0, 4.0]]);
        assert!(beside.abs() < 1e-12, "{beside}");
        assert!((gap(&[[3.0, 11.0], [3.0, 3.0], [11.0, 3.0]]) - 2.0_f64.sqrt()).abs() < 1e-12);
        // Seen edge on.
        assert!(gap(&[[3.0, 11.0], [11.0, 3.0], [7.0, 7.0]]) > 1.0);
        assert!(gap(&[[8.0, 16.0], [16.0, 8.0], [12.0, 12.0]]) < 0.0);
    }

    #[test]
    fn cells_list_what_touches_them() {
        // Two triangles: one over many cells, one within a cell.
        let points = [[1.0, 1.0], [30.0, 1.0], [1.0, 30.0], [20.0, 20.0], [21.0, 20.0], [20.0, 21.0]];
        let faces = Projected {
            points: points.map(DVec2::from_array).to_vec(),
            depths: vec![1.0; 6],
            corners: (0..6).collect(),
            starts: vec![0, 3, 6],
            numbers: vec![7, 9],
            is_mesh: false,
        };
        let cells = Cells::gather(&faces, 2, 8, PixelRect { min: [0, 0], max: [4, 4] });
        let lists: Vec<Vec<&[u32]>> = [[0, 0], [1, 0], [0, 1], [1, 1]].map(|tile| cells.of_tile(tile).collect()).into();
        assert_eq!(lists[0], [&[7][..]; 4]);
        assert_eq!(lists[1], [&[7][..], &[7], &[7], &[]]);
        assert_eq!(lists[2], [&[7][..], &[7], &[7], &[]]);
        assert_eq!(lists[3], [&[9][..], &[], &[], &[]]);
    }

    fn some_view() -> View {
        View {
            eye: DVec3::ZERO,
            right: DVec3::X,
            up: DVec3::Y,
            forward: DVec3::NEG_Z,
            projection: Projection::Perspective { tan_half_y: 0.5 },
            anchor: Anchor::default(),
            near: 0.1,
            far: 10.0,
            size: [64, 64],
        }
    }

    #[test]
    fn triangles_are_functions_of_the_point() {
        let points = [[10.0, 10.0], [30.0, 12.0], [14.0, 40.0], [35.0, 35.0]].map(DVec2::from_array);
        let depths = [2.0, 4.0, 3.0, 5.0];
        let triangles = [[0, 1, 2], [2, 1, 3]];
        let faces = Projected {
            points: points.to_vec(),
            depths: depths.to_vec(),
            corners: triangles.as_flattened().to_vec(),
            starts: vec![0, 3, 6],
            numbers: vec![0, 1],
            is_mesh: true,
        };
        let window = Window { min: [100, 200], size: [64, 64] };
        let mesh = ProjectedMesh::new(&faces, &triangles, &some_view(), &window);
        let value = |v: &[f32; 4], p: DVec2| f64::from(v[0]) * p.x + f64::from(v[1]) * p.y + f64::from(v[2]);
        for (vectors, corners) in mesh.vectors.chunks_exact(4).zip(triangles) {
            for (i, corner) in corners.map(|corner| corner as usize).into_iter().enumerate() {
                let p = points[corner] + DVec2::new(100.0, 200.0) - Vec2::from_array(mesh.origin).as_dvec2();
                // On two of the sides, and off the one across.
                assert!(value(&vectors[i], p).abs() < 1e-3 && value(&vectors[(i + 2) % 3], p).abs() < 1e-3);
                assert!(value(&vectors[(i + 1) % 3], p).abs() > 100.0);
                let start = DVec2::new(f64::from(vectors[0][3]), f64::from(vectors[1][3]));
                assert!((value(&vectors[3], p - start) - 1.0 / depths[corner]).abs() < 1e-6);
                assert!((f64::from(vectors[2][3])..=f64::from(vectors[3][3])).contains(&depths[corner]));
            }
        }
        // The side between them has the same numbers in both.
        let [a, b] = [mesh.vectors[1], mesh.vectors[4]];
        assert_eq!(a[..3], [-b[0], -b[1], -b[2]]);
    }
}
