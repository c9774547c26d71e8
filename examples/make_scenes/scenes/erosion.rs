//! Height grids and the wear of running water.

use glam::{DVec2, dvec2};

use super::noise::Random;

/// Square grid of heights; `size * size` samples, one unit apart.
pub struct Heights {
    pub size: usize,
    pub data: Vec<f64>,
}

/// How a drop of water works on the ground.
const INERTIA: f64 = 0.08;
const CAPACITY: f64 = 3.0;
const LEAST_SLOPE: f64 = 0.012;
const DEPOSIT: f64 = 0.15;
const ERODE: f64 = 0.12;
const EVAPORATE: f64 = 0.02;
const LIFE: usize = 48;

impl Heights {
    pub fn from_fn(size: usize, height: impl Fn(usize, usize) -> f64) -> Self {
        let data = (0..size * size).map(|i| height(i % size, i / size)).collect();
        Self { size, data }
    }

    pub fn at(&self, x: usize, y: usize) -> f64 {
        self.data[y.min(self.size - 1) * self.size + x.min(self.size - 1)]
    }

    /// Bilinear height at a point in grid units, clamped to the grid.
    pub fn sample(&self, p: DVec2) -> f64 {
        let (x, y, f) = self.cell(p);
        let row = |y: usize| self.at(x, y) * (1.0 - f.x) + self.at(x + 1, y) * f.x;
        row(y) * (1.0 - f.y) + row(y + 1) * f.y
    }

    pub fn gradient(&self, p: DVec2) -> DVec2 {
        let (dx, dy) = (dvec2(0.5, 0.0), dvec2(0.0, 0.5));
        dvec2(self.sample(p + dx) - self.sample(p - dx), self.sample(p + dy) - self.sample(p - dy))
    }

    fn cell(&self, p: DVec2) -> (usize, usize, DVec2) {
        let limit = (self.size - 1) as f64 - 1e-6;
        let p = p.clamp(DVec2::ZERO, DVec2::splat(limit));
        let corner = p.floor();
        (corner.x as usize, corner.y as usize, p - corner)
    }

    /// Spreads a change of height over the four samples around a point.
    fn add(&mut self, p: DVec2, amount: f64) {
        let (x, y, f) = self.cell(p);
        for (dx, dy, w) in
            [(0, 0, (1.0 - f.x) * (1.0 - f.y)), (1, 0, f.x * (1.0 - f.y)), (0, 1, (1.0 - f.x) * f.y), (1, 1, f.x * f.y)]
        {
            self.data[(y + dy) * self.size + x + dx] += amount * w;
        }
    }

    /// Lets `drops` drops of rain run downhill, each carrying soil along (Beyer 2015, "Implementation of a method
    /// for hydraulic erosion"). Returns how often water passed each sample.
    pub fn rain(&mut self, drops: usize, seed: u64) -> Vec<f64> {
        let mut random = Random::new(seed);
        let mut flow = vec![0.0; self.data.len()];
        let side = (self.size - 1) as f64;
        for _ in 0..drops {
            let start = dvec2(random.range(0.0, side), random.range(0.0, side));
            self.drop(start, &mut flow);
        }
        flow
    }

    fn drop(&mut self, start: DVec2, flow: &mut [f64]) {
        let (mut p, mut direction) = (start, DVec2::ZERO);
        let (mut speed, mut water, mut soil) = (1.0_f64, 1.0_f64, 0.0_f64);
        for _ in 0..LIFE {
            direction = (direction * INERTIA - self.gradient(p) * (1.0 - INERTIA)).normalize_or_zero();
            let next = p + direction;
            if direction == DVec2::ZERO || next.min_element() < 0.0 || next.max_element() > (self.size - 1) as f64 {
                return;
            }
            let (x, y, _) = self.cell(p);
            flow[y * self.size + x] += water;
            let rise = self.sample(next) - self.sample(p);
            let capacity = (-rise).max(LEAST_SLOPE) * speed * water * CAPACITY;
            let change = if rise > 0.0 {
                // A pit: fill it, but not above its rim.
                soil.min(rise)
            } else if soil > capacity {
                (soil - capacity) * DEPOSIT
            } else {
                -((capacity - soil) * ERODE).min(-rise)
            };
            soil -= change;
            self.add(p, change);
            speed = (speed * speed - rise * 4.0).max(0.01).sqrt().min(4.0);
            water *= 1.0 - EVAPORATE;
            p = next;
        }
    }

    /// Moves each sample towards the mean of its neighbours.
    pub fn smooth(&mut self, amount: f64) {
        let old = Heights { size: self.size, data: self.data.clone() };
        for y in 0..self.size {
            for x in 0..self.size {
                let around = old.at(x + 1, y)
                    + old.at(x.saturating_sub(1), y)
                    + old.at(x, y + 1)
                    + old.at(x, y.saturating_sub(1));
                self.data[y * self.size + x] += amount * (around / 4.0 - old.at(x, y));
            }
        }
    }
}
