//! The typed mirror of a lens-spec file (see `SPEC-FORMAT`). Lengths are scene units, angles degrees.
//!
//! A value of these types is syntactically right: types, ranges and names of keys have been checked.
//! What needs the models (node names, bounds) is checked when the scene is opened.

use crate::custom::Given;
use std::ops::Range;
use std::path::PathBuf;
use std::sync::Arc;

use super::{Color, Pattern, Rotation, Shape};

/// The text an error points into.
#[derive(Debug, Clone)]
pub struct Source {
    /// How messages name the file.
    pub name: String,
    /// The file, then on lines of their own what was set beside it.
    pub text: Arc<str>,
    /// Where its lines end.
    ends: Arc<[usize]>,
    /// Where each setting begins.
    settings: Arc<[usize]>,
}

/// How messages name a setting.
const SETTING: &str = "--set";

impl Source {
    pub fn new(name: impl Into<String>, text: impl Into<String>) -> Self {
        Self::with_settings(name, text, &[])
    }

    /// A file with settings (`KEY=VALUE`) that stand behind it.
    pub fn with_settings(name: impl Into<String>, text: impl Into<String>, settings: &[String]) -> Self {
        let mut all = text.into();
        let mut starts = Vec::new();
        for setting in settings {
            all.push('\n');
            starts.push(all.len());
            all += setting;
        }
        let ends = all.bytes().enumerate().filter(|(_, byte)| *byte == b'\n').map(|(at, _)| at).collect();
        Self { name: name.into(), text: all.into(), ends, settings: starts.into() }
    }

    /// The parts of the text: the file, then each setting.
    pub fn parts(&self) -> impl Iterator<Item = Range<usize>> {
        let starts = std::iter::once(0).chain(self.settings.iter().copied());
        let ends = self.settings.iter().map(|start| start - 1).chain([self.text.len()]);
        starts.zip(ends).map(|(start, end)| start..end)
    }

    /// The part that an offset lies in.
    pub fn part(&self, offset: usize) -> Range<usize> {
        self.parts().find(|part| offset <= part.end).unwrap_or(0..self.text.len())
    }

    /// How messages name the part that an offset lies in.
    pub fn part_name(&self, offset: usize) -> &str {
        if self.part(offset).start == 0 { &self.name } else { SETTING }
    }

    /// 1-based line of a byte offset, in its part.
    pub fn line(&self, offset: usize) -> usize {
        let before = |place: usize| self.ends.partition_point(|end| *end < place);
        1 + before(offset) - before(self.part(offset).start)
    }

    /// The same as words: "line 3", or the setting.
    pub fn spot(&self, offset: usize) -> String {
        match self.part(offset).start {
            0 => format!("line {}", self.line(offset)),
            _ => self.place(offset),
        }
    }

    /// `file:line` of a byte offset; a setting is short enough to be told whole.
    pub fn place(&self, offset: usize) -> String {
        let part = self.part(offset);
        match part.start {
            0 => format!("{}:{}", self.name, self.line(offset)),
            _ => format!("{SETTING} {}", &self.text[part]),
        }
    }
}

/// A value and the bytes of the file that declare it.
#[derive(Debug, Clone, PartialEq)]
pub struct At<T> {
    pub value: T,
    pub span: Range<usize>,
}

impl<T> At<T> {
    pub fn new(value: T, span: Range<usize>) -> Self {
        Self { value, span }
    }
}

/// A whole lens-spec file.
#[derive(Debug, Clone)]
pub struct Spec {
    pub source: Source,
    pub scene: SceneSpec,
    pub camera: Option<At<CameraSpec>>,
    pub image: ImageSpec,
    pub light: Option<LightSpec>,
    /// In file order.
    pub lenses: Vec<LensSpec>,
    pub overlaps: Vec<OverlapSpec>,
}

