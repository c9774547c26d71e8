//! The camera: where the eye is, the ray of every pixel, and how depths are counted.
//!
//! Backends keep depths and positions in single precision, which has seven digits. Counted from an eye that is far from
//! what it sees (an orthographic camera's may be anywhere, a long lens's is) those digits would say how far off the eye is
//! and little else. So they are counted from the [`Anchor`]: a plane across the view at a depth where something is to be
//! seen. Rays start on it, points are taken relative to where it meets the view's axis, and a ray's parameter is the
//! depth behind it, negative before it. All of that is computed in double precision and rounded last. The depth from the
//! eye itself, which people are told, is [`View::from_eye`].

use glam::{DAffine3, DMat3, DVec2, DVec3};

use crate::scene::Aabb;

/// A resolved camera for one picture size. World space, scene units; `right`, `up`, `forward` are orthonormal.
#[derive(Debug, Clone, PartialEq)]
pub struct View {
    pub eye: DVec3,
    pub right: DVec3,
    pub up: DVec3,
    pub forward: DVec3,
    pub projection: Projection,
    /// Where depths are counted from.
    pub anchor: Anchor,
    /// Depths, like all that are not said to be from the eye.
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

/// What single precision is kept for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Anchor {
    /// Depth from the eye at which depths are zero.
    pub depth: f64,
    /// About how far from the anchor things are that are to be seen; positive.
    pub unit: f64,
    /// Between these depths lies all of the scene that may be seen.
    pub drawn: [f64; 2],
    pub merging: Merging,
}

impl Default for Anchor {
    /// The eye.
    fn default() -> Self {
        let drawn = [f64::NEG_INFINITY, f64::INFINITY];
        Self { depth: 0.0, unit: 1.0, drawn, merging: Merging::default() }
    }
}

/// Which boundaries on a ray are one (SEMANTICS 2.1). Both backends ask this with the same numbers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Merging {
    /// How far the eye of a perspective camera is before the anchor; none for an orthographic camera.
    pub eye: Option<f64>,
    /// The most that merges, in scene units.
    pub most: f64,
    /// How far across the view positions may be that share in a depth's rounding.
    pub across: f64,
}

impl Merging {
    /// Of the distance from the eye.
    pub const SHARE: f64 = 1e-5;
    /// What single precision resolves after the arithmetic of a boundary: some units in the last place.
    pub const RESOLVED: f64 = 1e-6;

    /// How far apart boundaries at a depth may be to be one.
    pub fn at(&self, depth: f64) -> f64 {
        let most = self.eye.map_or(self.most, |eye| (Self::SHARE * (eye + depth).abs()).min(self.most));
        most.max(Self::RESOLVED * (depth.abs() + self.across))
    }

    /// Whether a boundary is another one than the boundary at `first` before it.
    pub fn starts_boundary(&self, first: f64, depth: f64) -> bool {
        depth - first > self.at(first)
    }
}

impl Default for Merging {
    /// Of a perspective camera, depths from its eye, whatever is drawn.
    fn default() -> Self {
        Self { eye: Some(0.0), most: f64::INFINITY, across: 0.0 }
    }
}

/// A ray whose direction has length one along the camera's forward axis: its parameter is the depth.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Ray {
    pub origin: DVec3,
    pub direction: DVec3,
    /// Which boundaries on it are one.
    pub merging: Merging,
}

impl Ray {
    pub fn new(origin: DVec3, direction: DVec3) -> Self {
        Self { origin, direction, merging: Merging::default() }
    }

    pub fn at(&self, depth: f64) -> DVec3 {
        self.origin + self.direction * depth
    }

    /// The ray in another space; its parameter stays what it is.
    pub fn moved(&self, map: &DAffine3) -> Self {
        let (origin, direction) = (map.transform_point3(self.origin), map.transform_vector3(self.direction));
        Self { origin, direction, merging: self.merging }
    }
}

/// From so many times its distance on a triangle is very large.
const LARGE: f64 = 32.0;

/// See [`View::is_wide`].
const WIDE: f64 = 1e3;

impl View {
    pub fn is_perspective(&self) -> bool {
        matches!(self.projection, Projection::Perspective { .. })
    }

    /// Where the anchor meets the view's axis: positions in single precision are relative to it.
    pub fn origin(&self) -> DVec3 {
        self.eye + self.forward * self.anchor.depth
    }

