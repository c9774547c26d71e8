//! The `cap` of an eraser: `"own"`, a colour, `"hatch"` or `"hatch COLOUR"`; and the `outline` of its caps.

use super::item::Item;
use super::table::Table;
use super::{color, keys, suggest};
use crate::InputError;
use crate::spec::catalogue::LINE_WIDTH;
use crate::spec::{Cap, Color, Outline};

/// The lines of a hatch that names no colour: ink on paper.
const INK: Color = Color::rgb(0x3a, 0x46, 0x55);
const OWN: &str = "own";
const HATCH: &str = "hatch";
const WANTED: &str = "write a colour such as \"#cc3333\" or \"orange\", \"own\", \"hatch\" or \"hatch #3a4655\"";

pub fn read(item: &Item) -> Result<Cap, InputError> {
    let text = item.text().map_err(|error| error.help(WANTED))?;
    parse(text).ok_or_else(|| {
        let (start, word) = match text.split_once(char::is_whitespace) {
            Some((HATCH, color)) => ("hatch ", color.trim_start()),
            _ => ("", text),
        };
        let known = [OWN, HATCH].into_iter().filter(|_| start.is_empty());
        let near = suggest::nearest(word, known).or_else(|| color::nearest(word));
        let help = near.map_or_else(|| WANTED.to_owned(), |near| format!("did you mean \"{start}{near}\"?"));
        item.error(format!("{} is no colour, \"own\" or hatch: \"{text}\"", item.called())).help(help)
    })
}

/// A table; what is left out has a default.
pub fn outline(item: &Item) -> Result<Outline, InputError> {
    let table = Table::open(item, "`outline`", keys::OUTLINE)?;
    let default = Outline::default();
    Ok(Outline {
        width: table.read("width", |item: &Item| item.number32(LINE_WIDTH)).unwrap_or(default.width),
        color: table.read("color", Item::color).unwrap_or(default.color),
    })
}

fn parse(text: &str) -> Option<Cap> {
    match text.split_once(char::is_whitespace) {
        Some((HATCH, color)) => color::parse(color.trim_start()).map(Cap::Hatch),
        _ if text == OWN => Some(Cap::Own),
        _ if text == HATCH => Some(Cap::Hatch(INK)),
        _ => color::parse(text).map(Cap::Color),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_colours_and_hatches() {
        for (text, expected) in [
            ("own", Some(Cap::Own)),
            ("hatch", Some(Cap::Hatch(INK))),
            ("hatch orange", Some(Cap::Hatch(Color::rgb(255, 165, 0)))),
            ("hatch  #10203040", Some(Cap::Hatch(Color([16, 32, 48, 64])))),
            ("#cc3333", Some(Cap::Color(Color::rgb(0xcc, 0x33, 0x33)))),
            ("tomato", Some(Cap::Color(Color::rgb(255, 99, 71)))),
            ("Own", None),
            ("hatch ", None),
            ("hatched", None),
            ("hatch own", None),
            ("own orange", None),
            ("", None),
        ] {
            assert_eq!(parse(text), expected, "{text}");
        }
    }
}
