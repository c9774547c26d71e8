//! Records as the shaders read them: twins of the structs in `shaders/gpu/common.wgsl`.

use bytemuck::{Pod, Zeroable};
use glam::DAffine3;

use crate::plan::{GlassRecord, LensSet};

/// Stands for "not there" in an index.
pub const NONE: u32 = u32::MAX;

pub const ITEM_TRANSLUCENT: u32 = 1;
pub const ITEM_ALTERNATE: u32 = 2;

pub const FORM_EMPTY: u32 = 0;
pub const FORM_SPHERE: u32 = 1;
pub const FORM_CONE: u32 = 2;
pub const FORM_CAPSULE: u32 = 3;
pub const FORM_HALF_SPACES: u32 = 4;
pub const FORM_MESH: u32 = 5;

pub const LENS_GLASS: u32 = 1;
pub const LENS_BY_OBJECT: u32 = 2;
pub const LENS_FLAT: u32 = 4;

pub const PART_FLAT: u32 = 1;
pub const PART_PARITY: u32 = 2;

/// One sample, or one layer of one, of a frame.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
pub struct FrameRecord {
    /// A step across the picture by one pixel, right and down.
    pub ray_dx: [f32; 4],
    pub ray_dy: [f32; 4],
    pub right: [f32; 4],
    pub up: [f32; 4],
    pub forward: [f32; 4],
    pub clip_scale: [f32; 2],
    pub clip_shift: [f32; 2],
    /// In pixels from the picture's top left corner.
    pub middle: [f32; 2],
    /// Of a step across the picture: of a ray's origin, and of its direction.
    pub shares: [f32; 2],
    pub near: f32,
    pub far: f32,
    pub perspective: u32,
    pub layer: u32,
    pub window_min: [u32; 2],
    pub window_size: [u32; 2],
    pub sample: [f32; 2],
    pub sample_index: u32,
    pub samples: u32,
    pub ambient: [f32; 4],
    pub texture_space: [f32; 4],
    pub background: [f32; 4],
    pub fragment_capacity: u32,
    pub active_tiles: u32,
    pub target_is_srgb: u32,
    pub lens_count: u32,
    pub rule_count: u32,
    /// For accounts of one pixel: the fragment of which the next one behind is looked for.
    pub after_depth: f32,
    /// The number of its triangle among all; `u32::MAX` for pictures.
    pub after_key: u32,
    /// Into `Plan::instances`.
    pub after_item: u32,
    /// `TONE_...` of the shaders.
    pub tone_mapping: u32,
    /// Depths between which drawn depths resolve.
    pub drawn: [f32; 2],
    /// The former, from the eye.
    pub drawn_from_eye: f32,
    /// Of the view: world space.
    pub origin: [f32; 3],
    /// How far the eye is before the anchor.
    pub anchor: f32,
    pub merge_most: f32,
    pub merge_across: f32,
    pub pad: f32,
    /// Two over the picture's height, at depth 1 for a perspective camera.
    pub picture_scale: f32,
    pub by_pixel: [u32; 12],
    pub translucent: [u32; 12],
    /// For accounts of one pixel: the lenses and rules that act on nearer fragments.
    pub passed: [u32; 12],
}

/// One instance of an item; its masks follow.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
pub struct ItemRecord {
    /// Rows of the map from local space to where it is shown around the view's origin.
    pub row_x: [f32; 4],
    pub row_y: [f32; 4],
    pub row_z: [f32; 4],
    pub material: u32,
    /// The number of its item's first triangle among all.
    pub first_triangle: u32,
    pub flags: u32,
    pub first_index: u32,
    /// Where the numbers start that its triangles have in their primitive.
    pub first_number: u32,
    pub base_vertex: u32,
    /// Where each attribute starts, in floats, or `u32::MAX`.
    pub normals: u32,
    pub tangents: u32,
    pub colors: u32,
    pub uv0: u32,
    pub uv1: u32,
    /// Bit i: its material has a texture in its i-th slot.
    pub slots: u32,
    /// The centre of its node where it is in place, around the view's origin.
    pub center: [f32; 3],
    pub first_step: u32,
    pub step_count: u32,
    /// Among the words of lenses, or `u32::MAX`: the body that it is of, and what closes it where it is cut.
    pub body: u32,
    pub caps: u32,
    /// The number of its node in its file.
    pub node: u32,
    /// The share of its primitive's triangles: which version it is.
    pub ratio: f32,
    /// How far versions of it may lie from each other.
    pub spread: f32,
    /// Among the words of lenses, or `u32::MAX`: which of its triangles have their depths from their planes.
    pub planes: u32,
    /// See `cut_data::CutWords`.
    pub group: u32,
    pub roles: u32,
    pub lids: u32,
    /// Where what lies across the edges of its triangles starts, or `u32::MAX`.
    pub across: u32,
}

