//! Random lenses over a small scene, as a brute force reads them and as a spec file says them.

use std::fmt::Write;

use glam::{DAffine3, DVec3, Vec3};
use lenspeel::plan::Plan;
use lenspeel::scene::{Material, Mesh, Model, Node, Primitive, Scene, Transform};
use lenspeel::spec::Spec;

use crate::random::Random;

/// The middle of the mesh of node `i` is at `x = NODE_STEP * i`.
pub const NODE_STEP: f64 = 10.0;
pub const MATERIALS: [&str; 3] = ["steel", "glass", "steel-dark"];
/// Name, parent, material of the mesh's one primitive (`None`: no mesh), of the scene's nodes.
pub const NODES: [NodeRow; 5] = [
    ("Root", None, None),
    ("gear", Some(0), Some(0)),
    ("bolt", Some(1), Some(2)),
    ("cover", Some(0), Some(1)),
    ("helper", None, Some(0)),
];
/// The same of the alternates; they share some names with the scene.
pub const ALTERNATES: [(&str, &[NodeRow]); 2] = [
    ("bones", &[("gear", None, Some(1)), ("bone", Some(0), Some(0))]),
    ("flesh", &[("flesh", None, Some(2)), ("cover", None, Some(0))]),
];
/// Hidden by `[scene] hide`.
pub const HIDDEN: &str = "helper";
const NODE_PATTERNS: [&str; 7] = ["gear", "bolt", "cover", "b*", "Root", "bone", "flesh"];
const MATERIAL_PATTERNS: [&str; 3] = ["steel", "steel*", "glass"];
const SHOWN_NODES: [&str; 4] = ["helper", "bolt", "gear", "cover"];

