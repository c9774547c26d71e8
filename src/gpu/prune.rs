//! Takes out of a shader what a plan does not need.
//!
//! The constants that [`Needs`](super::Needs) writes say what that is. Drivers put a function's body in the place of
//! every call before they look at conditions: code that never runs would cost them seconds.

use std::collections::HashMap;

use naga::compact::{KeepUnused, compact};
use naga::{
    Block, Constant, Expression, Function, Handle, Literal, LocalVariable, Module, Span, Statement, SwitchCase,
    UnaryOperator,
};

/// The same shader with these of its entry points alone, without branches that constants rule out, and without what only
/// those use.
pub fn pruned(mut module: Module, entries: &[&str]) -> Module {
    module.entry_points.retain(|entry| entries.contains(&entry.name.as_str()));
    let constants = known_constants(&module);
    let mut results = HashMap::new();
    let entries = module.entry_points.iter_mut().map(|entry| (None, &mut entry.function));
    // Functions stand after those that they call.
    let functions = module.functions.iter_mut().map(|(handle, function)| (Some(handle), function));
    for (handle, function) in functions.chain(entries) {
        // What is ruled out may decide what a variable is, and that rule out more.
        loop {
            let known = Known::new(function, &constants, &results);
            let before = known.variables.len();
            let pruned = pruned_block(function.body.clone(), &|condition| known.value(condition));
            function.body = pruned;
            if Known::new(function, &constants, &results).variables.len() == before {
                break;
            }
        }
        let known = Known::new(function, &constants, &results);
        results.extend(handle.zip(known.result()));
        // A name would keep what it names, and the function that it is the result of.
        function.named_expressions.clear();
    }
    // So would that of a constant: what is not used says nothing.
    module.constants.iter_mut().for_each(|(_, constant)| constant.name = None);
    compact(&mut module, KeepUnused::No);
    module
}

fn known_constants(module: &Module) -> HashMap<Handle<Constant>, bool> {
    let value = |constant: &Constant| match module.global_expressions[constant.init] {
        Expression::Literal(Literal::Bool(value)) => Some(value),
        _ => None,
    };
    module.constants.iter().filter_map(|(handle, constant)| Some((handle, value(constant)?))).collect()
}

/// What is known of the truth values of a function.
struct Known<'a> {
    function: &'a Function,
    constants: &'a HashMap<Handle<Constant>, bool>,
    /// Of functions that return one value alone.
    results: &'a HashMap<Handle<Function>, bool>,
    /// The front end keeps the results of `&&` and `||` in variables without names, which are read after they are written:
    /// those to which one value alone is written.
    variables: HashMap<Handle<LocalVariable>, bool>,
}

impl<'a> Known<'a> {
    fn new(
        function: &'a Function,
        constants: &'a HashMap<Handle<Constant>, bool>,
        results: &'a HashMap<Handle<Function>, bool>,
    ) -> Self {
        let mut known = Self { function, constants, results, variables: HashMap::new() };
        // Of one may follow another.
        loop {
            let mut written = HashMap::new();
            known.gather(&function.body, &mut written);
            let variables: HashMap<_, _> =
                written.into_iter().filter_map(|(variable, value)| Some((variable, value?))).collect();
            if variables == known.variables {
                return known;
            }
            known.variables = variables;
        }
    }

    /// What is written to variables without names; `None` where that is unknown, or not always the same.
    fn gather(&self, block: &Block, written: &mut HashMap<Handle<LocalVariable>, Option<bool>>) {
        for statement in block {
            match statement {
                Statement::Store { pointer, value } => {
                    let Some(variable) = self.variable(*pointer) else { continue };
                    let value = self.value(*value);
                    written
                        .entry(variable)
                        .and_modify(|known| *known = known.filter(|_| *known == value))
                        .or_insert(value);
                }
                other => inner_blocks(other).for_each(|inner| self.gather(inner, written)),
            }
        }
    }

    /// What the function returns, if that is always the same.
    fn result(&self) -> Option<bool> {
        let mut returned = Vec::new();
        self.returned(&self.function.body, &mut returned);
        let first = *returned.first()?;
        first.filter(|_| returned.iter().all(|value| *value == first))
    }

    fn returned(&self, block: &Block, values: &mut Vec<Option<bool>>) {
        for statement in block {
            match statement {
                Statement::Return { value } => values.push(value.and_then(|value| self.value(value))),
                other => inner_blocks(other).for_each(|inner| self.returned(inner, values)),
            }
        }
    }

    fn variable(&self, pointer: Handle<Expression>) -> Option<Handle<LocalVariable>> {
        match self.function.expressions[pointer] {
            Expression::LocalVariable(variable) => {
                Some(variable).filter(|variable| self.function.local_variables[*variable].name.is_none())
            }
            _ => None,
        }
    }

