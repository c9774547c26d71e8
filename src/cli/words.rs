//! Plain words for what tables list.

/// With a capital letter and a full stop.
pub fn sentence(text: &str) -> String {
    let mut rest = text.chars();
    let first = rest.next().map(char::to_uppercase);
    let stop = if text.ends_with(['.', '?', '!']) || text.is_empty() { "" } else { "." };
    first.into_iter().flatten().chain(rest).chain(stop.chars()).collect()
}

/// For a cell of a table in Markdown.
pub fn cell(text: &str) -> String {
    text.replace('|', "\\|")
}
