//! Whether a filter leaves the opacity of surfaces as it finds it: what it acts on then ends rays as it would have.

use naga::valid::{FunctionInfo, ModuleInfo};
use naga::{Expression, Handle, Module, Type, TypeInner};

use super::contract::MEMBERS;
use super::signature::SURFACE;
use super::source::Text;
use super::words;

/// Whether some function could give a surface an opacity of its own: one that takes hold of the member, or makes a surface
/// from nothing. It may say so of a filter that never does.
pub fn may_change(text: &Text, module: &Module, info: &ModuleInfo) -> bool {
    let Some((surface, _)) = module.types.iter().find(|(_, ty)| ty.name.as_deref() == Some(SURFACE)) else {
        return false;
    };
    let made = |expression: &Expression| made(module, expression, surface);
    // naga's variables begin as zeros, whether the text gives them a value next or not. Only `var name: Surface;` does not,
    // or one whose type has been given another name.
    let words = words::all(&text.user.text);
    let is_zero = words.windows(2).any(|pair| (pair[0].text, pair[1].text) == (SURFACE, ";"));
    is_zero
        || module.global_expressions.iter().any(|(_, expression)| made(expression))
        || module.functions.iter().any(|(handle, function)| {
            let zero = |(_, local): (_, &naga::LocalVariable)| local.ty != surface && holds(module, local.ty, surface);
            function.local_variables.iter().any(zero)
                || function
                    .expressions
                    .iter()
                    .any(|(_, expression)| made(expression) || takes_hold(&info[handle], module, expression, surface))
        })
}

/// Whether an expression is a surface that is not another one's copy.
fn made(module: &Module, expression: &Expression, surface: Handle<Type>) -> bool {
    match expression {
        Expression::Compose { ty, .. } | Expression::ZeroValue(ty) => holds(module, *ty, surface),
        _ => false,
    }
}

/// Whether an expression is a place to which an opacity can be written.
fn takes_hold(info: &FunctionInfo, module: &Module, expression: &Expression, surface: Handle<Type>) -> bool {
    let Expression::AccessIndex { base, index } = *expression else { return false };
    let is_opacity = MEMBERS.get(index as usize).is_some_and(|(name, _)| *name == "opacity");
    let base = info[base].ty.inner_with(&module.types);
    is_opacity && matches!(base, TypeInner::Pointer { base, .. } if *base == surface)
}

/// Whether values of a type hold surfaces.
fn holds(module: &Module, ty: Handle<Type>, surface: Handle<Type>) -> bool {
    ty == surface
        || match &module.types[ty].inner {
            TypeInner::Array { base, .. } => holds(module, *base, surface),
            TypeInner::Struct { members, .. } => members.iter().any(|member| holds(module, member.ty, surface)),
            _ => false,
        }
}
