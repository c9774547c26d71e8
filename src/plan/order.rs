//! The priority graph: declared edges, cycles, and the one total order (SEMANTICS section 3).

use std::cmp::{Ordering, Reverse};
use std::collections::{BTreeMap, BTreeSet, HashSet};
use std::ops::Range;

use petgraph::graph::{DiGraph, EdgeIndex, NodeIndex};
use petgraph::visit::EdgeRef;

use crate::InputError;
use crate::limits::MAX_EDGES;
use crate::spec::{At, Names, Pattern, Spec};

/// The most edges of a cycle that a report shows in the file; its text tells all.
const MOST_LABELS: usize = 32;

/// Which key declared that one lens is above another.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Key {
    Over,
    Under,
    Hides,
}

impl Key {
    pub fn name(self) -> &'static str {
        match self {
            Key::Over => "over",
            Key::Under => "under",
            Key::Hides => "hides",
        }
    }
}

/// An edge below -> above.
#[derive(Debug, Clone)]
pub struct Declared {
    pub key: Key,
    /// The pattern's bytes in the spec.
    pub span: Range<usize>,
}

/// Lenses as nodes in file order (disabled ones too), edges from below to above.
#[derive(Debug, Clone)]
pub struct PriorityGraph {
    pub graph: DiGraph<(), Declared>,
    /// Of each enabled lens, the enabled ones that edges put above it, each once.
    above: Vec<Vec<usize>>,
}

/// What orders the ready lenses; by position in the file.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rank {
    pub enabled: bool,
    pub priority: i64,
    /// For a flat lens: its distance from the eye.
    pub flat: Option<f64>,
}

impl PriorityGraph {
    /// Expands the patterns of a spec and refuses cycles of enabled lenses.
    pub fn new(spec: &Spec) -> Result<Self, InputError> {
        let mut graph = DiGraph::new();
        spec.lenses.iter().for_each(|_| {
            graph.add_node(());
        });
        let names = Names::new(spec.lenses.iter().map(|lens| lens.name.value.as_str()));
        // What one key says twice of two lenses is one edge.
        let mut declared_by: HashSet<(usize, usize, Key)> = HashSet::new();
        for (index, lens) in spec.lenses.iter().enumerate() {
            for (key, patterns) in [(Key::Over, &lens.over), (Key::Under, &lens.under), (Key::Hides, &lens.hides)] {
                for pattern in patterns {
                    for other in matched(spec, &names, index, pattern)? {
                        let (below, above) = if key == Key::Under { (index, other) } else { (other, index) };
                        if !declared_by.insert((below, above, key)) {
                            continue;
                        }
                        if declared_by.len() > MAX_EDGES {
                            return Err(too_many_edges(spec, pattern));
                        }
                        let declared = Declared { key, span: pattern.span.clone() };
                        graph.add_edge(NodeIndex::new(below), NodeIndex::new(above), declared);
                    }
                }
            }
        }
        let above = |lens: usize| {
            let targets = graph.neighbors(NodeIndex::new(lens)).map(NodeIndex::index);
            let enabled: BTreeSet<usize> = targets.filter(|lens| spec.lenses[*lens].enabled).collect();
            if spec.lenses[lens].enabled { enabled.into_iter().collect() } else { Vec::new() }
        };
        let above = (0..spec.lenses.len()).map(above).collect();
        let graph = Self { graph, above };
        match graph.cycles(&|lens| spec.lenses[lens].enabled).into_iter().next() {
            Some(cycle) => Err(cycle_error(spec, &graph, &cycle)),
            None => Ok(graph),
        }
    }

    /// The cycles that only disabled lenses close, a line each: what would be an error with all of them enabled.
    pub fn idle_cycles(&self, spec: &Spec) -> Vec<String> {
        let warning = |cycle: Vec<EdgeIndex>| {
            let ends = |edge: &EdgeIndex| self.graph.edge_endpoints(*edge);
            let mut disabled: Vec<&str> = cycle
                .iter()
                .filter_map(|edge| Some(&spec.lenses[ends(edge)?.0.index()]).filter(|lens| !lens.enabled))
                .map(|lens| lens.name.value.as_str())
                .collect();
            disabled.sort_unstable();
            let is = if disabled.len() == 1 { "is" } else { "are" };
            format!(
                "{}: once {} {is} enabled, {}",
                spec.source.place(self.graph[cycle[0]].span.start),
                disabled.join(", "),
                cycle_text(spec, self, &cycle)
            )
        };
        self.cycles(&|_| true).into_iter().map(warning).collect()
    }

