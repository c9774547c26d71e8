//! Closed meshes around the origin, from an icosahedron whose faces are divided again and again.

use std::collections::HashMap;

use glam::DVec3;

/// How often the faces have been divided; each time they become four times as many.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ball {
    /// 20 faces.
    Icosahedron = 0,
    /// 20,480 faces.
    Smooth = 5,
    /// 81,920 faces.
    Finest = 6,
}

impl Ball {
    /// What specs call it.
    pub fn file(self) -> String {
        format!("ball-{}.glb", self as u32)
    }

    /// Points on the unit sphere, and triangles that are counter-clockwise seen from outside.
    pub fn mesh(self) -> (Vec<DVec3>, Vec<[u32; 3]>) {
        let (mut points, mut triangles) = icosahedron();
        for _ in 0..self as u32 {
            triangles = divided(&mut points, &triangles);
        }
        (points, triangles)
    }
}

fn divided(points: &mut Vec<DVec3>, triangles: &[[u32; 3]]) -> Vec<[u32; 3]> {
    let mut middles: HashMap<[u32; 2], u32> = HashMap::new();
    let mut middle = |a: u32, b: u32| {
        *middles.entry([a.min(b), a.max(b)]).or_insert_with(|| {
            points.push((points[a as usize] + points[b as usize]).normalize());
            points.len() as u32 - 1
        })
    };
    let four = |[a, b, c]: &[u32; 3]| {
        let [ab, bc, ca] = [middle(*a, *b), middle(*b, *c), middle(*c, *a)];
        [[*a, ab, ca], [*b, bc, ab], [*c, ca, bc], [ab, bc, ca]]
    };
    triangles.iter().flat_map(four).collect()
}

/// Corners of three golden rectangles, each across the next, and the triples of them that lie next to each other.
fn icosahedron() -> (Vec<DVec3>, Vec<[u32; 3]>) {
    let golden = 0.5 + 1.25_f64.sqrt();
    let corner = |i: usize| {
        let signed = |value: f64, bit: usize| if i >> bit & 1 == 0 { value } else { -value };
        let (long, short) = (signed(golden, 0), signed(1.0, 1));
        [DVec3::new(0.0, short, long), DVec3::new(short, long, 0.0), DVec3::new(long, 0.0, short)][i >> 2].normalize()
    };
    let points: Vec<DVec3> = (0..12).map(corner).collect();
    let near = |a: usize, b: usize| points[a].dot(points[b]) > 0.4;
    let triples = (0..12).flat_map(|a| (a + 1..12).flat_map(move |b| (b + 1..12).map(move |c| [a, b, c])));
    let triangles: Vec<[u32; 3]> = triples
        .filter(|[a, b, c]| near(*a, *b) && near(*b, *c) && near(*c, *a))
        .map(|[a, b, c]| {
            let outward = (points[b] - points[a]).cross(points[c] - points[a]).dot(points[a]) > 0.0;
            (if outward { [a, b, c] } else { [a, c, b] }).map(|i| i as u32)
        })
        .collect();
    assert_eq!(triangles.len(), 20, "an icosahedron");
    (points, triangles)
}
