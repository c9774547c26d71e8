//! The JSON of a file: what it is, and its typed form, with what that form cannot hold read beside it.

use std::collections::BTreeSet;

use gltf::json;
use serde::Deserialize;
use serde_json::Value;

use super::warnings::Warnings;
use super::{count_of, object};
use crate::InputError;
use crate::file_kind::FileKind;
use crate::scene::Budget;

/// A file's JSON as the rest of the reader takes it.
pub struct Parsed {
    pub root: json::Root,
    /// Where each node stands, in the precision of the file.
    pub placements: Vec<Placement>,
    /// Bytes of the budget that it holds.
    pub cost: u64,
}

/// The transform of a node as the file writes it; the crate's node has these in f32.
#[derive(Debug, Default, Deserialize)]
pub struct Placement {
    pub matrix: Option<[f64; 16]>,
    pub translation: Option<[f64; 3]>,
    /// A quaternion, `xyzw`.
    pub rotation: Option<[f64; 4]>,
    pub scale: Option<[f64; 3]>,
}

/// Memory of one value of the JSON, and of one object that is read from it, on the safe side.
const VALUE_BYTES: u64 = 64;
const OBJECT_BYTES: u64 = 1536;

pub fn parse(bytes: &[u8], name: &str, budget: &mut Budget, warnings: &mut Warnings) -> Result<Parsed, InputError> {
    let fail = |error: serde_json::Error| not_gltf(bytes, name, &error.to_string());
    let mut cost = values_in(bytes).saturating_mul(VALUE_BYTES).saturating_add(bytes.len() as u64);
    budget.take(cost, || format!("{name}: its JSON"))?;
    let mut value: Value = serde_json::from_slice(bytes).map_err(fail)?;
    version(&value, bytes, name)?;
    let objects = objects_in(&value).saturating_mul(OBJECT_BYTES);
    budget.take(objects, || format!("{name}: the objects that its JSON lists"))?;
    cost += objects;
    let mut used = BTreeSet::new();
    tidy(&mut value, &mut used);
    undeclared(&mut value, used, warnings);
    complete(&mut value, warnings);
    let placements = placements(&value, name)?;
    let root = serde_path_to_error::deserialize(value).map_err(|error| {
        InputError::new(format!("{name}: {}: {}", error.path(), error.inner())).help("expected glTF 2.0")
    })?;
    Ok(Parsed { root, placements, cost })
}

/// At most so many values; base64 has none of these marks.
fn values_in(bytes: &[u8]) -> u64 {
    bytes.iter().filter(|b| matches!(b, b',' | b':' | b'[' | b'{')).count() as u64 + 1
}

/// Members of lists of objects: what becomes large when it is read.
fn objects_in(value: &Value) -> u64 {
    match value {
        Value::Array(items) => {
            let own = items.iter().filter(|item| item.is_object()).count() as u64;
            own + items.iter().map(objects_in).sum::<u64>()
        }
        Value::Object(entries) => entries.values().map(objects_in).sum(),
        _ => 0,
    }
}

/// An error that says what the file is instead.
fn not_gltf(bytes: &[u8], name: &str, why: &str) -> InputError {
    let kind = FileKind::of(bytes);
    match kind {
        FileKind::GLTF | FileKind::JSON => {
            InputError::new(format!("{name}: not a glTF file: {why}")).help(FileKind::JSON.advice)
        }
        FileKind { name: what, advice } => InputError::new(format!("{name}: it is {what}")).help(advice),
    }
}

fn version(value: &Value, bytes: &[u8], name: &str) -> Result<(), InputError> {
    let text = |key: &str| value.pointer(key).and_then(Value::as_str);
    // Version 1.0 had objects with names where 2.0 has lists, and need not say what it is.
    let has_names = ["meshes", "accessors", "nodes", "bufferViews"].iter().any(|list| value[list].is_object());
    let (wanted, written) = (text("/asset/minVersion"), text("/asset/version"));
    let known = wanted.map_or(written.is_some_and(|v| v == "2" || v.starts_with("2.")), |wanted| wanted == "2.0");
    if known && !has_names {
        return Ok(());
    }
    if has_names || written.is_some_and(|v| v == "1" || v.starts_with("1.")) {
        return Err(InputError::new(format!("{name}: it is glTF 1.0, and 2.0 is read"))
            .help("convert it, for example with `gltf-pipeline -i old.gltf -o new.glb`"));
    }
    match wanted.or(written) {
        Some(version) => Err(InputError::new(format!("{name}: glTF version `{version}`")).help("expected 2.0")),
        None => Err(not_gltf(bytes, name, "it has no `asset` with a `version`")),
    }
}