    /// The distance from the eye, along the forward axis, of a depth.
    pub fn from_eye(&self, depth: f64) -> f64 {
        self.anchor.depth + depth
    }

    /// Whether the scene reaches so far beyond what an orthographic camera's picture shows that drawn depths, spread evenly over
    /// it, would not tell apart what is seen.
    pub fn is_wide(&self) -> bool {
        let [near, far] = self.anchor.drawn;
        !self.is_perspective() && far - near > WIDE * self.half_diagonal()
    }

    /// Whether a triangle, or what holds it, its corners relative to the origin, is very large for how far it is from there or, nearer than
    /// that, from what is to be seen: seen from nearby, single precision of its far corners is too coarse to say where it is.
    pub fn is_large(&self, corners: &[DVec3]) -> bool {
        let bounds = Aabb::from_points(corners.iter().copied());
        let distance = DVec3::ZERO.clamp(bounds.min, bounds.max).length();
        bounds.size().max_element() > (LARGE * distance).max(self.anchor.unit)
    }

    fn aspect(&self) -> f64 {
        f64::from(self.size[0]) / f64::from(self.size[1])
    }

    /// Half the picture's height per unit of depth (perspective) or at all (orthographic).
    pub fn half_height(&self) -> f64 {
        match self.projection {
            Projection::Perspective { tan_half_y } => tan_half_y,
            Projection::Orthographic { half_height } => half_height,
        }
    }

    /// Half the picture's diagonal, as [`View::half_height`].
    pub fn half_diagonal(&self) -> f64 {
        self.half_height() * self.aspect().hypot(1.0)
    }

    /// What a step across the picture, as [`View::pixel_steps`] has it, moves of a ray: of its origin, and of its direction.
    pub fn shares(&self) -> [f64; 2] {
        if self.is_perspective() { [self.anchor.depth, 1.0] } else { [1.0, 0.0] }
    }

    /// The ray through a point of the picture, in pixels from its top left corner.
    pub fn ray(&self, x: f64, y: f64) -> Ray {
        let half = self.half_height();
        let sx = (2.0 * x / f64::from(self.size[0]) - 1.0) * half * self.aspect();
        let sy = (1.0 - 2.0 * y / f64::from(self.size[1])) * half;
        let across = self.right * sx + self.up * sy;
        let [origin, direction] = self.shares();
        Ray {
            origin: self.origin() + across * origin,
            direction: self.forward + across * direction,
            merging: self.anchor.merging,
        }
    }

    /// Whether the picture has this column and row.
    pub fn has_pixel(&self, [x, y]: [u32; 2]) -> bool {
        x < self.size[0] && y < self.size[1]
    }

    /// The step across the picture by one pixel to the right and down: at depth 1 from the eye of a perspective camera.
    pub fn pixel_steps(&self) -> (DVec3, DVec3) {
        let step = 2.0 * self.half_height() / f64::from(self.size[1]);
        (self.right * step, -self.up * step)
    }

    /// Depth of a world point.
    pub fn depth(&self, p: DVec3) -> f64 {
        (p - self.eye).dot(self.forward) - self.anchor.depth
    }

    /// Where a world point appears, in pixels from the top left corner; `None` at or behind the eye of a perspective.
    pub fn project(&self, p: DVec3) -> Option<DVec2> {
        let offset = p - self.eye;
        let depth = offset.dot(self.forward);
        let scale = match self.projection {
            Projection::Perspective { tan_half_y } if depth > 0.0 => 1.0 / (depth * tan_half_y),
            Projection::Perspective { .. } => return None,
            Projection::Orthographic { half_height } => 1.0 / half_height,
        };
        let x = offset.dot(self.right) * scale / self.aspect();
        let y = offset.dot(self.up) * scale;
        Some(DVec2::new((x + 1.0) * 0.5 * f64::from(self.size[0]), (1.0 - y) * 0.5 * f64::from(self.size[1])))
    }

    /// World from the space of lenses attached to the camera: +x right, +y up, -z forward, origin at the eye.
    pub fn world_from_camera(&self) -> DAffine3 {
        DAffine3::from_mat3_translation(DMat3::from_cols(self.right, self.up, -self.forward), self.eye)
    }
}
