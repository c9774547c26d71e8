//! What a filter file may not use: refused by name before anything runs.

mod depth;
pub mod types;

use naga::{
    AddressSpace, DerivativeControl, Expression, Function, Handle, MathFunction, Module, RelationalFunction, Scalar,
    Span, Statement, TypeInner,
};

use super::source::Text;
use super::{contract, program, walk, words, write};
use crate::InputError;
use types::{is_known, name_of};

/// Everything that the CPU could not do, or that would mean something else there.
pub fn check(text: &Text, module: &Module) -> Result<(), InputError> {
    entry_points(text, module)?;
    globals(text, module)?;
    types::check(text, module)?;
    module.functions.iter().try_for_each(|(_, function)| body(text, module, function))
}

/// `what` is not available in a filter, and what to do instead.
fn refuse(text: &Text, span: Span, what: &str, help: &str) -> InputError {
    text.error(text.place(span), format!("{what} not available in a filter")).help(help)
}

fn entry_points(text: &Text, module: &Module) -> Result<(), InputError> {
    let Some(entry) = module.entry_points.first() else { return Ok(()) };
    Err(text
        .error_at_name(&entry.name, format!("`{}` is an entry point, which a filter file has none of", entry.name))
        .help("take its attributes away: lenspeel calls `filter_surface` and `filter_color` itself"))
}

fn globals(text: &Text, module: &Module) -> Result<(), InputError> {
    if let Some((handle, constant)) = module.overrides.iter().next() {
        let name = constant.name.as_deref().unwrap_or_default();
        let what = format!("`override {name}` is");
        let help = "write `const` for a fixed value; what a spec sets is a member of `struct Params`";
        return Err(refuse(text, module.overrides.get_span(handle), &what, help));
    }
    let Some((handle, variable)) = module.global_variables.iter().next() else { return Ok(()) };
    let name = variable.name.as_deref().unwrap_or_default();
    let (what, help) = match variable.space {
        AddressSpace::Private => {
            ("a `var<private>`", "each call stands alone: use a local `var`, or `const` for a fixed value")
        }
        AddressSpace::WorkGroup => ("a `var<workgroup>`", ALONE),
        AddressSpace::Uniform => ("a uniform buffer", "what a spec sets is a member of `struct Params`"),
        AddressSpace::Storage { .. } => ("a storage buffer", "what a spec sets is a member of `struct Params`"),
        AddressSpace::Handle => match module.types[variable.ty].inner {
            TypeInner::Sampler { .. } => ("a sampler", NO_TEXTURES),
            TypeInner::Image { .. } => ("a texture", NO_TEXTURES),
            _ => ("a `var` outside of functions", "use a local `var`, or `const` for a fixed value"),
        },
        _ => ("a variable of the GPU", "a filter reads its arguments and nothing else"),
    };
    Err(refuse(text, module.global_variables.get_span(handle), &format!("`{name}` is {what}, which is"), help))
}

fn body(text: &Text, module: &Module, function: &Function) -> Result<(), InputError> {
    for (handle, expression) in function.expressions.iter() {
        if let Some((what, help)) = expression_refused(expression) {
            return Err(refuse(text, function.expressions.get_span(handle), &what, help));
        }
    }
    depth::check(text, function)?;
    for (handle, variable) in function.local_variables.iter() {
        types::kind(text, &module.types[variable.ty].inner, function.local_variables.get_span(handle))?;
    }
    walk::statements(&function.body, &mut |statement, span| match statement_refused(statement) {
        Some((what, help)) => Err(refuse(text, span, what, help)),
        None => arguments(text, module, function, statement),
    })
}

/// WGSL lets a function take pointers to whole variables only, which naga does not check, and not all of its backends can
/// write.
fn arguments(text: &Text, module: &Module, function: &Function, statement: &Statement) -> Result<(), InputError> {
    let Statement::Call { arguments, .. } = statement else { return Ok(()) };
    let part = arguments.iter().find(|argument| is_pointer_to_part(module, function, **argument));
    let Some(part) = part else { return Ok(()) };
    let message = "a function cannot take a pointer to a part of a variable";
    Err(text
        .error(text.place(function.expressions.get_span(*part)), message)
        .help("pass a pointer to the whole; or copy the part to a `var`, pass a pointer to that, and copy it back"))
}

fn is_pointer_to_part(module: &Module, function: &Function, handle: Handle<Expression>) -> bool {
    let mut root = handle;
    while let Expression::Access { base, .. } | Expression::AccessIndex { base, .. } = function.expressions[root] {
        root = base;
    }
    let is_pointer = match function.expressions[root] {
        Expression::LocalVariable(_) => true,
        Expression::FunctionArgument(index) => {
            let ty = function.arguments[index as usize].ty;
            matches!(module.types[ty].inner, TypeInner::Pointer { .. } | TypeInner::ValuePointer { .. })
        }
        _ => false,
    };
    is_pointer && root != handle
}

const ONE_SAMPLE: &str = "a filter sees one sample; use s.pixel and s.depth";
const ALONE: &str = "a filter sees one sample and shares nothing with others";
const NO_RAYS: &str = "a filter sees one sample and not the scene";
const KNOWN_SCALARS: &str = "use f32, i32, u32 or bool";
const NO_TEXTURES: &str = "`texture` is a filter of its own, and `s.base_color` has what it gave";

