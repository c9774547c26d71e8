//! Why one lens is above another, and whether it matters.

use super::{LensSet, Plan, Rank};
use crate::spec::{Filter, Spec};

/// What decided that one lens is below another.
#[derive(Debug, Clone, PartialEq)]
pub enum Reason {
    /// A chain of declared edges: `(key, line, below, above)` each, by names.
    Declared(Vec<(&'static str, usize, String, String)>),
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
                    .map(|(key, line, below, above)| format!("`{key}` in line {line} puts {below} below {above}"))
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
    /// Why the lens of rank `below` is below the lens of rank `above`.
    pub fn reason(&self, spec: &Spec, below: usize, above: usize) -> Reason {
        let (low, high) = (&self.lenses[below], &self.lenses[above]);
        let name = |index: usize| spec.lenses[index].name.value.clone();
        if let Some(chain) = self.graph.chain(low.index, high.index, &self.ranks) {
            let edge = |(a, b, declared): (usize, usize, &super::Declared)| {
                (declared.key.name(), spec.source.line(declared.span.start), name(a), name(b))
            };
            return Reason::Declared(chain.into_iter().map(edge).collect());
        }
        let by_file = self.separated_by_file(below);
        if by_file.contains(above) {
            return Reason::FileOrder;
        }
        if let Some(reason) = directly(&self.ranks[low.index], &self.ranks[high.index]) {
            return reason;
        }
        // Whatever the file's order, the lower goes first: it beats a lens that the upper one must wait for.
        let awaited = (below + 1..above).find(|rank| {
            let between = self.lenses[*rank].index;
            !by_file.contains(*rank)
                && directly(&self.ranks[low.index], &self.ranks[between]).is_some()
                && self.graph.chain(between, high.index, &self.ranks).is_some()
        });
        awaited.map_or(Reason::FileOrder, |rank| Reason::Waited(self.lenses[rank].name.clone()))
    }

    /// The lenses above one that would be below it if it stood elsewhere in the file: nothing else separates them.
    pub fn separated_by_file(&self, below: usize) -> LensSet {
        let own = self.lenses[below].index;
        let order = self.graph.order_if_last(own, &self.ranks);
        let before = |rank: usize| order.iter().take_while(|lens| **lens != own).any(|l| *l == self.lenses[rank].index);
        (below + 1..self.lenses.len()).filter(|rank| before(*rank)).collect()
    }
}

/// What puts one lens below another when both are ready, wherever they stand in the file.
fn directly(low: &Rank, high: &Rank) -> Option<Reason> {
    if low.priority != high.priority {
        return (low.priority < high.priority).then_some(Reason::Priority(low.priority, high.priority));
    }
    let (far, near) = (low.flat?, high.flat?);
    (far > near).then_some(Reason::Farther(far, near))
}

/// Whether two lenses' filters make the same picture in either order.
pub fn commute(a: &super::Lens, b: &super::Lens) -> bool {
    // Who is hidden depends on who is above.
    if a.overrides || b.overrides {
        return false;
    }
    a.filters.iter().all(|f| b.filters.iter().all(|g| filters_commute(f, g)))
}

/// What a filter writes; two that write the same thing differently do not commute.
#[derive(PartialEq, Clone, Copy)]
enum Writes {
    /// Takes away; in any order the same is left.
    Removal,
    /// Puts other content in place.
    Content,
    /// A factor; products commute.
    Factor,
    /// The base colour or the other material values.
    Base,
    /// The lit colour.
    Lit,
    /// Wires: their coverages multiply, but the upper wire's colour wins.
    Wires,
    /// Switches lighting off and leaves all else.
    Flag,
}

fn writes(filter: &Filter) -> Writes {
    match filter {
        Filter::Erase { .. } => Writes::Removal,
        Filter::Show(_) => Writes::Content,
        Filter::Opacity { .. } => Writes::Factor,
        Filter::Unlit { color: None } => Writes::Flag,
        Filter::Unlit { .. } | Filter::Material { .. } | Filter::Texture { .. } | Filter::Normals => Writes::Base,
        Filter::Tint { .. } | Filter::Grayscale { .. } | Filter::Invert { .. } => Writes::Lit,
        Filter::Wireframe { .. } => Writes::Wires,
    }
}

fn filters_commute(f: &Filter, g: &Filter) -> bool {
    match (writes(f), writes(g)) {
        (Writes::Content, Writes::Removal) | (Writes::Removal, Writes::Content) => false,
        (Writes::Wires, Writes::Wires) => wire_color(f) == wire_color(g),
        (a, b) if a == b && matches!(a, Writes::Content | Writes::Base | Writes::Lit) => f == g,
        _ => true,
    }
}

fn wire_color(filter: &Filter) -> Option<crate::spec::Color> {
    match filter {
        Filter::Wireframe { color, .. } => *color,
        _ => None,
    }
}
