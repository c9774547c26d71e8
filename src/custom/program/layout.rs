//! How values lie in the interpreter's memory: as 32-bit words without gaps, members and columns one after another.

use naga::{ArraySize, Handle, Type, TypeInner, UniqueArena};

/// Words of each type of a module; pointers are one word.
pub struct Layout(Vec<usize>);

impl Layout {
    /// Types stand before those that are made of them, so one pass will do. Sizes saturate.
    pub fn new(types: &UniqueArena<Type>) -> Self {
        let mut sizes = Self(Vec::new());
        for (_, ty) in types.iter() {
            let words = sizes.words(&ty.inner);
            sizes.0.push(words);
        }
        sizes
    }

    pub fn of(&self, ty: Handle<Type>) -> usize {
        self.0[ty.index()]
    }

    pub fn words(&self, inner: &TypeInner) -> usize {
        match inner {
            TypeInner::Vector { size, .. } => *size as usize,
            TypeInner::Matrix { columns, rows, .. } => *columns as usize * *rows as usize,
            TypeInner::Array { base, size: ArraySize::Constant(count), .. } => {
                self.of(*base).saturating_mul(count.get() as usize)
            }
            TypeInner::Struct { members, .. } => {
                members.iter().fold(0, |sum, member| sum.saturating_add(self.of(member.ty)))
            }
            _ => 1,
        }
    }

    /// What indexing a value (not a pointer) of a type gives: the words of one element, and how many there are.
    pub fn elements(&self, inner: &TypeInner) -> Option<(usize, usize)> {
        match inner {
            TypeInner::Vector { size, .. } => Some((1, *size as usize)),
            TypeInner::Matrix { columns, rows, .. } => Some((*rows as usize, *columns as usize)),
            TypeInner::Array { base, size: ArraySize::Constant(count), .. } => {
                Some((self.of(*base), count.get() as usize))
            }
            _ => None,
        }
    }

    /// Words before an element or member.
    pub fn offset(&self, inner: &TypeInner, index: u32) -> Option<usize> {
        match inner {
            TypeInner::Struct { members, .. } => {
                Some(members.iter().take(index as usize).map(|member| self.of(member.ty)).sum())
            }
            _ => self.elements(inner).map(|(words, _)| words * index as usize),
        }
    }
}
