//! Expressions: each has a slot, and most have a step that fills it. Parts of values and copies of constants need
//! none: they are where the whole is.

use naga::{BinaryOperator, Expression, Handle, Literal, MathFunction, ScalarKind, SwizzleComponent, TypeInner};

use super::body::{Body, Slot};
use super::compile::Refusal;
use super::kernel::Kernel;
use super::{Address, Step, Stretch, math, operators, vectors};

impl Body<'_, '_> {
    /// Steps that compute an expression, at the place where it is emitted.
    pub fn evaluate(&mut self, handle: Handle<Expression>) -> Result<(), Refusal> {
        let slot = self.compute(handle)?;
        self.slots[handle.index()] = Some(slot);
        Ok(())
    }

    /// Constants, arguments and variables are never emitted: they get their slot when they are first asked for.
    pub fn slot(&mut self, handle: Handle<Expression>) -> Result<Slot, Refusal> {
        if self.slots[handle.index()].is_none() {
            self.evaluate(handle)?;
        }
        self.slots[handle.index()].ok_or_else(|| self.refusal(handle, "this has no value"))
    }

    pub fn value(&mut self, handle: Handle<Expression>) -> Result<Stretch, Refusal> {
        match self.slot(handle)? {
            Slot::Value(value) => Ok(value),
            _ => Err(self.refusal(handle, "this is a pointer where a value is needed")),
        }
    }

    fn compute(&mut self, handle: Handle<Expression>) -> Result<Slot, Refusal> {
        let arena = self.expressions;
        let value = match &arena[handle] {
            Expression::Literal(literal) => self.literal(handle, *literal)?,
            Expression::Constant(constant) => {
                let init = self.compiler.module.constants[*constant].init;
                self.compiler.constants[init.index()]
            }
            Expression::ZeroValue(_) => self.room(handle)?,
            Expression::Compose { components, .. } => self.compose(handle, components)?,
            Expression::Access { base, index } => return self.access(handle, *base, *index),
            Expression::AccessIndex { base, index } => return self.access_index(handle, *base, *index),
            Expression::Splat { value, .. } => self.apply(handle, Kernel::Each1(|x| x), &[*value])?,
            Expression::Swizzle { vector, pattern, .. } => self.swizzle(handle, *vector, *pattern)?,
            Expression::FunctionArgument(index) => return self.function_argument(handle, *index),
            Expression::GlobalVariable(variable) => return Ok(Slot::Place(self.compiler.variables[variable.index()])),
            Expression::LocalVariable(variable) => return Ok(Slot::Place(self.variables[variable.index()])),
            Expression::Load { pointer } => self.load(handle, *pointer)?,
            Expression::Unary { op, expr } => {
                let kernel = operators::unary(*op, self.kind(*expr));
                self.apply_known(handle, kernel, &[*expr])?
            }
            Expression::Binary { op, left, right } => self.binary(handle, *op, *left, *right)?,
            Expression::Select { condition, accept, reject } => {
                let kernel = Kernel::Each3(|condition, accept, reject| if condition != 0 { accept } else { reject });
                self.apply(handle, kernel, &[*condition, *accept, *reject])?
            }
            Expression::Relational { fun, argument } => {
                self.apply_known(handle, vectors::relational(*fun), &[*argument])?
            }
            Expression::Math { fun, arg, arg1, arg2, arg3 } => {
                let args: Vec<_> = [Some(*arg), *arg1, *arg2, *arg3].into_iter().flatten().collect();
                self.math(handle, *fun, &args)?
            }
            Expression::As { expr, kind, convert } => {
                let kernel = match convert {
                    Some(_) => operators::convert(self.kind(*expr), *kind),
                    None => Some(Kernel::Each1(|x| x)),
                };
                self.apply_known(handle, kernel, &[*expr])?
            }
            _ => return Err(self.refusal(handle, "a filter cannot do this")),
        };
        Ok(Slot::Value(value))
    }

