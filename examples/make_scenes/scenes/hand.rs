//! The skin of the hand: one smooth implicit surface around the joints, and finger nails.

use glam::{DVec3, dvec3};

use super::anatomy::{CM, Digit, centimetres, digits};
use super::det::{self, smoothstep};
use super::glb::{Glb, Look, Place};
use super::mesh::Mesh;
use super::nets;
use super::noise::fbm;
use super::shapes::ball;

/// Where the forearm is cut off, in scene units.
const CUT: f64 = -0.64;
/// Side of the cubes of the polygonisation. With this one no cube is crossed by two sheets of skin, which would make
/// an edge of four triangles; a test watches it.
const CELL: f64 = 0.0228;

pub fn skin() -> Vec<u8> {
    let mut glb = Glb::default();
    let digits = digits();
    let flesh = glb.material(Look::new("skin", 0xff_ffff, 0.0, 0.55));
    let horn = glb.material(Look::new("nail", 0xee_c4b4, 0.0, 0.28));
    let root = glb.node("hand", Place::default());
    let mesh = glb.mesh("skin", &body(&digits), flesh);
    glb.node("skin", Place::mesh(mesh).under(root));
    let nail = glb.mesh("nail", &ball(1.0, 28, 14), horn);
    for digit in &digits {
        glb.node(&format!("nail-{}", digit.name), nail_place(digit, nail).under(root));
    }
    glb.finish()
}

fn nail_place(digit: &Digit, mesh: usize) -> Place {
    let last = digit.joints.len() - 1;
    let radius = digit.skin[last];
    let along = (digit.joints[last] - digit.joints[last - 1]).normalize();
    let at = digit.joints[last] - along * 0.5 * radius + digit.back * 0.66 * radius;
    let place = Place::mesh(mesh).at(at.x, at.y, at.z);
    place.turned(digit.nail_frame()).scaled(dvec3(0.74, 0.39, 0.9) * radius)
}

fn body(digits: &[Digit]) -> Mesh {
    let parts = Parts::new(digits);
    let mut mesh = nets::surface(dvec3(-0.93, -0.7, -0.95), dvec3(0.62, 1.98, 0.32), CELL, |p| parts.distance(p));
    mesh.colors = mesh.positions.iter().zip(&mesh.normals).map(|(p, n)| color(digits, *p, *n)).collect();
    mesh
}

/// Two spheres and all between them.
struct RoundCone {
    a: DVec3,
    b: DVec3,
    ra: f64,
    rb: f64,
}

/// A cone in centimetres.
fn cone(a: [f64; 3], ra: f64, b: [f64; 3], rb: f64) -> RoundCone {
    RoundCone { a: centimetres(a), b: centimetres(b), ra: ra * CM, rb: rb * CM }
}

impl RoundCone {
    /// After Quilez, "distance functions": the signed distance of a round cone.
    fn distance(&self, p: DVec3) -> f64 {
        let (axis, to) = (self.b - self.a, p - self.a);
        let shrink = self.ra - self.rb;
        let length2 = axis.length_squared();
        let slant2 = length2 - shrink * shrink;
        let along = to.dot(axis);
        let beyond = along - length2;
        let across2 = (to * length2 - axis * along).length_squared();
        let along2 = along * along * length2;
        let beyond2 = beyond * beyond * length2;
        let k = shrink.signum() * shrink * shrink * across2;
        if beyond.signum() * slant2 * beyond2 > k {
            return (across2 + beyond2).sqrt() / length2 - self.rb;
        }
        if along.signum() * slant2 * along2 < k {
            return (across2 + along2).sqrt() / length2 - self.ra;
        }
        ((across2 * slant2 / length2).sqrt() + along * shrink) / length2 - self.ra
    }
}

/// What the skin wraps, in groups that blend within themselves and with each other.
struct Parts {
    fingers: Vec<Vec<RoundCone>>,
    palm: Vec<RoundCone>,
    wrist: Vec<RoundCone>,
    tendons: Vec<RoundCone>,
}

