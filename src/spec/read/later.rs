//! What the format has and this version does not: refused by name.

use super::item::Item;
use super::suggest;
use crate::InputError;
use crate::spec::catalogue::{FILTERS, FilterRow, Param};

pub fn filter(item: &Item, row: &FilterRow) -> InputError {
    let built = FILTERS.iter().filter(|row| row.built).map(|row| row.name);
    item.error_at_key(format!("filter `{}` is not built yet", row.name))
        .help(format!("these work: {}", suggest::listed(built)))
}

pub fn param(item: &Item, row: &FilterRow, param: &Param) -> InputError {
    item.error(format!("`{}` of filter `{}` is not built yet", param.name, row.name))
        .help(format!("leave it out: its default is {}", param.default))
}

/// Anything else, with what to write instead.
pub fn feature(item: &Item, what: &str, instead: &str) -> InputError {
    item.error_at_key(format!("{what} is not built yet")).help(instead)
}
