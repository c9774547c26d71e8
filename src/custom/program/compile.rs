//! A module's functions, one after another, callees first.

use std::collections::HashMap;
use std::convert::Infallible;

use naga::valid::ModuleInfo;
use naga::{Function, Handle, Module, Statement};

use super::body::Body;
use super::{Address, Entry, Layout, MOST_MEMORY, Program, Step, Stretch, Target};
use crate::custom::walk;

/// Why a module cannot be compiled, and where.
#[derive(Debug)]
pub struct Refusal {
    pub span: naga::Span,
    pub message: String,
    /// What to do about it.
    pub help: Option<&'static str>,
}

impl Refusal {
    pub fn new(span: naga::Span, message: impl Into<String>) -> Self {
        Self { span, message: message.into(), help: None }
    }

    fn help(self, help: &'static str) -> Self {
        Self { help: Some(help), ..self }
    }

    /// With another place where it has none.
    fn or_at(self, span: naga::Span) -> Self {
        if self.span.is_defined() { self } else { Self { span, ..self } }
    }
}

/// Numbers that one call of a function may compute or move, with all that it calls and each loop taken once. Shader
/// compilers write the calls out, so this bounds their work, too.
const MOST_WORK: usize = 100_000;

/// Compiles functions with all that they call; the entries come in the order asked for.
pub fn compile(
    module: &Module,
    info: &ModuleInfo,
    wanted: &[Handle<Function>],
) -> Result<(Program, Vec<Entry>), Refusal> {
    let mut compiler = Compiler::new(module, info);
    compiler.globals()?;
    let needed = needed(module, wanted);
    let mut work = HashMap::new();
    for (handle, function) in module.functions.iter().filter(|(handle, _)| needed[handle.index()]) {
        let span = module.functions.get_span(handle);
        let entry = Body::compile(&mut compiler, handle).map_err(|refusal| refusal.or_at(span))?;
        let of_step = |step: &Step| match step {
            Step::Call { function, .. } => work.get(function).copied().unwrap_or(0),
            step => step.words(),
        };
        let total = compiler.steps[entry.start as usize..].iter().map(of_step).fold(0, usize::saturating_add);
        if total > MOST_WORK {
            let name = function.name.as_deref().unwrap_or_default();
            let message =
                format!("`{name}` computes {total} numbers, each loop taken once, and {MOST_WORK} are the most");
            return Err(
                Refusal::new(span, message).help("call functions in a loop, or keep what they gave in a variable")
            );
        }
        work.insert(entry.start, total);
        compiler.functions.insert(handle, entry);
    }
    let missing = || Refusal::new(naga::Span::UNDEFINED, "a function is missing");
    let entries =
        wanted.iter().map(|f| compiler.functions.get(f).cloned().ok_or_else(missing)).collect::<Result<_, _>>()?;
    Ok((compiler.finish(), entries))
}

/// Whether each function is wanted, or called by one that is.
fn needed(module: &Module, wanted: &[Handle<Function>]) -> Vec<bool> {
    let mut needed = vec![false; module.functions.len()];
    wanted.iter().for_each(|handle| needed[handle.index()] = true);
    // Callees stand before their callers.
    for (handle, function) in module.functions.iter().rev() {
        if needed[handle.index()] {
            let Ok(()) = walk::statements::<Infallible>(&function.body, &mut |statement, _| {
                if let Statement::Call { function, .. } = statement {
                    needed[function.index()] = true;
                }
                Ok(())
            });
        }
    }
    needed
}

/// Where a jump leads, to be known later.
#[derive(Debug, Clone, Copy)]
pub struct Label(Target);

/// What all functions share.
pub struct Compiler<'a> {
    pub module: &'a Module,
    pub info: &'a ModuleInfo,
    pub layout: Layout,
    pub steps: Vec<Step>,
    pub image: Vec<u32>,
    pub functions: HashMap<Handle<Function>, Entry>,
    /// The addresses of the module's variables.
    pub variables: Vec<Address>,
    /// The values of the module's constant expressions.
    pub constants: Vec<Stretch>,
    /// Words that never change, by their value.
    words: HashMap<u32, Address>,
    /// The steps that labels stand for.
    labels: Vec<Target>,
}

impl<'a> Compiler<'a> {
    fn new(module: &'a Module, info: &'a ModuleInfo) -> Self {
        Self {
            module,
            info,
            layout: Layout::new(&module.types),
            steps: Vec::new(),
            image: Vec::new(),
            functions: HashMap::new(),
            variables: Vec::new(),
            constants: Vec::new(),
            words: HashMap::new(),
            labels: Vec::new(),
        }
    }

    /// Evaluates the module's constant expressions into the image, and places its variables.
    fn globals(&mut self) -> Result<(), Refusal> {
        Body::constants(self)?;
        let end = self.steps.len() as Target;
        let steps = std::mem::take(&mut self.steps);
        let program = Program { steps, image: Vec::new(), fuel: None };
        let mut at = 0;
        while at < end {
            at = program.steps[at as usize].act(&mut self.image, at + 1);
        }
        for (handle, variable) in self.module.global_variables.iter() {
            let span = self.module.global_variables.get_span(handle);
            let to = self.room(self.layout.of(variable.ty), span)?;
            if let Some(init) = variable.init {
                let from = self.constants[init.index()].of(&self.image).to_vec();
                self.image[to.at as usize..][..from.len()].copy_from_slice(&from);
            }
            self.variables.push(to.at);
        }
        Ok(())
    }

    /// Words of their own, zero before each call.
    pub fn room(&mut self, count: usize, span: naga::Span) -> Result<Stretch, Refusal> {
        let at = self.image.len();
        if at.saturating_add(count) > MOST_MEMORY {
            let message = format!("the file's variables and values need more than {MOST_MEMORY} numbers of memory");
            return Err(Refusal::new(span, message).help("use smaller arrays, and copy them less often"));
        }
        self.image.resize(at + count, 0);
        Ok(Stretch { at: at as Address, count: count as u32 })
    }

    /// A word that holds a value which never changes.
    pub fn word(&mut self, value: u32, span: naga::Span) -> Result<Address, Refusal> {
        if let Some(at) = self.words.get(&value) {
            return Ok(*at);
        }
        let at = self.room(1, span)?.at;
        self.image[at as usize] = value;
        self.words.insert(value, at);
        Ok(at)
    }

    pub fn label(&mut self) -> Label {
        self.labels.push(Target::MAX);
        Label(self.labels.len() as Target - 1)
    }

    /// The next step is what the label stands for.
    pub fn place(&mut self, label: Label) {
        self.labels[label.0 as usize] = self.steps.len() as Target;
    }

    pub fn jump(&mut self, label: Label) {
        self.steps.push(Step::Jump(label.0));
    }

    pub fn jump_unless(&mut self, condition: Address, label: Label) {
        self.steps.push(Step::JumpUnless { condition, target: label.0 });
    }

    pub fn jump_if_equal(&mut self, selector: Address, value: u32, label: Label) {
        self.steps.push(Step::JumpIfEqual { selector, value, target: label.0 });
    }

    fn finish(self) -> Program {
        let mut steps = self.steps;
        for step in &mut steps {
            if let Step::Jump(target) | Step::JumpUnless { target, .. } | Step::JumpIfEqual { target, .. } = step {
                *target = self.labels[*target as usize];
            }
        }
        // The only variable there is.
        Program { steps, image: self.image, fuel: self.variables.first().copied() }
    }
}
