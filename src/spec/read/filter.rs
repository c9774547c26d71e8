//! Filters: a bare name or a one-key table, checked against the catalogue.

use std::ops::Range;
use std::path::PathBuf;

use toml::de::{DeTable, DeValue};

use super::item::{File, Item, kind_of};
use super::suggest;
use super::table::{entries, only_entry};
use super::{cap, color};
use crate::InputError;
use crate::color_map;
use crate::custom::{self, Given};
use crate::spec::catalogue::{self, FILTERS, FilterRow, Param, ParamDefault, ParamKind};
use crate::spec::{
    At, Cap, Color, Filter, Matches, NumberRange, Outline, Pattern, Quantity, ShowWhat, UvMapping, WireEdges,
};

/// A parameter's value, of the type its [`ParamKind`] says.
#[derive(Debug, Clone, PartialEq)]
enum Value {
    Number(f64),
    Pair([f64; 2]),
    Vector([f64; 3]),
    Color(Color),
    Bool(bool),
    Text(At<String>),
    File(At<PathBuf>),
    Patterns(Vec<At<Pattern>>),
    Cap(Cap),
    Outline(Outline),
    /// Checked against the filter's own file.
    Free(Vec<Given>),
}

/// The filters of a lens or a rule, first to act first.
pub fn list(item: &Item) -> Result<Vec<At<Filter>>, InputError> {
    item.each("a list of filters, such as [\"wireframe\"]", one)
}

/// The filters of an overlap rule, which may not move content (SEMANTICS 4).
pub fn list_that_stays(item: &Item) -> Result<Vec<At<Filter>>, InputError> {
    for filter in item.list("a list of filters, such as [\"unlit\"]")? {
        let (row, item, _) = named(&filter)?;
        if row.moves {
            return Err(item
                .error_at_key(format!("filter `{}` moves content, which an overlap rule may not", row.name))
                .help("move it to a lens"));
        }
    }
    list(item)
}

fn one(item: &Item) -> Result<At<Filter>, InputError> {
    let (row, item, table) = named(item)?;
    let params = Params::read(row, &item, table)?;
    Ok(item.at(build(row, &params)?))
}

/// The catalogue's row of a filter, its place, and its table of parameters if it has one.
fn named<'a>(item: &Item<'a>) -> Result<(&'static FilterRow, Item<'a>, Option<&'a DeTable<'a>>), InputError> {
    if let DeValue::String(name) = item.value {
        return Ok((row(name, item)?, item.clone(), None));
    }
    let inner = only_entry(item, "a filter's name, or one such as { tint = { amount = 0.4 } }")?;
    let row = row(&inner.name, &inner)?;
    match inner.value {
        DeValue::Table(map) => Ok((row, inner, Some(map))),
        _ => Err(not_parameters(&inner, row)),
    }
}

fn row(name: &str, item: &Item) -> Result<&'static FilterRow, InputError> {
    catalogue::filter(name).ok_or_else(|| {
        let names = FILTERS.iter().map(|row| row.name);
        item.error_at_key(format!("there is no filter `{name}`")).help(suggest::help(name, names))
    })
}

fn not_parameters(item: &Item, row: &FilterRow) -> InputError {
    let example = match row.params {
        [] => "{}".to_owned(),
        [first, ..] => format!("{{ {} = ... }}", first.name),
    };
    item.error(format!("filter `{}` takes a table of parameters, not {}", row.name, kind_of(item.value)))
        .help(format!("write {{ {} = {example} }}", row.name))
}

/// The values of one filter's parameters, defaults filled in.
struct Params<'a> {
    file: &'a File<'a>,
    row: &'static FilterRow,
    /// `None` where the default is a meaning rather than a value.
    values: Vec<(&'static str, Option<Value>)>,
    span: Range<usize>,
}

