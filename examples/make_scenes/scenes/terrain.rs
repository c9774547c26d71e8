//! A worn mountain valley cut out as a block, with a lake, a village and trees; one map as a satellite sees it and a
//! registered one of the rock below. x and z run from -2 to 2, y is up.

use glam::{DVec2, DVec3, dvec2, dvec3};

use super::Generated;
use super::det::{self, smoothstep};
use super::erosion::Heights;
use super::glb::{Glb, Look, Place, Sampling};
use super::mesh::Mesh;
use super::noise::{fbm, ridged, value};
use super::paint::{self, Paint, mix, paint};
use super::shapes::bevelled_box;
use super::village;

/// Samples along a side of the ground.
const SIZE: usize = 176;
/// Side length in scene units.
const SIDE: f64 = 4.0;
const BASE: f64 = -0.55;
const LAKE: f64 = 0.128;

/// The ground: heights in scene units, and how much water runs where.
pub struct Ground {
    heights: Heights,
    flow: Heights,
}

pub fn terrain() -> Vec<Generated> {
    let ground = Ground::new();
    let geology = paint::png(paint::rgb(768, 768, |u, v| ground.geology(dvec2(u, v))));
    vec![
        Generated { name: "terrain.glb", bytes: file(&ground) },
        Generated { name: "terrain-geology.png", bytes: geology },
    ]
}

fn file(ground: &Ground) -> Vec<u8> {
    let mut glb = Glb::default();
    let map = paint::jpeg(&paint::rgb(1024, 1024, |u, v| ground.satellite(dvec2(u, v))), 90);
    let map = glb.texture("satellite", &map, Sampling::SMOOTH);
    let surface = glb.material(Look::new("ground", 0xff_ffff, 0.0, 0.9).textured(map));
    let earth = glb.material(Look::new("earth", 0x6b_5240, 0.0, 0.95));
    let water = glb.material(Look::new("water", 0x0e_62a4, 0.0, 0.18).blended(0.8));
    let plinth = glb.material(Look::new("plinth", 0x2b_2e33, 0.0, 0.55));
    let block = glb.mesh_of("terrain", &[(&ground.surface(), surface), (&ground.skirt(), earth)]);
    glb.node("terrain", Place::mesh(block));
    let depth = LAKE - BASE - 0.1;
    let lake = super::shapes::cuboid(dvec3(0.0, LAKE - 0.5 * depth, 0.0), dvec3(SIDE - 0.004, depth, SIDE - 0.004));
    let lake = glb.mesh("lake", &lake, water);
    glb.node("lake", Place::mesh(lake));
    let foot = glb.mesh("plinth", &bevelled_box(dvec3(SIDE + 0.24, 0.14, SIDE + 0.24), 0.05), plinth);
    // A hair below the block: coplanar faces would flicker where a lens bares both.
    glb.node("plinth", Place::mesh(foot).at(0.0, BASE - 0.075, 0.0));
    village::build(&mut glb, ground);
    glb.finish()
}

impl Ground {
    fn new() -> Self {
        let mut heights = Heights::from_fn(SIZE, |x, y| raw(dvec2(x as f64, y as f64) / (SIZE - 1) as f64));
        // Rain cuts gullies and smoothing wears their sides down, in turns.
        let mut flow = vec![0.0; SIZE * SIZE];
        for seed in 0..4 {
            let passed = heights.rain(14_000, seed);
            flow.iter_mut().zip(passed).for_each(|(sum, drops)| *sum += drops);
            heights.smooth(0.45);
        }
        // From grid steps to scene units.
        let step = SIDE / (SIZE - 1) as f64;
        heights.data.iter_mut().for_each(|h| *h = deepened(*h * step));
        let mut flow = Heights { size: SIZE, data: flow };
        (0..2).for_each(|_| flow.smooth(0.6));
        Self { heights, flow }
    }

    /// Height in scene units at texture coordinates.
    pub fn height(&self, uv: DVec2) -> f64 {
        self.heights.sample(uv * (SIZE - 1) as f64)
    }

    /// Rise over run.
    pub fn slope(&self, uv: DVec2) -> f64 {
        self.heights.gradient(uv * (SIZE - 1) as f64).length() * (SIZE - 1) as f64 / SIDE
    }

    /// The point of the ground above texture coordinates.
    pub fn point(&self, uv: DVec2) -> DVec3 {
        dvec3((uv.x - 0.5) * SIDE, self.height(uv), (uv.y - 0.5) * SIDE)
    }

