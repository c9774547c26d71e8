//! Houses, a church and trees on the terrain: a few meshes, many nodes.

use std::f64::consts::TAU;

use glam::{DMat3, DVec2, DVec3, dvec2, dvec3};

use super::det;
use super::glb::{Glb, Look, Place};
use super::loft::lathe;
use super::mesh::Mesh;
use super::noise::Random;
use super::shapes::cuboid;
use super::terrain::Ground;

/// Where the village lies, in texture coordinates.
const CENTER: DVec2 = dvec2(0.46, 0.76);
const HOUSES: usize = 22;
const TREES: usize = 260;

pub fn build(glb: &mut Glb, ground: &Ground) {
    let site = flattest(ground);
    houses(glb, ground, site);
    trees(glb, ground, site);
}

/// The flattest dry spot near the wished-for centre.
fn flattest(ground: &Ground) -> DVec2 {
    let spots = (0..15 * 15).map(|i| CENTER + dvec2(f64::from(i % 15) - 7.0, f64::from(i / 15) - 7.0) * 0.012);
    let cost = |uv: DVec2| {
        let around = [dvec2(0.04, 0.0), dvec2(-0.04, 0.0), dvec2(0.0, 0.04), dvec2(0.0, -0.04), DVec2::ZERO];
        around
            .iter()
            .map(|d| ground.slope(uv + *d) + if ground.above_lake(uv + *d) < 0.02 { 2.0 } else { 0.0 })
            .sum::<f64>()
    };
    spots.min_by(|a, b| cost(*a).total_cmp(&cost(*b))).unwrap_or(CENTER)
}

fn houses(glb: &mut Glb, ground: &Ground, site: DVec2) {
    let walls = glb.material(Look::new("plaster", 0xef_e6d4, 0.0, 0.9));
    let tiles = glb.material(Look::new("tiles", 0xb0_4a36, 0.0, 0.8));
    let slate = glb.material(Look::new("slate", 0x46_505c, 0.0, 0.6));
    let body = cuboid(dvec3(0.0, 0.01, 0.0), dvec3(0.07, 0.06, 0.05));
    let house = glb.mesh_of("house", &[(&body, walls), (&roof(dvec3(0.084, 0.036, 0.066), 0.04), tiles)]);
    let barn = cuboid(dvec3(0.0, 0.005, 0.0), dvec3(0.1, 0.05, 0.05));
    let barn = glb.mesh_of("barn", &[(&barn, walls), (&roof(dvec3(0.112, 0.04, 0.066), 0.03), slate)]);
    let church = church(glb, walls, slate);
    let group = glb.node("village", Place::default());
    let at = |uv: DVec2| ground.point(uv);
    let middle = at(site);
    glb.node("church", Place::mesh(church).under(group).at(middle.x, middle.y, middle.z));
    let mut random = Random::new(5);
    let mut placed = vec![site];
    let mut tries = 0;
    while placed.len() <= HOUSES && tries < 4000 {
        tries += 1;
        let angle = random.range(0.0, TAU);
        let uv = site + dvec2(det::cos(angle), 0.8 * det::sin(angle)) * random.range(0.025, 0.12);
        let turn = det::rotation(DVec3::Y, random.range(-0.5, 0.5) + if random.unit() < 0.4 { 1.57 } else { 0.0 });
        let free = placed.iter().all(|other| (*other - uv).length() > 0.026);
        if free && ground.slope(uv) < 0.5 && ground.above_lake(uv) > 0.02 {
            let (p, index) = (at(uv), placed.len());
            let mesh = if index % 5 == 4 { barn } else { house };
            let place = Place::mesh(mesh).under(group).at(p.x, p.y, p.z).turned(turn);
            glb.node(&format!("house-{index}"), place);
            placed.push(uv);
        }
    }
}

/// A gable roof: a prism along x, its eaves at height `y`.
fn roof(size: DVec3, y: f64) -> Mesh {
    let (x, z) = (0.5 * size.x, 0.5 * size.z);
    let positions = vec![
        dvec3(-x, y, -z),
        dvec3(-x, y, z),
        dvec3(-x, y + size.y, 0.0),
        dvec3(x, y, -z),
        dvec3(x, y, z),
        dvec3(x, y + size.y, 0.0),
    ];
    let triangles = vec![[0, 1, 2], [3, 5, 4], [1, 4, 5], [1, 5, 2], [0, 2, 5], [0, 5, 3], [0, 3, 4], [0, 4, 1]];
    Mesh { positions, triangles, ..Mesh::default() }.shaded(10.0)
}

fn church(glb: &mut Glb, walls: usize, slate: usize) -> usize {
    let mut body = cuboid(dvec3(0.0, 0.02, 0.0), dvec3(0.15, 0.1, 0.07));
    body.join(cuboid(dvec3(-0.085, 0.08, 0.0), dvec3(0.055, 0.22, 0.055)));
    let mut cover = roof(dvec3(0.16, 0.06, 0.086), 0.07);
    let spire = lathe(&[(0.0, 0.19), (0.044, 0.19), (0.02, 0.24), (0.0, 0.33)], 4).shaded(20.0).upright();
    cover.join(spire.moved(det::rotation(DVec3::Y, std::f64::consts::FRAC_PI_4), dvec3(-0.085, 0.0, 0.0)));
    glb.mesh_of("church", &[(&body, walls), (&cover, slate)])
}

fn trees(glb: &mut Glb, ground: &Ground, site: DVec2) {
    let bark = glb.material(Look::new("bark", 0x5a_4030, 0.0, 0.95));
    let needles = glb.material(Look::new("needles", 0x2f_5a38, 0.0, 0.85));
    let leaves = glb.material(Look::new("leaves", 0x6c_8f3a, 0.0, 0.85));
    let trunk = lathe(&[(0.0, -0.03), (0.008, -0.03), (0.006, 0.04), (0.0, 0.04)], 6).shaded(60.0).upright();
    let crown =
        lathe(&[(0.0, 0.02), (0.03, 0.02), (0.014, 0.06), (0.022, 0.06), (0.0, 0.12)], 8).shaded(50.0).upright();
    let round =
        lathe(&[(0.0, 0.022), (0.022, 0.03), (0.03, 0.052), (0.02, 0.076), (0.0, 0.084)], 8).shaded(80.0).upright();
    let spruce = glb.mesh_of("spruce", &[(&trunk, bark), (&crown, needles)]);
    let birch = glb.mesh_of("birch", &[(&trunk, bark), (&round, leaves)]);
    let group = glb.node("trees", Place::default());
    let mut random = Random::new(9);
    let (mut count, mut tries) = (0, 0);
    while count < TREES && tries < 40_000 {
        tries += 1;
        let uv = dvec2(random.range(0.02, 0.98), random.range(0.02, 0.98));
        let scattered = ground.above_lake(uv) > 0.015 && ground.slope(uv) < 0.5 && random.unit() < 0.012;
        if (uv - site).length() > 0.09 && (ground.forest(uv) > 0.1 || scattered) {
            count += 1;
            let p = ground.point(uv);
            let mesh = if scattered || random.unit() < 0.2 { birch } else { spruce };
            let place = Place::mesh(mesh).under(group).at(p.x, p.y, p.z);
            let size = DVec3::splat(random.range(0.75, 1.25));
            glb.node(&format!("tree-{count}"), place.scaled(size).turned(yaw(&mut random)));
        }
    }
}

fn yaw(random: &mut Random) -> DMat3 {
    det::rotation(DVec3::Y, random.range(-3.0, 3.0))
}