fn expression_refused(expression: &Expression) -> Option<(String, &'static str)> {
    let (what, help) = match expression {
        Expression::Derivative { axis, ctrl, .. } => {
            let axis = match axis {
                naga::DerivativeAxis::X => "dpdx",
                naga::DerivativeAxis::Y => "dpdy",
                naga::DerivativeAxis::Width => "fwidth",
            };
            let control = match ctrl {
                DerivativeControl::Coarse => "Coarse",
                DerivativeControl::Fine => "Fine",
                DerivativeControl::None => "",
            };
            return Some((format!("`{axis}{control}` is"), ONE_SAMPLE));
        }
        Expression::Math { fun, .. } if !program::has(*fun) => return Some(function_refused(*fun)),
        Expression::Relational { fun: RelationalFunction::IsNan | RelationalFunction::IsInf, .. } => {
            ("`isNan` and `isInf` are", "test the operands instead: WGSL promises nothing of such numbers")
        }
        Expression::ImageSample { .. } | Expression::ImageLoad { .. } | Expression::ImageQuery { .. } => {
            ("reading textures is", NO_TEXTURES)
        }
        Expression::ArrayLength(_) => ("`arrayLength` is", "arrays of a filter have a fixed size"),
        Expression::AtomicResult { .. } | Expression::WorkGroupUniformLoadResult { .. } => ("sharing memory is", ALONE),
        Expression::SubgroupBallotResult | Expression::SubgroupOperationResult { .. } => {
            ("a subgroup operation is", ALONE)
        }
        Expression::RayQueryVertexPositions { .. }
        | Expression::RayQueryProceedResult
        | Expression::RayQueryGetIntersection { .. } => ("a ray query is", NO_RAYS),
        Expression::CooperativeLoad { .. } | Expression::CooperativeMultiplyAdd { .. } => {
            ("a cooperative matrix is", "use mat2x2f to mat4x4f")
        }
        Expression::As { kind, convert: Some(width), .. } if !is_known(Scalar { kind: *kind, width: *width }) => {
            return Some((format!("`{}` is", name_of(Scalar { kind: *kind, width: *width })), KNOWN_SCALARS));
        }
        Expression::Literal(literal) if !is_known(literal.scalar()) => {
            return Some((format!("`{}` is", name_of(literal.scalar())), KNOWN_SCALARS));
        }
        Expression::Override(_) => ("an `override` is", "write `const`"),
        _ => return None,
    };
    Some((what.to_owned(), help))
}

fn function_refused(fun: MathFunction) -> (String, &'static str) {
    let half = "not every device has half precision: leave it out";
    match fun {
        MathFunction::QuantizeToF16 => ("`quantizeToF16` is".to_owned(), half),
        MathFunction::Pack2x16float => ("`pack2x16float` is".to_owned(), half),
        MathFunction::Unpack2x16float => ("`unpack2x16float` is".to_owned(), half),
        _ => (format!("`{fun:?}` is"), "write it out in operators"),
    }
}

fn statement_refused(statement: &Statement) -> Option<(&'static str, &'static str)> {
    Some(match statement {
        Statement::Kill => ("`discard` is", "set s.opacity to 0.0 in `filter_surface`"),
        Statement::ControlBarrier(_) | Statement::MemoryBarrier(_) => ("a barrier is", ALONE),
        Statement::Atomic { .. } | Statement::ImageAtomic { .. } | Statement::WorkGroupUniformLoad { .. } => {
            ("sharing memory is", ALONE)
        }
        Statement::ImageStore { .. } => ("writing textures is", "return the changed surface or colour"),
        Statement::RayQuery { .. } | Statement::RayPipelineFunction(_) => ("a ray query is", NO_RAYS),
        Statement::SubgroupBallot { .. }
        | Statement::SubgroupGather { .. }
        | Statement::SubgroupCollectiveOperation { .. } => ("a subgroup operation is", ALONE),
        Statement::CooperativeStore { .. } => ("a cooperative matrix is", "use mat2x2f to mat4x4f"),
        _ => return None,
    })
}

/// What naga could not find wrong, or not where it is: the contract and the user's text are one to it.
pub fn words(text: &Text) -> Result<(), InputError> {
    directives(text)?;
    names(text)
}

/// `enable`, `requires` and `diagnostic` at the top of a file, which naga would not see there: the contract is in front.
fn directives(text: &Text) -> Result<(), InputError> {
    let words = words::all(&text.user.text);
    let starts = std::iter::once(None).chain(words.iter().map(|word| Some(word.text)));
    for (before, word) in starts.zip(&words) {
        let help = match word.text {
            "enable" | "requires" => "filters run on every device: leave it out, with what it is for",
            "diagnostic" => "leave it out: nothing that a filter may do is filtered",
            _ => continue,
        };
        if matches!(before, None | Some(";")) {
            return Err(text
                .error(Some(word.span.clone()), format!("`{}` is not available in a filter", word.text))
                .help(help));
        }
    }
    Ok(())
}

/// Names that would mean something else to the contract's functions, or that the GPU's text gives meaning to.
fn names(text: &Text) -> Result<(), InputError> {
    let used = words::used(contract::WGSL);
    if let Some(word) = words::top_level(&text.user.text).into_iter().find(|word| used.contains(word.text)) {
        let message =
            format!("`{}` is a name of WGSL itself, which the functions that every file finds use", word.text);
        return Err(text.error(Some(word.span), message).help("choose another name"));
    }
    let taken = words::all(&text.user.text).into_iter().find(|word| word.text.contains(write::PREFIX));
    match taken {
        Some(word) => Err(text
            .error(Some(word.span), format!("names with `{}` in them are taken", write::PREFIX))
            .help("choose another name")),
        None => Ok(()),
    }
}
