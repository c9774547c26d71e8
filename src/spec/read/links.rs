//! What only the whole file can tell: names that must be unique, and names that must exist.

use std::collections::{HashMap, HashSet};

use super::suggest;
use crate::InputError;
use crate::error::Faults;
use crate::limits::{MAX_COMPARISONS, MAX_LENSES, MAX_PARTS, MAX_PLANES, MAX_RULES, MAX_WRITTEN_LENSES};
use crate::spec::{At, Condition, Filter, LensSpec, Names, NamesSize, Pattern, Shape, ShowWhat, Source, Spec};

pub fn check(spec: &Spec) -> Result<(), InputError> {
    let names = Names::new(spec.lenses.iter().map(|lens| lens.name.value.as_str()));
    let alternates = spec.scene.alternates.iter().map(|(name, _)| name.as_str()).collect();
    let links = Links { source: &spec.source, spec, names, alternates };
    // Of too many nothing else is looked at.
    links.count_written()?;
    links.count_comparisons()?;
    let mut faults = Faults::default();
    for counted in [links.count(), links.count_rules(), links.count_parts(), links.count_planes()] {
        faults.take(counted);
    }
    links.unique_names(&mut faults);
    spec.lenses.iter().for_each(|lens| links.lens(lens, &mut faults));
    for rule in &spec.overlaps {
        links.condition(&rule.when.value, &mut faults);
        links.filters(&rule.filters, &mut faults);
    }
    faults.finish()
}

struct Links<'a> {
    source: &'a Source,
    spec: &'a Spec,
    /// Of all lenses.
    names: Names<'a>,
    alternates: HashSet<&'a str>,
}

