//! Which lenses act on a fragment: sections 3 to 5 of SEMANTICS for one point.

use super::{Instance, Item, Lens, LensSet, Plan};

/// What the walk down the order found.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Verdict {
    /// The lenses around the fragment that apply to it, hidden ones included: S. Below a lens that moves content,
    /// those around the moved point.
    pub set: LensSet,
    /// Those that act, a subset of `set`, lowest rank first; or the one overlap rule that acts in their place.
    pub stack: LensSet,
    /// The lenses that move content take a fragment at this point just where the instance has it from.
    pub here: bool,
    /// It is there, in one version or another: neither erased nor replaced nor moved elsewhere, and, for an alternate,
    /// shown.
    pub there: bool,
    /// The share of the triangles in the version that is seen.
    pub ratio: f32,
    /// It is there, and in this version, or it fills a gap between versions.
    pub displayed: bool,
    /// It is seen only where no surface lies within [`Instance::spread`] behind it: see [`Plan::verdict`].
    pub fills: bool,
    /// Who takes it away from here: what erases it, shows something else, or moves it elsewhere. An alternate that
    /// no lens shows is not taken away, it is not there.
    pub removed_by: LensSet,
    /// Who decides which version is seen, if some `lod` does.
    pub simplified_by: Option<usize>,
}

impl Verdict {
    /// Who takes an item away, as accounts tell it: who removes it, or lets a simplified version be seen in its place. A
    /// simplified version that is not seen is not taken away, it is not there.
    pub fn taken_by(&self, item: &Item) -> LensSet {
        match self.simplified_by.filter(|_| self.ratio != item.ratio) {
            _ if item.is_simplified() && self.ratio != item.ratio => LensSet::EMPTY,
            Some(rank) => self.removed_by | LensSet::only(rank),
            None => self.removed_by,
        }
    }
}

