//! Filters as both backends run them: one record each, as in `shaders/appearance/surface.wgsl`.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use crate::InputError;
use crate::appearance as wgsl;
use crate::custom::{Custom, Given};
use crate::scene::{Aabb, CURVATURE, Scene};
use crate::spec::{At, Color, Filter, Outline, Quantity, Spec, UvMapping, WireEdges};
use crate::view::View;

/// One appearance filter with its parameters; the layout of WGSL's `Op`.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Op {
    /// An `OP_...` constant of the shaders.
    pub kind: u32,
    /// Of the filter's image or colour map.
    pub texture: u32,
    pub flags: u32,
    /// Not 0: it stands before a filter of its lens that moves content, so it acts where that takes it from.
    pub inner: u32,
    pub a: [f32; 4],
    pub b: [f32; 4],
    pub c: [f32; 4],
}

/// The records of all lenses and rules while they are gathered.
pub(super) struct Ops<'a> {
    pub spec: &'a Spec,
    pub scene: &'a Scene,
    pub view: &'a View,
    pub list: Vec<Op>,
    /// Names of the numbers at vertices that they read: [`super::Plan::channels`].
    pub channels: Vec<String>,
    /// The user's own filters: [`super::Plan::customs`].
    pub customs: Vec<Arc<Custom>>,
    /// The values of their parameters: [`super::Plan::custom_words`].
    pub custom_words: Vec<u32>,
    pub legend: Vec<LegendEntry>,
}

/// What colours or lines of a filter stand for.
#[derive(Debug, Clone, PartialEq)]
pub struct LegendEntry {
    /// Whose: into [`super::Plan::ops`].
    pub op: usize,
    pub quantity: Quantity,
    pub look: LegendLook,
}

#[derive(Debug, Clone, PartialEq)]
pub enum LegendLook {
    /// Values at the ends of the colours, the first above the second where colours run backwards.
    Colors {
        colormap: String,
        range: [f64; 2],
    },
    Lines {
        spacing: f64,
        color: Color,
    },
    /// The parts of a direction as red, green and blue.
    Axes,
}

const NONE: [f32; 4] = [0.0; 4];

/// What counts as an edge between two caps: as for the filter `edges` by default.
const OUTLINE_THRESHOLD: f32 = 0.1;

impl Op {
    fn new(kind: naga_rust_rt::Scalar<u32>, a: [f32; 4], b: [f32; 4]) -> Self {
        Self { kind: kind.0, texture: 0, flags: 0, inner: 0, a, b, c: NONE }
    }

    fn colored(self, color: Option<Color>) -> Self {
        match color {
            Some(color) => self.flagged(wgsl::HAS_COLOR.0, true).with_color(color),
            None => self,
        }
    }

    fn with_color(self, color: Color) -> Self {
        Self { a: color.to_linear(), ..self }
    }

    fn flagged(self, bit: u32, on: bool) -> Self {
        Self { flags: self.flags | if on { bit } else { 0 }, ..self }
    }

    /// As the translated shaders take it.
    pub fn shader(&self) -> wgsl::Op {
        let vector = |v: [f32; 4]| naga_rust_rt::Vec4::new(v[0], v[1], v[2], v[3]);
        let Self { kind, texture, flags, inner, a, b, c } = *self;
        wgsl::Op { kind, texture, flags, inner, a: vector(a), b: vector(b), c: vector(c) }
    }

    /// Whether it does anything in a stage: 0 on surfaces before they are lit, 1 on lit colours, 2 on coverage.
    pub fn acts_in(&self, stage: usize) -> bool {
        let custom = self.kind == wgsl::OP_WGSL.0 && self.flags & [CUSTOM_SURFACE, CUSTOM_COLOR, 0][stage] != 0;
        custom || wgsl::FILTERS[self.kind as usize].stages[stage]
    }

    /// Whether it looks up a quantity of the surface.
    pub fn reads_quantity(&self) -> bool {
        self.flags >> 8 & 0xff != 0
    }