impl Links<'_> {
    fn count_written(&self) -> Result<(), InputError> {
        let Some(first_too_many) = self.spec.lenses.get(MAX_WRITTEN_LENSES) else { return Ok(()) };
        let count = self.spec.lenses.len();
        let message =
            format!("the file has {count} lenses, and at most {MAX_WRITTEN_LENSES} can be, disabled ones included");
        Err(self.error(&first_too_many.name, message).help("leave out what is never enabled"))
    }

    /// How often patterns are held against the names of lenses.
    fn count_comparisons(&self) -> Result<(), InputError> {
        let names: NamesSize = self.names.iter().collect();
        let of_lenses = self.spec.lenses.iter().flat_map(|lens| lens.over.iter().chain(&lens.under).chain(&lens.hides));
        let of_rules = self.spec.overlaps.iter().flat_map(|rule| rule.when.value.patterns());
        let mut steps = 0u64;
        for pattern in of_lenses.chain(of_rules) {
            steps = steps.saturating_add(names.steps([&pattern.value]));
            if steps > MAX_COMPARISONS {
                let message = format!(
                    "patterns with wildcards over the names of {} lenses are too many to compare: \
                     that takes more than {MAX_COMPARISONS} steps",
                    names.count
                );
                return Err(self.error(pattern, message).help("names without `*` and `?` cost nothing"));
            }
        }
        Ok(())
    }

    fn count(&self) -> Result<(), InputError> {
        let enabled = || self.spec.lenses.iter().filter(|lens| lens.enabled);
        let Some(first_too_many) = enabled().nth(MAX_LENSES) else { return Ok(()) };
        let message = format!("{} lenses are enabled, and at most {MAX_LENSES} can be", enabled().count());
        Err(self.error(&first_too_many.name, message).help("disable some with `enabled = false`"))
    }

    fn count_rules(&self) -> Result<(), InputError> {
        let Some(first_too_many) = self.spec.overlaps.get(MAX_RULES) else { return Ok(()) };
        let message = format!("there are {} overlap rules, and at most {MAX_RULES} can be", self.spec.overlaps.len());
        Err(self.error(&first_too_many.when, message).help("one rule can stand for many: join conditions with `|`"))
    }

    /// All parts of all enabled lenses.
    fn count_parts(&self) -> Result<(), InputError> {
        let parts = || self.spec.lenses.iter().filter(|lens| lens.enabled).flat_map(|lens| lens.shape.parts());
        let Some(first_too_many) = parts().nth(MAX_PARTS) else { return Ok(()) };
        let message =
            format!("the shapes of the enabled lenses have {} parts, and at most {MAX_PARTS} can be", parts().count());
        Err(self.error(first_too_many, message).help("a hull or a mesh is one part, however many faces it has"))
    }

    /// All planes of polytopes and corners of flat lenses: shapes of disabled lenses are made, too.
    fn count_planes(&self) -> Result<(), InputError> {
        let mut count = 0;
        let mut first_too_many = None;
        for part in self.spec.lenses.iter().flat_map(|lens| lens.shape.parts()) {
            count += match &part.value {
                Shape::Polytope { planes } => planes.len(),
                Shape::Flat { corners, .. } => corners.len(),
                _ => 0,
            };
            first_too_many = first_too_many.or((count > MAX_PLANES).then_some(part));
        }
        let Some(part) = first_too_many else { return Ok(()) };
        let message = format!(
            "the lenses have {count} planes of polytopes and corners of flat lenses, and at most {MAX_PLANES} can be, \
             those of disabled lenses included"
        );
        Err(self.error(part, message).help("a `hull` or a `mesh` may have any number of faces"))
    }

    fn unique_names(&self, faults: &mut Faults) {
        let mut seen: HashMap<&str, &At<String>> = HashMap::new();
        for lens in &self.spec.lenses {
            if let Some(first) = seen.get(lens.name.value.as_str()) {
                let message = format!("there are two lenses named `{}`", lens.name.value);
                let error = self.error(&lens.name, message).label(first.span.clone(), "the first is here");
                faults.note(error.help("rename one of them"));
            }
            seen.entry(&lens.name.value).or_insert(&lens.name);
        }
    }

    fn lens(&self, lens: &LensSpec, faults: &mut Faults) {
        for (key, patterns) in [("over", &lens.over), ("under", &lens.under), ("hides", &lens.hides)] {
            for pattern in patterns {
                faults.take(self.other_lens(lens, key, pattern, faults.are_few()));
            }
        }
        self.filters(&lens.filters, faults);
    }

    /// An edge must lead to a lens other than its own (SEMANTICS 3.1).
    fn other_lens(&self, lens: &LensSpec, key: &str, pattern: &At<Pattern>, suggests: bool) -> Result<(), InputError> {
        let name = &lens.name.value;
        let matches_itself = pattern.value.matches(name);
        // Names are unique, so what matches more than once matches another.
        if self.names.count(&pattern.value, 2) > usize::from(matches_itself) {
            return Ok(());
        }
        if !matches_itself {
            let others = self.names.iter().filter(|other| other != name);
            let others = suggests.then_some(others);
            return Err(self.no_match(&format!("`{key}` of lens `{name}` names"), pattern, others));
        }
        let message = format!("`{key}` of lens `{name}` names no lens but itself: \"{}\"", pattern.value);
        Err(self.error(pattern, message).help("name another lens, or leave it out"))
    }

    fn condition(&self, condition: &Condition, faults: &mut Faults) {
        for pattern in condition.patterns().into_iter().filter(|pattern| !self.names.any(&pattern.value)) {
            let names = faults.are_few().then(|| self.names.iter());
            faults.note(self.no_match("`when` names", pattern, names));
        }
    }

    fn filters(&self, filters: &[At<Filter>], faults: &mut Faults) {
        for filter in filters {
            if let Filter::Show(ShowWhat::Alternate { name, .. }) = &filter.value {
                faults.take(self.alternate(name, faults.are_few()));
            }
        }
    }

    fn alternate(&self, wanted: &At<String>, suggests: bool) -> Result<(), InputError> {
        if self.alternates.contains(wanted.value.as_str()) {
            return Ok(());
        }
        let help = match self.alternates.is_empty() || !suggests {
            true => format!("add it: [scene.alternates] and below it {} = \"file.glb\"", wanted.value),
            false => suggest::help(&wanted.value, self.spec.scene.alternates.iter().map(|(name, _)| name.as_str())),
        };
        Err(self.error(wanted, format!("there is no alternate `{}`", wanted.value)).help(help))
    }

    /// `names`: those that may have been meant; `None` where nobody would read them.
    fn no_match<'n>(
        &self,
        what: &str,
        pattern: &At<Pattern>,
        names: Option<impl Iterator<Item = &'n str> + Clone>,
    ) -> InputError {
        let kind = if pattern.value.has_wildcard() { "no lens matches it" } else { "there is none" };
        let help = match names {
            None => "name a lens of this file".to_owned(),
            Some(names) if names.clone().next().is_none() => "there is no other lens".to_owned(),
            Some(names) => suggest::help(&pattern.value.0, names),
        };
        self.error(pattern, format!("{what} \"{}\", but {kind}", pattern.value)).help(help)
    }

    fn error<T>(&self, place: &At<T>, message: String) -> InputError {
        InputError::at(self.source, place.span.clone(), message)
    }
}
