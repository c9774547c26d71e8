//! Which lenses act on a fragment: sections 3 to 5 of SEMANTICS for one point.

use super::{Item, Lens, LensSet};

/// What the walk down the order found.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Verdict {
    /// The lenses around the fragment that apply to it, hidden ones included: S.
    pub set: LensSet,
    /// Those that act, a subset of `set`: the stack, lowest rank first.
    pub stack: LensSet,
    /// Neither erased nor replaced by other content, and, for an alternate, shown by some lens.
    pub displayed: bool,
}

/// Walks from the top of the order down through the lenses that contain the point.
///
/// `inside`: the lenses (by pixel) whose volume holds the point. Content filters act on the base scene at
/// every level; on an alternate only above the lens that shows it, for what lies lower does not reach it.
pub fn walk(lenses: &[Lens], item: &Item, inside: LensSet) -> Verdict {
    let mut verdict = Verdict { set: LensSet::EMPTY, stack: LensSet::EMPTY, displayed: true };
    let mut hidden = LensSet::EMPTY;
    // Whether the lens that brought this content in has been passed.
    let mut shown = false;
    let mut rest = (inside | item.object) & (item.scope | item.shown_by);
    while let Some(rank) = rest.top() {
        rest.remove(rank);
        let acts = !hidden.contains(rank);
        let shows = acts && !shown && item.shown_by.contains(rank);
        if !shows && !item.scope.contains(rank) {
            continue;
        }
        verdict.set.insert(rank);
        if !acts {
            continue;
        }
        verdict.stack.insert(rank);
        hidden = hidden | lenses[rank].hides;
        if shows {
            shown = true;
        } else if !shown && item.removed_by.contains(rank) {
            verdict.displayed = false;
        }
    }
    verdict.displayed &= shown || !item.is_alternate();
    verdict
}

/// The survivors of a set by itself, without regard to content.
pub fn survivors(lenses: &[Lens], set: LensSet) -> LensSet {
    let mut stack = LensSet::EMPTY;
    let mut rest = set;
    while let Some(rank) = rest.top() {
        rest.remove(rank);
        stack.insert(rank);
        rest = rest.minus(lenses[rank].hides);
    }
    stack
}
