//! One `[[lens]]`.

use std::collections::HashSet;

use toml::de::DeValue;

use super::item::Item;
use super::table::Table;
use super::{filter, keys, shape};
use crate::InputError;
use crate::limits::MAX_NAME;
use crate::spec::{At, Attach, By, Glass, LensSpec, Matches, NumberRange, OverlapMode, Pattern};

pub fn read(item: &Item) -> Result<LensSpec, InputError> {
    let table = Table::open(item, "[[lens]]", keys::LENS)?;
    let name = name(&table.need("name")?)?;
    let table = table.called(format!("lens `{}`", name.value));
    let shape = table.need("shape").and_then(|item| shape::read(&item));
    let goes_on = shape.as_ref().is_ok_and(|shape| shape.value.is_half_space());
    let glass_unless_given = (!goes_on).then(Glass::default);
    Ok(LensSpec {
        name,
        enabled: table.read("enabled", Item::boolean).unwrap_or(true),
        attach: table.read("attach", attach).unwrap_or(At::new(Attach::Scene, table.span.clone())),
        translation: table.read("translation", Item::vector).unwrap_or_default(),
        rotation: table.read("rotation", Item::rotation).unwrap_or_default(),
        scale: table.read("scale", scale).unwrap_or([1.0; 3]),
        filters: table.read("filters", filter::list).unwrap_or_default(),
        over: patterns(&table, "over"),
        under: patterns(&table, "under"),
        hides: patterns(&table, "hides"),
        overlap: table.read("overlap", overlap).unwrap_or(OverlapMode::Stack),
        priority: table.read("priority", |item| item.integer(i64::MIN, i64::MAX)).unwrap_or(0),
        by: table.read("by", |item| item.choice(&[("pixel", By::Pixel), ("object", By::Object)])).unwrap_or(By::Pixel),
        only: table.read("only", matches).unwrap_or_default(),
        except: table.read("except", matches).unwrap_or_default(),
        soft: table.read("soft", |item| item.number(NumberRange::NOT_NEGATIVE)).unwrap_or(0.0),
        glass: table.read("glass", glass).unwrap_or(glass_unless_given),
        // When all else has been looked at.
        shape: shape?,
    })
}

/// Letters, digits, `-` and `_`: what the `when` of a rule can write.
pub fn is_name_char(c: char) -> bool {
    c.is_ascii_alphanumeric() || c == '-' || c == '_'
}

fn name(item: &Item) -> Result<At<String>, InputError> {
    let text = item.text()?;
    bound_name("a lens name", text).map_err(|message| item.error(message).help("give it a shorter name"))?;
    match text.chars().find(|c| !is_name_char(*c)) {
        None => Ok(item.at(text.to_owned())),
        Some(c) => Err(item
            .error(format!("a lens name may not hold {c:?}"))
            .help("use the letters a to z and A to Z, digits, - and _")),
    }
}

/// Names end up in messages, and are held against patterns.
pub fn bound_name(what: &str, name: &str) -> Result<(), String> {
    match name.chars().count() {
        count if count > MAX_NAME => Err(format!("{what} has at most {MAX_NAME} characters, and this one has {count}")),
        _ => Ok(()),
    }
}

fn patterns(table: &Table, key: &'static str) -> Vec<At<Pattern>> {
    let wanted = "a list of lens names or patterns, such as [\"probe\", \"cut-*\"]";
    let mut patterns = table.read(key, |item| item.each(wanted, Item::pattern)).unwrap_or_default();
    // What is said twice is said once.
    let mut known = HashSet::new();
    patterns.retain(|pattern| known.insert(pattern.value.clone()));
    patterns
}

fn overlap(item: &Item) -> Result<OverlapMode, InputError> {
    item.choice(&[("stack", OverlapMode::Stack), ("override", OverlapMode::Override)])
}

fn attach(item: &Item) -> Result<At<Attach>, InputError> {
    let attach = match item.value {
        DeValue::Table(_) => {
            let table = Table::open(item, "`attach`", keys::ATTACH)?;
            Attach::Node(table.need("node")?.text()?.to_owned())
        }
        DeValue::String(_) => item
            .choice(&[("scene", false), ("camera", true)])
            .map(|camera| if camera { Attach::Camera } else { Attach::Scene })
            .map_err(|error| match error.help {
                Some(_) => error,
                None => error.help("to follow a node, write { node = \"Wheel\" }"),
            })?,
        _ => return Err(item.wrong_type("\"scene\", \"camera\" or { node = \"Wheel\" }")),
    };
    Ok(item.at(attach))
}

/// One factor or three, none zero.
fn scale(item: &Item) -> Result<[f64; 3], InputError> {
    let factors = match item.value {
        DeValue::Array(_) => item.vector()?,
        _ => [item.number(NumberRange::ANY)?; 3],
    };
    match factors.iter().find(|factor| factor.abs() < crate::spec::range::SMALLEST_SIZE) {
        None => Ok(factors),
        Some(_) => {
            Err(item.error("`scale` must not be zero").help("a lens of scale 0 has no volume; 1 leaves it as it is"))
        }
    }
}

fn matches(item: &Item) -> Result<Matches, InputError> {
    let table = Table::open(item, format!("`{}`", item.name), keys::MATCHES)?;
    Ok(Matches {
        nodes: table.read("nodes", Item::patterns).unwrap_or_default(),
        materials: table.read("materials", Item::patterns).unwrap_or_default(),
    })
}

/// `false` for none, or a table.
fn glass(item: &Item) -> Result<Option<Glass>, InputError> {
    match item.value {
        DeValue::Boolean(false) => return Ok(None),
        DeValue::Table(_) => {}
        _ => {
            let error = item.wrong_type("false or a table such as { opacity = 0.06 }");
            return Err(error.help("leave it out for the default glass"));
        }
    }
    let table = Table::open(item, "`glass`", keys::GLASS)?;
    let default = Glass::default();
    let number = |key, range| table.read(key, |item: &Item| item.number32(range));
    let width = NumberRange::closed(0.0, 1000.0);
    Ok(Some(Glass {
        color: table.read("color", Item::color).unwrap_or(default.color),
        opacity: number("opacity", NumberRange::UNIT).unwrap_or(default.opacity),
        rim: number("rim", NumberRange::UNIT).unwrap_or(default.rim),
        outline: number("outline", width).unwrap_or(default.outline),
        contact: number("contact", width).unwrap_or(default.contact),
    }))
}