pub type NodeRow = (&'static str, Option<usize>, Option<usize>);

#[derive(Debug, Clone, Default)]
pub struct Patterns {
    pub nodes: Vec<&'static str>,
    pub materials: Vec<&'static str>,
}

#[derive(Debug, Clone)]
pub enum Act {
    Tint,
    Erase(Patterns),
    ShowAlternate(usize),
    ShowNode(&'static str),
}

#[derive(Debug, Clone, Default)]
pub struct LensCase {
    pub name: String,
    pub enabled: bool,
    pub priority: i64,
    /// Names or patterns as written.
    pub over: Vec<String>,
    pub under: Vec<String>,
    pub hides: Vec<String>,
    pub overrides: bool,
    /// The middle of a flat lens; else the lens is a box around the nodes `nodes.0 ..= nodes.1`.
    pub flat: Option<[f64; 3]>,
    pub nodes: (usize, usize),
    pub by_object: bool,
    pub only: Patterns,
    pub except: Patterns,
    pub acts: Vec<Act>,
}

/// The eye looks along -z, from z = 0.
#[derive(Debug, Clone)]
pub struct Case {
    pub lenses: Vec<LensCase>,
    pub orthographic: bool,
}

impl Case {
    pub fn toml(&self) -> String {
        let camera = if self.orthographic { "orthographic_height = 20" } else { "fov_y = 60" };
        let mut text = format!(
            "[scene]\nfile = \"a.glb\"\nhide = [\"{HIDDEN}\"]\n[scene.alternates]\nbones = \"b.glb\"\n\
             flesh = \"c.glb\"\n[camera]\neye = [0, 0, 0]\ntarget = [0, 0, -1]\n{camera}\n"
        );
        self.lenses.iter().for_each(|lens| lens.write(&mut text));
        text
    }

    pub fn spec(&self) -> Spec {
        let text = self.toml();
        Spec::parse(&text, "case.toml", std::path::Path::new("")).unwrap_or_else(|e| panic!("{e}\n{text}"))
    }

    pub fn plan(&self) -> Plan {
        Plan::new(&self.spec(), &scene()).unwrap_or_else(|e| panic!("{e}\n{}", self.toml()))
    }
}

fn list<T: AsRef<str>>(items: &[T]) -> String {
    let quoted: Vec<String> = items.iter().map(|s| format!("\"{}\"", s.as_ref())).collect();
    format!("[{}]", quoted.join(", "))
}

impl Patterns {
    fn written(&self) -> String {
        format!("{{ nodes = {}, materials = {} }}", list(&self.nodes), list(&self.materials))
    }

    fn random(random: &mut Random) -> Self {
        let mut patterns = Self::default();
        for _ in 0..random.index(3) {
            if random.chance(0.6) {
                patterns.nodes.push(NODE_PATTERNS[random.index(NODE_PATTERNS.len())]);
            } else {
                patterns.materials.push(MATERIAL_PATTERNS[random.index(MATERIAL_PATTERNS.len())]);
            }
        }
        patterns
    }
}

impl Act {
    fn written(&self) -> String {
        match self {
            Act::Tint => "\"tint\"".into(),
            Act::Erase(patterns) => format!("{{ erase = {} }}", patterns.written()),
            Act::ShowAlternate(i) => format!("{{ show = {{ alternate = \"{}\" }} }}", ALTERNATES[*i].0),
            Act::ShowNode(node) => format!("{{ show = {{ nodes = [\"{node}\"] }} }}"),
        }
    }

    fn random(random: &mut Random) -> Self {
        match random.index(10) {
            0..5 => Act::Tint,
            5..7 => Act::Erase(Patterns::random(random)),
            7 | 8 => Act::ShowAlternate(random.index(ALTERNATES.len())),
            _ => Act::ShowNode(SHOWN_NODES[random.index(SHOWN_NODES.len())]),
        }
    }
}

impl LensCase {
    fn write(&self, text: &mut String) {
        let acts: Vec<String> = self.acts.iter().map(Act::written).collect();
        let overlap = if self.overrides { "override" } else { "stack" };
        let by = if self.by_object { "object" } else { "pixel" };
        write!(
            text,
            "[[lens]]\nname = \"{}\"\nenabled = {}\npriority = {}\nover = {}\nunder = {}\nhides = {}\n\
             overlap = \"{overlap}\"\nby = \"{by}\"\nonly = {}\nexcept = {}\nfilters = [{}]\n{}\n",
            self.name,
            self.enabled,
            self.priority,
            list(&self.over),
            list(&self.under),
            list(&self.hides),
            self.only.written(),
            self.except.written(),
            acts.join(", "),
            self.shape(),
        )
        .expect("a string takes text");
    }

    fn shape(&self) -> String {
        if let Some([x, y, z]) = self.flat {
            let corner = |dx: f64, dy: f64| format!("[{}, {}, {z}]", x + dx, y + dy);
            let corners = [corner(-0.5, -0.5), corner(0.5, -0.5), corner(0.5, 0.5), corner(-0.5, 0.5)];
            return format!("shape.flat = {{ corners = [{}] }}", corners.join(", "));
        }
        let low = NODE_STEP * self.nodes.0 as f64 - 2.0;
        let high = NODE_STEP * self.nodes.1 as f64 + 2.0;
        format!("shape.box = {{ min = [{low}, -2, -2], max = [{high}, 2, 2] }}")
    }

    /// A lens without any edges.
    pub fn random(random: &mut Random, name: String) -> Self {
        let first = random.index(NODES.len());
        let flat = random.chance(0.3).then(|| {
            // Few places, so that some flats are as far away as others.
            [random.index(3) as f64 - 1.0, random.index(2) as f64, -2.0 - random.index(3) as f64]
        });
        Self {
            name,
            enabled: random.chance(0.9),
            priority: [0, 0, 0, 1, -1][random.index(5)],
            overrides: random.chance(0.1),
            flat,
            nodes: (first, (first + random.index(3)).min(NODES.len() - 1)),
            by_object: random.chance(0.2),
            only: if random.chance(0.3) { Patterns::random(random) } else { Patterns::default() },
            except: if random.chance(0.2) { Patterns::random(random) } else { Patterns::default() },
            acts: (0..1 + random.index(2)).map(|_| Act::random(random)).collect(),
            ..Self::default()
        }
    }
}

/// Up to `most` lenses whose declared edges all lead upwards in some hidden order, so that there is no cycle.
pub fn random_acyclic(random: &mut Random, most: usize, edges: f64) -> Case {
    let mut case = random_lenses(random, most);
    let count = case.lenses.len();
    let place: Vec<usize> = shuffled(random, count);
    for a in 0..count {
        for b in 0..count {
            if place[a] < place[b] && random.chance(edges) {
                let (below, above) = (case.lenses[a].name.clone(), case.lenses[b].name.clone());
                match random.index(3) {
                    0 => case.lenses[b].over.push(below),
                    1 => case.lenses[a].under.push(above),
                    _ => case.lenses[b].hides.push(below),
                }
            }
        }
    }
    case
}

/// Edges at random, patterns among them; most have a cycle.
pub fn random_edges(random: &mut Random, most: usize) -> Case {
    let mut case = random_lenses(random, most);
    let count = case.lenses.len();
    for _ in 0..random.index(count + 1) {
        let (from, to) = (random.index(count), random.index(count));
        if from == to {
            continue;
        }
        let mut name = case.lenses[to].name.clone();
        if random.chance(0.2) {
            name.replace_range(1.., "*");
        }
        match random.index(3) {
            0 => case.lenses[from].over.push(name),
            1 => case.lenses[from].under.push(name),
            _ => case.lenses[from].hides.push(name),
        }
    }
    case
}

fn random_lenses(random: &mut Random, most: usize) -> Case {
    let count = 2 + random.index(most - 1);
    let name = |i: usize| format!("{}{i}", ["a", "b", "c"][i % 3]);
    let lenses = (0..count).map(|i| LensCase::random(random, name(i))).collect();
    Case { lenses, orthographic: random.chance(0.3) }
}

pub fn shuffled(random: &mut Random, count: usize) -> Vec<usize> {
    let mut places: Vec<usize> = (0..count).collect();
    (1..count).for_each(|i| places.swap(i, random.index(i + 1)));
    places
}

pub fn scene() -> Scene {
    let alternates = ALTERNATES.iter().map(|(name, _)| name.to_string()).collect();
    let models = std::iter::once(model(&NODES)).chain(ALTERNATES.iter().map(|(_, rows)| model(rows)));
    Scene::new(models.collect(), alternates)
}

fn model(rows: &[NodeRow]) -> Model {
    let mut model = Model { name: "a.glb".into(), scenes: vec![None], ..Model::default() };
    model.materials = MATERIALS.iter().map(|name| Material { name: name.to_string(), ..Material::default() }).collect();
    model.materials.push(Material::default());
    for (index, (name, parent, material)) in rows.iter().enumerate() {
        let place = |steps: usize| DAffine3::from_translation(DVec3::X * NODE_STEP * steps as f64);
        model.nodes.push(Node {
            name: name.to_string(),
            parent: *parent,
            children: (0..rows.len()).filter(|i| rows[*i].1 == Some(index)).collect(),
            rest: Transform::Matrix(place(index - parent.unwrap_or(0))),
            world_from_local: place(index),
            mesh: material.map(|_| model.meshes.len()),
            camera: None,
            light: None,
            drawn: true,
            hidden: false,
        });
        if let Some(material) = material {
            model.meshes.push(Mesh { name: name.to_string(), primitives: vec![triangle(*material)] });
        }
    }
    model
}

/// A triangle whose bounds have their middle at the origin.
fn triangle(material: usize) -> Primitive {
    let positions = vec![Vec3::new(-1.0, -1.0, 0.0), Vec3::new(1.0, -1.0, 0.0), Vec3::new(0.0, 1.0, 0.0)];
    Primitive { positions, triangles: vec![[0, 1, 2]], material, ..Primitive::default() }
}