impl<'a> Params<'a> {
    fn read(row: &'static FilterRow, item: &Item<'a>, table: Option<&'a DeTable<'a>>) -> Result<Self, InputError> {
        let mut params = Self { file: item.file, row, values: Vec::new(), span: item.span.clone() };
        let given = table.map(entries).unwrap_or_default();
        for (key, span, _) in &given {
            if row.param(key).is_none() {
                return Err(params.unknown(key, span.clone()));
            }
        }
        for param in row.params {
            let value = match given.iter().find(|(key, ..)| *key == param.name) {
                Some((_, _, value)) => Some(read(param.kind, &Item::new(item.file, param.name, value))?),
                None => params.default(param)?,
            };
            params.values.push((param.name, value));
        }
        Ok(params)
    }

    fn unknown(&self, key: &str, span: Range<usize>) -> InputError {
        let error = InputError::at(self.file.source, span, format!("filter `{}` has no `{key}`", self.row.name));
        match self.row.params {
            [] => error.help("it has no parameters"),
            params => error.help(suggest::help(key, params.iter().map(|param| param.name))),
        }
    }

    fn default(&self, param: &Param) -> Result<Option<Value>, InputError> {
        Ok(match (param.default, param.kind) {
            (ParamDefault::Number(x), ParamKind::NumberOrPair(_)) => Some(Value::Pair([x, x])),
            (ParamDefault::Number(x), _) => Some(Value::Number(x)),
            (ParamDefault::Color(text), _) => color::parse(text).map(Value::Color),
            (ParamDefault::Text(text), _) => Some(Value::Text(At::new(text.to_owned(), self.span.clone()))),
            (ParamDefault::Bool(value), _) => Some(Value::Bool(value)),
            (ParamDefault::Meaning(_), _) => None,
            (ParamDefault::Required, _) => {
                return Err(self
                    .error(format!("filter `{}` needs `{}`", self.row.name, param.name))
                    .help(format!("such as {{ {} = {{ {} = ... }} }}: {}", self.row.name, param.name, param.help)));
            }
        })
    }

    fn error(&self, message: String) -> InputError {
        InputError::at(self.file.source, self.span.clone(), message)
    }

    fn get(&self, name: &str) -> Option<&Value> {
        self.values.iter().find(|(key, _)| *key == name)?.1.as_ref()
    }

    /// A number where the row has a default number or the file one; else `None`.
    fn number(&self, name: &str) -> Option<f32> {
        self.double(name).map(|value| value as f32)
    }

    /// The same for what geometry is computed from.
    fn double(&self, name: &str) -> Option<f64> {
        match self.get(name)? {
            Value::Number(value) => Some(*value),
            _ => None,
        }
    }

    fn vector(&self, name: &str) -> Option<[f64; 3]> {
        match self.get(name)? {
            Value::Vector(vector) => Some(*vector),
            _ => None,
        }
    }

    fn color(&self, name: &str) -> Option<Color> {
        match self.get(name)? {
            Value::Color(color) => Some(*color),
            _ => None,
        }
    }

    fn patterns(&self, name: &str) -> Option<Vec<At<Pattern>>> {
        match self.get(name)? {
            Value::Patterns(patterns) => Some(patterns.clone()),
            _ => None,
        }
    }

    fn cap(&self, name: &str) -> Option<Cap> {
        match self.get(name)? {
            Value::Cap(cap) => Some(*cap),
            _ => None,
        }
    }

    fn outline(&self, name: &str) -> Option<Outline> {
        match self.get(name)? {
            Value::Outline(outline) => Some(*outline),
            _ => None,
        }
    }

    fn text(&self, name: &str) -> Option<At<String>> {
        match self.get(name)? {
            Value::Text(text) => Some(text.clone()),
            _ => None,
        }
    }

    fn boolean(&self, name: &str) -> Option<bool> {
        match self.get(name)? {
            Value::Bool(value) => Some(*value),
            _ => None,
        }
    }

