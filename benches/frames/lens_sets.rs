//! The lenses that the benchmarks of frames lay over the surface. All invert, none draws its surface.

use std::f64::consts::TAU;
use std::fmt::Write as _;

use glam::DVec3;
use lenspeel::plan::Plan;
use lenspeel::scene::Scene;
use lenspeel::spec::Spec;

use crate::balls::Ball;

/// Shapes in the words of a lens-spec file.
#[derive(Debug, Clone, Default)]
pub struct Lenses {
    pub shapes: Vec<String>,
    /// In the words of a lens-spec file.
    pub filter: String,
}

/// Everything around the lenses.
const HEAD: &str = "[scene]\nfile = \"surface.glb\"\nalternates = { deep = \"deep.glb\" }\n\
    [camera]\neye = [0, 1.5, 2.2]\ntarget = [0, 0, 0]\n";

impl Lenses {
    fn inverting(shapes: Vec<String>) -> Self {
        Self { shapes, filter: "\"invert\"".into() }
    }

    pub fn spec(&self, [width, height]: [u32; 2]) -> Spec {
        let mut text = format!("{HEAD}[image]\nsize = [{width}, {height}]\nsamples = 1\n");
        for (i, shape) in self.shapes.iter().enumerate() {
            let filter = &self.filter;
            let _ = write!(
                text,
                "[[lens]]\nname = \"l{i}\"\npriority = {i}\nglass = false\nfilters = [{filter}]\nshape.{shape}\n"
            );
        }
        Spec::parse(&text, "bench.toml", std::path::Path::new("")).expect("the specs of the benchmark are valid")
    }

    pub fn plan(&self, scene: &Scene, size: [u32; 2]) -> Plan {
        Plan::new(&self.spec(size), scene).expect("the specs of the benchmark are valid")
    }

    pub fn none() -> Self {
        Self::default()
    }

    /// One over a tenth of the picture.
    pub fn one_sphere() -> Self {
        Self::inverting(vec![sphere(DVec3::ZERO, 0.52)])
    }

    pub fn one_box() -> Self {
        Self::inverting(vec![cuboid(DVec3::ZERO, 0.8, 0.0)])
    }

    /// A ring in which each overlaps its neighbours.
    pub fn spheres() -> Self {
        Self::inverting(ring().map(|p| sphere(p, RADIUS)).to_vec())
    }

    /// The same ring of convex hulls with 200 faces.
    pub fn hulls() -> Self {
        Self::inverting(ring().map(|p| hull(p, RADIUS)).to_vec())
    }

    /// The same ring of turned boxes.
    pub fn boxes() -> Self {
        let ring = (0u32..).zip(ring());
        Self::inverting(ring.map(|(i, p)| cuboid(p, 1.6 * RADIUS, 20.0 * f64::from(i))).collect())
    }

    /// Eight groups of four.
    pub fn groups() -> Self {
        let around = |center: DVec3, i: usize| center + circle(i, 4, 0.07, 0.07);
        let place = |group: usize| circle(group, 8, 0.6, 0.5);
        Self::inverting((0..32).map(|i| sphere(around(place(i / 4), i), 0.15)).collect())
    }

    /// A grid of 256 that covers as much of the picture as [`Self::spheres`].
    pub fn small(scene: &Scene, size: [u32; 2]) -> Self {
        let place = |i: usize| DVec3::new(0.12 * ((i % 16) as f64 - 7.5), 0.0, 0.12 * ((i / 16) as f64 - 7.5));
        let grid = |radius| Self::inverting((0..256).map(|i| sphere(place(i), radius)).collect());
        covering(scene, size, coverage(&Self::spheres().plan(scene, size)), grid)
    }

    /// Eight that are apart from each other.
    pub fn apart() -> Self {
        let place = |i: usize| DVec3::new(0.45 * ((i % 4) as f64 - 1.5), 0.0, 0.6 * ((i / 4) as f64 - 0.5));
        Self::inverting((0..8).map(|i| sphere(place(i), 0.19)).collect())
    }