#[derive(Debug, Clone)]
pub struct SceneSpec {
    /// Resolved against the spec file's folder.
    pub file: At<PathBuf>,
    pub scene: Option<At<SceneChoice>>,
    /// Seconds into the animations of all models; `None`: the rest pose.
    pub time: Option<At<f64>>,
    pub hide: Vec<At<Pattern>>,
    pub backfaces: Backfaces,
    /// In file order; names are unique.
    pub alternates: Vec<(String, At<PathBuf>)>,
}

/// Which of a glTF file's scenes.
#[derive(Debug, Clone, PartialEq)]
pub enum SceneChoice {
    Name(String),
    Index(usize),
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Backfaces {
    #[default]
    Show,
    AsMaterial,
}

/// Either placed by hand or a camera node of the file.
#[derive(Debug, Clone, PartialEq)]
pub struct CameraSpec {
    pub place: CameraPlace,
    pub near: Option<At<f64>>,
    pub far: Option<At<f64>>,
}

#[derive(Debug, Clone, PartialEq)]
pub enum CameraPlace {
    /// `None` where the key was left out.
    Free {
        eye: Option<[f64; 3]>,
        target: Option<[f64; 3]>,
        up: [f64; 3],
        projection: ProjectionSpec,
    },
    Node(At<String>),
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ProjectionSpec {
    /// Vertical field of view, degrees.
    FovY(f64),
    /// Height of the picture in scene units.
    OrthographicHeight(f64),
}

#[derive(Debug, Clone, PartialEq)]
pub struct ImageSpec {
    pub size: [u32; 2],
    /// 1, 4, 9 or 16.
    pub samples: u32,
    /// `None` is transparent.
    pub background: Option<Color>,
    pub tone_mapping: ToneMapping,
    /// What false colours stand for is drawn over the picture.
    pub legend: bool,
}

impl ImageSpec {
    /// The most pixels along one side.
    pub const LARGEST_SIDE: u32 = 16384;
}

impl Default for ImageSpec {
    fn default() -> Self {
        Self {
            size: [1280, 720],
            samples: 4,
            background: Some(Color::rgb(0x1e, 0x22, 0x27)),
            tone_mapping: ToneMapping::None,
            legend: false,
        }
    }
}

#[derive(Debug, Clone, PartialEq)]
pub struct LightSpec {
    pub ambient: f32,
    pub directional: Vec<DirectionalSpec>,
}

#[derive(Debug, Clone, PartialEq)]
pub struct DirectionalSpec {
    /// The way the light travels; any length but zero.
    pub direction: [f64; 3],
    pub color: Color,
    pub intensity: f32,
}

#[derive(Debug, Clone)]
pub struct LensSpec {
    pub name: At<String>,
    pub enabled: bool,
    pub shape: At<Shape>,
    pub attach: At<Attach>,
    pub translation: [f64; 3],
    pub rotation: Rotation,
    pub scale: [f64; 3],
    /// The first listed acts first.
    pub filters: Vec<At<Filter>>,
    pub over: Vec<At<Pattern>>,
    pub under: Vec<At<Pattern>>,
    pub hides: Vec<At<Pattern>>,
    pub overlap: OverlapMode,
    pub priority: i64,
    pub by: By,
    pub only: Matches,
    pub except: Matches,
    /// Width over which the effect fades in from the boundary, scene units; 0: a sharp one.
    pub soft: f64,
    pub glass: Option<Glass>,
}

/// How colours brighter than a picture can show are brought into it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ToneMapping {
    /// They are cut off at white.
    None,
    /// The PBR Neutral operator of the Khronos Group.
    Neutral,
}

/// Name patterns for nodes and materials.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Matches {
    pub nodes: Vec<At<Pattern>>,
    pub materials: Vec<At<Pattern>>,
}

impl Matches {
    pub fn is_empty(&self) -> bool {
        self.nodes.is_empty() && self.materials.is_empty()
    }
}

