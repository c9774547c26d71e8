//! One `[[overlap]]` rule.

use super::item::Item;
use super::table::Table;
use super::{condition, filter, keys};
use crate::InputError;
use crate::spec::OverlapSpec;

pub fn read(item: &Item) -> Result<OverlapSpec, InputError> {
    let table = Table::open(item, "[[overlap]]", keys::OVERLAP)?;
    let filters = table.need("filters").and_then(|filters| filter::list_that_stays(&filters));
    let when = table.need("when").and_then(|when| condition::read(&when));
    match (when, filters) {
        (Ok(when), Ok(filters)) => Ok(OverlapSpec { when, filters }),
        (Err(error), Err(other)) => {
            item.file.note(other);
            Err(error)
        }
        (Err(error), _) | (_, Err(error)) => Err(error),
    }
}
