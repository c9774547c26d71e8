//! What a case expects, read from its folder.

use std::collections::HashMap;
use std::fs;
use std::path::Path;

use lenspeel::frame::{self, Aovs, Frame};
use lenspeel::plan::{LensSet, Plan, Region};
use serde_json::Value;

use crate::compare::{Reference, Rules};
use crate::edges::{JUMP, Mask, STEP, changes, depth_jumps, either, regions};
use crate::npy;

/// Bits of `doubt.png`.
const REGION: u8 = 1;
const NODE: u8 = 2;
const LAYERS: u8 = 4;
const VISIBILITY: u8 = 8;
/// Stands in `region.png` where nothing is.
const NOTHING: u16 = u16::MAX;

/// An entry of `region.json` each, lowest first.
type Stack = Vec<Value>;

pub struct Expected {
    pub reference: Reference,
    pub stacks: HashMap<LensSet, Stack>,
    /// Lens names, lowest first.
    pub order: Vec<String>,
}

impl Expected {
    /// Reads a folder of `expected/`; lens names become sets of the plan.
    pub fn read(folder: &Path, plan: &Plan) -> Result<Self, String> {
        let (size, ids) = gray16(&folder.join("region.png"))?;
        let table = Table::read(&folder.join("region.json"), plan)?;
        let aovs = Aovs {
            regions: ids.iter().map(|id| table.place(*id)).collect::<Result<_, _>>()?,
            table: table.regions.clone(),
            nodes: gray16(&folder.join("node.png"))?.1.into_iter().map(u32::from).collect(),
            depth: npy::read_f32(&folder.join("depth.npy"), size)?.into_iter().map(f64::from).collect(),
            layers: gray16(&folder.join("layers.png"))?.1,
            ..Aovs::default()
        };
        let doubt = decoded(&folder.join("doubt.png"))?.into_luma8().into_raw();
        let known = decoded(&folder.join("color_known.png"))?.into_luma8().into_raw();
        let pixels = decoded(&folder.join("color.png"))?.into_rgba8().pixels().map(|pixel| pixel.0).collect();
        let order = strings(&json(&folder.join("meta.json"))?["order"])?;
        let frame = Frame { size, pixels, aovs: Some(aovs) };
        Ok(Self { reference: reference(frame, &doubt, &known)?, stacks: table.stacks, order })
    }
}

/// Which pixels count for what, as the README of the cases says.
fn reference(frame: Frame, doubt: &[u8], known: &[u8]) -> Result<Reference, String> {
    let aovs = frame.aovs.as_ref().ok_or("no maps are expected")?;
    if [doubt.len(), known.len(), aovs.nodes.len(), aovs.layers.len()].iter().any(|n| *n != frame.pixels.len()) {
        return Err("the expected maps have different sizes".into());
    }
    let visible = either(&changes(frame.size, &regions(aovs)), &changes(frame.size, &aovs.nodes));
    let edges = either(&visible, &depth_jumps(frame.size, &aovs.depth, JUMP));
    let steps = either(&edges, &depth_jumps(frame.size, &aovs.depth, STEP));
    let exempt = |bits: u8| -> Mask { doubt.iter().map(|doubt| doubt & bits != 0).collect() };
    let unknown: Mask = known.iter().map(|known| *known == 0).collect();
    let by_map = |near_edge: &Mask, bits| Rules { near_edge: near_edge.clone(), exempt: exempt(bits) };
    Ok(Reference {
        region: by_map(&edges, REGION | VISIBILITY),
        node: by_map(&edges, NODE | VISIBILITY),
        stack: Rules { near_edge: edges.clone(), exempt: vec![true; doubt.len()] },
        layers: by_map(&changes(frame.size, &aovs.layers), LAYERS),
        depth: by_map(&steps, NODE | VISIBILITY),
        color: Rules {
            near_edge: either(&edges, &changes(frame.size, &frame.pixels)),
            exempt: either(&unknown, &exempt(REGION | NODE | VISIBILITY)),
        },
        frame,
    })
}

/// `region.json`.
struct Table {
    regions: Vec<Region>,
    /// Ids to places in `regions`.
    places: HashMap<u16, u32>,
    stacks: HashMap<LensSet, Stack>,
}

impl Table {
    fn read(path: &Path, plan: &Plan) -> Result<Self, String> {
        let mut table = Self { regions: vec![Region::PLAIN], places: HashMap::from([(0, 0)]), stacks: HashMap::new() };
        let value = json(path)?;
        for entry in value.as_array().ok_or("region.json is no list")? {
            let id = entry["id"].as_u64().and_then(|id| u16::try_from(id).ok()).ok_or("an entry without an id")?;
            let names = strings(&entry["lenses"])?;
            let set: LensSet = names.iter().map(|name| rank(plan, name)).collect::<Result<_, String>>()?;
            table.places.insert(id, table.regions.len() as u32);
            // The stack is compared by its filters.
            table.regions.push(Region { set, stack: LensSet::EMPTY });
            table.stacks.insert(set, entry["stack"].as_array().ok_or("an entry without a stack")?.clone());
        }
        Ok(table)
    }

    fn place(&self, id: u16) -> Result<u32, String> {
        if id == NOTHING {
            return Ok(frame::NOTHING);
        }
        self.places.get(&id).copied().ok_or_else(|| format!("region.json has no region {id}"))
    }
}

fn rank(plan: &Plan, name: &str) -> Result<usize, String> {
    plan.lenses.iter().position(|lens| lens.name == name).ok_or_else(|| format!("the plan has no lens {name}"))
}

fn json(path: &Path) -> Result<Value, String> {
    let text = fs::read_to_string(path).map_err(|error| format!("{}: {error}", path.display()))?;
    serde_json::from_str(&text).map_err(|error| format!("{}: {error}", path.display()))
}

fn strings(value: &Value) -> Result<Vec<String>, String> {
    let list = value.as_array().ok_or("a list of names is wanted")?;
    list.iter().map(|name| Ok(name.as_str().ok_or("a name is wanted")?.to_string())).collect()
}

fn decoded(path: &Path) -> Result<image::DynamicImage, String> {
    image::open(path).map_err(|error| format!("{}: {error}", path.display()))
}

fn gray16(path: &Path) -> Result<([u32; 2], Vec<u16>), String> {
    let image = decoded(path)?.into_luma16();
    Ok(([image.width(), image.height()], image.into_raw()))
}
