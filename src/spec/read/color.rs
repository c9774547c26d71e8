//! Colours: `"#rrggbb"`, `"#rrggbbaa"` or a CSS name.

use csscolorparser::NAMED_COLORS;

use super::item::Item;
use super::suggest;
use crate::InputError;
use crate::spec::Color;

const WANTED: &str = "write \"#rrggbb\", \"#rrggbbaa\" or a CSS name such as \"orange\"";

impl Item<'_> {
    /// A colour whose alpha would mean nothing.
    pub fn opaque_color(&self) -> Result<Color, InputError> {
        match self.color()? {
            color @ Color([_, _, _, 255]) => Ok(color),
            color => {
                let message = format!("{} has an alpha, and light has none: {color}", self.called());
                Err(self.error(message).help("leave the last two digits out; `intensity` dims a light"))
            }
        }
    }

    pub fn color(&self) -> Result<Color, InputError> {
        let text = self.text().map_err(|error| error.help(WANTED))?;
        parse(text).ok_or_else(|| {
            let help = nearest(text).map_or_else(|| WANTED.to_owned(), |name| format!("did you mean \"{name}\"?"));
            self.error(format!("{} is not a colour: \"{text}\"", self.called())).help(help)
        })
    }
}

pub fn parse(text: &str) -> Option<Color> {
    match text.strip_prefix('#') {
        Some(digits) => hex(digits),
        None if text.eq_ignore_ascii_case("transparent") => Some(Color([0; 4])),
        None => NAMED_COLORS.get(text.into()).map(|[r, g, b]| Color::rgb(*r, *g, *b)),
    }
}

fn hex(digits: &str) -> Option<Color> {
    let known = digits.bytes().all(|b| b.is_ascii_hexdigit());
    let number = u32::from_str_radix(digits, 16).ok()?;
    match (known, digits.len()) {
        (true, 6) => Some(Color((number << 8 | 0xff).to_be_bytes())),
        (true, 8) => Some(Color(number.to_be_bytes())),
        _ => None,
    }
}

/// The CSS name that a word may have been meant to be.
pub fn nearest(text: &str) -> Option<&'static str> {
    let names = NAMED_COLORS.keys().map(|name| name.as_str());
    (!text.starts_with('#')).then(|| suggest::nearest(text, names)).flatten()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hex_and_names() {
        for (text, expected) in [
            ("#3fa7ff", Some([0x3f, 0xa7, 0xff, 255])),
            ("#3FA7FF80", Some([0x3f, 0xa7, 0xff, 0x80])),
            ("orange", Some([255, 165, 0, 255])),
            ("RebeccaPurple", Some([102, 51, 153, 255])),
            ("transparent", Some([0, 0, 0, 0])),
            ("#fff", None),
            ("#+fffff", None),
            ("ff0000", None),
            ("rgb(1,2,3)", None),
        ] {
            assert_eq!(parse(text), expected.map(Color), "{text}");
        }
    }
}
