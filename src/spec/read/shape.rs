//! Lens shapes: sizes above zero, axes that point somewhere. Planarity and boundedness need geometry and come later.

use super::item::Item;
use super::number::{difference, length};
use super::table::{Table, only_entry};
use super::{keys, suggest};
use crate::InputError;
use crate::spec::catalogue::SHAPES;
use crate::spec::range::SMALLEST_SIZE;
use crate::spec::{At, Convex, MeshShape, NumberRange, Rotation, Shape};

const WANTED: &str = "one shape, such as { sphere = { center = [0, 0, 0], radius = 1 } }";

/// How many compounds a shape may be inside of.
const DEEPEST: usize = 16;

pub fn read(item: &Item) -> Result<At<Shape>, InputError> {
    nested(item, 0)
}

fn nested(item: &Item, depth: usize) -> Result<At<Shape>, InputError> {
    let inner = only_entry(item, WANTED)?;
    let shape = match inner.name.as_str() {
        "sphere" => sphere(&open(&inner, keys::SPHERE)?),
        "ellipsoid" => ellipsoid(&open(&inner, keys::ELLIPSOID)?),
        "box" => cuboid(&open(&inner, keys::BOX)?),
        "cylinder" => cylinder(&open(&inner, keys::CYLINDER)?),
        "cone" => cone(&open(&inner, keys::CONE)?),
        "capsule" => capsule(&open(&inner, keys::CAPSULE)?),
        "polytope" => polytope(&open(&inner, keys::POLYTOPE)?),
        "hull" => hull(&open(&inner, keys::HULL)?),
        "halfspace" => half_space(&open(&inner, keys::HALF_SPACE)?),
        "slab" => slab(&open(&inner, keys::SLAB)?),
        "flat" => flat(&open(&inner, keys::FLAT)?),
        "mesh" => mesh(&open(&inner, keys::MESH)?),
        "union" => list(&inner, depth).map(Shape::Union),
        "intersection" => list(&inner, depth).map(Shape::Intersection),
        "difference" => list(&inner, depth).map(Shape::Difference),
        other => {
            let names = SHAPES.iter().map(|row| row.name);
            Err(inner.error_at_key(format!("there is no shape `{other}`")).help(suggest::help(other, names)))
        }
    }?;
    Ok(inner.at(shape))
}

fn open<'a>(item: &Item<'a>, keys: &'static [&'static str]) -> Result<Table<'a>, InputError> {
    Table::open(item, format!("shape `{}`", item.name), keys)
}

fn size(table: &Table, key: &'static str) -> Result<f64, InputError> {
    table.need(key)?.number(NumberRange::POSITIVE)
}

fn sphere(table: &Table) -> Result<Shape, InputError> {
    Ok(Shape::Sphere { center: table.need("center")?.vector()?, radius: size(table, "radius")? })
}

fn ellipsoid(table: &Table) -> Result<Shape, InputError> {
    Ok(Shape::Ellipsoid {
        center: table.need("center")?.vector()?,
        radii: table.need("radii")?.numbers(NumberRange::POSITIVE)?,
        rotation: rotation(table)?,
    })
}

fn rotation(table: &Table) -> Result<Rotation, InputError> {
    Ok(table.read("rotation", Item::rotation).unwrap_or_default())
}

fn cuboid(table: &Table) -> Result<Shape, InputError> {
    let by_corners = table.get("min").or(table.get("max"));
    let by_center = table.get("center").or(table.get("size")).or(table.get("rotation"));
    match (by_corners, by_center) {
        (Some(corner), Some(other)) => Err(corner
            .error(format!("shape `box` has both `{}` and `{}`", corner.name, other.name))
            .help("write `center`, `size` and perhaps `rotation`, or `min` and `max`")
            .label(other.span, "and here")),
        (Some(_), None) => box_of_corners(table),
        (None, _) => Ok(Shape::Box {
            center: table.need("center")?.vector()?,
            size: table.need("size")?.numbers(NumberRange::POSITIVE)?,
            rotation: rotation(table)?,
        }),
    }
}

fn box_of_corners(table: &Table) -> Result<Shape, InputError> {
    let min = table.need("min")?.vector()?;
    let max_item = table.need("max")?;
    let max = max_item.vector()?;
    let size = difference(max, min);
    for (axis, (extent, name)) in size.iter().zip(["x", "y", "z"]).enumerate() {
        if *extent < SMALLEST_SIZE {
            let message = format!("`max` must be above `min` in {name}: {} is not above {}", max[axis], min[axis]);
            return Err(max_item.error(message));
        }
    }
    let center = std::array::from_fn(|i| min[i] + size[i] / 2.0);
    Ok(Shape::Box { center, size, rotation: Rotation::default() })
}