    /// The two ends of a range.
    fn range(&self, name: &str) -> Option<[f64; 2]> {
        match self.get(name)? {
            Value::Pair(range) => Some(*range),
            _ => None,
        }
    }

    fn free(&self, name: &str) -> Vec<Given> {
        match self.get(name) {
            Some(Value::Free(given)) => given.clone(),
            _ => Vec::new(),
        }
    }

    fn path(&self, name: &str) -> Option<At<PathBuf>> {
        match self.get(name)? {
            Value::File(path) => Some(path.clone()),
            _ => None,
        }
    }

    fn pair(&self, name: &str) -> Option<[f32; 2]> {
        match self.get(name)? {
            Value::Pair(pair) => Some(pair.map(|x| x as f32)),
            _ => None,
        }
    }
}

fn read(kind: ParamKind, item: &Item) -> Result<Value, InputError> {
    Ok(match kind {
        ParamKind::Number(range) => Value::Number(item.number(range)?),
        ParamKind::Integer(min, max) => Value::Number(item.integer(min, max)? as f64),
        ParamKind::NumberOrPair(range) => Value::Pair(number_or_pair(item, range)?),
        ParamKind::Interval => Value::Pair(interval(item)?),
        ParamKind::Color => Value::Color(item.color()?),
        ParamKind::Bool => Value::Bool(item.boolean()?),
        ParamKind::Text => Value::Text(item.at(item.text()?.to_owned())),
        ParamKind::File => Value::File(item.path()?),
        ParamKind::Choice(words) => {
            let choices: Vec<_> = words.iter().map(|word| (*word, *word)).collect();
            Value::Text(item.at(item.choice(&choices)?.to_owned()))
        }
        ParamKind::ColorMap => Value::Text(item.at(color_map(item)?.to_owned())),
        ParamKind::Patterns => Value::Patterns(item.patterns()?),
        ParamKind::Vector => Value::Vector(item.vector()?),
        ParamKind::Cap => Value::Cap(cap::read(item)?),
        ParamKind::Outline => Value::Outline(cap::outline(item)?),
        ParamKind::FreeTable => Value::Free(free_table(item)?),
    })
}

/// Numbers, lists of them, texts and truth values by name.
fn free_table(item: &Item) -> Result<Vec<Given>, InputError> {
    let DeValue::Table(map) = item.value else { return Err(item.wrong_type("a table")) };
    let given = entries(map).into_iter().map(|(name, _, value)| {
        let item = Item::new(item.file, name, value);
        let value = match item.value {
            DeValue::Integer(_) | DeValue::Float(_) => custom::Value::Number(item.number(NumberRange::ANY)?),
            DeValue::Boolean(value) => custom::Value::Bool(*value),
            DeValue::String(_) => custom::Value::Text(item.text()?.to_owned()),
            DeValue::Array(_) => {
                let numbers = item.list("a list of numbers")?;
                let numbers = numbers.iter().map(|number| number.number(NumberRange::ANY));
                custom::Value::Numbers(numbers.collect::<Result<_, _>>()?)
            }
            _ => return Err(item.wrong_type("a number, a list of numbers, a text, true or false")),
        };
        Ok(Given { name: name.to_owned(), span: item.span.clone(), value })
    });
    given.collect()
}

fn number_or_pair(item: &Item, range: NumberRange) -> Result<[f64; 2], InputError> {
    match item.value {
        DeValue::Array(_) => item.numbers(range),
        _ => item.number(range).map(|x| [x, x]),
    }
}

fn interval(item: &Item) -> Result<[f64; 2], InputError> {
    let [first, last] = item.numbers(NumberRange::ANY)?;
    if first != last {
        return Ok([first, last]);
    }
    Err(item.error(format!("`{}` must be two numbers that differ, not [{first}, {last}]", item.name)))
}

