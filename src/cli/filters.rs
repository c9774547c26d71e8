//! `lenspeel filters`: the catalogue as an aligned listing.

use crate::spec::catalogue::{FILTERS, FilterRow, Param};

/// Every filter with its parameters: type, range, default, a line of help.
pub fn filters_text() -> String {
    let blocks: Vec<String> = FILTERS.iter().map(block).collect();
    blocks.join("\n")
}

/// Widths that a filter's longest entries need.
struct Columns {
    name: usize,
    kind: usize,
    default: usize,
}

impl Columns {
    fn of(params: &[Param]) -> Self {
        let widest = |text: fn(&Param) -> String| params.iter().map(|p| text(p).chars().count()).max().unwrap_or(0);
        Self {
            name: widest(|param| param.name.to_owned()),
            kind: widest(|param| param.kind.to_string()),
            default: widest(|param| param.default.to_string()),
        }
    }
}

fn block(row: &FilterRow) -> String {
    let moves = if row.moves { ", moves" } else { "" };
    let built = if row.built { "" } else { " [not built yet]" };
    let mut text = format!("{} ({}{moves}): {}{built}\n", row.name, row.kind, row.help);
    let columns = Columns::of(row.params);
    for param in row.params {
        text.push_str(&line(param, row.built, &columns));
    }
    text
}

fn line(param: &Param, row_built: bool, columns: &Columns) -> String {
    let Columns { name, kind, default } = columns;
    let waits = if row_built && !param.built { " [not built yet]" } else { "" };
    format!(
        "    {:<name$}  {:<kind$}  {:<default$}  {}{waits}\n",
        param.name,
        param.kind.to_string(),
        param.default.to_string(),
        param.help
    )
}
