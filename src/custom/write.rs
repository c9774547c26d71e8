//! A filter file as it goes into the GPU's shaders: all its names with a prefix, and functions in front of it that any
//! host shader can call.

use std::fmt::Write;

use naga::Module;
use naga::back::wgsl;
use naga::valid::ModuleInfo;

use super::contract::{LOOP_BUDGET, MEMBERS};
use super::params::{FieldKind, ParamField};
use super::signature::{FILTER_COLOR, FILTER_SURFACE, Filter, PARAMS, SURFACE, Signature};
use super::{Custom, fuel};

/// Stands for `custom0_`, `custom1_` and so on until the number is known.
pub const PREFIX: &str = "custom_number_";

/// Before the names that lenspeel calls the file by.
const OWN: &str = "custom_number_own_";

/// Before all other names of the file's own: naga's writer makes `a_b` of `a__b` and of `a_b_`, and the names above must
/// stay as they are.
const OTHER: &str = "custom_number_other_";

/// The names of the host's side.
const HOST_SURFACE: &str = "CustomSurface";
const HOST_WORDS: &str = "custom_words";

/// The file's declarations and functions, then the adapters.
pub fn module(
    mut module: Module,
    info: &ModuleInfo,
    signature: &Signature,
    params: &[ParamField],
) -> Result<String, wgsl::Error> {
    rename(&mut module);
    let mut text = wgsl::write_string(&module, info, wgsl::WriterFlags::empty())?;
    if signature.params.is_some() {
        text += &load(params);
    }
    if let Some(filter) = &signature.surface {
        text += &surface_adapter(filter);
    }
    if let Some(filter) = &signature.color {
        text += &color_adapter(filter);
    }
    Ok(text)
}

/// The text with its number in place.
pub fn numbered(text: &str, number: usize) -> String {
    text.replace(PREFIX, &format!("custom{number}_"))
}

/// Gives every name of the module's scope the prefix. Types keep their order, and so their handles.
fn rename(module: &mut Module) {
    let prefixed = |name: &mut Option<String>| {
        if let Some(name) = name {
            let is_called = [SURFACE, PARAMS, FILTER_SURFACE, FILTER_COLOR].contains(&name.as_str());
            name.insert_str(0, if is_called { OWN } else { OTHER });
        }
    };
    let mut types = naga::UniqueArena::new();
    for (handle, ty) in module.types.iter() {
        let mut ty = ty.clone();
        prefixed(&mut ty.name);
        types.insert(ty, module.types.get_span(handle));
    }
    module.types = types;
    module.constants.iter_mut().for_each(|(_, constant)| prefixed(&mut constant.name));
    // The only variable there is.
    module
        .global_variables
        .iter_mut()
        .for_each(|(_, variable)| variable.name = Some(format!("{PREFIX}{}", fuel::FUEL)));
    for (_, function) in module.functions.iter_mut() {
        prefixed(&mut function.name);
        // A local name that looks like one of ours would take it away.
        let not_ours = |name: &mut Option<String>| {
            if name.as_ref().is_some_and(|name| name.starts_with("custom")) {
                *name = None;
            }
        };
        function.arguments.iter_mut().for_each(|argument| not_ours(&mut argument.name));
        function.local_variables.iter_mut().for_each(|(_, variable)| not_ours(&mut variable.name));
        function
            .named_expressions
            .values_mut()
            .filter(|name| name.starts_with("custom"))
            .for_each(|name| *name = "named".to_owned());
    }
}

/// `fn custom0_load(first: u32) -> custom0_own_Params`
fn load(params: &[ParamField]) -> String {
    let mut at = 0;
    let mut word = |write: &dyn Fn(&str) -> String| {
        let text = write(&format!("{HOST_WORDS}[first + {at}u]"));
        at += 1;
        text
    };
    let float = |word: &str| format!("bitcast<f32>({word})");
    let members: Vec<String> = params
        .iter()
        .map(|field| match field.kind {
            FieldKind::Float => word(&float),
            FieldKind::Int => word(&|word| format!("bitcast<i32>({word})")),
            FieldKind::Uint => word(&str::to_owned),
            FieldKind::Bool => word(&|word| format!("{word} != 0u")),
            FieldKind::Vec2 | FieldKind::Vec3 | FieldKind::Vec4 => {
                let parts: Vec<String> = (0..field.kind.words()).map(|_| word(&float)).collect();
                format!("vec{}f({})", parts.len(), parts.join(", "))
            }
        })
        .collect();
    format!(
        "\nfn {PREFIX}load(first: u32) -> {OWN}{PARAMS} {{\n    return {OWN}{PARAMS}({});\n}}\n",
        members.join(", ")
    )
}