    /// Whether wires of nearer surfaces of its lens hide those of farther ones.
    pub fn hides_lines(&self) -> bool {
        self.kind == wgsl::OP_WIREFRAME.0 && self.flags & wgsl::HIDES_LINES.0 != 0
    }

    /// Whether it works on the finished picture.
    pub fn is_of_screen(&self) -> bool {
        [wgsl::OP_EDGES.0, wgsl::OP_BLUR.0, wgsl::OP_PIXELATE.0, wgsl::OP_ERASE.0].contains(&self.kind)
    }

    /// Whether it draws the line around the caps of an eraser, which stands at a place among the filters of its lens.
    pub fn is_outline_of(&self, filter: usize) -> bool {
        self.kind == wgsl::OP_ERASE.0 && self.texture as usize == filter
    }

    /// Whether a fragment under this filter may let through what lies behind it.
    pub fn may_be_translucent(&self) -> bool {
        let color_alpha = self.a[3] < 1.0;
        let has_color = self.flags & wgsl::HAS_COLOR.0 != 0;
        match self.kind {
            k if k == wgsl::OP_WGSL.0 => self.flags & CUSTOM_OPACITY != 0,
            k if k == wgsl::OP_OPACITY.0 => self.a[0] < 1.0,
            k if k == wgsl::OP_GHOST.0 => self.b[0] > 0.0 || (has_color && color_alpha),
            k if k == wgsl::OP_WIREFRAME.0 || k == wgsl::OP_POINTS.0 => true,
            k if k == wgsl::OP_TINT.0 || k == wgsl::OP_HATCH.0 => color_alpha,
            k if k == wgsl::OP_UNLIT.0 => has_color && color_alpha,
            k if k == wgsl::OP_MATERIAL.0 => {
                (self.flags & wgsl::MATERIAL_COLOR.0 != 0 && color_alpha)
                    || (self.flags & wgsl::MATERIAL_EMISSIVE.0 != 0 && self.c[3] < 1.0)
            }
            _ => false,
        }
    }
}

/// Flags of the user's own filters: which functions their files have.
const CUSTOM_SURFACE: u32 = 1;
const CUSTOM_COLOR: u32 = 2;
/// And whether they may change how opaque surfaces are.
const CUSTOM_OPACITY: u32 = 4;

impl<'a> Ops<'a> {
    pub fn new(spec: &'a Spec, scene: &'a Scene, view: &'a View) -> Self {
        let (list, channels, customs, custom_words, legend) = Default::default();
        Self { spec, scene, view, list, channels, customs, custom_words, legend }
    }

    /// Appends the records of a list's appearance filters; their places.
    pub fn append(&mut self, filters: &[At<Filter>]) -> Result<std::ops::Range<usize>, InputError> {
        let first = self.list.len();
        let last_mover = filters.iter().rposition(|filter| filter.value.moves());
        for (place, filter) in filters.iter().enumerate() {
            let inner = u32::from(last_mover.is_some_and(|mover| place < mover));
            let record =
                self.record(place, &filter.value).map_err(|e| e.or_at(&self.spec.source, filter.span.clone()))?;
            if let Some(op) = record {
                self.list.push(Op { inner, ..op });
            }
        }
        Ok(first..self.list.len())
    }