/// A known name, reversed or not.
fn color_map<'a>(item: &Item<'a>) -> Result<&'a str, InputError> {
    let name = item.text()?;
    if color_map::colors(name).is_some() {
        return Ok(name);
    }
    let names: Vec<_> = color_map::NAMES.iter().map(|name| (*name, *name)).collect();
    item.choice(&names)
}

fn build(row: &FilterRow, params: &Params) -> Result<Filter, InputError> {
    let filter = match row.name {
        "wireframe" => wireframe(params),
        "erase" => Some(erase(params)?),
        "show" => Some(Filter::Show(show(params)?)),
        "lod" => params.number("ratio").map(|ratio| Filter::Lod { ratio }),
        "magnify" => params.double("factor").map(|factor| Filter::Magnify { factor, center: params.vector("center") }),
        "displace" => Some(displace(params)),
        "opacity" => params.number("value").map(|value| Filter::Opacity { value }),
        "tint" => {
            params.color("color").zip(params.number("amount")).map(|(color, amount)| Filter::Tint { color, amount })
        }
        "grayscale" => params.number("amount").map(|amount| Filter::Grayscale { amount }),
        "invert" => params.number("amount").map(|amount| Filter::Invert { amount }),
        "unlit" => Some(Filter::Unlit { color: params.color("color") }),
        "material" => Some(material(params)),
        "texture" => texture(params),
        "normals" => Some(normals(params)?),
        "points" => params.number("size").map(|size| Filter::Points { size }),
        "ghost" => params.number("strength").map(|strength| Filter::Ghost { strength, color: params.color("color") }),
        "brightness" => params.number("amount").map(|amount| Filter::Brightness { amount }),
        "depth" => false_color(params, Quantity::Depth),
        "height" => false_color(params, Quantity::Height),
        "curvature" => false_color(params, Quantity::Curvature),
        "attribute" => params.text("name").and_then(|name| false_color(params, Quantity::Attribute(name))),
        "contours" => Some(contours(params)?),
        "toon" => params.number("levels").map(|levels| Filter::Toon { levels: levels as u32 }),
        "hatch" => hatch(params),
        "edges" => edges(params),
        "wgsl" => params.path("file").map(|file| Filter::Wgsl { file, params: params.free("params") }),
        "blur" => params.number("radius").map(|radius| Filter::Blur { radius }),
        "pixelate" => params.number("radius").map(|radius| Filter::Pixelate { radius }),
        _ => None,
    };
    filter.ok_or_else(|| params.error(format!("filter `{}` cannot be made from its catalogue row", row.name)))
}

fn erase(params: &Params) -> Result<Filter, InputError> {
    let (cap, outline) = (params.cap("cap"), params.outline("outline"));
    if outline.is_some() && cap.is_none() {
        let error = params.error("`outline` of filter `erase` goes around caps, and there are none".to_owned());
        return Err(error.help("give it a `cap`, such as { erase = { cap = \"own\", outline = { width = 1.5 } } }"));
    }
    let [nodes, materials] = ["nodes", "materials"].map(|name| params.patterns(name).unwrap_or_default());
    Ok(Filter::Erase { nodes, materials, cap, outline })
}

fn wireframe(params: &Params) -> Option<Filter> {
    Some(Filter::Wireframe {
        width: params.number("width")?,
        color: params.color("color"),
        fill: params.number("fill")?,
        hidden: params.boolean("hidden")?,
        edges: match params.text("edges")?.value.as_str() {
            "all" => WireEdges::All,
            "feature" => WireEdges::Feature,
            _ => return None,
        },
    })
}