fn surface_adapter(filter: &Filter) -> String {
    let params = params_argument(filter);
    format!(
        "
fn {PREFIX}surface(s: {HOST_SURFACE}, first: u32) -> {HOST_SURFACE} {{
    {PREFIX}{fuel} = {LOOP_BUDGET}u;
    let r = {OWN}{FILTER_SURFACE}({}{params});
    return {};
}}
",
        surface(&format!("{OWN}{SURFACE}"), "s"),
        surface(HOST_SURFACE, "r"),
        fuel = fuel::FUEL,
    )
}

fn color_adapter(filter: &Filter) -> String {
    let params = params_argument(filter);
    format!(
        "
fn {PREFIX}color(c: vec3f, s: {HOST_SURFACE}, first: u32) -> vec3f {{
    {PREFIX}{fuel} = {LOOP_BUDGET}u;
    return {OWN}{FILTER_COLOR}(c, {}{params});
}}
",
        surface(&format!("{OWN}{SURFACE}"), "s"),
        fuel = fuel::FUEL,
    )
}

fn params_argument(filter: &Filter) -> String {
    if filter.takes_params { format!(", {PREFIX}load(first)") } else { String::new() }
}

/// A surface of one type made of a surface of another.
fn surface(ty: &str, from: &str) -> String {
    let members: Vec<String> = MEMBERS.iter().map(|(member, _)| format!("{from}.{member}")).collect();
    format!("{ty}({})", members.join(", "))
}

/// `struct CustomSurface`, all filters, and two functions that choose among them by number.
pub fn all(customs: &[&Custom]) -> String {
    let mut text = host_surface();
    for (number, custom) in customs.iter().enumerate() {
        text += &custom.wgsl(number);
    }
    let surfaces = (0..customs.len()).filter(|number| customs[*number].has_surface());
    let colors = (0..customs.len()).filter(|number| customs[*number].has_color());
    let arguments = format!("s: {HOST_SURFACE}, first: u32");
    text +=
        &choice("custom_surface", &arguments, HOST_SURFACE, "s", surfaces, |n| format!("custom{n}_surface(s, first)"));
    let arguments = format!("c: vec3f, {arguments}");
    text += &choice("custom_color", &arguments, "vec3f", "c", colors, |n| format!("custom{n}_color(c, s, first)"));
    text
}

/// The smallest host that a filter can stand in.
pub fn sample(custom: &Custom) -> String {
    format!("@group(0) @binding(0) var<storage> {HOST_WORDS}: array<u32>;\n\n{}", all(&[custom]))
}

/// The contract's `Surface` under the name by which the host's shaders know it.
fn host_surface() -> String {
    let declaration = super::contract::WGSL.split_once("struct Surface").map_or("", |(_, rest)| rest);
    let members = declaration.split_once('}').map_or("", |(members, _)| members);
    format!("struct {HOST_SURFACE}{members}}}\n\n")
}

/// A function that calls one of several by its number, and gives `otherwise` for any other.
fn choice(
    name: &str,
    arguments: &str,
    result: &str,
    otherwise: &str,
    numbers: impl Iterator<Item = usize>,
    call: impl Fn(usize) -> String,
) -> String {
    let mut text = format!("\nfn {name}(number: u32, {arguments}) -> {result} {{\n    switch number {{\n");
    for number in numbers {
        // Writing to a string cannot fail.
        let _ = writeln!(text, "        case {number}u: {{\n            return {};\n        }}", call(number));
    }
    text + &format!("        default: {{\n            return {otherwise};\n        }}\n    }}\n}}\n")
}
