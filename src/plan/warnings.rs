//! Patterns that match nothing, and what the models left out.

use super::{Item, Lens, Rule};
use crate::scene::{Model, Scene};
use crate::spec::{At, Filter, Matches, Names, Pattern, Spec};

pub(super) fn collect(spec: &Spec, scene: &Scene) -> Vec<String> {
    let mut warnings: Vec<String> = scene.models.iter().flat_map(|m| m.warnings.iter().cloned()).collect();
    if let Some(time) = spec.scene.time.as_ref().filter(|_| !moves(scene)) {
        warnings.push(format!(
            "{}: `time` changes nothing: no node of the models is animated",
            spec.source.place(time.span.start)
        ));
    }
    let mut check = |place: String, patterns: &[At<Pattern>], known: &dyn Fn(&Pattern) -> bool| {
        for pattern in patterns.iter().filter(|p| !known(&p.value)) {
            let here = spec.source.place(pattern.span.start);
            warnings.push(format!("{here}: {place} matches nothing: `{}`", pattern.value));
        }
    };
    let (nodes_of_scene, nodes) = (scene.models[0].node_names(), node_names(&scene.models));
    let materials = Names::new(scene.models.iter().flat_map(|m| &m.materials).map(|m| m.name.as_str()));
    let node = |p: &Pattern| nodes.any(p);
    let material = |p: &Pattern| materials.any(p);
    check("`hide`".into(), &spec.scene.hide, &|p| nodes_of_scene.any(p));
    for lens in &spec.lenses {
        let name = &lens.name.value;
        for (key, Matches { nodes, materials }) in [("only", &lens.only), ("except", &lens.except)] {
            check(format!("`{key}` of lens `{name}`"), nodes, &node);
            check(format!("`{key}` of lens `{name}`"), materials, &material);
        }
        for filter in &lens.filters {
            match &filter.value {
                Filter::Erase { nodes, materials, .. } => {
                    check(format!("`erase` of lens `{name}`"), nodes, &node);
                    check(format!("`erase` of lens `{name}`"), materials, &material);
                }
                Filter::Displace { nodes, .. } => check(format!("`displace` of lens `{name}`"), nodes, &node),
                _ => {}
            }
        }
    }
    warnings
}

/// So many times what a `lod` asks for is worth a word.
const MANY: f64 = 1.5;

/// Lenses and rules whose `lod` leaves more than it was asked for.
pub(super) fn of_lods(spec: &Spec, lenses: &[Lens], rules: &[Rule], items: &[Item]) -> Vec<String> {
    let of_lenses =
        lenses.iter().map(|lens| (lens.lod, format!("lens `{}`", lens.name), &spec.lenses[lens.index].filters));
    let of_rules = rules.iter().zip(&spec.overlaps).enumerate();
    let of_rules = of_rules.map(|(n, (rule, overlap))| (rule.lod, format!("overlap rule {n}"), &overlap.filters));
    let lods = of_lenses.chain(of_rules).enumerate().filter_map(|(rank, (ratio, name, filters))| {
        let ratio = ratio.filter(|ratio| *ratio < 1.0)?;
        let all = |ratio: f32| -> f64 {
            let own = items.iter().filter(|item| item.simplified_by.contains(rank) && item.ratio == ratio);
            own.map(|item| f64::from(item.triangles)).sum()
        };
        let (left, all) = (all(ratio), all(1.0));
        if left <= MANY * f64::from(ratio) * all {
            return None;
        }
        let filter = filters.iter().find(|filter| matches!(filter.value, Filter::Lod { .. }))?;
        Some(format!(
            "{}: `lod` of {name} leaves {:.1} % of the triangles, not {:.1} %: fewer would move borders, or surfaces too far",
            spec.source.place(filter.span.start),
            100.0 * left / all,
            100.0 * ratio,
        ))
    });
    lods.collect()
}

fn moves(scene: &Scene) -> bool {
    scene.models.iter().flat_map(|model| &model.animations).any(|animation| !animation.channels.is_empty())
}

fn node_names(models: &[Model]) -> Names<'_> {
    Names::new(models.iter().flat_map(|model| &model.nodes).map(|node| node.name.as_str()))
}