/// The two ends of an axis that must have a length.
fn axis(table: &Table) -> Result<[[f64; 3]; 2], InputError> {
    let from = table.need("from")?.vector()?;
    let to_item = table.need("to")?;
    let to = to_item.vector()?;
    if length(difference(to, from)) < SMALLEST_SIZE {
        return Err(to_item
            .error(format!("{} has no height: `from` and `to` are the same point", table.name))
            .help("move one of them"));
    }
    Ok([from, to])
}

fn cylinder(table: &Table) -> Result<Shape, InputError> {
    let [from, to] = axis(table)?;
    Ok(Shape::Cylinder { from, to, radius: size(table, "radius")? })
}

fn cone(table: &Table) -> Result<Shape, InputError> {
    let [from, to] = axis(table)?;
    let [from_radius, to_radius] = [cone_radius(table, "from_radius")?, cone_radius(table, "to_radius")?];
    if from_radius == 0.0 && to_radius == 0.0 {
        return Err(table.error("shape `cone` has both radii zero").help("at most one of them may be 0, at the tip"));
    }
    Ok(Shape::Cone { from, to, from_radius, to_radius })
}

/// Zero at the tip, else a size like any other.
fn cone_radius(table: &Table, key: &'static str) -> Result<f64, InputError> {
    let item = table.need(key)?;
    let radius = item.number(NumberRange::NOT_NEGATIVE)?;
    if radius == 0.0 { Ok(0.0) } else { item.number(NumberRange::POSITIVE) }
}

fn capsule(table: &Table) -> Result<Shape, InputError> {
    Ok(Shape::Capsule {
        from: table.need("from")?.vector()?,
        to: table.need("to")?.vector()?,
        radius: size(table, "radius")?,
    })
}

fn polytope(table: &Table) -> Result<Shape, InputError> {
    let item = table.need("planes")?;
    let rows = item.list("a list of planes [nx, ny, nz, d]")?;
    if rows.len() < 4 {
        return Err(item
            .error(format!("`planes` needs at least 4 planes, but has {}", rows.len()))
            .help("fewer cannot bound a volume"));
    }
    Ok(Shape::Polytope { planes: rows.iter().map(plane).collect::<Result<_, _>>()? })
}

fn plane(item: &Item) -> Result<[f64; 4], InputError> {
    let [x, y, z, d] = item.numbers(NumberRange::ANY)?;
    if length([x, y, z]) < SMALLEST_SIZE {
        return Err(item.error("this plane's normal [nx, ny, nz] has length zero").help("it must point outwards"));
    }
    Ok([x, y, z, d])
}

fn hull(table: &Table) -> Result<Shape, InputError> {
    Ok(Shape::Hull { points: table.need("points")?.points(4)? })
}

fn half_space(table: &Table) -> Result<Shape, InputError> {
    Ok(Shape::HalfSpace { point: table.need("point")?.vector()?, normal: normal(table)? })
}

fn slab(table: &Table) -> Result<Shape, InputError> {
    Ok(Shape::Slab {
        point: table.need("point")?.vector()?,
        normal: normal(table)?,
        thickness: size(table, "thickness")?,
    })
}

/// A direction, of any length but zero.
fn normal(table: &Table) -> Result<[f64; 3], InputError> {
    let item = table.need("normal")?;
    let normal = item.vector()?;
    if length(normal) < SMALLEST_SIZE {
        return Err(item
            .error(format!("`normal` of {} has length zero", table.name))
            .help("it must point somewhere, such as [0, 1, 0]"));
    }
    Ok(normal)
}

fn flat(table: &Table) -> Result<Shape, InputError> {
    Ok(Shape::Flat {
        corners: table.need("corners")?.points(3)?,
        depth: table.read("depth", |item| item.number(NumberRange::POSITIVE)),
    })
}

fn mesh(table: &Table) -> Result<Shape, InputError> {
    let convex = |item: &Item| item.choice(&[("hull", Convex::Hull), ("decompose", Convex::Decompose)]);
    Ok(Shape::Mesh(MeshShape {
        file: table.need("file")?.path()?,
        node: table.read("node", |item| Ok(item.at(item.text()?.to_owned()))),
        convex: table.read("convex", convex).unwrap_or(Convex::AsItStands),
    }))
}

/// The entries of a compound that is itself `depth` deep in others.
fn list(item: &Item, depth: usize) -> Result<Vec<At<Shape>>, InputError> {
    let parts = item.list("a list of shapes, such as [{ sphere = { ... } }, { box = { ... } }]")?;
    if parts.is_empty() {
        return Err(item.error(format!("shape `{}` has no parts", item.name)).help("list at least one shape"));
    }
    if depth == DEEPEST {
        let message = format!("shapes are nested more than {DEEPEST} deep");
        return Err(item.error_at_key(message).help("a union in a union may as well be one list"));
    }
    parts.iter().map(|part| nested(part, depth + 1)).collect()
}
