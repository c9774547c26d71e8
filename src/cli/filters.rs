//! `lenspeel filters`: the catalogue as an aligned listing, one filter with its documentation, or a page of all.

use crate::InputError;
use crate::appearance::FILTERS as FILES;
use crate::spec::catalogue::{FILTERS, FilterRow, Param, filter};
use crate::spec::suggest;

/// Every filter with its parameters: type, range, default, a line of help.
pub fn filters_text() -> String {
    let blocks: Vec<String> = FILTERS.iter().map(block).collect();
    blocks.join("\n")
}

/// One filter with its parameters and what its file says of it.
pub fn filter_text(name: &str) -> Result<String, InputError> {
    let row = filter(name).ok_or_else(|| {
        let names = FILTERS.iter().map(|row| row.name);
        InputError::new(format!("there is no filter `{name}`")).help(suggest::help(name, names))
    })?;
    Ok(format!("{}\n{}\n", block(row), documentation(row)))
}

/// All filters as a page in Markdown, with pictures beside the specs in `lens-specs/filters`.
pub fn filters_markdown() -> String {
    let head = "# The filters\n\n`lenspeel filters --markdown` writes this page, from the files under `shaders/filters` and \
        the catalogue;\nspecs beside the pictures draw them. Where a default is not a value, it is said in words.\n";
    let head = format!("{head}\n{}", filters_index(""));
    FILTERS.iter().fold(head, |page, row| page + "\n" + &section(row))
}

/// A table of the filters, each a link into the page at `page`; empty on that page itself.
pub fn filters_index(page: &str) -> String {
    let head = "| filter | kind | what it does |\n|---|---|---|\n".to_owned();
    FILTERS.iter().fold(head, |text, FilterRow { name, kind, help, moves, .. }| {
        let moves = if *moves { ", moves" } else { "" };
        text + &format!("| [`{name}`]({page}#{name}) | {kind}{moves} | {help} |\n")
    })
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
    let mut text = format!("{} ({}{moves}): {}\n", row.name, row.kind, row.help);
    let columns = Columns::of(row.params);
    for param in row.params {
        text.push_str(&line(param, &columns));
    }
    text
}

fn line(param: &Param, columns: &Columns) -> String {
    let Columns { name, kind, default } = columns;
    format!(
        "    {:<name$}  {:<kind$}  {:<default$}  {}\n",
        param.name,
        param.kind.to_string(),
        param.default.to_string(),
        param.help,
    )
}

/// What a filter's own file says of it.
fn documentation(row: &FilterRow) -> &'static str {
    FILES.iter().find(|file| file.name == row.name).map_or("", |file| file.text)
}

fn section(row: &FilterRow) -> String {
    let FilterRow { name, kind, help, .. } = row;
    let moves = if row.moves { ", moves content" } else { "" };
    let (picture, documentation) = (row.picture(), documentation(row));
    let mut text = format!("## `{name}`\n\n*{kind}{moves}*: {help}.\n\n![{name}]({picture})\n\n{documentation}\n");
    if !row.params.is_empty() {
        text += "\n| parameter | value | default | |\n|---|---|---|---|\n";
    }
    for Param { name, kind, default, help } in row.params {
        let kind = kind.to_string().replace('|', "\\|");
        text += &format!("| `{name}` | {kind} | {default} | {help} |\n");
    }
    text
}
