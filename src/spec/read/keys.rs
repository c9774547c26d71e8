//! The keys of every table of the format but the filters', which the catalogue lists.
//! The readers, the JSON Schema and the page of the format are held to these lists, and the page has them in this order.

pub const DOCUMENT: &[&str] = &["version", "scene", "camera", "image", "light", "lens", "overlap", "animation"];
pub const SCENE: &[&str] = &["file", "scene", "time", "hide", "backfaces", "alternates"];
pub const CAMERA: &[&str] = &["eye", "target", "up", "fov_y", "orthographic_height", "near", "far", "node"];
pub const IMAGE: &[&str] = &["size", "samples", "background", "tone_mapping", "legend"];
pub const LIGHT: &[&str] = &["ambient", "directional"];
pub const DIRECTIONAL: &[&str] = &["direction", "color", "intensity"];
pub const LENS: &[&str] = &[
    "name",
    "enabled",
    "shape",
    "attach",
    "translation",
    "rotation",
    "scale",
    "filters",
    "over",
    "under",
    "hides",
    "overlap",
    "priority",
    "by",
    "only",
    "except",
    "soft",
    "glass",
];
pub const ATTACH: &[&str] = &["node"];
pub const MATCHES: &[&str] = &["nodes", "materials"];
pub const GLASS: &[&str] = &["color", "opacity", "rim", "outline", "contact"];
pub const OUTLINE: &[&str] = &["width", "color"];
pub const OVERLAP: &[&str] = &["when", "filters"];
pub const ANIMATION: &[&str] = &["duration", "fps", "track"];
pub const TRACK: &[&str] = &["target", "keys", "ease"];

// Of the shapes.
pub const SPHERE: &[&str] = &["center", "radius"];
pub const ELLIPSOID: &[&str] = &["center", "radii", "rotation"];
pub const BOX: &[&str] = &["center", "size", "rotation", "min", "max"];
pub const CYLINDER: &[&str] = &["from", "to", "radius"];
pub const CONE: &[&str] = &["from", "to", "from_radius", "to_radius"];
pub const CAPSULE: &[&str] = &["from", "to", "radius"];
pub const POLYTOPE: &[&str] = &["planes"];
pub const HULL: &[&str] = &["points"];
pub const MESH: &[&str] = &["file", "node", "convex"];
pub const HALF_SPACE: &[&str] = &["point", "normal"];
pub const SLAB: &[&str] = &["point", "normal", "thickness"];
pub const FLAT: &[&str] = &["corners", "depth"];