fn show(params: &Params) -> Result<ShowWhat, InputError> {
    const REMEDY: &str = "write { show = { alternate = \"name\" } } or { show = { nodes = [\"name\"] } }";
    let (nodes, materials) = (params.patterns("nodes"), params.patterns("materials"));
    match (params.text("alternate"), nodes, materials) {
        (Some(name), nodes, materials) => {
            let only = Matches { nodes: nodes.unwrap_or_default(), materials: materials.unwrap_or_default() };
            Ok(ShowWhat::Alternate { name, only })
        }
        (None, Some(nodes), None) => Ok(ShowWhat::Nodes(nodes)),
        (None, None, None) => Err(params.error("filter `show` needs `alternate` or `nodes`".to_owned()).help(REMEDY)),
        (None, _, Some(_)) => Err(params
            .error("`materials` of filter `show` needs an `alternate`".to_owned())
            .help("of the scene it shows `nodes`; `only` limits the lens to materials")),
    }
}

/// What `displace` does when nothing else is said.
const EXPLODE: f64 = 0.5;

fn displace(params: &Params) -> Filter {
    let offset = params.vector("offset");
    Filter::Displace {
        nodes: params.patterns("nodes").unwrap_or_default(),
        offset: offset.unwrap_or_default(),
        explode: params.double("explode").unwrap_or(if offset.is_some() { 0.0 } else { EXPLODE }),
    }
}

fn material(params: &Params) -> Filter {
    Filter::Material {
        color: params.color("color"),
        metallic: params.number("metallic"),
        roughness: params.number("roughness"),
        emissive: params.color("emissive"),
    }
}

fn normals(params: &Params) -> Result<Filter, InputError> {
    match (params.text("colormap"), params.range("range")) {
        (None, None) => Ok(Filter::Normals),
        (None, Some(_)) => {
            let message = "`range` of filter `normals` needs a `colormap`".to_owned();
            Err(params.error(message).help("write { normals = { colormap = \"viridis\", range = [0, 1] } }"))
        }
        (Some(colormap), range) => {
            let range = range.or(Some([-1.0, 1.0]));
            Ok(Filter::FalseColor { quantity: Quantity::Slope, colormap: colormap.value, range })
        }
    }
}

fn false_color(params: &Params, quantity: Quantity) -> Option<Filter> {
    Some(Filter::FalseColor { quantity, colormap: params.text("colormap")?.value, range: params.range("range") })
}

fn contours(params: &Params) -> Result<Filter, InputError> {
    let missing = || params.error("filter `contours` cannot be made from its catalogue row".to_owned());
    let quantity = params.text("quantity").ok_or_else(missing)?;
    let quantity = match quantity.value.as_str() {
        "height" => Quantity::Height,
        "depth" => Quantity::Depth,
        "curvature" => Quantity::Curvature,
        name if name.starts_with('_') => Quantity::Attribute(quantity),
        other => {
            let message = format!("there is no quantity `{other}`");
            return Err(InputError::at(params.file.source, quantity.span, message)
                .help("write height, depth, curvature, or a vertex attribute of the file, which begins with `_`"));
        }
    };
    let (width, color) = params.number("width").zip(params.color("color")).ok_or_else(missing)?;
    Ok(Filter::Contours { quantity, spacing: params.double("spacing"), width, color })
}

fn hatch(params: &Params) -> Option<Filter> {
    let [spacing, width] = [params.number("spacing")?, params.number("width")?];
    Some(Filter::Hatch { spacing, width, color: params.color("color")? })
}

fn edges(params: &Params) -> Option<Filter> {
    let [width, threshold] = [params.number("width")?, params.number("threshold")?];
    Some(Filter::Edges { color: params.color("color")?, width, threshold })
}

fn texture(params: &Params) -> Option<Filter> {
    let uv = match params.text("uv")?.value.as_str() {
        "mesh" => UvMapping::Mesh,
        "planar-x" => UvMapping::PlanarX,
        "planar-y" => UvMapping::PlanarY,
        "planar-z" => UvMapping::PlanarZ,
        "box" => UvMapping::Box,
        "sphere" => UvMapping::Sphere,
        _ => return None,
    };
    Some(Filter::Texture { file: params.path("file")?, uv, scale: params.pair("scale")? })
}
