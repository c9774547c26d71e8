// What every pass shares: the records of a frame, the scene's buffers, and the ray of a pixel.
// Put in front of this file when it is assembled: `WORDS`, the number of 32-bit words of a set of lenses, `PART_WORDS`,
// that of a set of one lens's parts, and `LIGHTS`, the number of lights; and flags, see `Needs`: whether there are lenses
// or rules (`LENSES`), there are rules (`RULES`), rays are cut into layers (`LAYERS`), some lens takes something away or shows something
// (`TAKEN_AWAY`), some lens has several parts or a mesh (`COMPOUNDS`), which forms parts have (`SPHERES`, `CONES`,
// `CAPSULES`, `HALF_SPACES`), some lens moves content (`MOVERS`) or closes what it cuts (`CAPS`), is soft (`SOFT`), has a
// surface (`GLASS`) or one with a line where it meets the scene (`CONTACT`), something may be seen through something else
// (`TRANSLUCENT`), something has a texture (`TEXTURES`) or a colour for each vertex (`VERTEX_COLORS`), some filter acts in a
// stage (`SURFACE_FILTERS`, `COLOR_FILTERS`, `COVERAGE_FILTERS`), reads a quantity (`QUANTITIES`) or has wires that nearer
// surfaces hide (`HIDDEN_LINES`), some triangle has its depth from its plane (`PLANES`), or the scene reaches very far beyond
// what is seen (`WIDE`). `CHANNELS`: how many numbers at vertices filters read, at least 1. `ACCOUNTS`: what is asked for is
// where things are, and not their colours.
// Positions are relative to the view's origin, along the world's axes, and depths are counted from its anchor (see
// `view.rs`), unless a name says otherwise.

const NONE: u32 = 0xffffffffu;
// Stands for infinity: infinite values are not reliable in WGSL.
const FAR_AWAY: f32 = 1e37;
const TILE: u32 = 16u;
// Workgroups in a row of a dispatch over tiles; twin of `tiles::DISPATCH_WIDTH`.
const DISPATCH_WIDTH: u32 = 1024u;
// Of the distance from a perspective camera's eye, and what single precision resolves: see `merge_at`.
const MERGE: f32 = 1e-5;
const RESOLVED: f32 = 1e-6;

// How far apart boundaries at a depth may be to be one: twin of `Merging` in `view.rs`.
fn merge_at(depth: f32) -> f32 {
    let by_distance = select(FAR_AWAY, MERGE * abs(frame.anchor + depth), frame.perspective != 0u);
    return max(min(by_distance, frame.merge_most), RESOLVED * (abs(depth) + frame.merge_across));
}

// Whether a boundary is another one than that at `first` before it.
fn starts_boundary(first: f32, depth: f32) -> bool {
    return depth - first > merge_at(first);
}

// Twin of `records::FrameRecord`.
struct Frame {
    // A step across the picture by one pixel, right and down: see `pixel_ray`.
    ray_dx: vec4f,
    ray_dy: vec4f,
    right: vec4f,
    up: vec4f,
    forward: vec4f,
    // From clip coordinates of the whole picture to those of the window and the sample.
    clip_scale: vec2f,
    clip_shift: vec2f,
    // The middle of the whole picture, in pixels from its top left corner.
    middle: vec2f,
    // What a step across the picture moves of a ray: of its origin, and of its direction.
    shares: vec2f,
    // Depths along `forward`.
    near: f32,
    far: f32,
    perspective: u32,
    // The layer that `peel` draws.
    layer: u32,
    // Pixels of the whole picture that are drawn.
    window_min: vec2u,
    window_size: vec2u,
    // Where the sample lies in its pixel.
    sample: vec2f,
    sample_index: u32,
    samples: u32,
    // The up direction of ambient light; its strength.
    ambient: vec4f,
    // Maps the scene's bounds to 0..1: origin and scale.
    texture_space: vec4f,
    // Linear light, straight alpha.
    background: vec4f,
    fragment_capacity: u32,
    active_tiles: u32,
    // Not 0: the target encodes sRGB itself.
    target_is_srgb: u32,
    // Overlap rules stand behind the lenses.
    lens_count: u32,
    rule_count: u32,
    // For accounts of one pixel: the fragment of which the next one behind is looked for, by depth, number of its
    // triangle among all, and item; the number is NONE for pictures. The walk then goes on below a lens that takes a fragment elsewhere.
    after_depth: f32,
    after_key: u32,
    after_item: u32,
    // TONE_...
    tone_mapping: u32,
    // Between these depths drawn depths resolve.
    drawn_near: f32,
    drawn_far: f32,
    // The former, from the eye.
    drawn_from_eye: f32,
    // Of the view's origin: world space.
    origin: vec3f,
    // How far the eye is before the anchor.
    anchor: f32,
    // See `merge_at`.
    merge_most: f32,
    merge_across: f32,
    pad: f32,
    // Two over the picture's height, at depth 1 for a perspective camera.
    picture_scale: f32,
    // Lenses that test every fragment; lenses that may make one translucent.
    by_pixel: array<vec4u, 3>,
    translucent: array<vec4u, 3>,
    // For accounts of one pixel: the lenses and rules that act on nearer fragments.
    passed: array<vec4u, 3>,
}

