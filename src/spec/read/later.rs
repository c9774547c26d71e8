//! What the format has and this version does not: refused by name.

use super::item::Item;
use crate::InputError;

/// With what to write instead.
pub fn feature(item: &Item, what: &str, instead: &str) -> InputError {
    item.error_at_key(format!("{what} is not built yet")).help(instead)
}