    /// 0 at the water's edge and below, growing with the height above it.
    pub fn above_lake(&self, uv: DVec2) -> f64 {
        self.height(uv) - LAKE
    }

    fn vertex(&self, x: usize, y: usize) -> (DVec3, DVec2) {
        let uv = dvec2(x as f64, y as f64) / (SIZE - 1) as f64;
        (dvec3((uv.x - 0.5) * SIDE, self.heights.at(x, y), (uv.y - 0.5) * SIDE), uv)
    }

    fn surface(&self) -> Mesh {
        let mut mesh = Mesh::default();
        let step = SIDE / (SIZE - 1) as f64;
        for (x, y) in (0..SIZE * SIZE).map(|i| (i % SIZE, i / SIZE)) {
            let (position, uv) = self.vertex(x, y);
            let run = |a: f64, b: f64| (a - b) / (2.0 * step);
            let dx = run(self.heights.at(x + 1, y), self.heights.at(x.saturating_sub(1), y));
            let dz = run(self.heights.at(x, y + 1), self.heights.at(x, y.saturating_sub(1)));
            mesh.positions.push(position);
            mesh.normals.push(dvec3(-dx, 1.0, -dz).normalize());
            mesh.uv.push(uv);
        }
        let at = |x: usize, y: usize| (y * SIZE + x) as u32;
        for (x, y) in (0..(SIZE - 1) * (SIZE - 1)).map(|i| (i % (SIZE - 1), i / (SIZE - 1))) {
            let [a, b, c, d] = [at(x, y), at(x + 1, y), at(x + 1, y + 1), at(x, y + 1)];
            mesh.triangles.extend([[a, d, c], [a, c, b]]);
        }
        mesh
    }

    /// Walls down from the rim and the floor, which close the block.
    fn skirt(&self) -> Mesh {
        let last = SIZE - 1;
        let along = 0..SIZE;
        let sides: [(Vec<(usize, usize)>, DVec3); 4] = [
            (along.clone().map(|x| (x, last)).collect(), DVec3::Z),
            (along.clone().map(|y| (last, last - y)).collect(), DVec3::X),
            (along.clone().map(|x| (last - x, 0)).collect(), DVec3::NEG_Z),
            (along.map(|y| (0, y)).collect(), DVec3::NEG_X),
        ];
        let mut mesh = Mesh::default();
        for (rim, normal) in sides {
            let first = mesh.positions.len() as u32;
            for (x, y) in rim {
                let top = self.vertex(x, y).0;
                mesh.positions.extend([top, top.with_y(BASE)]);
                mesh.normals.extend([normal; 2]);
            }
            let columns = (0..last as u32).map(|i| first + 2 * i);
            mesh.triangles.extend(columns.flat_map(|i| [[i, i + 1, i + 3], [i, i + 3, i + 2]]));
        }
        self.floor(&mut mesh);
        mesh
    }

    /// The underside, with a vertex for each one of the walls' feet so that no crack opens.
    fn floor(&self, mesh: &mut Mesh) {
        let feet: Vec<DVec3> = mesh.positions.iter().skip(1).step_by(2).copied().collect();
        let first = mesh.positions.len() as u32;
        let count = feet.len() as u32;
        mesh.positions.extend(feet);
        mesh.positions.push(dvec3(0.0, BASE, 0.0));
        mesh.normals.extend(vec![DVec3::NEG_Y; count as usize + 1]);
        let fan = (0..count).map(|i| [first + count, first + (i + 1) % count, first + i]);
        // Consecutive sides share their corner: no triangle there.
        let real: Vec<_> = fan.filter(|t| mesh.positions[t[1] as usize] != mesh.positions[t[2] as usize]).collect();
        mesh.triangles.extend(real);
    }

    fn satellite(&self, uv: DVec2) -> Paint {
        let p = dvec3(uv.x, 0.0, uv.y);
        let (height, slope) = (self.height(uv), self.slope(uv));
        let grain = fbm(20, p * 38.0, 4);
        let meadow = mix(paint(0x6f_8f45), paint(0x93_a05a), smoothstep(-0.3, 0.4, fbm(21, p * 9.0, 4)));
        let wood = mix(paint(0x2c_4a2b), paint(0x3d_5e34), smoothstep(-0.5, 0.5, value(22, p * 160.0)));
        let forest = smoothstep(0.02, 0.16, self.forest(uv));
        let green = mix(meadow, wood, forest);
        let alpine = mix(green, paint(0x9a_9468), smoothstep(0.52, 0.7, height + 0.08 * grain));
        let rock = mix(paint(0x7b_7168), paint(0x9b_9086), smoothstep(-0.4, 0.4, grain));
        let bare = mix(alpine, rock, smoothstep(0.75, 1.15, slope + 0.35 * grain + 0.25 * height));
        let snow = smoothstep(0.86, 1.0, height + 0.12 * grain - 0.12 * (slope - 0.9));
        let snowed = mix(bare, paint(0xf1_f4f8), snow);
        let stream = smoothstep(45.0, 120.0, self.flow.sample(uv * (SIZE - 1) as f64)) * (1.0 - snow);
        let wet = mix(snowed, paint(0x5f_8f9a), 0.5 * stream);
        let shore = 1.0 - smoothstep(0.006, 0.03, height - LAKE);
        mix(wet, paint(0xbf_ad84), 0.85 * shore)
    }

