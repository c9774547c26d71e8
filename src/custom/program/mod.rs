//! A filter for the CPU: naga's IR, compiled once into a flat list of steps over a memory of 32-bit words.
//!
//! WGSL has no recursion, so each function has one frame at a fixed address: every value, local variable, argument and
//! result is known by the number of its word before anything runs. A call copies a memory image in which constants are
//! in place already, and allocates nothing once its thread has run a filter before.

mod body;
mod compile;
mod expression;
mod kernel;
mod layout;
mod math;
mod operators;
mod packing;
mod vectors;

pub use compile::compile;
pub use layout::Layout;

use std::cell::RefCell;

use kernel::{Kernel, MOST_WORDS};

/// The number of a word.
type Address = u32;

/// The number of a step.
type Target = u32;

/// Where the program ends.
const HALT: Target = Target::MAX;

/// Words that a program may take.
pub const MOST_MEMORY: usize = 1 << 16;

/// Components of a value, one after another, or one for all.
#[derive(Debug, Clone, Copy)]
struct Operand {
    at: Address,
    /// 0 where one scalar counts for every component, else 1.
    stride: u32,
}

impl Operand {
    fn word(self, i: u32) -> usize {
        (self.at + i * self.stride) as usize
    }
}

/// Words that a built-in takes as a whole.
#[derive(Debug, Clone, Copy, Default)]
struct Stretch {
    at: Address,
    count: u32,
}

impl Stretch {
    fn of(self, memory: &[u32]) -> &[u32] {
        &memory[self.at as usize..][..self.count as usize]
    }
}

#[derive(Debug, Clone)]
enum Step {
    Each1 {
        f: fn(u32) -> u32,
        to: Stretch,
        a: Operand,
    },
    Each2 {
        f: fn(u32, u32) -> u32,
        to: Stretch,
        a: Operand,
        b: Operand,
    },
    Each3 {
        f: fn(u32, u32, u32) -> u32,
        to: Stretch,
        a: Operand,
        b: Operand,
        c: Operand,
    },
    Whole {
        f: kernel::Whole,
        to: Stretch,
        args: [Stretch; 4],
    },
    /// The product of matrices, column by column: `a` has `rows` rows and `inner` columns.
    Product {
        to: Stretch,
        a: Address,
        b: Address,
        rows: u32,
        inner: u32,
    },
    Copy {
        to: Address,
        from: Stretch,
    },
    /// The address of an element: `base + min(index, count - 1) * stride`, of words that hold `base` and `index`.
    Element {
        to: Address,
        base: Address,
        index: Address,
        count: u32,
        stride: u32,
    },
    /// From where the word at `pointer` points.
    Load {
        to: Stretch,
        pointer: Address,
    },
    Store {
        pointer: Address,
        from: Stretch,
    },
    Jump(Target),
    JumpUnless {
        condition: Address,
        target: Target,
    },
    JumpIfEqual {
        selector: Address,
        value: u32,
        target: Target,
    },
    /// Leaves the number of the next step at `link`.
    Call {
        function: Target,
        link: Address,
    },
    Return {
        link: Address,
    },
}

/// A function that the host calls.
#[derive(Debug, Clone)]
pub struct Entry {
    start: Target,
    link: Address,
    arguments: Vec<Stretch>,
    result: Stretch,
}

/// All that a filter's functions come to.
#[derive(Debug, Clone)]
pub struct Program {
    steps: Vec<Step>,
    /// The memory before a call.
    image: Vec<u32>,
    /// Where the fuel of loops is, if there are some; see [`super::fuel`].
    fuel: Option<Address>,
}

thread_local! {
    static MEMORY: RefCell<Vec<u32>> = const { RefCell::new(Vec::new()) };
}

impl Program {
    /// Calls a function with the words of its arguments; `read` sees the words of its result.
    /// `spent` grows by the fuel that it took.
    pub fn call<T>(&self, entry: &Entry, arguments: &[&[u32]], spent: &mut u32, read: impl FnOnce(&[u32]) -> T) -> T {
        MEMORY.with_borrow_mut(|memory| {
            memory.clear();
            memory.extend_from_slice(&self.image);
            for (to, words) in entry.arguments.iter().zip(arguments) {
                let to = &mut memory[to.at as usize..][..to.count as usize];
                to.iter_mut().zip(*words).for_each(|(to, word)| *to = *word);
            }
            memory[entry.link as usize] = HALT;
            self.run(memory, entry.start);
            if let Some(fuel) = self.fuel {
                *spent += self.image[fuel as usize] - memory[fuel as usize];
            }
            read(entry.result.of(memory))
        })
    }