    /// A shortest cycle of each tangle of lenses that count: the one through the lens that stands first in the file.
    fn cycles(&self, counts: &dyn Fn(usize) -> bool) -> Vec<Vec<EdgeIndex>> {
        let counted = petgraph::visit::NodeFiltered::from_fn(&self.graph, |node| counts(node.index()));
        let tangles = petgraph::algo::tarjan_scc(&counted).into_iter().filter(|component| component.len() > 1);
        let mut starts: Vec<NodeIndex> = tangles.filter_map(|component| component.into_iter().min()).collect();
        starts.sort_unstable();
        starts.into_iter().filter_map(|start| self.path(start, start, counts)).collect()
    }

    /// The shortest chain of edges upwards from one lens to another over lenses that count, by file order where
    /// several are as short.
    fn path(&self, from: NodeIndex, to: NodeIndex, counts: &dyn Fn(usize) -> bool) -> Option<Vec<EdgeIndex>> {
        let mut came_by: Vec<Option<EdgeIndex>> = vec![None; self.graph.node_count()];
        let mut queue = std::collections::VecDeque::from([from]);
        while let Some(node) = queue.pop_front() {
            let mut edges: Vec<_> = self.graph.edges(node).map(|e| (e.target(), e.id())).collect();
            edges.sort();
            for (next, edge) in edges {
                if next == to {
                    let mut path = vec![edge];
                    let mut at = node;
                    while at != from {
                        let edge = came_by[at.index()]?;
                        path.push(edge);
                        at = self.graph.edge_endpoints(edge)?.0;
                    }
                    path.reverse();
                    return Some(path);
                }
                if next != from && counts(next.index()) && came_by[next.index()].is_none() {
                    came_by[next.index()] = Some(edge);
                    queue.push_back(next);
                }
            }
        }
        None
    }

    /// The declared chain of enabled lenses that puts `above` above `below`, as pairs of file positions.
    pub fn chain(&self, below: usize, above: usize, ranks: &[Rank]) -> Option<Vec<(usize, usize, &Declared)>> {
        let path = self.path(NodeIndex::new(below), NodeIndex::new(above), &|lens| ranks[lens].enabled)?;
        path.into_iter()
            .map(|edge| {
                let (a, b) = self.graph.edge_endpoints(edge)?;
                Some((a.index(), b.index(), &self.graph[edge]))
            })
            .collect()
    }

    /// The enabled lenses, lowest first, as positions in the file. Greedy, as section 3.3 has it.
    pub fn total_order(&self, ranks: &[Rank]) -> Vec<usize> {
        self.order_by(ranks, |lens| lens)
    }

    /// Whether two lenses would come the other way round if the file listed the lower one last and the upper one first.
    pub fn turns_round(&self, below: usize, above: usize, ranks: &[Rank]) -> bool {
        let order = self.order_by(ranks, |lens| (lens == below, lens != above, lens));
        order.iter().find(|lens| [below, above].contains(lens)) == Some(&above)
    }

    /// The order if the lenses stood in the file as `place` sorts them.
    fn order_by<K: Ord + Copy>(&self, ranks: &[Rank], place: impl Fn(usize) -> K) -> Vec<usize> {
        let enabled = || (0..ranks.len()).filter(|lens| ranks[*lens].enabled);
        // How many lenses each one still waits for.
        let mut waits = vec![0usize; ranks.len()];
        self.above.iter().flatten().for_each(|lens| waits[*lens] += 1);
        let mut ready = Ready::default();
        enabled().filter(|lens| waits[*lens] == 0).for_each(|lens| ready.insert(lens, &ranks[lens], place(lens)));
        let mut order = Vec::with_capacity(ranks.len());
        while let Some(next) = ready.take(ranks) {
            order.push(next);
            for &lens in &self.above[next] {
                waits[lens] -= 1;
                if waits[lens] == 0 {
                    ready.insert(lens, &ranks[lens], place(lens));
                }
            }
        }
        order
    }
}

