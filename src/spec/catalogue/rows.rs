//! The catalogue itself, in the order of the format's table.

use super::FilterKind::{Color as Colour, Content, Coverage, Custom, Screen, Surface};
use super::ParamDefault::{Bool as Yes, Color as Hex, Meaning, Number as Num, Required, Text as Word};
use super::ParamKind::{
    Bool, Cap, Choice, Color, ColorMap, File, FreeTable, Integer, Interval, Number, NumberOrPair, Outline, Patterns,
    Text, Vector,
};
use super::{FilterKind, FilterRow, Param, ParamDefault, ParamKind};
use crate::spec::NumberRange;

const PIXELS: ParamKind = Number(NumberRange::closed(0.0, 1000.0));
const LINE_PIXELS: ParamKind = Number(NumberRange::closed(1.0, 1000.0));
/// How far a filter of the finished picture may look, and how wide its lines may be, in pixels.
pub const LINE_WIDTH: NumberRange = NumberRange::closed(0.0, 100.0);
const SCREEN_PIXELS: ParamKind = Number(LINE_WIDTH);
const UNIT: ParamKind = Number(NumberRange::UNIT);
const OWN: ParamDefault = Meaning("the surface's own");
const FITTED: ParamDefault = Meaning("fitted to what is seen");
const EVERYTHING: ParamDefault = Meaning("everything");

const fn param(name: &'static str, kind: ParamKind, default: ParamDefault, help: &'static str) -> Param {
    Param { name, kind, default, help }
}

const fn filter(name: &'static str, kind: FilterKind, help: &'static str, params: &'static [Param]) -> FilterRow {
    FilterRow { name, kind, moves: false, help, params, picture: None }
}

const fn mover(row: FilterRow) -> FilterRow {
    FilterRow { moves: true, ..row }
}

/// A filter that another picture than the one of its name shows best.
const fn pictured(picture: &'static str, row: FilterRow) -> FilterRow {
    FilterRow { picture: Some(picture), ..row }
}

/// All filters, in the order of the format's table.
pub const FILTERS: &[FilterRow] = &[
    filter("wireframe", Coverage, "draws triangle edges, anti-aliased", WIREFRAME),
    filter("points", Coverage, "draws vertices as discs", POINTS),
    filter("erase", Content, "removes what it matches", ERASE),
    pictured(
        "show-alternate.png",
        filter("show", Content, "shows another content here: an alternate or some of it, or exactly these nodes", SHOW),
    ),
    filter("lod", Content, "shows a simplified version", LOD),
    pictured("../movers/magnify.png", mover(filter("magnify", Content, "enlarges what is inside", MAGNIFY))),
    pictured("../movers/displace.png", mover(filter("displace", Content, "moves matched nodes", DISPLACE))),
    filter("opacity", Surface, "multiplies the opacity", OPACITY),
    filter("ghost", Surface, "x-ray look: opacity from the view angle", GHOST),
    filter("tint", Colour, "mixes a colour in", TINT),
    filter("grayscale", Colour, "takes the colour out", GRAYSCALE),
    filter("invert", Colour, "inverts the colour", INVERT),
    filter("brightness", Colour, "multiplies the brightness", BRIGHTNESS),
    filter("unlit", Surface, "no lighting", UNLIT),
    pictured("material-all.png", filter("material", Surface, "overrides the material", MATERIAL)),
    pictured("texture-box.png", filter("texture", Surface, "replaces the base colour texture", TEXTURE)),
    filter("normals", Surface, "false colour by the surface normal", NORMALS),
    filter("depth", Surface, "false colour by depth along the camera's forward axis", FALSE_COLOR),
    filter("height", Surface, "false colour by height", FALSE_COLOR),
    filter("curvature", Surface, "false colour by curvature", FALSE_COLOR),
    filter("attribute", Surface, "false colour by a vertex attribute", ATTRIBUTE),
    filter("contours", Surface, "iso-lines of height or another quantity", CONTOURS),
    filter("toon", Surface, "light in a few flat steps", TOON),
    filter("hatch", Surface, "light as pen strokes", HATCH),
    filter("edges", Screen, "silhouettes, creases, and borders of regions and of caps", EDGES),
    filter("blur", Screen, "blurs, to push context back", BLUR),
    filter("pixelate", Screen, "coarse pixels, to push context back", PIXELATE),
    pictured("../wgsl/stripes.png", filter("wgsl", Custom, "a filter of your own, in WGSL", WGSL)),
];