/// Writes whole numbers as such, for JSON does not tell `48.0` from `48`, and collects the extensions in use.
fn tidy(value: &mut Value, used: &mut BTreeSet<String>) {
    /// Beyond it f64 skips integers.
    const EXACT: f64 = 9_007_199_254_740_992.0;
    match value {
        Value::Number(number) if number.is_f64() => {
            let float = number.as_f64().filter(|f| f.fract() == 0.0 && f.abs() < EXACT && !is_negative_zero(*f));
            if let Some(whole) = float {
                *value = if whole < 0.0 { Value::from(whole as i64) } else { Value::from(whole as u64) };
            }
        }
        Value::Array(items) => items.iter_mut().for_each(|item| tidy(item, used)),
        Value::Object(entries) => {
            for (key, entry) in entries.iter_mut().filter(|(key, _)| *key != "extras") {
                if let (true, Value::Object(extensions)) = (key == "extensions", &*entry) {
                    used.extend(extensions.keys().cloned());
                }
                tidy(entry, used);
            }
        }
        _ => {}
    }
}

fn is_negative_zero(number: f64) -> bool {
    number == 0.0 && number.is_sign_negative()
}

/// Extensions that objects have and the file does not declare are read as if it did: so many exporters forget them.
fn undeclared(value: &mut Value, used: BTreeSet<String>, warnings: &mut Warnings) {
    let Some(root) = value.as_object_mut() else { return };
    let declared = root.entry("extensionsUsed").or_insert_with(|| Value::Array(Vec::new()));
    let Some(declared) = declared.as_array_mut() else { return };
    let missing: Vec<String> =
        used.into_iter().filter(|name| !declared.iter().any(|known| known.as_str() == Some(name))).collect();
    if !missing.is_empty() {
        let plural = if missing.len() == 1 { "an extension that it does" } else { "extensions that it does" };
        warnings.say(format!("the file uses {plural} not declare in `extensionsUsed`: {}", missing.join(", ")));
        declared.extend(missing.into_iter().map(Value::String));
    }
}

/// What the crate's types want and the format does not: `nodes` of scenes, target nodes of channels (extensions animate
/// other things by channels without one).
fn complete(value: &mut Value, warnings: &mut Warnings) {
    let list = |value: &mut Value, key: &str| value.get_mut(key).and_then(Value::as_array_mut).map(std::mem::take);
    if let Some(mut scenes) = list(value, "scenes") {
        for scene in scenes.iter_mut().filter_map(Value::as_object_mut) {
            scene.entry("nodes").or_insert_with(|| Value::Array(Vec::new()));
        }
        value["scenes"] = Value::Array(scenes);
    }
    let mut left_out = 0;
    if let Some(mut animations) = list(value, "animations") {
        for channels in animations.iter_mut().filter_map(|a| a.get_mut("channels")?.as_array_mut()) {
            let before = channels.len();
            channels.retain(|channel| channel.pointer("/target/node").is_some());
            left_out += before - channels.len();
        }
        value["animations"] = Value::Array(animations);
    }
    if left_out > 0 {
        warnings.say(format!("{} without a target node left out", count_of(left_out, "animation channel")));
    }
}

fn placements(value: &Value, name: &str) -> Result<Vec<Placement>, InputError> {
    let nodes = value.get("nodes").and_then(Value::as_array).map_or(&[][..], Vec::as_slice);
    let placement = |(index, node): (usize, &Value)| {
        Placement::deserialize(node).map_err(|error| {
            let label = object("node", index, node.get("name").and_then(Value::as_str));
            InputError::new(format!("{name}: {label}: its transform does not read: {error}"))
        })
    };
    nodes.iter().enumerate().map(placement).collect()
}