const ITEM_TRANSLUCENT: u32 = 1u;
const ITEM_ALTERNATE: u32 = 2u;

const MASK_SCOPE: u32 = 0u;
const MASK_OBJECT: u32 = 1u;
const MASK_SHOWN_BY: u32 = 2u;
const MASK_REMOVED_BY: u32 = 3u;
const MASK_MOVERS: u32 = 4u;
const MASK_SIMPLIFIED_BY: u32 = 5u;

// An instance of an item, by its number in the plan: twin of `records::ItemRecord`, and the item's masks.
struct Item {
    // Rows of the map from local space to where it is shown.
    row_x: vec4f,
    row_y: vec4f,
    row_z: vec4f,
    material: u32,
    // The number of its item's first triangle among all.
    first_triangle: u32,
    flags: u32,
    first_index: u32,
    // Where the numbers start that its triangles have in their primitive, in `numbers`.
    first_number: u32,
    base_vertex: u32,
    // Where each attribute starts in `attributes`, or NONE.
    normals: u32,
    tangents: u32,
    colors: u32,
    uv0: u32,
    uv1: u32,
    // Bit i: its material has a texture in slot i.
    slots: u32,
    // The centre of its node where it is in place.
    center: vec3f,
    // How its rays are moved, in `steps`.
    first_step: u32,
    step_count: u32,
    // In `lens_words`, or NONE: the body that it is of, and what closes it where it is cut (see `closing.wgsl`).
    body: u32,
    caps: u32,
    // The number of its node in its file.
    node: u32,
    // Which version of its primitive it is: the share of the triangles; 1: all of it.
    ratio: f32,
    // How far versions of it may lie from each other.
    spread: f32,
    // In `lens_words`, or NONE: which of its triangles have their depths from their planes; see `planes.wgsl`.
    planes: u32,
    // Of one that may be cut: the first of those that enclose something only together with it.
    group: u32,
    // In `lens_words`, or NONE: the roles of its primitive's triangles, four a word, where not all are plain; and its lids,
    // LID_WORDS each.
    roles: u32,
    lids: u32,
    // What lies across the edges of its triangles, in `numbers`, or NONE.
    across: u32,
    masks: array<u32, 6u * WORDS>,
    // Of each channel, where its numbers start in `attributes`, or NONE, and a factor.
    channels: array<u32, 2u * CHANNELS>,
}

const FORM_EMPTY: u32 = 0u;
const FORM_SPHERE: u32 = 1u;
const FORM_CONE: u32 = 2u;
const FORM_CAPSULE: u32 = 3u;
const FORM_HALF_SPACES: u32 = 4u;
const FORM_MESH: u32 = 5u;

// A lens that moves content, on the way down from a shown point: twin of `records::StepRecord`.
struct Step {
    // Rows of the map from the shown point to where the lenses below are asked.
    row_x: vec4f,
    row_y: vec4f,
    row_z: vec4f,
    rank: u32,
    pad_a: u32,
    pad_b: u32,
    pad_c: u32,
}

const LENS_GLASS: u32 = 1u;
const LENS_BY_OBJECT: u32 = 2u;
// All of its parts in turn are joined in one way.
const LENS_FLAT: u32 = 4u;

// A lens or an overlap rule: twin of `records::LensRecord`, and the lens's mask.
struct Lens {
    glass: Glass,
    flags: u32,
    // Its parts in `parts`; of a rule the sets of its names in `lens_words`.
    first_part: u32,
    part_count: u32,
    // Its program in `lens_words`; none where a lens is one part.
    first_token: u32,
    token_count: u32,
    first_op: u32,
    op_count: u32,
    // Width over which it fades in from the boundary; 0: a sharp one.
    soft: f32,
    // The share of the triangles that its `lod` leaves.
    lod: f32,
    hides: array<u32, WORDS>,
}

const PART_FLAT: u32 = 1u;
// Of a mesh: some of its pieces are told by parity.
const PART_PARITY: u32 = 2u;