    /// The record of an appearance filter; `None` for content filters, which act before any surface exists: of an eraser
    /// that of the line around its caps. `place`: among the filters of its lens or rule.
    fn record(&mut self, place: usize, filter: &Filter) -> Result<Option<Op>, InputError> {
        let one = |a: f32| [a, 0.0, 0.0, 0.0];
        Ok(Some(match filter {
            Filter::Erase { outline: Some(Outline { width, color }), .. } => Op {
                texture: place as u32,
                ..Op::new(wgsl::OP_ERASE, color.to_linear(), [*width, OUTLINE_THRESHOLD, 0.0, 0.0])
            },
            Filter::Erase { .. }
            | Filter::Show(_)
            | Filter::Lod { .. }
            | Filter::Magnify { .. }
            | Filter::Displace { .. } => return Ok(None),
            Filter::Wgsl { file, params } => self.custom(file, params)?,
            Filter::Opacity { value } => Op::new(wgsl::OP_OPACITY, one(*value), NONE),
            Filter::Ghost { strength, color } => Op::new(wgsl::OP_GHOST, NONE, one(*strength)).colored(*color),
            Filter::Tint { color, amount } => Op::new(wgsl::OP_TINT, color.to_linear(), one(*amount)),
            Filter::Grayscale { amount } => Op::new(wgsl::OP_GRAYSCALE, NONE, one(*amount)),
            Filter::Invert { amount } => Op::new(wgsl::OP_INVERT, NONE, one(*amount)),
            Filter::Brightness { amount } => Op::new(wgsl::OP_BRIGHTNESS, NONE, one(*amount)),
            Filter::Unlit { color } => Op::new(wgsl::OP_UNLIT, NONE, NONE).colored(*color),
            Filter::Normals => {
                self.explain(&Quantity::Slope, LegendLook::Axes);
                Op::new(wgsl::OP_NORMALS, NONE, NONE)
            }
            Filter::FalseColor { quantity, colormap, range } => self.false_color(quantity, colormap, *range)?,
            Filter::Contours { quantity, spacing, width, color } => {
                let spacing = spacing.map_or_else(|| self.round_spacing(quantity), Ok)?;
                self.explain(quantity, LegendLook::Lines { spacing, color: *color });
                let from = self.counted_from(quantity);
                let beyond = from - (from / spacing).round() * spacing;
                let lines = Op::new(wgsl::OP_CONTOURS, NONE, [beyond as f32, 0.0, spacing as f32, *width]);
                self.reading(lines, quantity)?.with_color(*color)
            }
            Filter::Toon { levels } => Op::new(wgsl::OP_TOON, NONE, one(*levels as f32)),
            Filter::Hatch { spacing, width, color } => {
                Op::new(wgsl::OP_HATCH, color.to_linear(), [*spacing, *width, 0.0, 0.0])
            }
            Filter::Wireframe { width, color, fill, hidden, edges } => {
                prepared(self.scene.has_edges.then_some(()), || "the edges of triangles".to_owned())?;
                let lines = Op::new(wgsl::OP_WIREFRAME, NONE, [*width, *fill, 0.0, 0.0]).colored(*color);
                lines.flagged(wgsl::HIDES_LINES.0, !hidden).flagged(wgsl::FEATURE_EDGES.0, *edges == WireEdges::Feature)
            }
            Filter::Edges { color, width, threshold } => {
                Op::new(wgsl::OP_EDGES, color.to_linear(), [*width, *threshold, 0.0, 0.0])
            }
            Filter::Blur { radius } => Op::new(wgsl::OP_BLUR, NONE, one(*radius)),
            Filter::Pixelate { radius } => Op::new(wgsl::OP_PIXELATE, NONE, one(*radius)),
            Filter::Points { size } => Op::new(wgsl::OP_POINTS, NONE, one(*size)),
            Filter::Texture { file, uv, scale } => Op {
                texture: *prepared(self.scene.filter_textures.get(&file.value), || named("the image", &file.value))?,
                flags: mapping(*uv).0,
                ..Op::new(wgsl::OP_TEXTURE, [scale[0], scale[1], 0.0, 0.0], NONE)
            },
            Filter::Material { color, metallic, roughness, emissive } => {
                let values = [metallic.unwrap_or(0.0), roughness.unwrap_or(0.0), 0.0, 0.0];
                let op = Op::new(wgsl::OP_MATERIAL, color.map_or(NONE, Color::to_linear), values);
                Op { c: emissive.map_or(NONE, Color::to_linear), ..op }
                    .flagged(wgsl::MATERIAL_COLOR.0, color.is_some())
                    .flagged(wgsl::MATERIAL_METALLIC.0, metallic.is_some())
                    .flagged(wgsl::MATERIAL_ROUGHNESS.0, roughness.is_some())
                    .flagged(wgsl::MATERIAL_EMISSIVE.0, emissive.is_some())
            }
        }))
    }