#[derive(Debug, Clone, PartialEq)]
pub enum Attach {
    Scene,
    Camera,
    Node(String),
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum OverlapMode {
    Stack,
    Override,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum By {
    Pixel,
    Object,
}

/// How a lens surface is drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Glass {
    pub color: Color,
    /// Seen face on.
    pub opacity: f32,
    /// What is added where the surface is seen edge on.
    pub rim: f32,
    /// Width of the silhouette line in pixels; 0 draws none.
    pub outline: f32,
    /// Width in pixels of the line on the scene where the surface meets it; 0 draws none, 1 to 2 looks well.
    pub contact: f32,
}

impl Default for Glass {
    fn default() -> Self {
        Self { color: Color::rgb(0x9f, 0xd8, 0xff), opacity: 0.06, rim: 0.5, outline: 1.5, contact: 0.0 }
    }
}

/// One filter with all its parameters.
#[derive(Debug, Clone, PartialEq)]
pub enum Filter {
    /// `width` in pixels; `color` `None`: the surface's own; `fill`: opacity between the wires; `hidden`: wires are seen
    /// through nearer surfaces of the lens; `edges`: which are drawn.
    Wireframe {
        width: f32,
        color: Option<Color>,
        fill: f32,
        hidden: bool,
        edges: WireEdges,
    },
    /// `size` in pixels.
    Points {
        size: f32,
    },
    /// Removes what matches; both lists empty: everything. `cap` `None`: cut solids stay open. `outline`: the line around
    /// its caps.
    Erase {
        nodes: Vec<At<Pattern>>,
        materials: Vec<At<Pattern>>,
        cap: Option<Cap>,
        outline: Option<Outline>,
    },
    Show(ShowWhat),
    /// A simplified version: this share of the triangles, above 0.
    Lod {
        ratio: f32,
    },
    /// Enlarges about `center` (in the shape's space; `None`: the lens's centre).
    Magnify {
        factor: f64,
        center: Option<[f64; 3]>,
    },
    /// Moves nodes that match (an empty list: everything) by `offset`, along the scene's axes, and by `explode` times
    /// the vector from the lens's centre to the centre of the node's bounds.
    Displace {
        nodes: Vec<At<Pattern>>,
        offset: [f64; 3],
        explode: f64,
    },
    Opacity {
        value: f32,
    },
    /// `color` `None`: the surface's own, and lit.
    Ghost {
        strength: f32,
        color: Option<Color>,
    },
    Tint {
        color: Color,
        amount: f32,
    },
    Grayscale {
        amount: f32,
    },
    Invert {
        amount: f32,
    },
    Brightness {
        amount: f32,
    },
    /// `color` `None`: the surface's own.
    Unlit {
        color: Option<Color>,
    },
    /// What is `None` stays the surface's own.
    Material {
        color: Option<Color>,
        metallic: Option<f32>,
        roughness: Option<f32>,
        emissive: Option<Color>,
    },
    /// `scale`: how often the texture repeats over the unit of its mapping.
    Texture {
        file: At<PathBuf>,
        uv: UvMapping,
        scale: [f32; 2],
    },
    /// By direction: x, y, z as red, green, blue.
    Normals,
    /// `range` `None`: fitted to the scene; `colormap`: one of [`crate::color_map::NAMES`].
    FalseColor {
        quantity: Quantity,
        colormap: String,
        range: Option<[f64; 2]>,
    },
    /// `spacing` in the quantity's units, `None`: fitted to the scene; `width` in pixels.
    Contours {
        quantity: Quantity,
        spacing: Option<f64>,
        width: f32,
        color: Color,
    },
    /// Steps of light.
    Toon {
        levels: u32,
    },
    /// Pixels.
    Hatch {
        spacing: f32,
        width: f32,
        color: Color,
    },
    /// `width` in pixels.
    Edges {
        color: Color,
        width: f32,
        threshold: f32,
    },
    /// Pixels.
    Blur {
        radius: f32,
    },
    /// Pixels.
    Pixelate {
        radius: f32,
    },
    /// The user's own; what is given for its parameters is checked against its file.
    Wgsl {
        file: At<PathBuf>,
        params: Vec<Given>,
    },
}

/// What is shown as false colour or contour lines.
#[derive(Debug, Clone, PartialEq)]
pub enum Quantity {
    /// The shading normal's part along the scene's up axis.
    Slope,
    /// Along the camera's forward axis, scene units.
    Depth,
    /// The scene's y.
    Height,
    /// Mean curvature, one over scene units.
    Curvature,
    /// A vertex attribute of the file, by name.
    Attribute(At<String>),
}

impl Quantity {
    /// The name among [`crate::scene::Primitive::values`], of what stands at vertices.
    pub fn value_name(&self) -> Option<&str> {
        match self {
            Quantity::Curvature => Some(crate::scene::CURVATURE),
            Quantity::Attribute(name) => Some(&name.value),
            Quantity::Slope | Quantity::Depth | Quantity::Height => None,
        }
    }
}

impl Filter {
    /// Whether it moves content (SEMANTICS 5.2).
    pub fn moves(&self) -> bool {
        matches!(self, Filter::Magnify { .. } | Filter::Displace { .. })
    }
}

/// The share of the triangles that a list of filters leaves: its last `lod` says so. One that stands before a `show`
/// simplifies what that replaces.
pub fn lod<'a>(filters: impl DoubleEndedIterator<Item = &'a Filter>) -> Option<f32> {
    let decides = |filter: &&Filter| matches!(filter, Filter::Lod { .. } | Filter::Show(_));
    match filters.rev().find(decides)? {
        Filter::Lod { ratio } => Some(*ratio),
        _ => None,
    }
}