    fn run(&self, memory: &mut [u32], start: Target) {
        let mut at = start;
        while at != HALT {
            at = self.steps[at as usize].act(memory, at + 1);
        }
    }
}

impl Step {
    /// How many numbers the step computes or moves; 1 for a jump.
    fn words(&self) -> usize {
        let count = match self {
            Step::Each1 { to, .. } | Step::Each2 { to, .. } | Step::Each3 { to, .. } => to.count,
            Step::Whole { to, .. } | Step::Product { to, .. } | Step::Load { to, .. } => to.count,
            Step::Copy { from, .. } | Step::Store { from, .. } => from.count,
            _ => 1,
        };
        count as usize
    }

    /// Does the step and says which comes after it: `next` unless it jumps.
    #[inline]
    fn act(&self, memory: &mut [u32], next: Target) -> Target {
        match *self {
            Step::Each1 { f, to, a } => {
                for i in 0..to.count {
                    memory[(to.at + i) as usize] = f(memory[a.word(i)]);
                }
            }
            Step::Each2 { f, to, a, b } => {
                for i in 0..to.count {
                    memory[(to.at + i) as usize] = f(memory[a.word(i)], memory[b.word(i)]);
                }
            }
            Step::Each3 { f, to, a, b, c } => {
                for i in 0..to.count {
                    memory[(to.at + i) as usize] = f(memory[a.word(i)], memory[b.word(i)], memory[c.word(i)]);
                }
            }
            Step::Whole { f, to, args } => {
                let result = f(args.map(|arg| arg.of(memory)));
                let count = to.count as usize;
                memory[to.at as usize..][..count].copy_from_slice(&result[..count]);
            }
            Step::Product { to, a, b, rows, inner } => {
                for i in 0..to.count {
                    let (column, row) = (i / rows, i % rows);
                    let term = |k| {
                        let left = memory[(a + k * rows + row) as usize];
                        let right = memory[(b + column * inner + k) as usize];
                        f32::from_bits(left) * f32::from_bits(right)
                    };
                    let sum: f32 = (0..inner).map(term).sum();
                    memory[(to.at + i) as usize] = sum.to_bits();
                }
            }
            Step::Copy { to, from } => copy(memory, to, from),
            Step::Element { to, base, index, count, stride } => {
                let index = memory[index as usize].min(count - 1);
                memory[to as usize] = memory[base as usize] + index * stride;
            }
            Step::Load { to, pointer } => {
                let from = Stretch { at: memory[pointer as usize], count: to.count };
                copy(memory, to.at, from);
            }
            Step::Store { pointer, from } => copy(memory, memory[pointer as usize], from),
            Step::Jump(target) => return target,
            Step::JumpUnless { condition, target } => {
                if memory[condition as usize] == 0 {
                    return target;
                }
            }
            Step::JumpIfEqual { selector, value, target } => {
                if memory[selector as usize] == value {
                    return target;
                }
            }
            Step::Call { function, link } => {
                memory[link as usize] = next;
                return function;
            }
            Step::Return { link } => return memory[link as usize],
        }
        next
    }
}

fn copy(memory: &mut [u32], to: Address, from: Stretch) {
    let from = from.at as usize..(from.at + from.count) as usize;
    memory.copy_within(from, to as usize);
}

impl Step {
    /// The step that applies a kernel to as many operands as it takes; `None` where there are fewer.
    fn apply(kernel: Kernel, to: Stretch, args: &[Stretch]) -> Option<Step> {
        let each = |i: usize| {
            let arg = args.get(i)?;
            Some(Operand { at: arg.at, stride: u32::from(arg.count != 1) })
        };
        Some(match kernel {
            Kernel::Each1(f) => Step::Each1 { f, to, a: each(0)? },
            Kernel::Each2(f) => Step::Each2 { f, to, a: each(0)?, b: each(1)? },
            Kernel::Each3(f) => Step::Each3 { f, to, a: each(0)?, b: each(1)?, c: each(2)? },
            Kernel::Whole(f) => {
                if to.count as usize > MOST_WORDS {
                    return None;
                }
                let mut all = [Stretch::default(); 4];
                all.iter_mut().zip(args).for_each(|(to, arg)| *to = *arg);
                Step::Whole { f, to, args: all }
            }
        })
    }
}

/// Whether the interpreter has a built-in function for numbers of any kind.
pub fn has(fun: naga::MathFunction) -> bool {
    use naga::ScalarKind::{Float, Sint, Uint};
    fun == naga::MathFunction::Transpose || [Float, Sint, Uint].iter().any(|kind| math::function(fun, *kind).is_some())
}
