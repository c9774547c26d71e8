//! Did you mean: the nearest known name, and lists of names for messages.

/// Characters up to which names are compared: longer ones are no slips of the hand.
const LONGEST: usize = 64;
/// The most names that are compared.
const MOST_COMPARED: usize = 4096;
/// For so many things that are not known a name is looked for that may have been meant.
pub const MOST_SUGGESTED: usize = 20;
/// The most names that a message lists.
const MOST_LISTED: usize = 64;

/// The candidate nearest to what was written, if any is near enough to be a slip of the hand.
pub fn nearest<'a>(written: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let is_short = |name: &str| name.chars().take(LONGEST + 1).count() <= LONGEST;
    if !is_short(written) {
        return None;
    }
    let lower = written.to_lowercase();
    known
        .into_iter()
        .filter(|name| !name.is_empty() && is_short(name))
        .take(MOST_COMPARED)
        .map(|name| (strsim::damerau_levenshtein(&lower, &name.to_lowercase()), name))
        .filter(|(distance, name)| *distance <= 1 + name.chars().count().max(lower.chars().count()) / 4)
        .min_by_key(|(distance, _)| *distance)
        .map(|(_, name)| name)
}

/// "did you mean `x`?" when something is near, else all that is known.
pub fn help<'a>(written: &str, known: impl IntoIterator<Item = &'a str> + Clone) -> String {
    match nearest(written, known.clone()) {
        Some(name) => format!("did you mean `{name}`?"),
        None => format!("known here: {}", listed(known)),
    }
}

/// "`a`, `b`, `c`"
pub fn listed<'a>(names: impl IntoIterator<Item = &'a str>) -> String {
    let mut names = names.into_iter();
    let mut quoted: Vec<String> = names.by_ref().take(MOST_LISTED).map(|name| format!("`{name}`")).collect();
    let more = names.count();
    if more > 0 {
        quoted.push(format!("and {more} more"));
    }
    quoted.join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_any_length_are_answered_at_once() {
        let (long, longer) = ("a".repeat(200_000), "a".repeat(200_001));
        assert_eq!(nearest(&long, [longer.as_str(), "a"]), None);
        assert_eq!(nearest("prbe", [longer.as_str(), "probe"]), Some("probe"));
    }

    #[test]
    fn lists_end() {
        let names: Vec<String> = (0..1000).map(|i| format!("n{i}")).collect();
        let list = listed(names.iter().map(String::as_str));
        assert!(list.ends_with("`n63`, and 936 more"), "{list}");
    }
}