// One solid of a lens volume, convex but for FORM_MESH: twin of `records::PartRecord`.
struct Part {
    // In the part's own space the ray of the picture's middle, with in `w` what its origin is outside the surface (see
    // `local_ray`), and a pixel's steps as in `Frame`.
    ray_origin: vec4f,
    ray_direction: vec4f,
    ray_dx: vec4f,
    ray_dy: vec4f,
    // Columns of the map from normals in the part's own space.
    normal_x: vec4f,
    normal_y: vec4f,
    normal_z: vec4f,
    // Rows of the map from the space around the view's origin.
    local_x: vec4f,
    local_y: vec4f,
    local_z: vec4f,
    // Rank of its lens.
    lens: u32,
    form: u32,
    flags: u32,
    // Two vectors a plane in `lens_data`: the coefficients along pixels' rays, and the normal with
    // the offset. The first `hidden` are not seen.
    first_plane: u32,
    plane_count: u32,
    hidden: u32,
    // Corners of a flat part in `lens_data`.
    first_corner: u32,
    corner_count: u32,
    // Radii of a cone; length of a capsule.
    r0: f32,
    r1: f32,
    length: f32,
    // A mesh in `lens_words`, and for how many of its crossings each pixel has room.
    first_node: u32,
    node_count: u32,
    first_triangle: u32,
    first_vertex: u32,
    crossing_room: u32,
    // Of a mesh whose faces are listed: its triangles in the picture, four vectors each in `lens_data` (see
    // `cells::ProjectedMesh`), the point of the picture that they start from, and the depth from the eye, or 0, by which
    // their depths are counted.
    first_projected: u32,
    reference: f32,
    origin: vec2f,
}

// Twin of `scene::TextureSlot`.
struct TextureSlot {
    texture: u32,
    uv_set: u32,
    offset: vec2f,
    matrix: vec4f,
}

const SLOT_BASE_COLOR: u32 = 0u;
const SLOT_METALLIC_ROUGHNESS: u32 = 1u;
const SLOT_NORMAL: u32 = 2u;
const SLOT_OCCLUSION: u32 = 3u;
const SLOT_EMISSIVE: u32 = 4u;

// Twin of `scene::MaterialRecord`.
struct Material {
    base_color: vec4f,
    emissive: vec3f,
    alpha_cutoff: f32,
    metallic: f32,
    roughness: f32,
    normal_scale: f32,
    occlusion_strength: f32,
    alpha_mode: u32,
    double_sided: u32,
    unlit: u32,
    pad: u32,
    // By SLOT_...
    slots: array<TextureSlot, 5>,
}

// Twin of `records::TextureInfo`.
struct TextureInfo {
    wrap_u: u32,
    wrap_v: u32,
    filter_bits: u32,
    srgb: u32,
    level_count: u32,
    pad_a: u32,
    pad_b: u32,
    pad_c: u32,
    // Each level's place on the pages: x, y, page, and width with the height in the upper half.
    levels: array<vec4u, 16>,
}

// The scene: as long as it lives.
@group(0) @binding(0) var<storage, read> positions: array<f32>;
@group(0) @binding(1) var<storage, read> indices: array<u32>;
@group(0) @binding(2) var<storage, read> attributes: array<f32>;
@group(0) @binding(3) var<storage, read> materials: array<Material>;
@group(0) @binding(4) var<storage, read> textures: array<TextureInfo>;
@group(0) @binding(5) var pages: texture_2d_array<f32>;
@group(0) @binding(6) var pages_srgb: texture_2d_array<f32>;
@group(0) @binding(7) var<storage, read> numbers: array<u32>;

// The plan: one frame.
@group(1) @binding(0) var<storage, read> frame: Frame;
@group(1) @binding(1) var<storage, read> items: array<Item>;
@group(1) @binding(2) var<storage, read> steps: array<Step>;
@group(1) @binding(3) var<storage, read> lenses: array<Lens>;
@group(1) @binding(4) var<storage, read> parts: array<Part>;
@group(1) @binding(5) var<storage, read> lens_data: array<vec4f>;
// Programs and meshes of lenses.
@group(1) @binding(6) var<storage, read> lens_words: array<u32>;
@group(1) @binding(7) var<storage, read> ops: array<Op>;
@group(1) @binding(8) var<storage, read> lights: array<Light>;
// Four words a tile (see `TileRecord`), then the numbers of all tiles, first of those that lenses touch, then the parts
// of each tile (see `part_at`), then the faces of their cells.
@group(1) @binding(9) var<storage, read> tiles: array<u32>;
// Parameters of the user's own filters.
@group(1) @binding(10) var<storage, read> custom_words: array<u32>;

