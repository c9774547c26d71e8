//! What was left out or repaired: said once a kind, however many objects it concerns.

use std::collections::HashMap;
use std::fmt::Display;

use super::count_of;

/// Lines that are told; a file can be wrong in more ways than anyone reads.
const MOST_LINES: usize = 100;

/// The warnings about one file, in the order in which each kind was first met.
#[derive(Debug, Default)]
pub struct Warnings {
    kinds: Vec<Kind>,
    /// By the text of the kind.
    known: HashMap<String, usize>,
}

#[derive(Debug)]
struct Kind {
    /// The first object; empty for the file as a whole.
    place: String,
    places: usize,
    /// How many of something, in all objects together.
    count: Option<(usize, &'static str)>,
    what: String,
}

impl Warnings {
    /// About the file as a whole.
    pub fn say(&mut self, what: impl Into<String>) {
        self.put(Kind { place: String::new(), places: 1, count: None, what: what.into() });
    }

    /// About one object.
    pub fn add(&mut self, place: impl Display, what: impl Into<String>) {
        self.put(Kind { place: place.to_string(), places: 1, count: None, what: what.into() });
    }

    /// About some parts of one object: `3 triangles ...`.
    pub fn add_count(&mut self, place: impl Display, count: usize, noun: &'static str, what: impl Into<String>) {
        self.put(Kind { place: place.to_string(), places: 1, count: Some((count, noun)), what: what.into() });
    }

    pub fn append(&mut self, other: Warnings) {
        other.kinds.into_iter().for_each(|kind| self.put(kind));
    }

    fn put(&mut self, kind: Kind) {
        let noun = kind.count.map_or("", |(_, noun)| noun);
        let key = format!("{}\n{noun}\n{}", kind.place.is_empty(), kind.what);
        let next = self.kinds.len();
        let at = *self.known.entry(key).or_insert(next);
        match self.kinds.get_mut(at) {
            None => self.kinds.push(kind),
            Some(known) => {
                known.places += kind.places;
                if let (Some((sum, _)), Some((count, _))) = (&mut known.count, kind.count) {
                    *sum += count;
                }
            }
        }
    }

    /// One line a kind.
    pub fn into_lines(self) -> Vec<String> {
        let all = self.kinds.len();
        let mut lines: Vec<String> = self.kinds.iter().take(MOST_LINES).map(Kind::line).collect();
        if all > MOST_LINES {
            lines.push(format!("{} of other kinds", count_of(all - MOST_LINES, "more warning")));
        }
        lines
    }
}

impl Kind {
    fn line(&self) -> String {
        let count = self.count.map_or(String::new(), |(count, noun)| format!("{} ", count_of(count, noun)));
        let more = match self.places {
            1 => String::new(),
            places => format!(" and {} more", places - 1),
        };
        if self.place.is_empty() {
            return format!("{count}{}", self.what);
        }
        format!("{}{more}: {count}{}", self.place, self.what)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_line_a_kind() {
        let mut warnings = Warnings::default();
        warnings.say("extensions left out: A");
        warnings.add("mesh 0", "points left out");
        warnings.add_count("mesh 0", 1, "triangle", "turned");
        let mut others = Warnings::default();
        others.add("mesh 1", "points left out");
        others.add_count("mesh 1", 4, "triangle", "turned");
        others.add("mesh 1", "lines left out");
        warnings.append(others);
        let lines = [
            "extensions left out: A",
            "mesh 0 and 1 more: points left out",
            "mesh 0 and 1 more: 5 triangles turned",
            "mesh 1: lines left out",
        ];
        assert_eq!(warnings.into_lines(), lines);
    }

    #[test]
    fn there_is_an_end_to_them() {
        let mut warnings = Warnings::default();
        (0..1000).for_each(|n| warnings.say(format!("fault {n}")));
        let lines = warnings.into_lines();
        assert_eq!(lines.len(), MOST_LINES + 1);
        assert_eq!(lines[MOST_LINES], "900 more warnings of other kinds");
    }
}
