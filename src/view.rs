//! The camera: where the eye is, and the ray of every pixel.

use glam::{DAffine3, DMat3, DVec2, DVec3};

/// A resolved camera for one picture size. World space, scene units; `right`, `up`, `forward` are orthonormal.
#[derive(Debug, Clone, PartialEq)]
pub struct View {
    pub eye: DVec3,
    pub right: DVec3,
    pub up: DVec3,
    pub forward: DVec3,
    pub projection: Projection,
    /// Depths along `forward`; an orthographic camera's may be negative.
    pub near: f64,
    pub far: f64,
    /// Width and height in pixels.
    pub size: [u32; 2],
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Projection {
    /// Tangent of half the vertical field of view.
    Perspective { tan_half_y: f64 },
    /// Half the height of the picture in scene units.
    Orthographic { half_height: f64 },
}

/// A ray whose direction has length one along the camera's forward axis: its parameter is the depth.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Ray {
    pub origin: DVec3,
    pub direction: DVec3,
}

impl Ray {
    pub fn at(&self, depth: f64) -> DVec3 {
        self.origin + self.direction * depth
    }

    /// The ray in another space; its parameter stays what it is.
    pub fn moved(&self, map: &DAffine3) -> Self {
        Self { origin: map.transform_point3(self.origin), direction: map.transform_vector3(self.direction) }
    }
}

impl View {
    pub fn is_perspective(&self) -> bool {
        matches!(self.projection, Projection::Perspective { .. })
    }

    fn aspect(&self) -> f64 {
        f64::from(self.size[0]) / f64::from(self.size[1])
    }

    /// Half the picture's height per unit of depth (perspective) or at all (orthographic).
    fn half_height(&self) -> f64 {
        match self.projection {
            Projection::Perspective { tan_half_y } => tan_half_y,
            Projection::Orthographic { half_height } => half_height,
        }
    }

    /// The ray through a point of the picture, in pixels from its top left corner.
    pub fn ray(&self, x: f64, y: f64) -> Ray {
        let half = self.half_height();
        let sx = (2.0 * x / f64::from(self.size[0]) - 1.0) * half * self.aspect();
        let sy = (1.0 - 2.0 * y / f64::from(self.size[1])) * half;
        let across = self.right * sx + self.up * sy;
        match self.projection {
            Projection::Perspective { .. } => Ray { origin: self.eye, direction: self.forward + across },
            Projection::Orthographic { .. } => Ray { origin: self.eye + across, direction: self.forward },
        }
    }

    /// Whether the picture has this column and row.
    pub fn has_pixel(&self, [x, y]: [u32; 2]) -> bool {
        x < self.size[0] && y < self.size[1]
    }

    /// How a ray's origin (orthographic) or direction (perspective) changes by one pixel to the right and down.
    pub fn pixel_steps(&self) -> (DVec3, DVec3) {
        let step = 2.0 * self.half_height() / f64::from(self.size[1]);
        (self.right * step, -self.up * step)
    }

    /// Depth of a world point along the forward axis.
    pub fn depth(&self, p: DVec3) -> f64 {
        (p - self.eye).dot(self.forward)
    }

    /// Where a world point appears, in pixels from the top left corner; `None` at or behind the eye of a perspective.
    pub fn project(&self, p: DVec3) -> Option<DVec2> {
        let depth = self.depth(p);
        let scale = match self.projection {
            Projection::Perspective { tan_half_y } if depth > 0.0 => 1.0 / (depth * tan_half_y),
            Projection::Perspective { .. } => return None,
            Projection::Orthographic { half_height } => 1.0 / half_height,
        };
        let offset = p - self.eye;
        let x = offset.dot(self.right) * scale / self.aspect();
        let y = offset.dot(self.up) * scale;
        Some(DVec2::new((x + 1.0) * 0.5 * f64::from(self.size[0]), (1.0 - y) * 0.5 * f64::from(self.size[1])))
    }

    /// World from the space of lenses attached to the camera: +x right, +y up, -z forward, origin at the eye.
    pub fn world_from_camera(&self) -> DAffine3 {
        DAffine3::from_mat3_translation(DMat3::from_cols(self.right, self.up, -self.forward), self.eye)
    }
}
