//! `lenspeel filters`: the catalogue as an aligned listing.

use std::fmt::Write;

use crate::spec::catalogue::{FILTERS, FilterRow, Param};

/// Every filter with its parameters: type, range, default, a line of help.
pub fn filters_text() -> String {
    let columns = Columns::of(FILTERS);
    let blocks: Vec<String> = FILTERS.iter().map(|row| block(row, &columns)).collect();
    blocks.join("\n")
}

/// Widths that the longest entry needs.
struct Columns {
    name: usize,
    kind: usize,
    default: usize,
}

impl Columns {
    fn of(rows: &[FilterRow]) -> Self {
        let params = || rows.iter().flat_map(|row| row.params);
        let widest = |texts: &mut dyn Iterator<Item = String>| texts.map(|text| text.chars().count()).max().unwrap_or(0);
        Self {
            name: widest(&mut params().map(|param| param.name.to_owned())),
            kind: widest(&mut params().map(|param| param.kind.to_string())),
            default: widest(&mut params().map(|param| param.default.to_string())),
        }
    }
}

fn block(row: &FilterRow, columns: &Columns) -> String {
    let moves = if row.moves { ", moves" } else { "" };
    let built = if row.built { "" } else { " [not built yet]" };
    let mut text = format!("{} ({}{moves}): {}{built}\n", row.name, row.kind, row.help);
    for param in row.params {
        text.push_str(&line(param, row.built, columns));
    }
    text
}

fn line(param: &Param, row_built: bool, columns: &Columns) -> String {
    let Columns { name, kind, default } = columns;
    let mut line = String::new();
    // Writing to a String cannot fail.
    let _ = write!(
        line,
        "    {:<name$}  {:<kind$}  {:<default$}  {}",
        param.name,
        param.kind.to_string(),
        param.default.to_string(),
        param.help
    );
    if row_built && !param.built {
        line.push_str(" [not built yet]");
    }
    line.push('\n');
    line
}
