//! The shapes, in the order of the format's table.

use crate::spec::keys;

/// One shape of the format.
#[derive(Debug)]
pub struct ShapeRow {
    pub name: &'static str,
    /// Of its table; none for a list of shapes.
    pub keys: &'static [&'static str],
    pub help: &'static str,
    /// What lenses magnify and explode about.
    pub center: &'static str,
}

const fn row(name: &'static str, keys: &'static [&'static str], center: &'static str, help: &'static str) -> ShapeRow {
    ShapeRow { name, keys, help, center }
}

const POINT: &str = "`center`";
const MIDPOINT: &str = "midpoint";
const MIDDLE: &str = "middle of its bounds";
const PLANE: &str = "`point`";
const MEAN: &str = "mean of the parts' centres";

/// The row of a shape.
pub fn shape(name: &str) -> Option<&'static ShapeRow> {
    SHAPES.iter().find(|row| row.name == name)
}

pub const SHAPES: &[ShapeRow] = &[
    row("sphere", keys::SPHERE, POINT, "all points within a radius of a centre"),
    row("ellipsoid", keys::ELLIPSOID, POINT, "a sphere with a radius of its own along each axis"),
    row("box", keys::BOX, "middle", "a cuboid: `center` and `size`, perhaps turned; or `min` and `max`"),
    row("cylinder", keys::CYLINDER, MIDPOINT, "a round solid with flat ends about a line"),
    row("cone", keys::CONE, MIDPOINT, "the same with a radius at each end"),
    row(
        "capsule",
        keys::CAPSULE,
        MIDPOINT,
        "all points within a radius of a line, or of a point where both ends are one",
    ),
    row("polytope", keys::POLYTOPE, MIDDLE, "the points inside all planes; they must leave no side open"),
    row("hull", keys::HULL, MIDDLE, "the convex hull of points"),
    row(
        "mesh",
        keys::MESH,
        MIDDLE,
        "a closed mesh of a glTF file: solids that overlap unite, one inside another turned inwards is a hole",
    ),
    row(
        "halfspace",
        keys::HALF_SPACE,
        PLANE,
        "all that the normal points away from, without an end; it has no `glass` unless that is given",
    ),
    row("slab", keys::SLAB, PLANE, "all between two planes, half the thickness to each side of the point"),
    row("flat", keys::FLAT, "mean of the corners", "what the eye sees through a convex polygon, from either side"),
    row("union", &[], MEAN, "a list of shapes: what any of them holds"),
    row("intersection", &[], MEAN, "a list of shapes: what all of them hold"),
    row("difference", &[], MEAN, "a list of shapes: the first less the others"),
];