    /// What an expression is, where that is known. The front end has computed what is made of constants.
    fn value(&self, expression: Handle<Expression>) -> Option<bool> {
        match self.function.expressions[expression] {
            Expression::Literal(Literal::Bool(value)) => Some(value),
            Expression::Constant(constant) => self.constants.get(&constant).copied(),
            Expression::Unary { op: UnaryOperator::LogicalNot, expr } => self.value(expr).map(|value| !value),
            Expression::CallResult(function) => self.results.get(&function).copied(),
            Expression::Load { pointer } => self.variables.get(&self.variable(pointer)?).copied(),
            _ => None,
        }
    }
}

/// The blocks that a statement holds.
fn inner_blocks(statement: &Statement) -> impl Iterator<Item = &Block> {
    let (two, cases): ([Option<&Block>; 2], &[SwitchCase]) = match statement {
        Statement::If { accept, reject, .. } => ([Some(accept), Some(reject)], &[]),
        Statement::Loop { body, continuing, .. } => ([Some(body), Some(continuing)], &[]),
        Statement::Block(inner) => ([Some(inner), None], &[]),
        Statement::Switch { cases, .. } => ([None, None], cases),
        _ => ([None, None], &[]),
    };
    two.into_iter().flatten().chain(cases.iter().map(|case| &case.body))
}

fn pruned_block(block: Block, known: &impl Fn(Handle<Expression>) -> Option<bool>) -> Block {
    let mut kept = Block::new();
    for (statement, _) in block.span_into_iter() {
        let statement = match statement {
            Statement::If { condition, accept, reject } => match known(condition) {
                Some(holds) => Statement::Block(pruned_block(if holds { accept } else { reject }, known)),
                None => Statement::If {
                    condition,
                    accept: pruned_block(accept, known),
                    reject: pruned_block(reject, known),
                },
            },
            Statement::Block(inner) => Statement::Block(pruned_block(inner, known)),
            Statement::Switch { selector, cases } => {
                let pruned = |case: SwitchCase| SwitchCase { body: pruned_block(case.body, known), ..case };
                Statement::Switch { selector, cases: cases.into_iter().map(pruned).collect() }
            }
            Statement::Loop { body, continuing, break_if } => Statement::Loop {
                body: pruned_block(body, known),
                continuing: pruned_block(continuing, known),
                break_if,
            },
            other => other,
        };
        let ends = ends(&statement);
        match statement {
            Statement::Block(inner) => kept.extend_block(inner),
            // Where it stood in the text tells alike shaders apart.
            other => kept.push(other, Span::UNDEFINED),
        }
        // Nothing may stand behind it.
        if ends {
            break;
        }
    }
    kept
}

fn ends(statement: &Statement) -> bool {
    match statement {
        Statement::Return { .. } | Statement::Break | Statement::Continue | Statement::Kill => true,
        Statement::Block(inner) => inner.last().is_some_and(ends),
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "
        const NEEDED: bool = true;
        const NOT_NEEDED: bool = false;
        @group(0) @binding(0) var<storage, read_write> out: array<f32>;
        fn never(x: u32) -> bool { return NOT_NEEDED && x > 3u; }
        fn costly(x: f32) -> f32 { return sin(x); }
        fn cheap(x: f32) -> f32 {
            if NEEDED { return x + 1.0; }
            return costly(x);
        }
        @compute @workgroup_size(1) fn run(@builtin(global_invocation_id) id: vec3u) {
            loop {
                if NOT_NEEDED { out[0] = costly(3.0); } else { if id.x > 3u { break; } }
                while NOT_NEEDED { out[1] = costly(2.0); }
                switch id.y { case 1u: { if NEEDED { out[2] = cheap(1.0); } } default: {} }
                if id.y > 0u { if NOT_NEEDED { out[3] = costly(1.0); } }
                if id.z > 0u && NOT_NEEDED && id.y > 1u { out[3] = costly(1.0); }
                if NOT_NEEDED && (id.z > 1u || !NEEDED) { out[3] = costly(1.0); }
                if !(NEEDED || id.z > 2u) { out[3] = costly(1.0); } else if !NEEDED { out[3] = costly(1.0); }
                if never(id.x) { out[3] = costly(1.0); }
                if NEEDED { break; }
                let named = costly(0.0);
                out[4] = named;
            }
        }";

    fn parsed(text: &str) -> Module {
        naga::front::wgsl::parse_str(text).expect("WGSL")
    }

    fn names(module: &Module) -> Vec<&str> {
        module.functions.iter().filter_map(|(_, function)| function.name.as_deref()).collect()
    }

    #[test]
    fn what_never_runs_is_gone_and_the_rest_is_valid() {
        let module = pruned(parsed(TEXT), &["run"]);
        assert_eq!(names(&module), ["never", "cheap"]);
        let all = naga::valid::ValidationFlags::all();
        naga::valid::Validator::new(all, naga::valid::Capabilities::empty()).validate(&module).expect("valid");
    }

    #[test]
    fn what_may_run_stays() {
        let text = TEXT.replace("const NOT_NEEDED: bool = false;", "@id(0) override NOT_NEEDED: bool = false;");
        assert_eq!(names(&pruned(parsed(&text), &["run"])), ["never", "costly", "cheap"]);
        assert!(names(&pruned(parsed(&text), &[])).is_empty());
    }
}
