//! A user's own filter in WGSL (`wgsl` in a spec): read, checked, and made ready for both backends.
//!
//! A file stands behind the contract (`shaders/custom/contract.wgsl`), is parsed and validated by naga, and then goes
//! two ways from one IR: written back as WGSL for the GPU's shaders, and compiled to steps for the CPU. `check` keeps
//! out what only one of the two could do.

mod check;
mod contract;
mod fuel;
mod naga_errors;
mod opacity;
mod params;
mod program;
mod signature;
mod source;
mod value;
mod walk;
mod words;
mod write;

#[cfg(test)]
mod tests;

use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

use naga::valid::{Capabilities, ValidationFlags, Validator};

pub use contract::{LOOP_BUDGET, MEMBERS, SURFACE_WORDS, SurfaceValue};
pub use params::{FieldKind, ParamField};
pub use value::{Given, Value};
pub use write::all as wgsl;

use crate::InputError;
use crate::spec::Source;
use program::{Entry, Program};
use signature::Signature;
use source::Text;

/// Bytes that a filter file may have.
const MOST_BYTES: usize = 1 << 16;

/// Words and signs between two of `;`, `{` and `}`.
const MOST_WORDS_OF_A_STATEMENT: usize = 4096;

/// naga descends once for each level of an expression; this is enough for the longest statement.
const STACK_BYTES: usize = 128 << 20;

/// A filter file, ready to run on both backends.
#[derive(Debug, Clone)]
pub struct Custom {
    name: String,
    params: Vec<ParamField>,
    /// The GPU's text, but for its number.
    text: String,
    program: Program,
    surface: Option<Entry>,
    color: Option<Entry>,
    may_change_opacity: bool,
}

impl Custom {
    /// Opens a filter file and reads it; messages name it by its path.
    ///
    /// # Errors
    /// A file that cannot be read or is no UTF-8, and those of [`Custom::parse`].
    pub fn open(path: &Path) -> Result<Self, InputError> {
        let name = path.display().to_string();
        let cannot = |why: &str| InputError::new(format!("cannot read {name}: {why}"));
        let mut bytes = Vec::new();
        // One byte more than there may be is enough to refuse the rest unread.
        let read = File::open(path).and_then(|file| file.take(MOST_BYTES as u64 + 1).read_to_end(&mut bytes));
        read.map_err(|error: io::Error| cannot(&error.to_string()))?;
        if bytes.len() > MOST_BYTES {
            return Err(too_large(&name));
        }
        let text = String::from_utf8(bytes).map_err(|error| {
            let valid = &error.as_bytes()[..error.utf8_error().valid_up_to()];
            let line = valid.iter().filter(|byte| **byte == b'\n').count() + 1;
            cannot(&format!("line {line} is not UTF-8")).help("save it as text in UTF-8")
        })?;
        Self::parse(&text, &name)
    }

    /// Reads a filter file's text. `name` is how messages name it.
    ///
    /// # Errors
    /// All that is wrong with the file, with the line: what is no WGSL, what a filter may not use, functions that are
    /// missing or take something else, parameters that a spec could not give.
    pub fn parse(source: &str, name: &str) -> Result<Self, InputError> {
        let text = Text::new(source, name);
        size(&text)?;
        let read = || read(&text);
        std::thread::scope(|scope| {
            match std::thread::Builder::new().stack_size(STACK_BYTES).spawn_scoped(scope, read) {
                Ok(thread) => thread.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic)),
                // Without a thread of its own the file is read on this one's stack.
                Err(_) => read(),
            }
        })
    }

    /// How messages name the file.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The members of its `struct Params`, in order; none where it has no such struct.
    pub fn params(&self) -> &[ParamField] {
        &self.params
    }

    /// What a spec gives for the parameters as words, one for each scalar, in the order of the struct; where it gives
    /// nothing, the default.
    ///
    /// # Errors
    /// A name that the struct does not have, or a value that is not of its type; both point into `source`, the spec.
    pub fn values(&self, source: &Source, given: &[Given]) -> Result<Vec<u32>, InputError> {
        value::values(&self.params, source, given)
    }

    /// Whether the file has `filter_surface`.
    pub fn has_surface(&self) -> bool {
        self.surface.is_some()
    }

    /// Whether `filter_surface` may give surfaces another opacity; it may say so of a file that never does.
    pub fn may_change_opacity(&self) -> bool {
        self.may_change_opacity
    }

    /// Whether the file has `filter_color`.
    pub fn has_color(&self) -> bool {
        self.color.is_some()
    }

    /// The file's text for a shader, every name of it behind `custom<number>_own_` or `custom<number>_other_`; see [`wgsl`] for the whole.
    ///
    /// It has `fn custom0_surface(s: CustomSurface, first: u32) -> CustomSurface` and
    /// `fn custom0_color(c: vec3f, s: CustomSurface, first: u32) -> vec3f`, each where the file has that function.
    /// `first` is the index of the filter's first word in the host's `custom_words: array<u32>`.
    pub fn wgsl(&self, number: usize) -> String {
        write::numbered(&self.text, number)
    }

    /// `filter_surface`; the surface itself where the file has no such function. `words` as [`Custom::values`] gives them.
    pub fn surface(&self, surface: &SurfaceValue, words: &[u32]) -> SurfaceValue {
        self.surface_spending(surface, words, &mut 0)
    }

    /// The same; adds to `spent` the loop iterations that it took, as [`LOOP_BUDGET`] counts them.
    pub(crate) fn surface_spending(&self, surface: &SurfaceValue, words: &[u32], spent: &mut u32) -> SurfaceValue {
        let Some(entry) = &self.surface else { return *surface };
        let numbers: [u32; SURFACE_WORDS] = bytemuck::cast(*surface);
        self.program
            .call(entry, &[&numbers, words], spent, |result| *bytemuck::from_bytes(bytemuck::cast_slice(result)))
    }

    /// `filter_color` of a lit colour in linear light; the colour itself where the file has no such function.
    pub fn color(&self, color: [f32; 3], surface: &SurfaceValue, words: &[u32]) -> [f32; 3] {
        self.color_spending(color, surface, words, &mut 0)
    }

    /// The same; `spent` as in [`Custom::surface_spending`].
    pub(crate) fn color_spending(
        &self,
        color: [f32; 3],
        surface: &SurfaceValue,
        words: &[u32],
        spent: &mut u32,
    ) -> [f32; 3] {
        let Some(entry) = &self.color else { return color };
        let (color, numbers): ([u32; 3], [u32; SURFACE_WORDS]) = (bytemuck::cast(color), bytemuck::cast(*surface));
        self.program.call(entry, &[&color, &numbers, words], spent, |result| {
            *bytemuck::from_bytes(bytemuck::cast_slice(result))
        })
    }
}