    /// Where woods stand: positive inside.
    pub fn forest(&self, uv: DVec2) -> f64 {
        let p = dvec3(uv.x, 0.0, uv.y);
        let height = self.above_lake(uv);
        let belt = smoothstep(0.03, 0.12, height) * (1.0 - smoothstep(0.38, 0.6, height));
        let steep = smoothstep(0.9, 1.3, self.slope(uv));
        belt * (0.12 + fbm(30, p * 5.0, 4)) - 0.4 * steep - 0.5 * (1.0 - belt)
    }

    /// Folded strata, cut by the relief, an intrusion with its contact, faults, and the drainage lines.
    fn geology(&self, uv: DVec2) -> Paint {
        let p = dvec3(uv.x, 0.0, uv.y);
        let height = self.height(uv);
        let bend = fbm(60, p * 2.2, 4);
        let fault = uv.x * 0.8 - uv.y * 0.6 + 0.05 * fbm(61, p * 4.0, 3) - 0.08;
        let throw = if fault > 0.0 { 0.32 } else { 0.0 };
        let depth = 3.1 * height + 1.6 * bend + 2.4 * uv.y + throw * 3.0;
        let bands: [u32; 7] = [0xe8_d9a0, 0xc8_b06a, 0x8f_b08c, 0x5f_8f8a, 0xd0_8a5c, 0xa8_5a4c, 0xe0_b8a0];
        let level = (depth * 2.2).floor();
        let band = paint(bands[(level as i64).rem_euclid(7) as usize]);
        let within = depth * 2.2 - level;
        let lined = paint::scale(band, if within < 0.09 { 0.62 } else { 0.97 + 0.06 * within });
        let granite = (uv - dvec2(0.36, 0.34)).length() + 0.08 * bend;
        let speckle = if value(62, p * 190.0) > 0.35 { 0xb0_5f74 } else { 0xd2_8c9c };
        let contact = mix(lined, paint(0x7a_3448), 1.0 - smoothstep(0.015, 0.02, (granite - 0.2).abs()));
        let rock = if granite < 0.2 { paint(speckle) } else { contact };
        let cracked = mix(rock, paint(0x1c_1c22), 1.0 - smoothstep(0.004, 0.007, fault.abs()));
        let gravel = 1.0 - smoothstep(0.012, 0.03, height - LAKE);
        mix(cracked, paint(0xf4_efd2), gravel)
    }
}

/// Rain levels the basin; below the lake's surface the ground is drawn down again.
fn deepened(height: f64) -> f64 {
    let deep = if height < LAKE { LAKE - 3.2 * (LAKE - height) } else { height };
    (deep * 1e5).round() / 1e5
}

/// The land before the rain, in grid steps: a massif behind, a valley that winds to the front, hills.
fn raw(uv: DVec2) -> f64 {
    let p = dvec3(uv.x, 0.3, uv.y);
    let bend = fbm(1, p * 2.0, 3);
    let valley = (uv.x - 0.62 - 0.16 * det::sin(5.0 * uv.y + 0.4) - 0.08 * bend).abs();
    let basin = (uv - dvec2(0.66, 0.74)).length();
    let massif = ridged(2, p * 2.6 + DVec3::splat(0.2 * bend), 6);
    let hills = 0.5 + 0.5 * fbm(3, p * 5.0, 5);
    let rise = smoothstep(0.04, 0.46, valley) * (0.42 + 0.58 * (1.0 - uv.y));
    let back = 0.55 * (1.0 - smoothstep(0.05, 0.75, uv.y));
    let height = 0.12 + 0.1 * hills + rise * (0.18 + 0.75 * massif) + back * massif * 0.8 + 0.1 * back;
    let sunk = height - 0.24 * (1.0 - smoothstep(0.06, 0.27, basin));
    sunk * (SIZE - 1) as f64 / SIDE
}
