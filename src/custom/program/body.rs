//! One function: its frame, and its statements as jumps.

use naga::proc::TypeResolution;
use naga::valid::FunctionInfo;
use naga::{Arena, Block, Expression, Function, Handle, Span, Statement, SwitchCase, SwitchValue, Type, TypeInner};

use super::compile::{Compiler, Label, Refusal};
use super::{Address, Entry, Step, Stretch};

/// Where an expression's value is.
#[derive(Debug, Clone, Copy)]
pub enum Slot {
    Value(Stretch),
    /// A pointer to a place that is known.
    Place(Address),
    /// A pointer that the word at this address holds.
    Pointer(Address),
}

/// What `break` and `continue` leave.
struct Exit {
    end: Label,
    /// `None` of a `switch`.
    next: Option<Label>,
}

pub struct Body<'c, 'a> {
    pub compiler: &'c mut Compiler<'a>,
    pub expressions: &'a Arena<Expression>,
    /// Of the module's constant expressions, or of a function's.
    info: Option<&'a FunctionInfo>,
    pub slots: Vec<Option<Slot>>,
    pub variables: Vec<Address>,
    frame: Entry,
    exits: Vec<Exit>,
}

impl<'c, 'a> Body<'c, 'a> {
    /// Steps that compute all constant expressions of the module.
    pub fn constants(compiler: &'c mut Compiler<'a>) -> Result<(), Refusal> {
        let expressions = &compiler.module.global_expressions;
        let frame = Entry { start: 0, link: 0, arguments: Vec::new(), result: Stretch::default() };
        let mut body = Body::new(compiler, expressions, None, frame);
        for (handle, _) in expressions.iter() {
            body.evaluate(handle)?;
            let value = body.value(handle)?;
            body.compiler.constants.push(value);
        }
        Ok(())
    }

    pub fn compile(compiler: &'c mut Compiler<'a>, handle: Handle<Function>) -> Result<Entry, Refusal> {
        let module = compiler.module;
        let function = &module.functions[handle];
        let span = module.functions.get_span(handle);
        let info = &compiler.info[handle];
        let frame = Self::frame(compiler, function, span)?;
        let mut body = Body::new(compiler, &function.expressions, Some(info), frame);
        body.local_variables(function)?;
        body.block(&function.body)?;
        let link = body.frame.link;
        body.compiler.steps.push(Step::Return { link });
        Ok(body.frame)
    }

    fn new(
        compiler: &'c mut Compiler<'a>,
        expressions: &'a Arena<Expression>,
        info: Option<&'a FunctionInfo>,
        frame: Entry,
    ) -> Self {
        let slots = vec![None; expressions.len()];
        Self { compiler, expressions, info, slots, variables: Vec::new(), frame, exits: Vec::new() }
    }

    fn frame(compiler: &mut Compiler, function: &Function, span: Span) -> Result<Entry, Refusal> {
        let start = compiler.steps.len() as Address;
        let link = compiler.room(1, span)?.at;
        let mut room = |ty| {
            let count = compiler.layout.of(ty);
            compiler.room(count, span)
        };
        let arguments = function.arguments.iter().map(|argument| room(argument.ty)).collect::<Result<_, _>>()?;
        let result = function.result.as_ref().map(|result| room(result.ty)).transpose()?.unwrap_or_default();
        Ok(Entry { start, link, arguments, result })
    }

    /// Room for the variables, and steps that give each its first value, anew at each call.
    fn local_variables(&mut self, function: &'a Function) -> Result<(), Refusal> {
        for (handle, variable) in function.local_variables.iter() {
            let span = function.local_variables.get_span(handle);
            let count = self.compiler.layout.of(variable.ty);
            let to = self.compiler.room(count, span)?;
            self.variables.push(to.at);
            let from = match variable.init {
                Some(init) => self.value(init)?,
                None => self.compiler.room(count, span)?,
            };
            self.compiler.steps.push(Step::Copy { to: to.at, from });
        }
        Ok(())
    }

    pub fn span(&self, handle: Handle<Expression>) -> Span {
        self.expressions.get_span(handle)
    }

    pub fn refusal(&self, handle: Handle<Expression>, message: impl Into<String>) -> Refusal {
        Refusal::new(self.span(handle), message)
    }