    /// The number of the file stands where others have their texture, the place of its first value where they have a
    /// channel.
    fn custom(&mut self, file: &At<PathBuf>, params: &[Given]) -> Result<Op, InputError> {
        let source = &self.spec.source;
        let custom = prepared(self.scene.custom_filters.get(&file.value), || named("the filter file", &file.value))?;
        let words = custom.values(source, params)?;
        let first = self.custom_words.len() as u32;
        if first >= 1 << 16 {
            let message = "the filters before this one have too many parameters, 65536 numbers in all".to_owned();
            return Err(InputError::at(source, file.span.clone(), message).help("use fewer filters of your own"));
        }
        self.custom_words.extend(words);
        let known = self.customs.iter().position(|known| Arc::ptr_eq(known, custom));
        let number = known.unwrap_or_else(|| {
            self.customs.push(Arc::clone(custom));
            self.customs.len() - 1
        });
        let op = Op { texture: number as u32, flags: first << 16, ..Op::new(wgsl::OP_WGSL, NONE, NONE) };
        let op = op.flagged(CUSTOM_SURFACE, custom.has_surface()).flagged(CUSTOM_COLOR, custom.has_color());
        Ok(op.flagged(CUSTOM_OPACITY, custom.may_change_opacity()))
    }

    fn false_color(&mut self, quantity: &Quantity, colormap: &str, range: Option<[f64; 2]>) -> Result<Op, InputError> {
        let kind = match quantity {
            Quantity::Slope => wgsl::OP_NORMALS,
            Quantity::Depth => wgsl::OP_DEPTH,
            Quantity::Height => wgsl::OP_HEIGHT,
            Quantity::Curvature => wgsl::OP_CURVATURE,
            Quantity::Attribute(_) => wgsl::OP_ATTRIBUTE,
        };
        let [low, high] = range.unwrap_or(self.fitted(quantity)?);
        // A range without a length shows one colour, the low one.
        let scale = if high == low { 0.0 } else { 1.0 / (high - low) };
        self.explain(quantity, LegendLook::Colors { colormap: colormap.to_owned(), range: [low, high] });
        let texture = *prepared(self.scene.color_maps.get(colormap), || format!("the colour map `{colormap}`"))?;
        let op = self.reading(
            Op::new(kind, NONE, [(low - self.counted_from(quantity)) as f32, scale as f32, 0.0, 0.0]),
            quantity,
        )?;
        Ok(Op { texture, ..op.flagged(wgsl::MAPPED.0, true) })
    }

    /// About a tenth of what there is.
    fn round_spacing(&self, quantity: &Quantity) -> Result<f64, InputError> {
        let [low, high] = self.fitted(quantity)?;
        Ok(round_spacing((high - low) / 10.0))
    }

    /// For the legend: of the filter whose record comes next.
    fn explain(&mut self, quantity: &Quantity, look: LegendLook) {
        self.legend.push(LegendEntry { op: self.list.len(), quantity: quantity.clone(), look });
    }

    /// What shaders count a quantity from: positions are relative to the view's origin there, so that they have their
    /// digits far from the scene's.
    fn counted_from(&self, quantity: &Quantity) -> f64 {
        match quantity {
            Quantity::Height => self.view.origin().y,
            Quantity::Depth => self.view.from_eye(0.0),
            Quantity::Slope | Quantity::Curvature | Quantity::Attribute(_) => 0.0,
        }
    }

    /// The same, told what it reads.
    fn reading(&mut self, op: Op, quantity: &Quantity) -> Result<Op, InputError> {
        if let Some(name) = quantity.value_name() {
            self.range_of_values(name)?;
        }
        let kind = match quantity {
            Quantity::Slope => wgsl::QUANTITY_SLOPE,
            Quantity::Depth => wgsl::QUANTITY_DEPTH,
            Quantity::Height => wgsl::QUANTITY_HEIGHT,
            Quantity::Curvature | Quantity::Attribute(_) => wgsl::QUANTITY_VERTEX,
        };
        let channel = quantity.value_name().map_or(0, |name| {
            self.channels.iter().position(|known| known == name).unwrap_or_else(|| {
                self.channels.push(name.to_owned());
                self.channels.len() - 1
            })
        });
        Ok(Op { flags: op.flags | kind.0 << 8 | (channel as u32) << 16, ..op })
    }

