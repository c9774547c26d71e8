//! Patterns that match nothing, and what the models left out.

use super::{Instance, Item, Lens, Rule};
use crate::scene::{Model, Scene, nearest};
use crate::spec::{At, By, Filter, Matches, Names, Pattern, Spec};

pub(super) fn collect(spec: &Spec, scene: &Scene) -> Vec<String> {
    let mut warnings: Vec<String> = Vec::new();
    // A file may be scene, alternate and lens at once.
    for warning in scene.models.iter().flat_map(Model::named_warnings).chain(scene.lens_warnings.iter().cloned()) {
        if !warnings.contains(&warning) {
            warnings.push(warning);
        }
    }
    if let Some(time) = spec.scene.time.as_ref().filter(|_| !moves(scene)) {
        let line = spec.source.line(time.span.start);
        warnings
            .push(format!("{}:{line}: `time` changes nothing: no node of the models is animated", spec.source.name));
    }
    let (nodes_of_scene, nodes) = (scene.models[0].node_names(), node_names(&scene.models));
    let materials = Names::new(scene.models.iter().flat_map(|m| &m.materials).map(|m| m.name.as_str()));
    let mut told = 0;
    let mut check = |place: String, patterns: &[At<Pattern>], names: &Names| {
        for pattern in patterns.iter().filter(|p| !names.any(&p.value)) {
            let line = spec.source.line(pattern.span.start);
            told += 1;
            let near = if told > MOST_NEAREST { None } else { nearest(&pattern.value.0, names.iter()) };
            let help = near.map_or(String::new(), |name| format!("; did you mean `{name}`?"));
            warnings.push(format!("{}:{line}: {place} matches nothing: `{}`{help}", spec.source.name, pattern.value));
        }
    };
    check("`hide`".into(), &spec.scene.hide, &nodes_of_scene);
    let (node, material) = (&nodes, &materials);
    for lens in &spec.lenses {
        let name = &lens.name.value;
        for (key, Matches { nodes, materials }) in [("only", &lens.only), ("except", &lens.except)] {
            check(format!("`{key}` of lens `{name}`"), nodes, node);
            check(format!("`{key}` of lens `{name}`"), materials, material);
        }
        for filter in &lens.filters {
            match &filter.value {
                Filter::Erase { nodes, materials, .. } => {
                    check(format!("`erase` of lens `{name}`"), nodes, node);
                    check(format!("`erase` of lens `{name}`"), materials, material);
                }
                Filter::Displace { nodes, .. } => check(format!("`displace` of lens `{name}`"), nodes, node),
                _ => {}
            }
        }
    }
    warnings
}

/// For so many patterns that match nothing a name is looked for that may have been meant.
const MOST_NEAREST: usize = 20;

/// Lenses that mean nothing to what the scene draws.
pub(super) fn of_reach(spec: &Spec, lenses: &[Lens], items: &[Item], instances: &[Instance]) -> Vec<String> {
    let warn = |(rank, lens): (usize, &Lens)| {
        let own = &spec.lenses[lens.index];
        let is_there = |item: &Item| item.scope.contains(rank) || item.shown_by.contains(rank);
        let shows = own.filters.iter().any(|filter| matches!(filter.value, Filter::Show(_)));
        let problem = if !items.iter().any(is_there) {
            "acts on nothing: its `only` and `except` leave nothing of the scene"
        } else if shows && !items.iter().any(|item| item.shown_by.contains(rank)) {
            "brings nothing in: of what its `show` names, nothing has triangles or is left by its filters"
        } else if !instances.iter().any(|instance| may_meet(rank, lens, instance, items)) {
            match (lens.by, lens.volume.is_flat()) {
                (By::Object, _) => "meets nothing: with by = \"object\" it takes whole nodes, and no centre is inside",
                (By::Pixel, true) => "meets nothing: nothing that it acts on is seen through it",
                (By::Pixel, false) => "meets nothing: nothing that it acts on lies in its volume",
            }
        } else {
            return None;
        };
        let line = spec.source.line(own.name.span.start);
        Some(format!("{}:{line}: lens `{}` {problem}", spec.source.name, lens.name))
    };
    lenses.iter().enumerate().filter_map(warn).collect()
}

/// False only if a lens surely is nowhere around an instance.
fn may_meet(rank: usize, lens: &Lens, instance: &Instance, items: &[Item]) -> bool {
    let item = &items[instance.item];
    let applies = item.scope.contains(rank) || item.shown_by.contains(rank);
    applies
        && match lens.by {
            By::Object => item.object.contains(rank),
            By::Pixel => lens.volume.holds_box(&instance.bounds) != Some(false),
        }
}

/// So many times what a `lod` asks for is worth a word.
const MANY: f64 = 1.5;

/// Lenses and rules whose `lod` leaves more than it was asked for.
pub(super) fn of_lods(spec: &Spec, lenses: &[Lens], rules: &[Rule], items: &[Item]) -> Vec<String> {
    let of_lenses =
        lenses.iter().map(|lens| (lens.lod, format!("lens `{}`", lens.name), &spec.lenses[lens.index].filters));
    let of_rules = rules.iter().zip(&spec.overlaps);
    let of_rules =
        of_rules.map(|(rule, overlap)| (rule.lod, format!("the rule in line {}", rule.line), &overlap.filters));
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
            "{}:{}: `lod` of {name} leaves {:.1} % of the triangles, not {:.1} %: fewer would move borders, or surfaces too far",
            spec.source.name,
            spec.source.line(filter.span.start),
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
