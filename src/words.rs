//! Words of messages.

/// ``1 lens``, ``2 lenses``; the noun in the singular.
pub fn count_of(count: impl TryInto<u64>, noun: &str) -> String {
    let count = count.try_into().unwrap_or(u64::MAX);
    if count == 1 { format!("1 {noun}") } else { format!("{count} {}", plural(noun)) }
}

fn plural(noun: &str) -> String {
    let ends = |endings: &[&str]| endings.iter().any(|ending| noun.ends_with(ending));
    match noun.strip_suffix('y') {
        Some(stem) if !ends(&["ay", "ey", "oy"]) => format!("{stem}ies"),
        _ if ends(&["ex"]) => format!("{}ices", &noun[..noun.len() - 2]),
        _ if ends(&["s", "sh", "ch", "x"]) => format!("{noun}es"),
        _ => format!("{noun}s"),
    }
}

#[cfg(test)]
mod tests {
    use super::count_of;

    #[test]
    fn one_and_many() {
        assert_eq!([0, 1, 2].map(|n| count_of(n, "lens")), ["0 lenses", "1 lens", "2 lenses"]);
        let nouns = ["mesh", "vertex", "entry", "region", "key"].map(|noun| count_of(3usize, noun));
        assert_eq!(nouns, ["3 meshes", "3 vertices", "3 entries", "3 regions", "3 keys"]);
    }
}
