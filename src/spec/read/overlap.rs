//! One `[[overlap]]` rule.

use super::item::Item;
use super::table::Table;
use super::{condition, filter, keys};
use crate::InputError;
use crate::spec::OverlapSpec;

pub fn read(item: &Item) -> Result<OverlapSpec, InputError> {
    let table = Table::open(item, "[[overlap]]", keys::OVERLAP)?;
    Ok(OverlapSpec {
        when: condition::read(&table.need("when")?)?,
        filters: filter::list_that_stays(&table.need("filters")?)?,
    })
}
