//! Why one lens is above another, and whether it matters.

use super::{Plan, Reasons};
use crate::spec::{Filter, Spec};

/// What decided that one lens is below another.
#[derive(Debug, Clone, PartialEq)]
pub enum Reason {
    /// A chain of declared edges: `(key, place, below, above)` each, by names; the place as in "line 7".
    Declared(Vec<(&'static str, String, String, String)>),
    /// The lower has the lower priority.
    Priority(i64, i64),
    /// Both are flat and the lower is farther from the eye.
    Farther(f64, f64),
    /// The one above had to wait for a lens that it is declared to be above, by name.
    Waited(String),
    /// Nothing but their order in the file.
    FileOrder,
}

impl std::fmt::Display for Reason {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Reason::Declared(chain) => {
                let edges: Vec<String> = chain
                    .iter()
                    .map(|(key, place, below, above)| format!("`{key}` in {place} puts {below} below {above}"))
                    .collect();
                f.write_str(&edges.join(", "))
            }
            Reason::Priority(below, above) => write!(f, "priority {below} is lower than {above}"),
            Reason::Farther(below, above) => {
                write!(f, "flat, and farther from the eye ({below:.3} against {above:.3})")
            }
            Reason::Waited(name) => write!(f, "the upper one had to wait for {name}"),
            Reason::FileOrder => f.write_str("only the order of the file"),
        }
    }
}

impl Plan {
    /// Why the lens of rank `below` is below the lens of rank `above`; for many pairs ask [`Reasons`].
    pub fn reason(&self, spec: &Spec, below: usize, above: usize) -> Reason {
        Reasons::new(spec, self).between(below, above).as_ref().clone()
    }

    /// Whether the lens of rank `below` is below the other for no better reason than where they stand in the file.
    pub fn only_file_order(&self, below: usize, above: usize) -> bool {
        self.graph.turns_round(self.lenses[below].index, self.lenses[above].index, &self.ranks)
    }
}

/// Whether two lenses' filters make the same picture in either order.
pub fn commute(a: &super::Lens, b: &super::Lens) -> bool {
    // Who is hidden, and what is moved, depends on who is above.
    if a.overrides || b.overrides || a.moves || b.moves {
        return false;
    }
    // Inversions by different amounts, as near a soft boundary, do not commute.
    let faded = a.soft > 0.0 || b.soft > 0.0;
    let inverts = |f: &Filter| matches!(f, Filter::Invert { .. });
    a.filters.iter().all(|f| b.filters.iter().all(|g| filters_commute(f, g) && !(faded && inverts(f) && inverts(g))))
}

/// What a filter writes; two that write the same thing differently do not commute.
#[derive(PartialEq, Clone, Copy)]
enum Writes {
    /// Takes away; in any order the same is left.
    Removal,
    /// Puts other content in place.
    Content,
    /// Says which version of the content is seen.
    Version,
    /// Factors of the opacity, or lighting switched off alone: in any order the same comes out.
    Factor,
    /// Material values, as `BASE_COLOR` and its like.
    Surface(u32),
    /// The lit colour.
    Lit,
    /// Wires and points: their coverages multiply, but the upper wire's colour wins.
    Wires,
    /// The finished picture.
    Screen,
    /// Surfaces and colours, in a way of the user's own.
    Anything,
}

const BASE_COLOR: u32 = 1;
const METALLIC: u32 = 2;
const ROUGHNESS: u32 = 4;
const EMISSIVE: u32 = 8;
const TOON: u32 = 16;
const HATCH: u32 = 32;

fn writes(filter: &Filter) -> Writes {
    let bit = |written: bool, bit: u32| if written { bit } else { 0 };
    match filter {
        Filter::Erase { .. } => Writes::Removal,
        Filter::Lod { .. } => Writes::Version,
        Filter::Show(_) | Filter::Magnify { .. } | Filter::Displace { .. } => Writes::Content,
        Filter::Opacity { .. } | Filter::Unlit { color: None } => Writes::Factor,
        Filter::Ghost { color: None, .. } => Writes::Factor,
        Filter::Ghost { .. }
        | Filter::Unlit { .. }
        | Filter::Texture { .. }
        | Filter::Normals
        | Filter::FalseColor { .. } => Writes::Surface(BASE_COLOR),
        // Between the lines nothing sends out light of its own.
        Filter::Contours { .. } => Writes::Surface(BASE_COLOR | EMISSIVE),
        Filter::Toon { .. } => Writes::Surface(TOON),
        Filter::Hatch { .. } => Writes::Surface(HATCH),
        Filter::Material { color, metallic, roughness, emissive } => Writes::Surface(
            bit(color.is_some(), BASE_COLOR)
                | bit(metallic.is_some(), METALLIC)
                | bit(roughness.is_some(), ROUGHNESS)
                | bit(emissive.is_some(), EMISSIVE),
        ),
        Filter::Tint { .. } | Filter::Grayscale { .. } | Filter::Invert { .. } | Filter::Brightness { .. } => {
            Writes::Lit
        }
        Filter::Wgsl { .. } => Writes::Anything,
        Filter::Edges { .. } | Filter::Blur { .. } | Filter::Pixelate { .. } => Writes::Screen,
        Filter::Wireframe { .. } | Filter::Points { .. } => Writes::Wires,
    }
}

/// Whether a filter switches lighting on, or off.
fn lights(filter: &Filter) -> Option<bool> {
    match filter {
        Filter::Unlit { .. }
        | Filter::Normals
        | Filter::FalseColor { .. }
        | Filter::Ghost { color: Some(_), .. }
        | Filter::Contours { .. } => Some(false),
        Filter::Toon { .. } | Filter::Hatch { .. } => Some(true),
        _ => None,
    }
}

fn filters_commute(f: &Filter, g: &Filter) -> bool {
    if lights(f).zip(lights(g)).is_some_and(|(f, g)| f != g) {
        return false;
    }
    match (writes(f), writes(g)) {
        (Writes::Anything, Writes::Anything | Writes::Factor | Writes::Surface(_) | Writes::Lit)
        | (Writes::Factor | Writes::Surface(_) | Writes::Lit, Writes::Anything) => false,
        (Writes::Content, Writes::Removal | Writes::Version) | (Writes::Removal | Writes::Version, Writes::Content) => {
            false
        }
        (Writes::Version, Writes::Version) => f == g,
        (Writes::Wires, Writes::Wires) => match (wire_color(f), wire_color(g)) {
            (Some(a), Some(b)) => a == b,
            _ => true,
        },
        (Writes::Surface(a), Writes::Surface(b)) => a & b == 0 || f == g,
        // They keep the luminance that they mix towards, or multiply it.
        (Writes::Lit, Writes::Lit) => f == g || (keeps_luminance(f) && keeps_luminance(g)),
        (Writes::Content, Writes::Content) => f == g,
        // Lines of one colour lie where they lie; means mix what the other has made.
        (Writes::Screen, Writes::Screen) => f == g && matches!(f, Filter::Edges { .. }),
        _ => true,
    }
}

fn keeps_luminance(filter: &Filter) -> bool {
    matches!(filter, Filter::Grayscale { .. } | Filter::Brightness { .. })
}

fn wire_color(filter: &Filter) -> Option<crate::spec::Color> {
    match filter {
        Filter::Wireframe { color, .. } => *color,
        _ => None,
    }
}
