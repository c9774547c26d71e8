//! The eye and the rays of the pixels.

use glam::{DAffine3, DMat3, DVec3};

use crate::case::{Camera, Projection};

/// World space; the axes are orthonormal.
#[derive(Debug, Clone)]
pub struct View {
    pub eye: DVec3,
    pub right: DVec3,
    pub up: DVec3,
    pub forward: DVec3,
    pub is_perspective: bool,
    /// Half the picture's height: at depth 1 of a perspective, else at any.
    half_height: f64,
    size: [f64; 2],
    /// What is nearer or farther is not seen. Planes that are not given cut nothing in front of the eye.
    pub near: f64,
    pub far: f64,
}

/// A parameter along it is a depth.
#[derive(Debug, Clone, Copy)]
pub struct Ray {
    pub origin: DVec3,
    pub direction: DVec3,
}

impl Ray {
    pub fn at(&self, depth: f64) -> DVec3 {
        self.origin + self.direction * depth
    }
}

impl View {
    pub fn new(camera: &Camera) -> Self {
        let forward = (camera.target - camera.eye).normalize();
        let right = forward.cross(camera.up).normalize();
        let (is_perspective, half_height) = match camera.projection {
            Projection::Perspective(degrees) => (true, (0.5 * degrees.to_radians()).tan()),
            Projection::Orthographic(height) => (false, 0.5 * height),
        };
        let nearest = if is_perspective { 0.0 } else { f64::NEG_INFINITY };
        Self {
            eye: camera.eye,
            right,
            up: right.cross(forward),
            forward,
            is_perspective,
            half_height,
            size: camera.size.map(f64::from),
            near: camera.near.unwrap_or(nearest),
            far: camera.far.unwrap_or(f64::INFINITY),
        }
    }

    /// The ray through a point of the picture, in pixels from its top left corner.
    pub fn ray(&self, x: f64, y: f64) -> Ray {
        let [width, height] = self.size;
        let pixel = 2.0 * self.half_height / height;
        let aside = self.right * ((x - 0.5 * width) * pixel) + self.up * ((0.5 * height - y) * pixel);
        match self.is_perspective {
            true => Ray { origin: self.eye, direction: self.forward + aside },
            false => Ray { origin: self.eye + aside, direction: self.forward },
        }
    }

    /// Where a point appears, in pixels; it is in front of the eye.
    pub fn project(&self, p: DVec3) -> [f64; 2] {
        let from = p - self.eye;
        let depth = if self.is_perspective { from.dot(self.forward) } else { 1.0 };
        let pixel = 2.0 * self.half_height * depth / self.size[1];
        [0.5 * self.size[0] + from.dot(self.right) / pixel, 0.5 * self.size[1] - from.dot(self.up) / pixel]
    }

    /// The direction of the ray to a point, of any length.
    pub fn towards(&self, p: DVec3) -> DVec3 {
        if self.is_perspective { p - self.eye } else { self.forward }
    }

    pub fn is_in_front(&self, p: DVec3) -> bool {
        !self.is_perspective || (p - self.eye).dot(self.forward) > 0.0
    }

    /// World from the space of what is attached to the camera.
    pub fn world_from_camera(&self) -> DAffine3 {
        DAffine3::from_mat3_translation(DMat3::from_cols(self.right, self.up, -self.forward), self.eye)
    }
}