    /// Eight that all overlap, and cover as much of the picture as [`Self::apart`].
    pub fn heap(scene: &Scene, size: [u32; 2]) -> Self {
        let heap = |radius| Self::inverting((0..8).map(|i| sphere(circle(i, 8, 0.1, 0.1), radius)).collect());
        covering(scene, size, coverage(&Self::apart().plan(scene, size)), heap)
    }

    pub fn off_screen() -> Self {
        Self::inverting(vec![sphere(DVec3::new(8.0, 0.0, 0.0), 0.52)])
    }

    /// One closed mesh that covers as much of the picture as [`Self::one_sphere`].
    pub fn mesh(ball: Ball, scene: &Scene, size: [u32; 2]) -> Self {
        covering(scene, size, coverage(&Self::one_sphere().plan(scene, size)), |scale| Self::mesh_of(ball, scale))
    }

    pub fn mesh_of(ball: Ball, scale: f64) -> Self {
        let shape = format!("mesh = {{ file = \"{}\", convex = \"decompose\" }}\nscale = {scale:.6}", ball.file());
        Self::inverting(vec![shape])
    }

    /// A look at another model of a million triangles.
    pub fn x_ray() -> Self {
        Self { filter: "{ show = { alternate = \"deep\" } }".into(), ..Self::one_sphere() }
    }
}

const RADIUS: f64 = 0.4;

/// Place `i` of `count` on an ellipse around the middle of the surface.
fn circle(i: usize, count: usize, x: f64, z: f64) -> DVec3 {
    let angle = TAU * i as f64 / count as f64;
    DVec3::new(x * angle.cos(), 0.0, z * angle.sin())
}

fn ring() -> [DVec3; 8] {
    std::array::from_fn(|i| circle(i, 8, 0.45, 0.35))
}

fn list(p: DVec3) -> String {
    format!("[{:.6}, {:.6}, {:.6}]", p.x, p.y, p.z)
}

fn sphere(center: DVec3, radius: f64) -> String {
    format!("sphere = {{ center = {}, radius = {radius:.6} }}", list(center))
}

fn cuboid(center: DVec3, side: f64, degrees: f64) -> String {
    let size = list(DVec3::splat(side));
    format!("box = {{ center = {}, size = {size}, rotation = [0, {degrees}, 10] }}", list(center))
}

/// 102 points on a spiral over a sphere; no four lie in one plane, so their hull has 2 * 102 - 4 triangles.
fn hull(center: DVec3, radius: f64) -> String {
    let golden_angle = TAU * (1.0 - 1.0 / (0.5 + 1.25_f64.sqrt()));
    let point = |i: usize| {
        let (y, angle) = (1.0 - 2.0 * (i as f64 + 0.5) / 102.0, golden_angle * i as f64);
        let around = (1.0 - y * y).sqrt();
        list(center + radius * DVec3::new(around * angle.cos(), y, around * angle.sin()))
    };
    let points: Vec<String> = (0..102).map(point).collect();
    format!("hull = {{ points = [{}] }}", points.join(", "))
}

/// The share of the picture that lenses cover, from every fourth pixel of every fourth row.
pub fn coverage(plan: &Plan) -> f64 {
    let [width, height] = plan.view.size;
    let (mut covered, mut all, mut spans) = (0u32, 0u32, Vec::new());
    for y in (0..height).step_by(4) {
        for x in (0..width).step_by(4) {
            let ray = plan.view.ray(f64::from(x) + 0.5, f64::from(y) + 0.5);
            let mut is_hit = |solid: &lenspeel::lens::Solid| {
                spans.clear();
                solid.spans(&ray, &mut spans);
                spans.iter().any(|span| span.exit.t > plan.view.near)
            };
            covered += u32::from(plan.lenses.iter().flat_map(|lens| &lens.volume.parts).any(&mut is_hit));
            all += 1;
        }
    }
    f64::from(covered) / f64::from(all)
}

/// The lenses of the size at which they cover a share of the picture.
fn covering(scene: &Scene, size: [u32; 2], share: f64, lenses: impl Fn(f64) -> Lenses) -> Lenses {
    let (mut small, mut large) = (0.02, 1.0);
    for _ in 0..12 {
        let middle = 0.5 * (small + large);
        let covers = coverage(&lenses(middle).plan(scene, size));
        *(if covers < share { &mut small } else { &mut large }) = middle;
    }
    lenses(large)
}