    fn room(&mut self, handle: Handle<Expression>) -> Result<Stretch, Refusal> {
        self.compiler.room(self.words(handle), self.span(handle))
    }

    fn literal(&mut self, handle: Handle<Expression>, literal: Literal) -> Result<Stretch, Refusal> {
        let word = match literal {
            Literal::F32(x) => x.to_bits(),
            Literal::U32(x) => x,
            Literal::I32(x) => x as u32,
            Literal::Bool(x) => u32::from(x),
            _ => return Err(self.refusal(handle, "a filter computes in f32, i32, u32 and bool")),
        };
        Ok(Stretch { at: self.compiler.word(word, self.span(handle))?, count: 1 })
    }

    fn compose(&mut self, handle: Handle<Expression>, parts: &[Handle<Expression>]) -> Result<Stretch, Refusal> {
        let to = self.room(handle)?;
        let mut at = to.at;
        for part in parts {
            let from = self.value(*part)?;
            self.compiler.steps.push(Step::Copy { to: at, from });
            at += from.count;
        }
        Ok(to)
    }

    fn swizzle(
        &mut self,
        handle: Handle<Expression>,
        vector: Handle<Expression>,
        pattern: [SwizzleComponent; 4],
    ) -> Result<Stretch, Refusal> {
        let from = self.value(vector)?;
        let to = self.room(handle)?;
        for (i, component) in (0..to.count).zip(pattern) {
            let from = Stretch { at: from.at + component as Address, count: 1 };
            self.compiler.steps.push(Step::Copy { to: to.at + i, from });
        }
        Ok(to)
    }

    fn function_argument(&mut self, handle: Handle<Expression>, index: u32) -> Result<Slot, Refusal> {
        let argument = self.argument(index).ok_or_else(|| self.refusal(handle, "there is no such argument"))?;
        Ok(match self.inner(handle) {
            TypeInner::Pointer { .. } | TypeInner::ValuePointer { .. } => Slot::Pointer(argument.at),
            _ => Slot::Value(argument),
        })
    }

    fn load(&mut self, handle: Handle<Expression>, pointer: Handle<Expression>) -> Result<Stretch, Refusal> {
        let slot = self.slot(pointer)?;
        let to = self.room(handle)?;
        let step = match slot {
            Slot::Place(at) => Step::Copy { to: to.at, from: Stretch { at, count: to.count } },
            Slot::Pointer(pointer) => Step::Load { to, pointer },
            Slot::Value(_) => return Err(self.refusal(pointer, "this is no pointer")),
        };
        self.compiler.steps.push(step);
        Ok(to)
    }

    /// What an expression is, or what it points to.
    fn pointee(&self, handle: Handle<Expression>) -> TypeInner {
        match self.inner(handle) {
            TypeInner::Pointer { base, .. } => self.inner_of(*base).clone(),
            TypeInner::ValuePointer { size: Some(size), scalar, .. } => {
                TypeInner::Vector { size: *size, scalar: *scalar }
            }
            other => other.clone(),
        }
    }

    fn access_index(
        &mut self,
        handle: Handle<Expression>,
        base: Handle<Expression>,
        index: u32,
    ) -> Result<Slot, Refusal> {
        let offset = self.compiler.layout.offset(&self.pointee(base), index);
        let offset = offset.ok_or_else(|| self.refusal(handle, "this has no parts"))? as Address;
        match self.slot(base)? {
            Slot::Value(whole) => Ok(Slot::Value(Stretch { at: whole.at + offset, count: self.words(handle) as u32 })),
            Slot::Place(at) => Ok(Slot::Place(at + offset)),
            Slot::Pointer(base) => {
                let span = self.span(handle);
                let index = self.compiler.word(1, span)?;
                let to = self.compiler.room(1, span)?.at;
                self.compiler.steps.push(Step::Element { to, base, index, count: 2, stride: offset });
                Ok(Slot::Pointer(to))
            }
        }
    }

