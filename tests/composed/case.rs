//! A composition as plain data: a small scene, a camera, lenses and rules. The writers make files of it for the product; the
//! oracle reads it as it is.

use glam::{DQuat, DVec3};

/// sRGB and straight alpha, as a spec writes a colour.
pub type Color = [u8; 4];

#[derive(Debug, Clone)]
pub struct Case {
    /// The scene, then its alternates.
    pub models: Vec<Model>,
    /// Closed meshes that lenses are shaped by.
    pub solids: Vec<Model>,
    /// Patterns of `[scene] hide`.
    pub hide: Vec<String>,
    /// `backfaces = "as-material"`.
    pub cull: bool,
    pub camera: Camera,
    pub background: Color,
    pub lenses: Vec<Lens>,
    pub rules: Vec<Rule>,
}

#[derive(Debug, Clone)]
pub struct Model {
    /// Of the file, without its extension, and of the alternate.
    pub name: String,
    pub nodes: Vec<Node>,
    pub materials: Vec<Material>,
}

/// All its numbers are exact in f32, as a file stores them.
#[derive(Debug, Clone)]
pub struct Node {
    pub name: String,
    pub parent: Option<usize>,
    pub translation: DVec3,
    pub rotation: DQuat,
    pub scale: DVec3,
    pub primitives: Vec<Primitive>,
}

#[derive(Debug, Clone)]
pub struct Primitive {
    pub material: usize,
    pub triangles: Vec<[DVec3; 3]>,
}

#[derive(Debug, Clone)]
pub struct Material {
    pub name: String,
    /// Linear light and alpha; less than 1 goes with the alpha mode `BLEND`.
    pub color: [f64; 4],
    pub unlit: bool,
    pub double_sided: bool,
}

#[derive(Debug, Clone)]
pub struct Camera {
    pub eye: DVec3,
    pub target: DVec3,
    pub up: DVec3,
    pub projection: Projection,
    pub near: Option<f64>,
    pub far: Option<f64>,
    pub size: [u32; 2],
}

#[derive(Debug, Clone, Copy)]
pub enum Projection {
    /// Vertical field of view in degrees.
    Perspective(f64),
    /// Height of the picture in scene units.
    Orthographic(f64),
}

#[derive(Debug, Clone, Default)]
pub struct Patterns {
    pub nodes: Vec<String>,
    pub materials: Vec<String>,
}

impl Patterns {
    pub fn is_empty(&self) -> bool {
        self.nodes.is_empty() && self.materials.is_empty()
    }
}

#[derive(Debug, Clone)]
pub struct Lens {
    pub name: String,
    pub enabled: bool,
    pub shape: Shape,
    pub attach: Attach,
    pub translation: DVec3,
    pub rotation: Rotation,
    pub scale: DVec3,
    pub filters: Vec<Filter>,
    pub over: Vec<String>,
    pub under: Vec<String>,
    pub hides: Vec<String>,
    /// `overlap = "override"`.
    pub overrides: bool,
    pub priority: i64,
    pub by_object: bool,
    pub only: Patterns,
    pub except: Patterns,
    pub soft: f64,
    pub glass: bool,
}

#[derive(Debug, Clone)]
pub enum Attach {
    Scene,
    Camera,
    Node(String),
}

#[derive(Debug, Clone, Copy)]
pub enum Rotation {
    /// Degrees, intrinsic XYZ.
    Euler([f64; 3]),
    /// x, y, z, w of any length.
    Quaternion([f64; 4]),
}

#[derive(Debug, Clone)]
pub enum Shape {
    Sphere {
        center: DVec3,
        radius: f64,
    },
    Ellipsoid {
        center: DVec3,
        radii: DVec3,
        rotation: Rotation,
    },
    Box {
        center: DVec3,
        size: DVec3,
        rotation: Rotation,
    },
    Cylinder {
        from: DVec3,
        to: DVec3,
        radius: f64,
    },
    Cone {
        from: DVec3,
        to: DVec3,
        from_radius: f64,
        to_radius: f64,
    },
    Capsule {
        from: DVec3,
        to: DVec3,
        radius: f64,
    },
    /// Normals of any length.
    Polytope(Vec<[f64; 4]>),
    Hull(Vec<DVec3>),
    /// All that the normal points away from; with a thickness, what lies within half of it on both sides of the plane.
    Plane {
        point: DVec3,
        normal: DVec3,
        thickness: Option<f64>,
    },
    Flat {
        corners: Vec<DVec3>,
        depth: Option<f64>,
    },
    /// Into [`Case::solids`]; one node of it, or all.
    Mesh {
        solid: usize,
        node: Option<usize>,
        convex: Convex,
    },
    Compound(Compound, Vec<Shape>),
}

/// The key `convex` of a mesh lens.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Convex {
    AsItIs,
    Hull,
    Decompose,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Compound {
    Union,
    Intersection,
    /// The first less the others.
    Difference,
}

#[derive(Debug, Clone)]
pub enum Filter {
    Unlit(Option<Color>),
    Opacity(f64),
    Tint(Color, f64),
    Grayscale(f64),
    Invert(f64),
    /// Another base colour.
    Material(Color),
    Normals,
    /// With nothing between the wires, or all of the surface.
    Wireframe {
        width: f64,
        color: Option<Color>,
        filled: bool,
    },
    Erase(Patterns, Option<Cap>),
    /// Into [`Case::models`], from 1.
    ShowAlternate(usize),
    ShowNodes(Vec<String>),
    /// The centre in the shape's space.
    Magnify {
        factor: f64,
        center: Option<DVec3>,
    },
    Displace {
        nodes: Vec<String>,
        by: Displacement,
    },
}

/// What closes the solids that are cut.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Cap {
    Own,
    Color(Color),
    Hatch(Color),
}

#[derive(Debug, Clone, Copy)]
pub enum Displacement {
    Offset(DVec3),
    Explode(f64),
}

#[derive(Debug, Clone)]
pub struct Rule {
    pub when: When,
    pub filters: Vec<Filter>,
}

#[derive(Debug, Clone)]
pub enum When {
    /// A lens name or a pattern of some.
    Name(String),
    Not(Box<When>),
    And(Box<When>, Box<When>),
    Or(Box<When>, Box<When>),
}