struct TileRecord {
    // Where the layers of its first pixel are, and how many words each pixel has there.
    layers: u32,
    stride: u32,
    // The parts of lenses that may touch it, in `tiles`.
    first_part: u32,
    part_count: u32,
}

fn tile_columns() -> u32 {
    return (frame.window_size.x + TILE - 1u) / TILE;
}

fn tile_record(tile: u32) -> TileRecord {
    let at = 4u * tile;
    return TileRecord(tiles[at], tiles[at + 1u], tiles[at + 2u], tiles[at + 3u]);
}

fn tile_rows() -> u32 {
    return (frame.window_size.y + TILE - 1u) / TILE;
}

// Of all tiles, first those that lenses touch.
fn tile_in_order(index: u32) -> u32 {
    return tiles[4u * tile_columns() * tile_rows() + index];
}

// Words of a part of a tile; twin of `tiles::PART_WORDS_OF_TILE`.
const PART_WORDS_OF_TILE: u32 = 3u;

// A part of a lens as a ray asks it.
struct AskedPart {
    part: u32,
    // The planes or triangles that may matter, listed in `tiles`; NONE: all of them.
    first: u32,
    end: u32,
}

fn with_all_faces(part: u32) -> AskedPart {
    return AskedPart(part, NONE, NONE);
}

// The number of a part of a tile.
fn part_of_tile(tile: TileRecord, entry: u32) -> u32 {
    return tiles[tile.first_part + PART_WORDS_OF_TILE * entry];
}

// The same as a pixel of the tile asks it: with the faces listed for the cell of the tile that the pixel is in.
fn part_at(tile: TileRecord, entry: u32, pixel: vec2u) -> AskedPart {
    let at = tile.first_part + PART_WORDS_OF_TILE * entry;
    let part = tiles[at];
    if (!HALF_SPACES && !COMPOUNDS) || tiles[at + 1u] == NONE {
        return with_all_faces(part);
    }
    let side = tiles[at + 2u];
    let cell = (pixel % TILE) * side / TILE;
    let place = tiles[at + 1u] + cell.y * side + cell.x;
    return AskedPart(part, tiles[place], tiles[place + 1u]);
}

// Whether a lens has several parts or a mesh: a ray may cross it often.
fn is_compound(rank: u32) -> bool {
    return COMPOUNDS && (lenses[rank].token_count != 0u || parts[lenses[rank].first_part].form == FORM_MESH);
}

// The pixel that an invocation works on in a dispatch over the first so many tiles in their order; outside the window:
// it works on none.
fn pixel_of(group: vec3u, local: vec3u, tiles_in_order: u32) -> vec2u {
    let index = group.y * DISPATCH_WIDTH + group.x;
    if index >= tiles_in_order {
        return vec2u(NONE);
    }
    return tile_corner(tile_in_order(index)) + local.xy;
}

// The pixel in a tile's top left corner.
fn tile_corner(tile: u32) -> vec2u {
    return vec2u(tile % tile_columns(), tile / tile_columns()) * TILE;
}

// The tile of a pixel of the window.
fn tile_at(pixel: vec2u) -> TileRecord {
    return tile_record((pixel.y / TILE) * tile_columns() + pixel.x / TILE);
}

// Where a pixel's layers start.
fn layers_at(tile: TileRecord, pixel: vec2u) -> u32 {
    let local = pixel % TILE;
    return tile.layers + (local.y * TILE + local.x) * tile.stride;
}

// The sample's place in the whole picture, in pixels from its top left corner.
fn sample_point(pixel: vec2u) -> vec2f {
    return vec2f(frame.window_min + pixel) + frame.sample;
}

// Of a perspective camera rays part, of an orthographic one they start side by side; of the former they do that, too,
// where the anchor is not at the eye.
fn pixel_ray(pixel: vec2u) -> PixelRay {
    let at = sample_point(pixel);
    let from_middle = at - frame.middle;
    let dx = frame.ray_dx.xyz;
    let dy = frame.ray_dy.xyz;
    let across = dx * from_middle.x + dy * from_middle.y;
    let s = frame.shares;
    return PixelRay(across * s.x, frame.forward.xyz + across * s.y, dx * s.x, dy * s.x, dx * s.y, dy * s.y, at);
}

fn normalize_or(v: vec3f, other: vec3f) -> vec3f {
    let size = length(v);
    // What is so long that its length is no number has no direction either.
    if size > 1e-30 && size < 1e38 {
        return v / size;
    }
    return other;
}
