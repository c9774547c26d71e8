//! The priority graph for Graphviz and Mermaid: what is declared, what overrides what, and what is undecided.

use std::collections::BTreeSet;

use super::Explanation;
use crate::plan::Key;

/// What a line of the graph says of the two lenses it joins.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
enum Link {
    /// By `over` or `under`; with the key and its place.
    Above(&'static str, String),
    /// By `hides`, with its place.
    Hides(String),
    /// The upper one overrides all below it, and the two overlap.
    Overrides,
    /// Only the order of the file separates them.
    Undecided,
}

impl Link {
    fn label(&self) -> String {
        match self {
            Link::Above(key, place) => format!("{key}, {place}"),
            Link::Hides(place) => format!("hides, {place}"),
            Link::Overrides => "overrides".into(),
            Link::Undecided => "undecided".into(),
        }
    }
}

impl Explanation<'_> {
    /// Lower and upper lens by their places in the file, with what joins them.
    fn links(&self) -> Vec<(usize, usize, Link)> {
        let (plan, spec) = (self.plan, self.spec);
        let graph = &plan.graph.graph;
        let declared = graph.edge_indices().filter_map(|edge| {
            let (below, above) = graph.edge_endpoints(edge)?;
            // In a graph's text a quote would end the label.
            let place = spec.source.spot(graph[edge].span.start).replace('"', "'");
            let link = match graph[edge].key {
                Key::Hides => Link::Hides(place),
                key => Link::Above(key.name(), place),
            };
            Some((below.index(), above.index(), link))
        });
        let hidden: BTreeSet<(usize, usize)> =
            self.regions.iter().flat_map(|(_, region)| region.hidden(plan)).collect();
        let overridden = hidden.into_iter().filter(|(_, by)| plan.lenses[*by].overrides);
        let overridden = overridden.map(|(lens, by)| (plan.lenses[lens].index, plan.lenses[by].index, Link::Overrides));
        let place = |name: &str| plan.lenses.iter().find(|lens| lens.name == name).map(|lens| lens.index);
        let undecided = self.account.undecided.iter();
        let undecided = undecided.filter_map(|u| Some((place(&u.below)?, place(&u.above)?, Link::Undecided)));
        declared.chain(overridden).chain(undecided).collect()
    }

    /// For Graphviz.
    pub fn dot(&self) -> String {
        let mut text = String::from("digraph lenses {\n  rankdir = BT;\n  node [shape = box, style = rounded];\n");
        for (index, lens) in self.spec.lenses.iter().enumerate() {
            let name = &lens.name.value;
            text += &match self.plan.lenses.iter().position(|l| l.index == index) {
                Some(rank) => {
                    let filters: Vec<&str> = self.plan.filter_names(rank).collect();
                    let borders = if self.plan.lenses[rank].overrides { ", peripheries = 2" } else { "" };
                    format!("  \"{name}\" [label = \"{}. {name}\\n{}\"{borders}];\n", rank + 1, filters.join(", "))
                }
                None => format!("  \"{name}\" [label = \"{name}\\n(disabled)\", style = \"rounded,dashed\"];\n"),
            };
        }
        for (below, above, link) in self.links() {
            let [below, above] = [below, above].map(|index| &self.spec.lenses[index].name.value);
            let style = match link {
                Link::Above(..) => "",
                Link::Hides(_) => ", color = firebrick, fontcolor = firebrick",
                Link::Overrides => ", color = firebrick, fontcolor = firebrick, penwidth = 2",
                Link::Undecided => ", style = dashed, dir = none, color = gray40, fontcolor = gray40",
            };
            text += &format!("  \"{below}\" -> \"{above}\" [label = \"{}\"{style}];\n", link.label());
        }
        text + "}\n"
    }

    /// For Mermaid. A label that begins like a list item is refused there, so the rank stands behind the name.
    pub fn mermaid(&self) -> String {
        let mut text = String::from("flowchart BT\n");
        for (index, lens) in self.spec.lenses.iter().enumerate() {
            let name = &lens.name.value;
            text += &match self.plan.lenses.iter().position(|l| l.index == index) {
                Some(rank) => {
                    let filters: Vec<&str> = self.plan.filter_names(rank).collect();
                    format!("  l{index}[\"{name} ({})<br/>{}\"]\n", rank + 1, filters.join(", "))
                }
                None => format!("  l{index}[\"{name}<br/>(disabled)\"]:::disabled\n"),
            };
        }
        let mut styles = String::new();
        for (number, (below, above, link)) in self.links().into_iter().enumerate() {
            let arrow = match link {
                Link::Above(..) | Link::Hides(_) => "-->",
                Link::Overrides => "==>",
                Link::Undecided => "-.-",
            };
            text += &format!("  l{below} {arrow}|\"{}\"| l{above}\n", link.label());
            if matches!(link, Link::Hides(_) | Link::Overrides) {
                styles += &format!("  linkStyle {number} stroke:#b22222\n");
            }
        }
        text + &styles + "  classDef disabled stroke-dasharray: 4 4\n"
    }
}