    fn access(
        &mut self,
        handle: Handle<Expression>,
        base: Handle<Expression>,
        index: Handle<Expression>,
    ) -> Result<Slot, Refusal> {
        let elements = self.compiler.layout.elements(&self.pointee(base));
        let (stride, count) = elements.ok_or_else(|| self.refusal(handle, "this has no elements"))?;
        let span = self.span(handle);
        let index = self.value(index)?.at;
        let slot = self.slot(base)?;
        let base = match slot {
            Slot::Value(Stretch { at, .. }) | Slot::Place(at) => self.compiler.word(at, span)?,
            Slot::Pointer(base) => base,
        };
        let to = self.compiler.room(1, span)?.at;
        let (count, stride) = (count as u32, stride as u32);
        self.compiler.steps.push(Step::Element { to, base, index, count, stride });
        if let Slot::Value(_) = slot {
            let value = self.room(handle)?;
            self.compiler.steps.push(Step::Load { to: value, pointer: to });
            return Ok(Slot::Value(value));
        }
        Ok(Slot::Pointer(to))
    }

    /// The kind of a value's scalars.
    fn kind(&self, handle: Handle<Expression>) -> ScalarKind {
        self.inner(handle).scalar_kind().unwrap_or(ScalarKind::Bool)
    }

    fn apply(
        &mut self,
        handle: Handle<Expression>,
        kernel: Kernel,
        args: &[Handle<Expression>],
    ) -> Result<Stretch, Refusal> {
        self.apply_known(handle, Some(kernel), args)
    }

    /// A step that applies a kernel, which is `None` where there is none for these types.
    fn apply_known(
        &mut self,
        handle: Handle<Expression>,
        kernel: Option<Kernel>,
        args: &[Handle<Expression>],
    ) -> Result<Stretch, Refusal> {
        let args = args.iter().map(|arg| self.value(*arg)).collect::<Result<Vec<_>, _>>()?;
        let to = self.room(handle)?;
        let step = kernel.and_then(|kernel| Step::apply(kernel, to, &args));
        let step = step.ok_or_else(|| self.refusal(handle, "a filter cannot compute this"))?;
        self.compiler.steps.push(step);
        Ok(to)
    }

    fn math(
        &mut self,
        handle: Handle<Expression>,
        fun: MathFunction,
        args: &[Handle<Expression>],
    ) -> Result<Stretch, Refusal> {
        let kernel = match (fun, args.first().map(|arg| self.inner(*arg))) {
            (MathFunction::Transpose, Some(TypeInner::Matrix { columns, .. })) => vectors::transpose(*columns as usize),
            (_, Some(_)) => math::function(fun, self.kind(args[0])),
            (_, None) => None,
        };
        self.apply_known(handle, kernel, args)
    }

    fn binary(
        &mut self,
        handle: Handle<Expression>,
        op: BinaryOperator,
        left: Handle<Expression>,
        right: Handle<Expression>,
    ) -> Result<Stretch, Refusal> {
        let product = product(self.inner(left), self.inner(right)).filter(|_| op == BinaryOperator::Multiply);
        if let Some((rows, inner)) = product {
            let (a, b) = (self.value(left)?.at, self.value(right)?.at);
            let to = self.room(handle)?;
            self.compiler.steps.push(Step::Product { to, a, b, rows, inner });
            return Ok(to);
        }
        let kernel = operators::binary(op, self.kind(left));
        self.apply_known(handle, kernel, &[left, right])
    }
}

/// The rows and columns of the left side of a product of matrices; a vector is one row or one column.
fn product(left: &TypeInner, right: &TypeInner) -> Option<(u32, u32)> {
    match (left, right) {
        (TypeInner::Matrix { columns, rows, .. }, TypeInner::Matrix { .. } | TypeInner::Vector { .. }) => {
            Some((*rows as u32, *columns as u32))
        }
        (TypeInner::Vector { size, .. }, TypeInner::Matrix { .. }) => Some((1, *size as u32)),
        _ => None,
    }
}
