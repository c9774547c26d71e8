//! Visits every statement of a block and of the blocks in it.

use naga::{Block, Span, Statement};

/// Calls `visit` with each statement, outer before inner, until one gives an error.
pub fn statements<E>(block: &Block, visit: &mut impl FnMut(&Statement, Span) -> Result<(), E>) -> Result<(), E> {
    for (statement, span) in block.span_iter() {
        visit(statement, *span)?;
        blocks(statement).into_iter().try_for_each(|block| statements(block, visit))?;
    }
    Ok(())
}

/// The blocks of a statement.
pub fn blocks(statement: &Statement) -> Vec<&Block> {
    match statement {
        Statement::Block(block) => vec![block],
        Statement::If { accept, reject, .. } => vec![accept, reject],
        Statement::Switch { cases, .. } => cases.iter().map(|case| &case.body).collect(),
        Statement::Loop { body, continuing, .. } => vec![body, continuing],
        _ => Vec::new(),
    }
}
