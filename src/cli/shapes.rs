//! `lenspeel shapes`: the shapes of lenses as an aligned listing, one of them, or a table in Markdown.

use super::schema::{Row, shape_rows};
use super::words::cell;
use crate::InputError;
use crate::spec::catalogue::{SHAPES, ShapeRow, shape};
use crate::spec::suggest;

/// Every shape with its keys: type, range, default, a line of help.
pub fn shapes_text() -> String {
    let blocks: Vec<String> = SHAPES.iter().map(block).collect();
    blocks.join("\n")
}

pub fn shape_text(name: &str) -> Result<String, InputError> {
    let row = shape(name).ok_or_else(|| {
        let names = SHAPES.iter().map(|row| row.name);
        InputError::new(format!("there is no shape `{name}`")).help(suggest::help(name, names))
    })?;
    Ok(block(row))
}

/// All shapes as a table in Markdown.
pub fn shapes_markdown() -> String {
    let head = "| shape | is | keys | its centre |\n|---|---|---|---|\n".to_owned();
    SHAPES.iter().fold(head, |text, row| text + &line(row))
}

fn line(row: &ShapeRow) -> String {
    let keys = |Row { key, kind, default, .. }: &Row| {
        let optional = if default == "required" { "" } else { " (optional)" };
        format!("`{key}`: {kind}{optional}")
    };
    let keys: Vec<String> = shape_rows(row).iter().map(keys).collect();
    let keys = if keys.is_empty() { "a list of shapes".to_owned() } else { keys.join("; ") };
    format!("| `{}` | {} | {} | {} |\n", row.name, cell(row.help), cell(&keys), row.center)
}

fn block(row: &ShapeRow) -> String {
    let rows = shape_rows(row);
    let widest = |text: fn(&Row) -> &str| rows.iter().map(|row| text(row).chars().count()).max().unwrap_or(0);
    let (key, kind) = (widest(|row| row.key), widest(|row| &row.kind));
    let default = widest(|row| &row.default);
    let mut text = format!("{}: {}; its centre: {}\n", row.name, row.help, row.center);
    for row in &rows {
        let line = format!("    {:<key$}  {:<kind$}  {:<default$}  {}", row.key, row.kind, row.default, row.help);
        text += line.trim_end();
        text.push('\n');
    }
    text
}