/// A lens that moves content, on the way down from a shown point.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
pub struct StepRecord {
    /// Rows of the map, around the view's origin, from the shown point to where the lenses below are asked.
    pub row_x: [f32; 4],
    pub row_y: [f32; 4],
    pub row_z: [f32; 4],
    pub rank: u32,
    pub pad: [u32; 3],
}

/// One lens, or an overlap rule behind them; the set that it hides follows.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
pub struct LensRecord {
    pub glass: GlassRecord,
    pub flags: u32,
    /// Its parts; of a rule the sets of its names, in words.
    pub first_part: u32,
    pub part_count: u32,
    /// Its program; none where a lens is one part.
    pub first_token: u32,
    pub token_count: u32,
    pub first_op: u32,
    pub op_count: u32,
    pub soft: f32,
    /// The share of the triangles that its `lod` leaves; 1 where it has none.
    pub lod: f32,
}

/// One solid of a lens volume.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
pub struct PartRecord {
    /// In the part's own space the ray of the picture's middle, with last what its origin is outside the surfaces, and a
    /// pixel's steps.
    pub ray_origin: [f32; 4],
    pub ray_direction: [f32; 4],
    pub ray_dx: [f32; 4],
    pub ray_dy: [f32; 4],
    /// Columns of the map from normals in the part's own space.
    pub normal_x: [f32; 4],
    pub normal_y: [f32; 4],
    pub normal_z: [f32; 4],
    /// Rows of the map from the space around the view's origin.
    pub local_x: [f32; 4],
    pub local_y: [f32; 4],
    pub local_z: [f32; 4],
    /// Rank of its lens.
    pub lens: u32,
    pub form: u32,
    pub flags: u32,
    pub first_plane: u32,
    pub plane_count: u32,
    pub hidden: u32,
    pub first_corner: u32,
    pub corner_count: u32,
    pub r0: f32,
    pub r1: f32,
    pub length: f32,
    /// Words of a mesh: its nodes, triangles and corners.
    pub first_node: u32,
    pub node_count: u32,
    pub first_triangle: u32,
    pub first_vertex: u32,
    /// For how many of its crossings a pixel has room.
    pub crossing_room: u32,
    /// Of a mesh in front of the eye: its triangles in the picture, among the vectors, the point of the picture that they
    /// start from, and the depth from the eye, or 0, by which their depths are counted.
    pub first_projected: u32,
    pub reference: f32,
    pub origin: [f32; 2],
}

/// How a texture is sampled and where its levels lie on the pages.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
pub struct TextureInfo {
    pub wrap_u: u32,
    pub wrap_v: u32,
    pub filter_bits: u32,
    pub srgb: u32,
    pub level_count: u32,
    pub pad: [u32; 3],
    /// x, y, page, and width with the height in the upper half.
    pub levels: [[u32; 4]; 16],
}

/// The words of a set.
pub fn words_of(set: &LensSet, words: u32) -> impl Iterator<Item = u32> + '_ {
    (0..words as usize).map(|i| set.word(i))
}

/// All words a set can have.
pub fn all_words(set: &LensSet) -> [u32; 12] {
    std::array::from_fn(|i| set.word(i))
}

pub fn extended(v: glam::DVec3) -> [f32; 4] {
    v.as_vec3().extend(0.0).to_array()
}

/// Rows of a map as the shaders take them.
pub fn rows(map: &DAffine3) -> [[f32; 4]; 3] {
    let rows = map.matrix3.transpose();
    [(rows.x_axis, map.translation.x), (rows.y_axis, map.translation.y), (rows.z_axis, map.translation.z)]
        .map(|(row, shift)| row.extend(shift).as_vec4().to_array())
}