const WIREFRAME: &[Param] = &[
    param("width", PIXELS, Num(1.0), "of the lines, pixels"),
    param("color", Color, OWN, "of the lines"),
    param("fill", UNIT, Num(0.0), "opacity between the lines"),
    param("hidden", Bool, Yes(true), "draw the lines that nearer surfaces of the lens would hide"),
    param("edges", Choice(&["all", "feature"]), Word("all"), "`feature` leaves out the diagonals of flat polygons"),
];
const POINTS: &[Param] = &[param("size", PIXELS, Num(3.0), "of the discs, pixels")];
const ERASE: &[Param] = &[
    param("nodes", Patterns, EVERYTHING, "nodes that go"),
    param("materials", Patterns, EVERYTHING, "materials that go"),
    param("cap", Cap, Meaning("open"), "closes cut solids: in a colour, their own or hatched"),
    param("outline", Outline, Meaning("none"), "a line around each cap; width in pixels"),
];
const SHOW: &[Param] = &[
    param("alternate", Text, Meaning("the scene, of which give nodes"), "a name under [scene.alternates]"),
    param("nodes", Patterns, Meaning("all of the alternate"), "these nodes; of the scene hidden ones, too"),
    param("materials", Patterns, Meaning("all of the alternate"), "of the alternate, what has these materials"),
];
const LOD: &[Param] = &[param("ratio", Number(NumberRange::closed(0.001, 1.0)), Num(0.1), "of triangles kept")];
const MAGNIFY: &[Param] = &[
    param("factor", Number(NumberRange::POSITIVE), Num(2.0), "how many times larger"),
    param(
        "center",
        Vector,
        Meaning("the lens's centre; of a flat lens the line of sight to it"),
        "fixed point, in the shape's space",
    ),
];
const DISPLACE: &[Param] = &[
    param("nodes", Patterns, EVERYTHING, "nodes that move"),
    param("offset", Vector, Meaning("none"), "by this much along the scene's axes, scene units"),
    param(
        "explode",
        Number(NumberRange::ANY),
        Meaning("0.5 without an offset, else 0"),
        "each by this times the way from the lens's centre to its own",
    ),
];
const OPACITY: &[Param] = &[param("value", UNIT, Num(0.5), "factor")];
const GHOST: &[Param] = &[
    param("strength", UNIT, Num(1.0), "how clear it gets face on"),
    param("color", Color, OWN, "that it glows in, unlit"),
];
const TINT: &[Param] =
    &[param("color", Color, Hex("#3fa7ff"), "what is mixed in"), param("amount", UNIT, Num(0.5), "how much")];
const GRAYSCALE: &[Param] = &[param("amount", UNIT, Num(1.0), "how much")];
const INVERT: &[Param] = &[param("amount", UNIT, Num(1.0), "how much")];
const BRIGHTNESS: &[Param] =
    &[param("amount", Number(NumberRange::NOT_NEGATIVE), Num(1.5), "factor; 1 changes nothing")];
const UNLIT: &[Param] = &[param("color", Color, OWN, "of the surface")];
const MATERIAL: &[Param] = &[
    param("color", Color, OWN, "base colour"),
    param("metallic", UNIT, OWN, "1 for metals"),
    param("roughness", UNIT, OWN, "0 is a mirror"),
    param("emissive", Color, OWN, "light of its own"),
];
const TEXTURE: &[Param] = &[
    param("file", File, Required, "PNG or JPEG"),
    param("uv", Choice(UV), Word("mesh"), "where the texture lies"),
    param("scale", NumberOrPair(NumberRange::ANY), Num(1.0), "repetitions over the unit of the mapping"),
];
const UV: &[&str] = &["mesh", "planar-x", "planar-y", "planar-z", "box", "sphere"];
const NORMALS: &[Param] = &[
    param(
        "colormap",
        ColorMap,
        Meaning("x, y, z as red, green, blue"),
        "colours of the slope: 1 level, 0 upright, -1 from below",
    ),
    param("range", Interval, Meaning("-1 to 1"), "slopes at the ends of the colours; may run backwards"),
];
const FALSE_COLOR: &[Param] = &[
    param("colormap", ColorMap, Word("viridis"), "colours of the values"),
    param("range", Interval, FITTED, "values at the ends of the colours; may run backwards"),
];
const ATTRIBUTE: &[Param] = &[
    param("name", Text, Required, "of the attribute, such as _TEMPERATURE"),
    param("colormap", ColorMap, Word("viridis"), "colours of the values"),
    param("range", Interval, FITTED, "values at the ends of the colours; may run backwards"),
];
const CONTOURS: &[Param] = &[
    param(
        "spacing",
        Number(NumberRange::POSITIVE),
        Meaning("about a tenth of the scene's range"),
        "between lines, in the quantity's units",
    ),
    param("width", PIXELS, Num(1.0), "of the lines, pixels"),
    param("quantity", Text, Word("height"), "height, depth, curvature, or a vertex attribute such as _TEMPERATURE"),
    param("color", Color, Hex("#1a1a1a"), "of the lines"),
];
const TOON: &[Param] = &[param("levels", Integer(2, 16), Num(3.0), "steps from dark to full light")];
const HATCH: &[Param] = &[
    param("spacing", LINE_PIXELS, Num(6.0), "between lines, pixels"),
    param("width", PIXELS, Num(1.5), "of the lines, pixels"),
    param("color", Color, Hex("#1a1a1a"), "of the lines"),
];
const EDGES: &[Param] = &[
    param("color", Color, Hex("#000000"), "of the lines"),
    param("width", SCREEN_PIXELS, Num(1.0), "of the lines, pixels"),
    param("threshold", UNIT, Num(0.1), "what counts as an edge"),
];
const BLUR: &[Param] = &[param("radius", SCREEN_PIXELS, Num(4.0), "pixels")];
const PIXELATE: &[Param] = &[param("radius", SCREEN_PIXELS, Num(4.0), "pixels, of squares of 2 radius + 1")];
const WGSL: &[Param] = &[
    param("file", File, Required, "with fn filter_surface or fn filter_color"),
    param("params", FreeTable, Meaning("none"), "checked against the file's Params struct"),
];
