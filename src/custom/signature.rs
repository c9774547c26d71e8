//! The functions that lenspeel calls, and whether they take and give what they must.

use naga::{Function, Handle, Module, Scalar, Type, TypeInner, VectorSize};

use super::source::Text;
use super::words;
use crate::InputError;
use crate::spec::read::suggest;

pub const FILTER_SURFACE: &str = "filter_surface";
pub const FILTER_COLOR: &str = "filter_color";
pub const PARAMS: &str = "Params";
/// Of the contract.
pub const SURFACE: &str = "Surface";

/// One of the two functions.
#[derive(Debug, Clone, Copy)]
pub struct Filter {
    pub function: Handle<Function>,
    /// Whether its last argument is `Params`.
    pub takes_params: bool,
}

/// What a filter file has; at least one function.
#[derive(Debug, Clone, Copy)]
pub struct Signature {
    pub surface: Option<Filter>,
    pub color: Option<Filter>,
    pub params: Option<Handle<Type>>,
}

pub fn find(text: &Text, module: &Module) -> Result<Signature, InputError> {
    let params = params(text, module)?;
    let signature = Signature {
        surface: filter(text, module, FILTER_SURFACE, params)?,
        color: filter(text, module, FILTER_COLOR, params)?,
        params,
    };
    if signature.surface.is_none() && signature.color.is_none() {
        return Err(neither(text));
    }
    Ok(signature)
}

fn neither(text: &Text) -> InputError {
    let declared = words::declared(&text.user.text).into_iter();
    let slip = declared.filter_map(|name| Some((name, suggest::nearest(name, [FILTER_SURFACE, FILTER_COLOR])?))).next();
    let message = format!("a filter file needs `fn {FILTER_SURFACE}` or `fn {FILTER_COLOR}`, or both");
    match slip {
        Some((name, near)) => text.error_at_name(name, message).help(format!("did you mean `{near}`?")),
        None => text.error(None, message).help(format!("write {} {{ ... }}", wanted(FILTER_SURFACE, false))),
    }
}

fn params(text: &Text, module: &Module) -> Result<Option<Handle<Type>>, InputError> {
    let Some((keyword, place)) = words::declaration(&text.user.text, PARAMS) else { return Ok(None) };
    let is_params = |(_, ty): &(Handle<Type>, &Type)| {
        ty.name.as_deref() == Some(PARAMS) && matches!(ty.inner, TypeInner::Struct { .. })
    };
    match module.types.iter().find(is_params) {
        Some((handle, _)) if keyword == "struct" => Ok(Some(handle)),
        _ => Err(text
            .error(Some(place), format!("`{PARAMS}` is declared with `{keyword}`, and must be a struct"))
            .help("write struct Params { strength: f32, }")),
    }
}

fn filter(
    text: &Text,
    module: &Module,
    name: &str,
    params: Option<Handle<Type>>,
) -> Result<Option<Filter>, InputError> {
    let found = module.functions.iter().find(|(_, function)| function.name.as_deref() == Some(name));
    let Some((handle, function)) = found else { return Ok(None) };
    let surface = module.types.iter().find(|(_, ty)| ty.name.as_deref() == Some(SURFACE)).map(|(handle, _)| handle);
    let is_surface = |ty: Handle<Type>| Some(ty) == surface;
    let color = TypeInner::Vector { size: VectorSize::Tri, scalar: Scalar::F32 };
    let is_color = |ty: Handle<Type>| module.types[ty].inner == color;
    let arguments: Vec<_> = function.arguments.iter().map(|argument| argument.ty).collect();
    let result = function.result.as_ref().map(|result| result.ty);
    let (rest, gives) = match name {
        FILTER_SURFACE => match arguments.as_slice() {
            [s, rest @ ..] if is_surface(*s) => (Some(rest), result.is_some_and(is_surface)),
            _ => (None, false),
        },
        _ => match arguments.as_slice() {
            [c, s, rest @ ..] if is_color(*c) && is_surface(*s) => (Some(rest), result.is_some_and(is_color)),
            _ => (None, false),
        },
    };
    let takes_params = match rest {
        Some([]) => Some(false),
        Some([last]) if Some(*last) == params => Some(true),
        _ => None,
    };
    match takes_params {
        Some(takes_params) if gives => Ok(Some(Filter { function: handle, takes_params })),
        _ => Err(text
            .error_at_name(name, format!("`{name}` must take and give what lenspeel calls it with"))
            .help(format!("write {}", wanted(name, params.is_some())))),
    }
}

fn wanted(name: &str, params: bool) -> String {
    let last = if params { ", p: Params" } else { "" };
    match name {
        FILTER_SURFACE => format!("fn {name}(s: Surface{last}) -> Surface"),
        _ => format!("fn {name}(c: vec3f, s: Surface{last}) -> vec3f"),
    }
}
