//! A budget for loops: every iteration spends one of a filter's fuel, and a loop without fuel ends. The code itself is
//! changed, so that the GPU and the interpreter run the same.

use naga::{
    AddressSpace, BinaryOperator, Block, Expression, Function, GlobalVariable, Handle, Literal, MemoryDecorations,
    Module, Range, Scalar, Span, Statement, Type, TypeInner,
};

use super::contract::LOOP_BUDGET;

/// The variable that holds what is left.
pub const FUEL: &str = "fuel";

/// Makes every loop of the module spend fuel. A last loop that nothing leaves but `return` gets one behind it.
pub fn add(module: &mut Module) {
    let fuel = variable(module);
    for (_, function) in module.functions.iter_mut() {
        let mut body = std::mem::take(&mut function.body);
        ends_in_return(function, &mut body);
        loops(function, &mut body, fuel);
        function.body = body;
    }
}

fn variable(module: &mut Module) -> Handle<GlobalVariable> {
    let ty = Type { name: None, inner: TypeInner::Scalar(Scalar::U32) };
    let ty = module.types.insert(ty, Span::UNDEFINED);
    let init = module.global_expressions.append(Expression::Literal(Literal::U32(LOOP_BUDGET)), Span::UNDEFINED);
    let variable = GlobalVariable {
        name: Some(FUEL.to_owned()),
        space: AddressSpace::Private,
        binding: None,
        ty,
        init: Some(init),
        memory_decorations: MemoryDecorations::empty(),
    };
    module.global_variables.append(variable, Span::UNDEFINED)
}

/// naga puts a `return` without a value behind a last loop, right or wrong; where nothing but `return` left that loop
/// the end was never reached, and now is, without fuel.
fn ends_in_return(function: &mut Function, body: &mut Block) {
    let Some(result) = &function.result else { return };
    let ty = result.ty;
    if let [.., Statement::Loop { body: inner, break_if: None, .. }, last @ Statement::Return { value: None }] =
        &mut body[..]
    {
        if !breaks(inner) {
            let value = function.expressions.append(Expression::ZeroValue(ty), Span::UNDEFINED);
            *last = Statement::Return { value: Some(value) };
        }
        return;
    }
    match body.last_mut() {
        Some(Statement::Block(block)) => ends_in_return(function, block),
        Some(Statement::If { accept, reject, .. }) => {
            ends_in_return(function, accept);
            ends_in_return(function, reject);
        }
        Some(Statement::Switch { cases, .. }) => {
            cases.iter_mut().for_each(|case| ends_in_return(function, &mut case.body))
        }
        _ => {}
    }
}

/// Whether a loop's body breaks out of that very loop.
fn breaks(block: &Block) -> bool {
    block.iter().any(|statement| match statement {
        Statement::Break => true,
        Statement::Block(block) => breaks(block),
        Statement::If { accept, reject, .. } => breaks(accept) || breaks(reject),
        _ => false,
    })
}

fn loops(function: &mut Function, block: &mut Block, fuel: Handle<GlobalVariable>) {
    for statement in block.iter_mut() {
        match statement {
            Statement::Block(block) => loops(function, block, fuel),
            Statement::If { accept, reject, .. } => {
                loops(function, accept, fuel);
                loops(function, reject, fuel);
            }
            Statement::Switch { cases, .. } => cases.iter_mut().for_each(|case| loops(function, &mut case.body, fuel)),
            Statement::Loop { body, continuing, .. } => {
                loops(function, body, fuel);
                loops(function, continuing, fuel);
                let mut spent = spend(function, fuel);
                spent.append(body);
                *body = spent;
            }
            _ => {}
        }
    }
}

/// `if fuel == 0 { break; } fuel = fuel - 1;`
fn spend(function: &mut Function, fuel: Handle<GlobalVariable>) -> Block {
    let mut add = |expression| function.expressions.append(expression, Span::UNDEFINED);
    let pointer = add(Expression::GlobalVariable(fuel));
    let zero = add(Expression::Literal(Literal::U32(0)));
    let one = add(Expression::Literal(Literal::U32(1)));
    let left = add(Expression::Load { pointer });
    let condition = add(Expression::Binary { op: BinaryOperator::Equal, left, right: zero });
    let value = add(Expression::Binary { op: BinaryOperator::Subtract, left, right: one });
    Block::from_vec(vec![
        Statement::Emit(Range::new_from_bounds(left, value)),
        Statement::If { condition, accept: Block::from_vec(vec![Statement::Break]), reject: Block::new() },
        Statement::Store { pointer, value },
    ])
}
