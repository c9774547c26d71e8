//! How deep expressions and statements nest.

use naga::{Block, Expression, Function, Handle, Span, Statement};

use crate::InputError;
use crate::custom::source::Text;
use crate::custom::walk;

/// How deep expressions may nest: what is written for the GPU has a pair of brackets for each level, and shader
/// compilers bound those.
const MOST_DEPTH: usize = 64;

/// Braces within braces, as a function is written for the GPU; naga reads 127.
const MOST_BRACES: usize = 120;

pub fn check(text: &Text, function: &Function) -> Result<(), InputError> {
    expressions(text, function)?;
    statements(&function.body, 1).map_err(|span| {
        text.error(text.place(span), "`if`, `switch` and loops nest too deep here").help(
            "make a part of it a function; write a long chain of `else if` as `switch`, or one `if` after another",
        )
    })
}

/// `braces`: how many are open around the block. Gives the place of a statement that has too many.
fn statements(block: &Block, braces: usize) -> Result<(), Span> {
    for (statement, span) in block.span_iter() {
        // A case has braces of its own, and so has `continuing`.
        let more = if matches!(statement, Statement::Switch { .. } | Statement::Loop { .. }) { 2 } else { 1 };
        for inner in walk::blocks(statement) {
            if braces + more > MOST_BRACES {
                return Err(*span);
            }
            statements(inner, braces + more)?;
        }
    }
    Ok(())
}

fn expressions(text: &Text, function: &Function) -> Result<(), InputError> {
    let mut depths = Vec::with_capacity(function.expressions.len());
    for (handle, expression) in function.expressions.iter() {
        let mut deepest = 0;
        operands(expression, |operand| deepest = deepest.max(depths[operand.index()] + 1));
        if deepest > MOST_DEPTH {
            let place = text.place(function.expressions.get_span(handle));
            return Err(text
                .error(place, format!("this expression is more than {MOST_DEPTH} operations deep"))
                .help("give a part of it a name with `let`"));
        }
        // A name of its own ends the nesting.
        depths.push(if function.named_expressions.contains_key(&handle) { 0 } else { deepest });
    }
    Ok(())
}

/// Calls `visit` with every expression that an expression is made of.
fn operands(expression: &Expression, mut visit: impl FnMut(Handle<Expression>)) {
    match expression {
        Expression::Compose { components, .. } => components.iter().copied().for_each(visit),
        Expression::Access { base, index } => [*base, *index].into_iter().for_each(visit),
        Expression::AccessIndex { base: of, .. }
        | Expression::Splat { value: of, .. }
        | Expression::Swizzle { vector: of, .. }
        | Expression::Unary { expr: of, .. }
        | Expression::Relational { argument: of, .. }
        | Expression::As { expr: of, .. }
        | Expression::Load { pointer: of } => visit(*of),
        Expression::Binary { left, right, .. } => [*left, *right].into_iter().for_each(visit),
        Expression::Select { condition, accept, reject } => {
            [*condition, *accept, *reject].into_iter().for_each(visit);
        }
        Expression::Math { arg, arg1, arg2, arg3, .. } => {
            [Some(*arg), *arg1, *arg2, *arg3].into_iter().flatten().for_each(visit);
        }
        _ => {}
    }
}
