//! Patterns that match nothing, and what the models left out.

use super::{Instance, Item, Lens, Rule};
use crate::scene::{Coincident, Model, Scene};
use crate::spec::suggest::{self, MOST_SUGGESTED};
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
        warnings.push(format!(
            "{}: `time` changes nothing: no node of the models is animated",
            spec.source.place(time.span.start)
        ));
    }
    warnings.extend(unmatched(spec, scene));
    warnings
}

/// So many patterns that match nothing are told one by one.
const MOST_TOLD: usize = MOST_SUGGESTED;

/// A line for each pattern that matches nothing, as far as one reads them.
fn unmatched(spec: &Spec, scene: &Scene) -> Vec<String> {
    let (of_scene, of_nodes) = (scene.models[0].node_names(), node_names(&scene.models));
    let of_materials = Names::new(scene.models.iter().flat_map(|m| &m.materials).map(|m| m.name.as_str()));
    let (mut told, mut more) = (Vec::new(), 0);
    let mut check = |key: &str, owner: &str, patterns: &[At<Pattern>], names: &Names| {
        for pattern in patterns.iter().filter(|p| !names.any(&p.value)) {
            if told.len() == MOST_TOLD {
                more += 1;
                continue;
            }
            let here = spec.source.place(pattern.span.start);
            let near = suggest::nearest(&pattern.value.0, names.iter());
            let help = near.map_or(String::new(), |name| format!("; did you mean `{name}`?"));
            told.push(format!("{here}: `{key}`{owner} matches nothing: `{}`{help}", pattern.value));
        }
    };
    check("hide", "", &spec.scene.hide, &of_scene);
    let of_lenses = spec.lenses.iter().map(|lens| {
        let scopes = [("only", &lens.only), ("except", &lens.except)];
        let scopes = scopes.map(|(key, Matches { nodes, materials })| (key, nodes.as_slice(), materials.as_slice()));
        (format!(" of lens `{}`", lens.name.value), scopes.to_vec(), &lens.filters)
    });
    let of_rules = spec.overlaps.iter().map(|rule| {
        let name = super::rules::name(spec, rule);
        (format!(" of the {name}"), Vec::new(), &rule.filters)
    });
    for (owner, scopes, filters) in of_lenses.chain(of_rules) {
        let of_filters = filters.iter().filter_map(|filter| match &filter.value {
            Filter::Erase { nodes, materials, .. } => Some(("erase", nodes.as_slice(), materials.as_slice())),
            Filter::Displace { nodes, .. } => Some(("displace", nodes.as_slice(), &[][..])),
            _ => None,
        });
        for (key, nodes, materials) in scopes.into_iter().chain(of_filters) {
            check(key, &owner, nodes, &of_nodes);
            check(key, &owner, materials, &of_materials);
        }
    }
    if more > 0 {
        told.push(format!("and {more} more patterns match nothing"));
    }
    told
}

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
        Some(format!("{}: lens `{}` {problem}", spec.source.place(own.name.span.start), lens.name))
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
    let of_rules = of_rules.map(|(rule, overlap)| (rule.lod, format!("the {}", rule.name), &overlap.filters));
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

/// Where there is more to find than is looked for.
pub(super) fn of_coincident(found: &Coincident) -> Option<String> {
    found.is_partial.then(|| {
        "more triangles lie over each other in one plane than are told apart: which of the rest are seen is left to rounding"
            .into()
    })
}

fn moves(scene: &Scene) -> bool {
    scene.models.iter().flat_map(|model| &model.animations).any(|animation| !animation.channels.is_empty())
}

fn node_names(models: &[Model]) -> Names<'_> {
    Names::new(models.iter().flat_map(|model| &model.nodes).map(|node| node.name.as_str()))
}