fn too_large(name: &str) -> InputError {
    InputError::new(format!("{name}: a filter file has at most {MOST_BYTES} bytes, and this one has more"))
        .help("leave out what the filter does not call")
}

/// Bounds what naga has to descend into.
fn size(text: &Text) -> Result<(), InputError> {
    let source = &text.user.text;
    if source.len() > MOST_BYTES {
        return Err(too_large(&text.user.name));
    }
    let words = words::all(source);
    for statement in words.split(|word| [";", "{", "}"].contains(&word.text)) {
        if let (Some(first), true) = (statement.first(), statement.len() > MOST_WORDS_OF_A_STATEMENT) {
            return Err(text
                .error(Some(first.span.clone()), format!("this statement has {} words and signs", statement.len()))
                .help(format!("{MOST_WORDS_OF_A_STATEMENT} are the most; give a part of it a name with `let`")));
        }
    }
    Ok(())
}

fn read(text: &Text) -> Result<Custom, InputError> {
    check::words(text)?;
    let mut module = naga::front::wgsl::parse_str(&text.whole).map_err(|error| naga_errors::not_wgsl(text, &error))?;
    check::check(text, &module)?;
    fuel::close(&mut module);
    let valid = |module: &naga::Module| {
        let validated = Validator::new(ValidationFlags::all(), Capabilities::empty()).validate(module);
        validated.map_err(|error| naga_errors::not_valid(text, &error))
    };
    let info = valid(&module)?;
    fuel::add(&mut module, &info);
    let info = valid(&module)?;
    let signature = signature::find(text, &module)?;
    let params = signature.params.map(|ty| params::read(text, &module, ty)).transpose()?.unwrap_or_default();
    let (program, calls) = compile(text, &module, &info, &signature)?;
    let [surface, color] = calls;
    let may_change_opacity = surface.is_some() && opacity::may_change(text, &module, &info);
    let unwritten = |why: String| text.error(None, format!("the file cannot be written for the GPU: {why}"));
    let gpu = write::module(module, &info, &signature, &params).map_err(|error| unwritten(error.to_string()))?;
    let custom =
        Custom { name: text.user.name.clone(), params, text: gpu, program, surface, color, may_change_opacity };
    // What is accepted here must not fail later, in a shader where its lines mean nothing to the user.
    validated(&write::sample(&custom)).map_err(unwritten)?;
    Ok(custom)
}

/// Whether a whole shader is valid, and if not, why.
fn validated(wgsl: &str) -> Result<(), String> {
    let module = naga::front::wgsl::parse_str(wgsl).map_err(|error| error.message().to_owned())?;
    let validated = Validator::new(ValidationFlags::all(), Capabilities::empty()).validate(&module);
    validated.map(|_| ()).map_err(|error| error.to_string())
}

fn compile(
    text: &Text,
    module: &naga::Module,
    info: &naga::valid::ModuleInfo,
    signature: &Signature,
) -> Result<(Program, [Option<Entry>; 2]), InputError> {
    let wanted = [signature.surface, signature.color];
    let functions: Vec<_> = wanted.iter().flatten().map(|filter| filter.function).collect();
    let (program, entries) = program::compile(module, info, &functions).map_err(|refusal| {
        let error = text.error(text.place(refusal.span), refusal.message);
        InputError { help: refusal.help.map(str::to_owned), ..error }
    })?;
    let mut entries = entries.into_iter();
    Ok((program, wanted.map(|filter| filter.and_then(|_| entries.next()))))
}