impl Plan {
    /// What the lenses do at a point where an instance is met.
    ///
    /// `around(n)`: the lenses (by pixel) whose volume holds the point after the first n steps of the instance; 0 is
    /// the shown point itself. Content filters act on the base scene at every level; on an alternate only from the
    /// lens that shows it upwards, for what lies lower does not reach it.
    pub fn walk(&self, instance: &Instance, mut around: impl FnMut(usize) -> LensSet) -> Verdict {
        let item = &self.items[instance.item];
        let here = around(0);
        let containing = self.applying(item, here) & item.scope;
        if let Some(rule) = self.rule_for(containing) {
            return self.rule_verdict(item, instance, self.rule_rank(rule), containing);
        }
        let nothing = LensSet::EMPTY;
        let mut verdict = Verdict {
            set: nothing,
            stack: nothing,
            here: true,
            there: true,
            ratio: 1.0,
            displayed: true,
            fills: false,
            removed_by: nothing,
            simplified_by: None,
        };
        let mut hidden = LensSet::EMPTY;
        // Whether the lens that brought this content in has been passed.
        let mut shown = false;
        let mut steps = 0;
        let mut rest = self.applying(item, here);
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
            hidden = hidden | self.lenses[rank].hides;
            if !shown && verdict.simplified_by.is_none() && item.simplified_by.contains(rank) {
                verdict.simplified_by = Some(rank);
                verdict.ratio = self.lod_of(rank).unwrap_or(1.0);
            }
            if !shown && item.movers.contains(rank) {
                if instance.steps.get(steps).is_some_and(|step| step.rank == rank) {
                    steps += 1;
                    rest = self.applying(item, around(steps)) & LensSet::below(rank);
                } else {
                    verdict.here = false;
                    verdict.removed_by.insert(rank);
                    // Who else acts is asked only of what is in place, and there are many ways to be moved.
                    if instance.is_moved() {
                        break;
                    }
                }
            }
            if shows {
                shown = true;
            } else if !shown && item.removed_by.contains(rank) {
                verdict.removed_by.insert(rank);
            }
        }
        verdict.here &= steps == instance.steps.len();
        verdict.there = verdict.here && verdict.removed_by.is_empty();
        if item.is_alternate() && !shown {
            (verdict.there, verdict.removed_by) = (false, LensSet::EMPTY);
        }
        verdict.displayed = verdict.there && verdict.ratio == item.ratio;
        verdict
    }

    /// As [`Plan::walk`] at a depth of a ray. Simplified surfaces do not quite meet those that they stand for: a ray may
    /// miss each of two versions where it is seen. So that no gap opens, all of an item fills in where another version is
    /// seen close by, as if it lay [`Instance::spread`] farther from the eye: in front of nothing but what is behind both.
    ///
    /// `around(n, depth)`: as there.
    pub fn verdict(&self, instance: &Instance, depth: f64, mut around: impl FnMut(usize, f64) -> LensSet) -> Verdict {
        let mut verdict = self.walk(instance, |steps| around(steps, depth));
        if verdict.there && !verdict.displayed && !self.items[instance.item].is_simplified() {
            let reach = instance.filling_reach();
            let close_by = [depth - reach, depth + reach];
            verdict.fills = close_by.into_iter().any(|depth| {
                let depth = depth.clamp(self.view.near, self.view.far);
                let other = self.walk(instance, |steps| around(steps, depth));
                other.there && other.ratio != verdict.ratio
            });
            verdict.displayed = verdict.fills;
        }
        verdict
    }

    /// A rule's filters are the whole stack, on the plain scene: what lenses move or show is not there.
    fn rule_verdict(&self, item: &Item, instance: &Instance, rank: usize, set: LensSet) -> Verdict {
        let shown = item.shown_by.contains(rank);
        let gone = !shown && item.removed_by.contains(rank);
        let there = !instance.is_moved() && (shown || (!gone && !item.is_alternate()));
        let simplified_by = item.simplified_by.contains(rank).then_some(rank);
        let ratio = simplified_by.and_then(|rank| self.lod_of(rank)).unwrap_or(1.0);
        Verdict {
            set,
            stack: LensSet::only(rank),
            here: !instance.is_moved(),
            there,
            ratio,
            displayed: there && ratio == item.ratio,
            fills: false,
            removed_by: if gone && !item.is_alternate() { LensSet::only(rank) } else { LensSet::EMPTY },
            simplified_by,
        }
    }

    /// Those of a stack that take an instance away from a point where they act, as [`Verdict::taken_by`] has it; `None`
    /// where that is not to be told: an instance that lenses move is told of where it is seen, not where it might have
    /// been, and what no lens shows is not there.
    #[cfg(feature = "gpu")]
    pub(crate) fn removers(&self, instance: &Instance, stack: LensSet) -> Option<LensSet> {
        let item = &self.items[instance.item];
        let (mut removers, mut shown, mut steps) = (LensSet::EMPTY, false, 0);
        let mut simplified_by = None;
        let mut rest = stack;
        while let Some(rank) = rest.top() {
            rest.remove(rank);
            let is_rule = self.rule_of(rank).is_some();
            if !shown && simplified_by.is_none() && item.simplified_by.contains(rank) {
                simplified_by = Some(rank);
            }
            if !is_rule && !shown && item.movers.contains(rank) {
                if instance.steps.get(steps).is_some_and(|step| step.rank == rank) {
                    steps += 1;
                } else if instance.is_moved() {
                    return None;
                } else {
                    removers.insert(rank);
                }
            }
            if !shown && item.shown_by.contains(rank) {
                shown = true;
            } else if !shown && item.removed_by.contains(rank) {
                removers.insert(rank);
            }
        }
        let ratio = simplified_by.and_then(|rank| self.lod_of(rank)).unwrap_or(1.0);
        let is_seen_otherwise = ratio != item.ratio;
        removers = removers | simplified_by.filter(|_| is_seen_otherwise).map_or(LensSet::EMPTY, LensSet::only);
        let was_there = (shown || !item.is_alternate()) && !(is_seen_otherwise && item.is_simplified());
        let told = steps == instance.steps.len() && was_there && !removers.is_empty();
        told.then_some(removers)
    }

    /// The lenses that may mean something to an item, of those around a point.
    pub(super) fn applying(&self, item: &Item, around: LensSet) -> LensSet {
        ((around & self.by_pixel) | item.object) & (item.scope | item.shown_by)
    }

    /// The last rule that holds where a set of lenses contains the point (SEMANTICS 4).
    pub fn rule_for(&self, set: LensSet) -> Option<usize> {
        self.rules.iter().rposition(|rule| rule.when.holds(set))
    }

    /// Who acts on a surface inside a set of lenses, without regard to content: a rule, or the survivors.
    pub fn stack_of(&self, set: LensSet) -> LensSet {
        match self.rule_for(set) {
            Some(rule) => LensSet::only(self.rule_rank(rule)),
            None => survivors(&self.lenses, set),
        }
    }
}

/// The survivors of a set by itself, without regard to content and rules.
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