    /// The range of a quantity in the scene, or of the depths at which it is seen.
    fn fitted(&self, quantity: &Quantity) -> Result<[f64; 2], InputError> {
        let bounds = self.scene.models[0].bounds();
        Ok(match quantity {
            Quantity::Slope => [-1.0, 1.0],
            Quantity::Height if bounds.is_empty() => [0.0; 2],
            Quantity::Height => [bounds.min.y, bounds.max.y],
            Quantity::Depth => depths(self.view, &bounds),
            Quantity::Curvature => self.range_of_values(CURVATURE)?,
            Quantity::Attribute(name) => self.range_of_values(&name.value)?,
        })
    }

    fn range_of_values(&self, name: &str) -> Result<[f64; 2], InputError> {
        let range = prepared(self.scene.value_ranges.get(name), || format!("the values `{name}` at vertices"))?;
        Ok(range.map(f64::from))
    }
}

/// What `Scene::prepare_filters` has put into the scene; an error where nobody called it.
fn prepared<T>(found: Option<T>, what: impl FnOnce() -> String) -> Result<T, InputError> {
    found.ok_or_else(|| {
        InputError::new(format!("the scene has not been prepared for {}", what()))
            .help("call `Scene::prepare_filters` with the spec")
    })
}

fn named(what: &str, path: &Path) -> String {
    format!("{what} {}", path.display())
}

/// The depths from the eye of bounds between near and far.
fn depths(view: &View, bounds: &Aabb) -> [f64; 2] {
    if bounds.is_empty() {
        return [view.near, view.far].map(|depth| view.from_eye(depth));
    }
    let corners = bounds.corners().map(|p| view.from_eye(view.depth(p).clamp(view.near, view.far)));
    [corners.into_iter().fold(f64::INFINITY, f64::min), corners.into_iter().fold(f64::NEG_INFINITY, f64::max)]
}

/// The nearest of 1, 2 and 5 times a power of ten; 1 for nothing.
fn round_spacing(spacing: f64) -> f64 {
    if spacing <= 0.0 || !spacing.is_finite() {
        return 1.0;
    }
    let power = 10f64.powf(spacing.log10().floor());
    let nearest = [1.0, 2.0, 5.0, 10.0].into_iter().min_by(|a, b| {
        let away = |step: f64| (spacing / power / step).ln().abs();
        away(*a).total_cmp(&away(*b))
    });
    nearest.unwrap_or(1.0) * power
}

fn mapping(uv: UvMapping) -> naga_rust_rt::Scalar<u32> {
    match uv {
        UvMapping::Mesh => wgsl::UV_MESH,
        UvMapping::PlanarX => wgsl::UV_PLANAR_X,
        UvMapping::PlanarY => wgsl::UV_PLANAR_Y,
        UvMapping::PlanarZ => wgsl::UV_PLANAR_Z,
        UvMapping::Box => wgsl::UV_BOX,
        UvMapping::Sphere => wgsl::UV_SPHERE,
    }
}

