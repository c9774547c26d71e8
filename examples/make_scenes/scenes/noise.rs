//! Pseudo-random numbers and gradient-free value noise in three dimensions.

use glam::DVec3;

/// SplitMix64: a sequence fixed by its seed.
pub struct Random(u64);

impl Random {
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// Uniform in 0..1.
    pub fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        to_unit(mix(self.0))
    }

    pub fn range(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }
}

fn mix(mut z: u64) -> u64 {
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

fn to_unit(bits: u64) -> f64 {
    (bits >> 11) as f64 / (1u64 << 53) as f64
}

fn lattice(seed: u64, x: i64, y: i64, z: i64) -> f64 {
    let packed = (x as u64).wrapping_mul(0x8da6_b343)
        ^ (y as u64).wrapping_mul(0xd816_3841_1f35)
        ^ (z as u64).wrapping_mul(0xcb1a_b31f_77a9_0d31);
    to_unit(mix(packed.wrapping_add(mix(seed)))) * 2.0 - 1.0
}

/// Smooth noise in -1..1 with features about one unit wide.
pub fn value(seed: u64, p: DVec3) -> f64 {
    let cell = p.floor();
    let f = p - cell;
    let w = f * f * f * (f * (f * 6.0 - 15.0) + 10.0);
    let [x, y, z] = cell.to_array().map(|c| c as i64);
    let along_x = |dy: i64, dz: i64| {
        let a = lattice(seed, x, y + dy, z + dz);
        a + (lattice(seed, x + 1, y + dy, z + dz) - a) * w.x
    };
    let along_y = |dz: i64| {
        let a = along_x(0, dz);
        a + (along_x(1, dz) - a) * w.y
    };
    let a = along_y(0);
    a + (along_y(1) - a) * w.z
}

/// Fractal sum of `octaves` noises, each twice as fine and half as strong; about -1..1.
pub fn fbm(seed: u64, p: DVec3, octaves: u32) -> f64 {
    octave_sum(seed, p, octaves, |n| n)
}

/// Fractal sum with sharp crests at 1: mountain ridges, lightning, veins. About 0..1.
pub fn ridged(seed: u64, p: DVec3, octaves: u32) -> f64 {
    octave_sum(seed, p, octaves, |n| (1.0 - n.abs() * 1.6).max(0.0))
}

fn octave_sum(seed: u64, p: DVec3, octaves: u32, shape: impl Fn(f64) -> f64) -> f64 {
    let (mut sum, mut weights, mut weight, mut q) = (0.0, 0.0, 1.0, p);
    for octave in 0..u64::from(octaves) {
        sum += weight * shape(value(seed + octave, q));
        weights += weight;
        weight *= 0.5;
        q = q * 2.03 + DVec3::new(17.3, 5.1, 9.7);
    }
    sum / weights
}