/// What the surface looks like that closes a cut solid.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Cap {
    /// The solid's own material, without textures.
    Own,
    Color(Color),
    /// Slanted lines of the colour over a light ground.
    Hatch(Color),
}

/// The line around each cap of an eraser; it lies on the cap.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Outline {
    /// Pixels.
    pub width: f32,
    pub color: Color,
}

impl Default for Outline {
    fn default() -> Self {
        Self { width: 1.5, color: Color::rgb(0, 0, 0) }
    }
}

/// What `show` puts in place of the scene.
#[derive(Debug, Clone, PartialEq)]
pub enum ShowWhat {
    Alternate {
        /// Under `[scene.alternates]`.
        name: At<String>,
        /// What of it; empty: all.
        only: Matches,
    },
    /// Of the scene.
    Nodes(Vec<At<Pattern>>),
}

/// Which edges of triangles are drawn as wires.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum WireEdges {
    All,
    /// Without those within flat polygons.
    Feature,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum UvMapping {
    Mesh,
    PlanarX,
    PlanarY,
    PlanarZ,
    Box,
    Sphere,
}

/// An explicit style for chosen overlaps.
#[derive(Debug, Clone)]
pub struct OverlapSpec {
    pub when: At<Condition>,
    pub filters: Vec<At<Filter>>,
}

/// `when` of an overlap rule: a boolean expression over lens names and patterns.
#[derive(Debug, Clone, PartialEq)]
pub enum Condition {
    /// Holds if any lens that matches contains the point.
    Lens(At<Pattern>),
    Not(Box<Condition>),
    And(Box<Condition>, Box<Condition>),
    Or(Box<Condition>, Box<Condition>),
}

impl Condition {
    /// All that it names, as they stand.
    pub fn patterns(&self) -> Vec<&At<Pattern>> {
        match self {
            Condition::Lens(pattern) => vec![pattern],
            Condition::Not(inner) => inner.patterns(),
            Condition::And(left, right) | Condition::Or(left, right) => {
                left.patterns().into_iter().chain(right.patterns()).collect()
            }
        }
    }
}