impl Parts {
    fn new(digits: &[Digit]) -> Self {
        let fingers = digits.iter().map(phalanges).collect();
        let mut palm: Vec<_> = digits[1..].iter().map(metacarpal).collect();
        palm.extend([
            // The ball of the thumb, the edge of the hand, and the web between thumb and index.
            cone([-1.5, 1.7, -0.75], 1.15, [-3.6, 4.5, -1.55], 1.3),
            cone([1.75, 1.6, -0.45], 1.15, [2.75, 6.7, -0.4], 1.05),
            cone([-2.2, 3.4, -0.7], 0.9, [-2.7, 6.4, -0.3], 0.75),
            cone([-0.2, 2.4, -0.3], 1.2, [0.2, 6.8, -0.2], 1.1),
        ]);
        let wrist = vec![
            cone([-1.1, 1.2, 0.0], 1.35, [-1.55, -8.0, 0.0], 1.95),
            cone([1.1, 1.2, 0.0], 1.3, [1.45, -8.0, 0.0], 1.85),
            cone([0.0, 1.0, 0.0], 1.5, [0.0, -8.0, 0.0], 2.35),
        ];
        let tendons = digits[1..].iter().map(|digit| tendon(digit.joints[1])).collect();
        Self { fingers, palm, wrist, tendons }
    }

    fn distance(&self, p: DVec3) -> f64 {
        let group = |cones: &[RoundCone], k: f64| cones.iter().fold(9.0, |d, c| smooth_min(d, c.distance(p), k));
        let fingers = self.fingers.iter().fold(9.0, |d, finger| smooth_min(d, group(finger, 0.15 * CM), 0.7 * CM));
        let palm = smooth_min(group(&self.palm, 0.9 * CM), group(&self.wrist, 0.8 * CM), 2.2 * CM);
        let ridged = smooth_min(palm, group(&self.tendons, 0.1 * CM), 0.7 * CM);
        let hand = smooth_min(ridged, fingers, 0.75 * CM);
        -smooth_min(-hand, p.y - CUT, 0.5 * CM)
    }
}

/// The fleshy part of a finger: its phalanges with slightly fuller joints; for the thumb its metacarpal too.
fn phalanges(digit: &Digit) -> Vec<RoundCone> {
    let first = if digit.joints.len() == 4 { 0 } else { 1 };
    let last = digit.joints.len() - 1;
    let tip = digit.joints[last] - (digit.joints[last] - digit.joints[last - 1]).normalize() * 0.25 * digit.skin[last];
    let end = |k: usize| if k == last { tip } else { digit.joints[k] };
    let mut cones = Vec::new();
    for k in first..last {
        let (a, b) = (digit.joints[k], end(k + 1));
        let middle = a.lerp(b, 0.5);
        let slim = 0.985 * 0.5 * (digit.skin[k] + digit.skin[k + 1]);
        cones.push(RoundCone { a, b: middle, ra: digit.skin[k], rb: slim });
        cones.push(RoundCone { a: middle, b, ra: slim, rb: digit.skin[k + 1] });
    }
    cones
}

fn metacarpal(digit: &Digit) -> RoundCone {
    let down = DVec3::NEG_Z * 0.18 * CM;
    RoundCone { a: digit.joints[0] + down, b: digit.joints[1] + down, ra: digit.skin[0], rb: 1.02 * digit.skin[1] }
}

/// The faint ridge of a tendon on the back of the hand, which ends in the knuckle.
fn tendon(knuckle: DVec3) -> RoundCone {
    let rise = DVec3::Z * 0.5 * CM;
    let wrist = dvec3(0.25 * knuckle.x, 0.22, 0.0) + rise;
    RoundCone { a: wrist, b: knuckle + rise, ra: 0.15 * CM, rb: 0.5 * CM }
}

fn smooth_min(a: f64, b: f64, k: f64) -> f64 {
    let h = (k - (a - b).abs()).max(0.0) / k;
    a.min(b) - h * h * h * k / 6.0
}

/// Skin tone: paler on the palm side, redder at knuckles and tips, a little mottled.
fn color(digits: &[Digit], p: DVec3, normal: DVec3) -> [u8; 4] {
    let palm = smoothstep(0.1, 0.8, -normal.z);
    let mut warm = 0.0_f64;
    for digit in digits {
        for (joint, skin) in digit.joints.iter().zip(&digit.skin).skip(1) {
            warm = warm.max(1.0 - smoothstep(0.7, 1.9, (p - *joint).length() / skin));
        }
    }
    let mottle = 0.5 + 0.5 * fbm(3, p * 9.0, 3);
    let [base, pale, red] = [0xdc_a88c, 0xe9_bfa6, 0xcf_8672].map(det::rgb);
    let mix = |i: usize| {
        let tone = det::lerp(f64::from(base[i]), f64::from(pale[i]), palm);
        det::lerp(tone, f64::from(red[i]), 0.5 * warm + 0.22 * mottle)
    };
    let byte = |i: usize| (mix(i) * 255.0).round().clamp(0.0, 255.0) as u8;
    [byte(0), byte(1), byte(2), 255]
}