    fn resolution(&self, handle: Handle<Expression>) -> &'a TypeResolution {
        match self.info {
            Some(info) => &info[handle].ty,
            None => &self.compiler.info[handle],
        }
    }

    pub fn inner(&self, handle: Handle<Expression>) -> &'a TypeInner {
        self.resolution(handle).inner_with(&self.compiler.module.types)
    }

    /// Words of an expression's value.
    pub fn words(&self, handle: Handle<Expression>) -> usize {
        match self.resolution(handle) {
            TypeResolution::Handle(ty) => self.compiler.layout.of(*ty),
            TypeResolution::Value(inner) => self.compiler.layout.words(inner),
        }
    }

    pub fn inner_of(&self, ty: Handle<Type>) -> &'a TypeInner {
        &self.compiler.module.types[ty].inner
    }

    pub fn argument(&self, index: u32) -> Option<Stretch> {
        self.frame.arguments.get(index as usize).copied()
    }

    fn block(&mut self, block: &'a Block) -> Result<(), Refusal> {
        block.span_iter().try_for_each(|(statement, span)| self.statement(statement, *span))
    }

    fn statement(&mut self, statement: &'a Statement, span: Span) -> Result<(), Refusal> {
        match statement {
            Statement::Emit(range) => range.clone().try_for_each(|handle| self.evaluate(handle)),
            Statement::Block(block) => self.block(block),
            Statement::If { condition, accept, reject } => {
                let condition = self.value(*condition)?.at;
                let (otherwise, end) = (self.compiler.label(), self.compiler.label());
                self.compiler.jump_unless(condition, otherwise);
                self.block(accept)?;
                self.compiler.jump(end);
                self.compiler.place(otherwise);
                self.block(reject)?;
                self.compiler.place(end);
                Ok(())
            }
            Statement::Switch { selector, cases } => self.switch(*selector, cases),
            Statement::Loop { body, continuing, break_if } => self.repeat(body, continuing, *break_if),
            Statement::Break => self.leave(span, |exit| Some(exit.end)),
            Statement::Continue => self.leave(span, |exit| exit.next),
            Statement::Return { value } => {
                if let Some(value) = value {
                    let from = self.value(*value)?;
                    self.compiler.steps.push(Step::Copy { to: self.frame.result.at, from });
                }
                self.compiler.steps.push(Step::Return { link: self.frame.link });
                Ok(())
            }
            Statement::Store { pointer, value } => {
                let from = self.value(*value)?;
                let step = match self.slot(*pointer)? {
                    Slot::Place(to) => Step::Copy { to, from },
                    Slot::Pointer(pointer) => Step::Store { pointer, from },
                    Slot::Value(_) => return Err(self.refusal(*pointer, "this is no place to store to")),
                };
                self.compiler.steps.push(step);
                Ok(())
            }
            Statement::Call { function, arguments, result } => self.call(*function, arguments, *result, span),
            _ => Err(Refusal::new(span, "a filter cannot do this")),
        }
    }

    fn repeat(
        &mut self,
        body: &'a Block,
        continuing: &'a Block,
        break_if: Option<Handle<Expression>>,
    ) -> Result<(), Refusal> {
        let [start, next, end] = [(); 3].map(|()| self.compiler.label());
        self.compiler.place(start);
        self.exits.push(Exit { end, next: Some(next) });
        self.block(body)?;
        self.exits.pop();
        self.compiler.place(next);
        self.block(continuing)?;
        match break_if {
            Some(condition) => {
                let condition = self.value(condition)?.at;
                self.compiler.jump_unless(condition, start);
            }
            None => self.compiler.jump(start),
        }
        self.compiler.place(end);
        Ok(())
    }

    fn switch(&mut self, selector: Handle<Expression>, cases: &'a [SwitchCase]) -> Result<(), Refusal> {
        let selector = self.value(selector)?.at;
        let end = self.compiler.label();
        let labels: Vec<Label> = cases.iter().map(|_| self.compiler.label()).collect();
        let mut default = end;
        for (case, label) in cases.iter().zip(&labels) {
            match case.value {
                SwitchValue::I32(value) => self.compiler.jump_if_equal(selector, value as u32, *label),
                SwitchValue::U32(value) => self.compiler.jump_if_equal(selector, value, *label),
                SwitchValue::Default => default = *label,
            }
        }
        self.compiler.jump(default);
        self.exits.push(Exit { end, next: None });
        for (case, label) in cases.iter().zip(&labels) {
            self.compiler.place(*label);
            self.block(&case.body)?;
            if !case.fall_through {
                self.compiler.jump(end);
            }
        }
        self.exits.pop();
        self.compiler.place(end);
        Ok(())
    }

    /// Jumps out of the innermost statement that has such an exit.
    fn leave(&mut self, span: Span, label: impl Fn(&Exit) -> Option<Label>) -> Result<(), Refusal> {
        let label =
            self.exits.iter().rev().find_map(label).ok_or_else(|| Refusal::new(span, "there is nothing to leave"))?;
        self.compiler.jump(label);
        Ok(())
    }

    fn call(
        &mut self,
        function: Handle<Function>,
        arguments: &'a [Handle<Expression>],
        result: Option<Handle<Expression>>,
        span: Span,
    ) -> Result<(), Refusal> {
        let unknown = || Refusal::new(span, "a function is called before it is known");
        let entry = self.compiler.functions.get(&function).cloned().ok_or_else(unknown)?;
        for (argument, to) in arguments.iter().zip(&entry.arguments) {
            let from = match self.slot(*argument)? {
                Slot::Value(value) => value,
                Slot::Place(at) => Stretch { at: self.compiler.word(at, span)?, count: 1 },
                Slot::Pointer(at) => Stretch { at, count: 1 },
            };
            self.compiler.steps.push(Step::Copy { to: to.at, from });
        }
        self.compiler.steps.push(Step::Call { function: entry.start, link: entry.link });
        if let Some(result) = result {
            let to = self.compiler.room(entry.result.count as usize, span)?;
            self.compiler.steps.push(Step::Copy { to: to.at, from: entry.result });
            self.slots[result.index()] = Some(Slot::Value(to));
        }
        Ok(())
    }
}
