//! Filters as both backends run them: one record each, as in `shaders/appearance/surface.wgsl`.

use crate::appearance as wgsl;
use crate::scene::Scene;
use crate::spec::{Color, Filter, UvMapping};

/// One appearance filter with its parameters; the layout of WGSL's `Op`.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Op {
    /// An `OP_...` constant of the shaders.
    pub kind: u32,
    /// Into the plan's filter textures.
    pub texture: u32,
    pub flags: u32,
    /// Not 0: it stands before a filter of its lens that moves content, so it acts where that takes it from.
    pub inner: u32,
    pub a: [f32; 4],
    pub b: [f32; 4],
    pub c: [f32; 4],
}

impl Op {
    fn new(kind: naga_rust_rt::Scalar<u32>, a: [f32; 4], b: [f32; 4]) -> Self {
        Self { kind: kind.0, texture: 0, flags: 0, inner: 0, a, b, c: [0.0; 4] }
    }

    /// Appends the records of a list's appearance filters; their places.
    pub fn append(filters: &[Filter], scene: &Scene, ops: &mut Vec<Self>) -> std::ops::Range<usize> {
        let first = ops.len();
        let last_mover = filters.iter().rposition(Filter::moves);
        for (place, filter) in filters.iter().enumerate() {
            let inner = u32::from(last_mover.is_some_and(|mover| place < mover));
            ops.extend(Self::from_filter(filter, filter_texture(filter, scene)).map(|op| Self { inner, ..op }));
        }
        first..ops.len()
    }

    /// The record of an appearance filter; `None` for content filters, which act before any surface exists.
    /// `texture` is the index of the filter's own texture, where it has one.
    pub fn from_filter(filter: &Filter, texture: u32) -> Option<Self> {
        let none = [0.0; 4];
        let amount = |a: f32| [a, 0.0, 0.0, 0.0];
        Some(match filter {
            Filter::Erase { .. } | Filter::Show(_) | Filter::Magnify { .. } | Filter::Displace { .. } => return None,
            Filter::Opacity { value } => Self::new(wgsl::OP_OPACITY, amount(*value), none),
            Filter::Tint { color, amount: a } => Self::new(wgsl::OP_TINT, color.to_linear(), amount(*a)),
            Filter::Grayscale { amount: a } => Self::new(wgsl::OP_GRAYSCALE, none, amount(*a)),
            Filter::Invert { amount: a } => Self::new(wgsl::OP_INVERT, none, amount(*a)),
            Filter::Unlit { color } => Self::new(wgsl::OP_UNLIT, none, none).colored(*color),
            Filter::Normals => Self::new(wgsl::OP_NORMALS, none, none),
            Filter::Wireframe { width, color, fill } => {
                Self::new(wgsl::OP_WIREFRAME, none, [*width, *fill, 0.0, 0.0]).colored(*color)
            }
            Filter::Texture { uv, scale, .. } => Self {
                texture,
                flags: mapping(*uv).0,
                ..Self::new(wgsl::OP_TEXTURE, [scale[0], scale[1], 0.0, 0.0], none)
            },
            Filter::Material { color, metallic, roughness, emissive } => Self {
                flags: flag(color.is_some(), wgsl::MATERIAL_COLOR.0)
                    | flag(metallic.is_some(), wgsl::MATERIAL_METALLIC.0)
                    | flag(roughness.is_some(), wgsl::MATERIAL_ROUGHNESS.0)
                    | flag(emissive.is_some(), wgsl::MATERIAL_EMISSIVE.0),
                c: emissive.map_or(none, Color::to_linear),
                ..Self::new(
                    wgsl::OP_MATERIAL,
                    color.map_or(none, Color::to_linear),
                    [metallic.unwrap_or(0.0), roughness.unwrap_or(0.0), 0.0, 0.0],
                )
            },
        })
    }

    fn colored(self, color: Option<Color>) -> Self {
        match color {
            Some(color) => Self { a: color.to_linear(), flags: self.flags | wgsl::HAS_COLOR.0, ..self },
            None => self,
        }
    }

    /// Whether it does anything in a stage: 0 on surfaces before they are lit, 1 on lit colours, 2 on coverage.
    pub fn acts_in(&self, stage: u32) -> bool {
        // The alpha of a tint counts on the surface.
        wgsl::op_stage(naga_rust_rt::Scalar(self.kind)) == stage || (stage == 0 && self.kind == wgsl::OP_TINT.0)
    }

    /// Whether a fragment under this filter may let through what lies behind it.
    pub fn may_be_translucent(&self) -> bool {
        let color_alpha = self.a[3] < 1.0;
        match self.kind {
            k if k == wgsl::OP_OPACITY.0 => self.a[0] < 1.0,
            k if k == wgsl::OP_WIREFRAME.0 => true,
            k if k == wgsl::OP_TINT.0 => color_alpha,
            k if k == wgsl::OP_UNLIT.0 => self.flags & wgsl::HAS_COLOR.0 != 0 && color_alpha,
            k if k == wgsl::OP_MATERIAL.0 => {
                (self.flags & wgsl::MATERIAL_COLOR.0 != 0 && color_alpha)
                    || (self.flags & wgsl::MATERIAL_EMISSIVE.0 != 0 && self.c[3] < 1.0)
            }
            _ => false,
        }
    }
}

fn filter_texture(filter: &Filter, scene: &Scene) -> u32 {
    match filter {
        Filter::Texture { file, .. } => scene.filter_textures.get(&file.value).copied().unwrap_or_default(),
        _ => 0,
    }
}

fn flag(on: bool, bit: u32) -> u32 {
    if on { bit } else { 0 }
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
        Filter::Erase { .. } => "erase",
        Filter::Show(_) => "show",
        Filter::Magnify { .. } => "magnify",
        Filter::Displace { .. } => "displace",
        Filter::Opacity { .. } => "opacity",
        Filter::Tint { .. } => "tint",
        Filter::Grayscale { .. } => "grayscale",
        Filter::Invert { .. } => "invert",
        Filter::Unlit { .. } => "unlit",
        Filter::Material { .. } => "material",
        Filter::Texture { .. } => "texture",
        Filter::Normals => "normals",
    }
}
