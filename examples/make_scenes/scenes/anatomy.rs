//! Where the joints of a right hand are. Fingers point to +y, the thumb to -x, the back of the hand to +z; one scene
//! unit is ten centimetres.

use glam::{DMat3, DVec3, dvec3};

use super::det;

/// Scene units in a centimetre.
pub const CM: f64 = 0.1;

/// A finger or the thumb: joints from the base of the metacarpal to the tip of the bone.
pub struct Digit {
    pub name: &'static str,
    /// Metacarpal base, then the proximal end of each phalanx, then the tip.
    pub joints: Vec<DVec3>,
    /// Radius of the skin at each joint, tip included; at the metacarpal base that of the palm.
    pub skin: Vec<f64>,
    /// Unit vector out of the back of the last phalanx.
    pub back: DVec3,
}

/// A finger's measures in centimetres and degrees.
struct Finger {
    name: &'static str,
    base: [f64; 3],
    knuckle: [f64; 3],
    /// Sideways lean, towards the little finger.
    lean: f64,
    phalanges: [f64; 3],
    bend: [f64; 3],
    skin: [f64; 5],
}

const FINGERS: [Finger; 4] = [
    Finger {
        name: "index",
        base: [-1.45, 2.6, 0.0],
        knuckle: [-2.6, 8.9, 0.2],
        lean: -11.0,
        phalanges: [4.4, 2.6, 2.0],
        bend: [9.0, 17.0, 11.0],
        skin: [1.12, 1.04, 0.95, 0.82, 0.66],
    },
    Finger {
        name: "middle",
        base: [-0.45, 2.6, 0.1],
        knuckle: [-0.65, 9.3, 0.32],
        lean: -3.0,
        phalanges: [4.9, 3.0, 2.1],
        bend: [12.0, 21.0, 13.0],
        skin: [1.12, 1.06, 0.97, 0.84, 0.68],
    },
    Finger {
        name: "ring",
        base: [0.55, 2.5, 0.1],
        knuckle: [1.2, 8.85, 0.22],
        lean: 7.0,
        phalanges: [4.5, 2.8, 2.1],
        bend: [15.0, 25.0, 14.0],
        skin: [1.12, 1.01, 0.92, 0.79, 0.64],
    },
    Finger {
        name: "little",
        base: [1.45, 2.35, 0.0],
        knuckle: [2.85, 7.9, 0.0],
        lean: 18.0,
        phalanges: [3.6, 2.1, 1.8],
        bend: [17.0, 25.0, 14.0],
        skin: [1.05, 0.9, 0.8, 0.7, 0.56],
    },
];

/// Thumb first, then the fingers from index to little.
pub fn digits() -> Vec<Digit> {
    let mut digits = vec![thumb()];
    digits.extend(FINGERS.iter().map(finger));
    digits
}

fn finger(finger: &Finger) -> Digit {
    let lean = det::radians(finger.lean);
    let mut direction = dvec3(det::sin(lean), det::cos(lean), 0.0);
    let across = dvec3(det::cos(lean), -det::sin(lean), 0.0);
    let mut joints = vec![centimetres(finger.base), centimetres(finger.knuckle)];
    for (length, bend) in finger.phalanges.iter().zip(finger.bend) {
        direction = det::rotation(across, -det::radians(bend)) * direction;
        joints.push(joints[joints.len() - 1] + direction * length * CM);
    }
    Digit { name: finger.name, joints, skin: finger.skin.map(|r| r * CM).to_vec(), back: across.cross(direction) }
}

fn thumb() -> Digit {
    let mut joints = vec![centimetres([-1.95, 2.2, -0.55])];
    let segments = [(4.4, [-0.64, 0.68, -0.34]), (3.4, [-0.57, 0.79, -0.2]), (2.6, [-0.36, 0.9, -0.24])];
    for (length, direction) in segments {
        let step = DVec3::from_array(direction).normalize() * length * CM;
        joints.push(joints[joints.len() - 1] + step);
    }
    let direction = (joints[3] - joints[2]).normalize();
    let outward = dvec3(-0.55, -0.1, 0.8);
    let back = (outward - direction * outward.dot(direction)).normalize();
    Digit { name: "thumb", joints, skin: [1.3, 1.2, 1.08, 0.82].map(|r| r * CM).to_vec(), back }
}

impl Digit {
    /// Rotation whose z runs along the last phalanx and whose y points out of its back.
    pub fn nail_frame(&self) -> DMat3 {
        let last = self.joints.len() - 1;
        let direction = (self.joints[last] - self.joints[last - 1]).normalize();
        det::frame(direction, self.back.cross(direction))
    }
}

/// The eight carpal bones: name, centre and half sizes in centimetres.
pub const CARPALS: [(&str, [f64; 3], [f64; 3]); 8] = [
    ("trapezium", [-1.75, 1.75, -0.4], [0.52, 0.46, 0.5]),
    ("trapezoid", [-0.92, 2.0, 0.0], [0.42, 0.44, 0.48]),
    ("capitate", [0.0, 1.78, 0.1], [0.46, 0.68, 0.52]),
    ("hamate", [0.98, 1.72, 0.0], [0.5, 0.58, 0.52]),
    ("scaphoid", [-1.15, 0.98, 0.0], [0.56, 0.5, 0.5]),
    ("lunate", [-0.22, 0.66, 0.05], [0.46, 0.44, 0.52]),
    ("triquetrum", [0.72, 0.78, 0.0], [0.46, 0.4, 0.46]),
    ("pisiform", [1.25, 0.95, -0.5], [0.34, 0.36, 0.32]),
];

pub fn centimetres(p: [f64; 3]) -> DVec3 {
    DVec3::from_array(p) * CM
}
