//! Name patterns: `*` stands for any run of characters, `?` for one; the whole name must match, case minded.

use std::collections::{HashMap, HashSet};

/// A name pattern as written.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct Pattern(pub String);

impl Pattern {
    pub fn new(text: impl Into<String>) -> Self {
        Self(text.into())
    }

    /// Whether the pattern has a wildcard (else it names exactly one thing).
    pub fn has_wildcard(&self) -> bool {
        self.0.contains(['*', '?'])
    }

    /// Greedy matching with one remembered star: no allocation, and no more steps than the product of both lengths.
    pub fn matches(&self, name: &str) -> bool {
        if !self.has_wildcard() {
            return self.0 == name;
        }
        let (pattern, name) = (self.0.as_bytes(), name.as_bytes());
        let (mut p, mut n) = (0, 0);
        let mut star: Option<(usize, usize)> = None;
        while n < name.len() {
            match pattern.get(p) {
                Some(b'*') => {
                    star = Some((p, n));
                    p += 1;
                }
                Some(b'?') => {
                    p += 1;
                    n += char_length(name[n]);
                }
                Some(byte) if *byte == name[n] => {
                    p += 1;
                    n += 1;
                }
                _ => {
                    let Some((star_p, star_n)) = star else { return false };
                    let next = star_n + char_length(name[star_n]);
                    (p, n) = (star_p + 1, next);
                    star = Some((star_p, next));
                }
            }
        }
        pattern[p..].iter().all(|byte| *byte == b'*')
    }
}

/// Bytes of the character that begins with this byte of UTF-8.
fn char_length(first: u8) -> usize {
    match first {
        0xf0.. => 4,
        0xe0.. => 3,
        0xc0.. => 2,
        _ => 1,
    }
}

/// Names that patterns are held against, by their places in a list: one that stands for itself is looked up.
#[derive(Debug, Clone)]
pub struct Names<'a> {
    all: Vec<&'a str>,
    places: HashMap<&'a str, Vec<usize>>,
}

impl<'a> Names<'a> {
    pub fn new(names: impl IntoIterator<Item = &'a str>) -> Self {
        let all: Vec<&str> = names.into_iter().collect();
        let mut places: HashMap<&str, Vec<usize>> = HashMap::with_capacity(all.len());
        all.iter().enumerate().for_each(|(place, name)| places.entry(name).or_default().push(place));
        Self { all, places }
    }

    /// In rising order.
    pub fn matched(&self, pattern: &Pattern) -> Vec<usize> {
        if pattern.has_wildcard() {
            return (0..self.all.len()).filter(|place| pattern.matches(self.all[*place])).collect();
        }
        self.places.get(pattern.0.as_str()).cloned().unwrap_or_default()
    }

    /// Whether some name matches.
    pub fn any(&self, pattern: &Pattern) -> bool {
        match pattern.has_wildcard() {
            true => self.all.iter().any(|name| pattern.matches(name)),
            false => self.places.contains_key(pattern.0.as_str()),
        }
    }

    /// How many names match, counted up to `most`.
    pub fn count(&self, pattern: &Pattern, most: usize) -> usize {
        match pattern.has_wildcard() {
            true => self.all.iter().filter(|name| pattern.matches(name)).take(most).count(),
            false => self.places.get(pattern.0.as_str()).map_or(0, Vec::len).min(most),
        }
    }

    pub fn iter(&self) -> impl Iterator<Item = &'a str> + Clone + '_ {
        self.all.iter().copied()
    }
}

/// How many names there are, and how many bytes they have together.
#[derive(Debug, Clone, Copy, Default)]
pub struct NamesSize {
    pub count: u64,
    pub bytes: u64,
}

impl<'a> FromIterator<&'a str> for NamesSize {
    fn from_iter<I: IntoIterator<Item = &'a str>>(names: I) -> Self {
        let add = |all: Self, name: &str| Self { count: all.count + 1, bytes: all.bytes + name.len() as u64 };
        names.into_iter().fold(Self::default(), add)
    }
}

impl NamesSize {
    /// What it takes to hold the wildcards of a list against the names, as
    /// [`MAX_COMPARISONS`](crate::limits::MAX_COMPARISONS) counts: a pattern and a name take at most the product of both
    /// lengths, and a sixteenth of that counts.
    pub fn steps<'p>(&self, patterns: impl IntoIterator<Item = &'p Pattern>) -> u64 {
        let wild = patterns.into_iter().filter(|pattern| pattern.has_wildcard());
        let (wild, length) = wild.fold((0u64, 0u64), |(wild, length), p| (wild + 1, length + p.0.len() as u64));
        wild.saturating_mul(self.count).saturating_add(length.saturating_mul(self.bytes) / 16)
    }
}

/// A list of patterns made ready to be asked about many names.
#[derive(Debug, Clone)]
pub struct PatternSet<'a> {
    literal: HashSet<&'a str>,
    wild: Vec<&'a Pattern>,
}

impl<'a> PatternSet<'a> {
    pub fn new(patterns: impl IntoIterator<Item = &'a Pattern>) -> Self {
        let (mut literal, mut wild) = (HashSet::new(), Vec::new());
        for pattern in patterns {
            match pattern.has_wildcard() {
                true => wild.push(pattern),
                false => _ = literal.insert(pattern.0.as_str()),
            }
        }
        Self { literal, wild }
    }

    /// Whether one of the patterns matches.
    pub fn matches(&self, name: &str) -> bool {
        self.literal.contains(name) || self.wild.iter().any(|pattern| pattern.matches(name))
    }
}

impl std::fmt::Display for Pattern {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.0)
    }
}

#[cfg(test)]
mod tests {
    use super::{Names, Pattern, PatternSet};

    #[test]
    fn wildcards_match_whole_names() {
        for (pattern, name, expected) in [
            ("a*", "abc", true),
            ("a*", "bac", false),
            ("*c", "abc", true),
            ("a?c", "abc", true),
            ("a?c", "ac", false),
            ("a*b*c", "aXbYbZc", true),
            ("a*b*c", "aXcYb", false),
            ("*", "", true),
            ("?", "", false),
            ("Bolt", "bolt", false),
            ("Bolt", "Bolt.001", false),
            ("*é?", "caféß", true),
            ("caf?", "café", true),
            ("caf??", "café", false),
            ("*?", "é", true),
            ("?*?", "é", false),
            ("*\u{e9}", "ḩé", true),
        ] {
            assert_eq!(Pattern::new(pattern).matches(name), expected, "{pattern} against {name}");
        }
    }

    #[test]
    fn lists_find_what_single_patterns_match() {
        let names = ["a", "ab", "b", "ab", ""];
        let index = Names::new(names);
        let patterns = ["ab", "a*", "c", "?", "*"].map(Pattern::new);
        for pattern in &patterns {
            let matched: Vec<usize> = (0..names.len()).filter(|i| pattern.matches(names[*i])).collect();
            assert_eq!(index.any(pattern), !matched.is_empty(), "{pattern}");
            assert_eq!(index.matched(pattern), matched, "{pattern}");
        }
        let set = PatternSet::new(&patterns[..3]);
        let matched: Vec<&str> = ["a", "ab", "b", "c", "cc"].into_iter().filter(|name| set.matches(name)).collect();
        assert_eq!(matched, ["a", "ab", "c"]);
    }

    #[test]
    fn many_stars_do_not_multiply() {
        let pattern = Pattern::new("*a".repeat(200) + "b");
        assert!(!pattern.matches(&"a".repeat(20_000)));
    }
}
