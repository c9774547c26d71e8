//! The types that a filter may use, and how large they may be.

use naga::{AddressSpace, ArraySize, Function, Handle, Module, Scalar, ScalarKind, Span, Type, TypeInner};

use super::{ALONE, KNOWN_SCALARS, NO_RAYS, NO_TEXTURES};
use crate::InputError;
use crate::custom::source::Text;
use crate::custom::{program, words};

/// The largest value, as a number of 32-bit words.
const MOST_WORDS: usize = 1024;

/// How deep types may be made of types.
const MOST_NESTING: usize = 16;

pub fn check(text: &Text, module: &Module) -> Result<(), InputError> {
    results(text, module)?;
    let layout = program::Layout::new(&module.types);
    let mut depths = Vec::with_capacity(module.types.len());
    for (handle, ty) in module.types.iter() {
        let span = place_of(module, handle);
        kind(text, &ty.inner, span)?;
        let inside = |base: &Handle<Type>| depths[base.index()];
        let depth: usize = match &ty.inner {
            TypeInner::Array { base, .. } | TypeInner::Pointer { base, .. } => inside(base) + 1,
            TypeInner::Struct { members, .. } => members.iter().map(|member| inside(&member.ty)).max().unwrap_or(0) + 1,
            _ => 0,
        };
        depths.push(depth);
        let name = ty.name.as_deref().map_or("a type".to_owned(), |name| format!("`{name}`"));
        let place = || text.place(span).or_else(|| words::find_start(&text.user.text, "array"));
        if layout.of(handle) > MOST_WORDS {
            let message =
                format!("{name} takes {} numbers, and a filter's values at most {MOST_WORDS}", layout.of(handle));
            return Err(text.error(place(), message).help("use a smaller array"));
        }
        if depth > MOST_NESTING {
            let message = format!("{name} is made of types more than {MOST_NESTING} deep");
            return Err(text.error(place(), message).help("use fewer levels"));
        }
    }
    Ok(())
}

/// What `modf` and `frexp` give has a type without a name in WGSL, so that nothing else can be written with it.
fn results(text: &Text, module: &Module) -> Result<(), InputError> {
    let is_result = |ty: Handle<Type>| module.special_types.predeclared_types.values().any(|result| *result == ty);
    for (_, function) in module.functions.iter() {
        if let Some((handle, _)) = function.local_variables.iter().find(|(_, variable)| is_result(variable.ty)) {
            let span = function.local_variables.get_span(handle);
            return Err(refuse_type(text, span, "var", "a `var` for what `modf` or `frexp` gives is", "use `let`"));
        }
    }
    let of_results = |ty: &Type| matches!(ty.inner, TypeInner::Array { base, .. } if is_result(base));
    if module.types.iter().any(|(_, ty)| of_results(ty)) {
        let what = "an array of what `modf` or `frexp` gives is";
        return Err(refuse_type(text, Span::UNDEFINED, "array", what, "make one of the parts that you need"));
    }
    Ok(())
}

/// Where a type is declared, or else a variable of it: types without a name have no place of their own.
fn place_of(module: &Module, ty: Handle<Type>) -> Span {
    let declared = module.types.get_span(ty);
    let variable = |function: &Function| {
        let found = function.local_variables.iter().find(|(_, variable)| variable.ty == ty);
        found.map(|(handle, _)| function.local_variables.get_span(handle))
    };
    if declared.is_defined() {
        return declared;
    }
    module.functions.iter().find_map(|(_, function)| variable(function)).unwrap_or(declared)
}

/// What refuses a type, at its place or else at the first word of the file that begins like it.
fn refuse_type(text: &Text, span: Span, word: &str, what: &str, help: &str) -> InputError {
    let place = text.place(span).or_else(|| words::find_start(&text.user.text, word));
    text.error(place, format!("{what} not available in a filter")).help(help)
}

pub fn kind(text: &Text, inner: &TypeInner, span: Span) -> Result<(), InputError> {
    let (word, what, help) = match inner {
        TypeInner::Scalar(scalar) | TypeInner::Vector { scalar, .. } | TypeInner::Matrix { scalar, .. } => {
            if is_known(*scalar) {
                return Ok(());
            }
            let name = name_of(*scalar);
            return Err(refuse_type(text, span, &name, &format!("`{name}` is"), KNOWN_SCALARS));
        }
        TypeInner::Atomic(_) => ("atomic", "an atomic is", ALONE),
        TypeInner::Image { .. } => ("texture_", "a texture is", NO_TEXTURES),
        TypeInner::Sampler { .. } => ("sampler", "a sampler is", NO_TEXTURES),
        TypeInner::AccelerationStructure { .. } => ("acceleration_structure", "a ray query is", NO_RAYS),
        TypeInner::RayQuery { .. } => ("ray_query", "a ray query is", NO_RAYS),
        TypeInner::BindingArray { .. } => ("binding_array", "an array of bindings is", NO_TEXTURES),
        TypeInner::CooperativeMatrix { .. } => ("coop_mat", "a cooperative matrix is", "use mat2x2f to mat4x4f"),
        TypeInner::Array { size, .. } if !matches!(size, ArraySize::Constant(_)) => {
            ("array", "an array without a fixed size is", "give the number of its elements: array<f32, 8>")
        }
        TypeInner::Pointer { space, .. } | TypeInner::ValuePointer { space, .. }
            if *space != AddressSpace::Function =>
        {
            ("ptr", "a pointer into memory that is shared is", "use ptr<function, ...>, to local variables")
        }
        TypeInner::Struct { members, .. } if members.iter().any(|member| member.binding.is_some()) => (
            "struct",
            "a struct with `@location` or `@builtin` is",
            "take the attributes away: only shader stages have use for them",
        ),
        _ => return Ok(()),
    };
    Err(refuse_type(text, span, word, what, help))
}

pub fn is_known(scalar: Scalar) -> bool {
    [Scalar::F32, Scalar::I32, Scalar::U32, Scalar::BOOL].contains(&scalar)
        || matches!(scalar.kind, ScalarKind::AbstractInt | ScalarKind::AbstractFloat)
}

/// As a file writes the type.
pub fn name_of(scalar: Scalar) -> String {
    let letter = match scalar.kind {
        ScalarKind::Sint => "i",
        ScalarKind::Uint => "u",
        ScalarKind::Bool => return "bool".to_owned(),
        _ => "f",
    };
    format!("{letter}{}", 8 * u32::from(scalar.width))
}