/// The lenses that wait for no other, sorted by who comes next.
struct Ready<K> {
    /// By priority and place.
    all: BTreeMap<(i64, K), usize>,
    /// Flat lenses by priority, the farthest first, then by place.
    flat: BTreeMap<(i64, Reverse<Distance>, K), usize>,
}

impl<K> Default for Ready<K> {
    fn default() -> Self {
        Self { all: BTreeMap::new(), flat: BTreeMap::new() }
    }
}

impl<K: Ord + Copy> Ready<K> {
    fn insert(&mut self, lens: usize, rank: &Rank, place: K) {
        self.all.insert((rank.priority, place), lens);
        if let Some(distance) = rank.flat {
            self.flat.insert((rank.priority, Reverse(Distance(distance)), place), lens);
        }
    }

    /// Takes, of the lenses of lowest priority, the earliest; if that is flat, the farthest of those that are, then
    /// the earlier.
    fn take(&mut self, ranks: &[Rank]) -> Option<usize> {
        let first = self.all.first_entry()?;
        if ranks[*first.get()].flat.is_none() {
            return Some(first.remove());
        }
        let ((priority, _, place), _) = self.flat.pop_first()?;
        self.all.remove(&(priority, place))
    }
}

/// A distance that sorts.
#[derive(Clone, Copy)]
struct Distance(f64);

impl Ord for Distance {
    fn cmp(&self, other: &Self) -> Ordering {
        self.0.total_cmp(&other.0)
    }
}

impl PartialOrd for Distance {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Distance {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Distance {}

/// The other lenses a pattern stands for.
fn matched(spec: &Spec, names: &Names, own: usize, pattern: &At<Pattern>) -> Result<Vec<usize>, InputError> {
    let mut others = names.matched(&pattern.value);
    others.retain(|lens| *lens != own);
    if others.is_empty() {
        let message = format!("no other lens matches `{}`", pattern.value);
        return Err(InputError::at(&spec.source, pattern.span.clone(), message)
            .help("name a lens of this file, or a pattern that matches one"));
    }
    Ok(others)
}

fn too_many_edges(spec: &Spec, pattern: &At<Pattern>) -> InputError {
    let message = format!("`over`, `under` and `hides` put more than {MAX_EDGES} pairs of lenses in order");
    InputError::at(&spec.source, pattern.span.clone(), message)
        .help("`priority` orders any number of lenses without naming pairs")
}

fn cycle_error(spec: &Spec, graph: &PriorityGraph, cycle: &[EdgeIndex]) -> InputError {
    let mut error = InputError::new(cycle_text(spec, graph, cycle)).help("remove one of these edges");
    error.source_text = Some(Box::new(spec.source.clone()));
    for edge in cycle.iter().take(MOST_LABELS) {
        let (below, above) = names_of_ends(spec, graph, *edge);
        error.labels.push((graph.graph[*edge].span.clone(), format!("`{below}` below `{above}`")));
    }
    error
}

/// "the order of the lenses goes in a circle", with the whole circle, each edge with its line.
fn cycle_text(spec: &Spec, graph: &PriorityGraph, cycle: &[EdgeIndex]) -> String {
    let ends = || cycle.iter().map(|edge| names_of_ends(spec, graph, *edge));
    let mut names: Vec<&str> = ends().map(|(below, _)| below).collect();
    names.push(names[0]);
    let lines = cycle.iter().zip(ends()).map(|(edge, (below, above))| {
        let declared = &graph.graph[*edge];
        let spot = spec.source.spot(declared.span.start);
        format!("{spot} (`{}`) puts `{below}` below `{above}`", declared.key.name())
    });
    let lines: Vec<String> = lines.collect();
    format!("the order of the lenses goes in a circle: {}: {}", names.join(" < "), lines.join(", "))
}

/// Below and above.
fn names_of_ends<'a>(spec: &'a Spec, graph: &PriorityGraph, edge: EdgeIndex) -> (&'a str, &'a str) {
    let name = |lens: NodeIndex| spec.lenses[lens.index()].name.value.as_str();
    let (below, above) = graph.graph.edge_endpoints(edge).expect("edges of the cycle are in the graph");
    (name(below), name(above))
}
