//! A budget for loops: every iteration spends of a filter's fuel, the more the more it computes, and a loop without enough
//! fuel ends. The code itself is changed, so that the GPU and the interpreter run the same.

use std::collections::HashMap;

use naga::valid::{FunctionInfo, ModuleInfo};
use naga::{
    AddressSpace, BinaryOperator, Block, Expression, Function, GlobalVariable, Handle, Literal, MemoryDecorations,
    Module, Range, Scalar, Span, Statement, Type, TypeInner,
};

use super::contract::{LOOP_BUDGET, NUMBERS_OF_AN_ITERATION};

/// The variable that holds what is left.
pub const FUEL: &str = "fuel";

/// Puts a `return` behind a last loop that nothing leaves but `return`.
pub fn close(module: &mut Module) {
    for (_, function) in module.functions.iter_mut() {
        let mut body = std::mem::take(&mut function.body);
        ends_in_return(function, &mut body);
        function.body = body;
    }
}

/// Makes every loop of a valid module spend fuel.
pub fn add(module: &mut Module, info: &ModuleInfo) {
    let mut work: HashMap<Handle<Function>, u64> = HashMap::new();
    let mut spending: Vec<Vec<u32>> = Vec::new();
    // Callees stand before their callers.
    for (handle, function) in module.functions.iter() {
        let scale = Scale { module, function, info: &info[handle], work: &work };
        let mut of_loops = Vec::new();
        scale.loops(&function.body, &mut of_loops);
        let own = scale.numbers(&function.body);
        work.insert(handle, own);
        spending.push(of_loops);
    }
    let fuel = variable(module);
    for ((_, function), spending) in module.functions.iter_mut().zip(spending) {
        let mut body = std::mem::take(&mut function.body);
        loops(function, &mut body, fuel, &mut spending.into_iter());
        function.body = body;
    }
}

/// Says how much code computes.
struct Scale<'a> {
    module: &'a Module,
    function: &'a Function,
    info: &'a FunctionInfo,
    /// Of the functions that may be called.
    work: &'a HashMap<Handle<Function>, u64>,
}

impl Scale<'_> {
    /// What an iteration of each loop spends, in the order in which [`loops`] meets them.
    fn loops(&self, block: &Block, spending: &mut Vec<u32>) {
        for statement in block.iter() {
            match statement {
                Statement::Block(block) => self.loops(block, spending),
                Statement::If { accept, reject, .. } => {
                    self.loops(accept, spending);
                    self.loops(reject, spending);
                }
                Statement::Switch { cases, .. } => cases.iter().for_each(|case| self.loops(&case.body, spending)),
                Statement::Loop { body, continuing, .. } => {
                    let numbers = self.numbers(body).saturating_add(self.numbers(continuing));
                    let spent = numbers.div_ceil(NUMBERS_OF_AN_ITERATION).clamp(1, u64::from(LOOP_BUDGET));
                    spending.push(spent as u32);
                    self.loops(body, spending);
                    self.loops(continuing, spending);
                }
                _ => {}
            }
        }
    }

    /// Numbers that a block computes or moves, all branches together, without the loops in it.
    fn numbers(&self, block: &Block) -> u64 {
        let of_statement = |statement: &Statement| match statement {
            Statement::Emit(range) => range.clone().map(|handle| self.expression(handle)).fold(0, u64::saturating_add),
            Statement::Block(block) => self.numbers(block),
            Statement::If { accept, reject, .. } => self.numbers(accept).saturating_add(self.numbers(reject)),
            Statement::Switch { cases, .. } => {
                cases.iter().map(|case| self.numbers(&case.body)).fold(0, u64::saturating_add)
            }
            Statement::Store { value, .. } => self.size(*value),
            Statement::Call { function, .. } => self.work.get(function).copied().unwrap_or(1),
            _ => 1,
        };
        block.iter().map(of_statement).fold(0, u64::saturating_add)
    }

    fn expression(&self, handle: Handle<Expression>) -> u64 {
        let own = self.size(handle);
        match &self.function.expressions[handle] {
            // A product of matrices has as many terms as the larger of them.
            Expression::Binary { left, right, .. } => own.max(self.size(*left)).max(self.size(*right)),
            _ => own,
        }
    }

    /// Numbers of a value.
    fn size(&self, handle: Handle<Expression>) -> u64 {
        let inner = self.info[handle].ty.inner_with(&self.module.types);
        match inner {
            TypeInner::Pointer { .. } | TypeInner::ValuePointer { .. } => 1,
            inner => u64::from(inner.size(self.module.to_ctx())).div_ceil(4).max(1),
        }
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

/// `spending`: what an iteration of each loop spends.
fn loops(
    function: &mut Function,
    block: &mut Block,
    fuel: Handle<GlobalVariable>,
    spending: &mut impl Iterator<Item = u32>,
) {
    for statement in block.iter_mut() {
        match statement {
            Statement::Block(block) => loops(function, block, fuel, spending),
            Statement::If { accept, reject, .. } => {
                loops(function, accept, fuel, spending);
                loops(function, reject, fuel, spending);
            }
            Statement::Switch { cases, .. } => {
                cases.iter_mut().for_each(|case| loops(function, &mut case.body, fuel, spending));
            }
            Statement::Loop { body, continuing, .. } => {
                let own = spending.next().unwrap_or(LOOP_BUDGET);
                loops(function, body, fuel, spending);
                loops(function, continuing, fuel, spending);
                let mut spent = spend(function, fuel, own);
                spent.append(body);
                *body = spent;
            }
            _ => {}
        }
    }
}

/// `if fuel < own { break; } fuel = fuel - own;`
fn spend(function: &mut Function, fuel: Handle<GlobalVariable>, own: u32) -> Block {
    let mut add = |expression| function.expressions.append(expression, Span::UNDEFINED);
    let pointer = add(Expression::GlobalVariable(fuel));
    let own = add(Expression::Literal(Literal::U32(own)));
    let left = add(Expression::Load { pointer });
    let condition = add(Expression::Binary { op: BinaryOperator::Less, left, right: own });
    let value = add(Expression::Binary { op: BinaryOperator::Subtract, left, right: own });
    Block::from_vec(vec![
        Statement::Emit(Range::new_from_bounds(left, value)),
        Statement::If { condition, accept: Block::from_vec(vec![Statement::Break]), reject: Block::new() },
        Statement::Store { pointer, value },
    ])
}