/// The filter's name in the spec.
pub fn filter_name(filter: &Filter) -> &'static str {
    match filter {
        Filter::Wireframe { .. } => "wireframe",
        Filter::Points { .. } => "points",
        Filter::Erase { .. } => "erase",
        Filter::Show(_) => "show",
        Filter::Lod { .. } => "lod",
        Filter::Magnify { .. } => "magnify",
        Filter::Displace { .. } => "displace",
        Filter::Opacity { .. } => "opacity",
        Filter::Ghost { .. } => "ghost",
        Filter::Tint { .. } => "tint",
        Filter::Grayscale { .. } => "grayscale",
        Filter::Invert { .. } => "invert",
        Filter::Brightness { .. } => "brightness",
        Filter::Unlit { .. } => "unlit",
        Filter::Material { .. } => "material",
        Filter::Texture { .. } => "texture",
        Filter::Normals | Filter::FalseColor { quantity: Quantity::Slope, .. } => "normals",
        Filter::FalseColor { quantity: Quantity::Depth, .. } => "depth",
        Filter::FalseColor { quantity: Quantity::Height, .. } => "height",
        Filter::FalseColor { quantity: Quantity::Curvature, .. } => "curvature",
        Filter::FalseColor { quantity: Quantity::Attribute(_), .. } => "attribute",
        Filter::Contours { .. } => "contours",
        Filter::Toon { .. } => "toon",
        Filter::Hatch { .. } => "hatch",
        Filter::Edges { .. } => "edges",
        Filter::Blur { .. } => "blur",
        Filter::Pixelate { .. } => "pixelate",
        Filter::Wgsl { .. } => "wgsl",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn spec(filter: &str) -> Spec {
        let text = format!(
            "[scene]\nfile = \"made-in-code.glb\"\n[[lens]]\nname = \"a\"\n\
             shape.sphere = {{ center = [0, 0, 0], radius = 1 }}\nfilters = [{filter}]\n"
        );
        Spec::parse(&text, "spec.toml", env!("CARGO_MANIFEST_DIR").as_ref()).expect("the test's spec is right")
    }

    /// A triangle with a number at each vertex.
    fn scene() -> Scene {
        use crate::scene::{Material, Mesh, Model, Node, Primitive, Transform};
        let positions = vec![glam::Vec3::ZERO, glam::Vec3::X, glam::Vec3::Y];
        let values = [("_HEAT".to_owned(), vec![0.0, 1.0, 2.0])].into();
        let primitive = Primitive { positions, values, triangles: vec![[0, 1, 2]], ..Primitive::default() };
        let node = Node {
            name: "triangle".into(),
            parent: None,
            children: vec![],
            rest: Transform::Matrix(glam::DAffine3::IDENTITY),
            world_from_local: glam::DAffine3::IDENTITY,
            mesh: Some(0),
            camera: None,
            light: None,
            drawn: true,
            hidden: false,
        };
        let mesh = Mesh { name: "triangle".into(), primitives: vec![primitive] };
        let materials = vec![Material::default()];
        Scene::new(vec![Model { nodes: vec![node], meshes: vec![mesh], materials, ..Model::default() }], vec![])
    }

    #[test]
    fn a_scene_that_was_not_prepared_is_refused() {
        let filters = [
            (r#"{ texture = { file = "lens-specs/textures/checker.png" } }"#, "the image "),
            (r#""height""#, "the colour map `viridis`"),
            (r#"{ normals = { colormap = "turbo" } }"#, "the colour map `turbo`"),
            (r#"{ curvature = { range = [0, 1] } }"#, "the values `curvature`"),
            (r#"{ attribute = { name = "_HEAT" } }"#, "the values `_HEAT`"),
            (r#"{ contours = { quantity = "_HEAT", spacing = 1 } }"#, "the values `_HEAT`"),
            (r#"{ wgsl = { file = "lens-specs/wgsl/stripes.wgsl" } }"#, "the filter file "),
        ];
        for (filter, what) in filters {
            let (spec, mut scene) = (spec(filter), scene());
            let error = crate::plan::Plan::new(&spec, &scene).expect_err(filter);
            let start = format!("the scene has not been prepared for {what}");
            assert!(error.message.starts_with(&start), "{filter}: {error}");
            assert_eq!(error.line(), Some(6), "{filter}: {error}");
            scene.prepare_filters(&spec).unwrap_or_else(|error| panic!("{filter}: {error}"));
            crate::plan::Plan::new(&spec, &scene).unwrap_or_else(|error| panic!("{filter}: {error}"));
        }
    }

    #[test]
    fn spacings_are_round() {
        for (spacing, round) in [(0.13, 0.1), (0.15, 0.2), (3.4, 5.0), (7.5, 10.0), (900.0, 1000.0), (0.0, 1.0)] {
            assert!((round_spacing(spacing) / round - 1.0).abs() < 1e-12, "{spacing}: {}", round_spacing(spacing));
        }
    }
}
