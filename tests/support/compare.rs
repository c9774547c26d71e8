//! Two pictures of one spec, compared pixel by pixel as section 7 of SEMANTICS demands.
//!
//! What counts is every single pixel, never a mean. A pixel within one pixel of an edge of the reference may differ
//! (and is counted), any other may not.

use std::fmt;

use lenspeel::frame::{Aovs, Frame};
use lenspeel::plan::LensSet;

use crate::edges::Mask;

/// The share of all pixels that may differ, all of them near edges (SEMANTICS 7).
const SHARE: f64 = 0.002;
/// Steps of 255 by which a colour may differ away from edges (SEMANTICS 7).
const COLOR_STEPS: u8 = 2;
/// Relative; depths below 1 are compared absolutely.
const DEPTH: f64 = 1e-4;

/// For one property: which pixels are near an edge, and which do not count at all.
#[derive(Debug, Clone)]
pub struct Rules {
    pub near_edge: Mask,
    pub exempt: Mask,
}

/// A reference picture and how each of its properties is to be compared.
#[derive(Debug, Clone)]
pub struct Reference {
    pub frame: Frame,
    pub region: Rules,
    pub stack: Rules,
    pub node: Rules,
    pub layers: Rules,
    pub depth: Rules,
    pub color: Rules,
}

/// What came out for one property.
#[derive(Debug)]
pub struct Tally {
    property: &'static str,
    pixels: usize,
    /// Pixels that are neither near an edge nor exempt.
    interior: usize,
    differ_inside: usize,
    /// Near edges, too.
    differ: usize,
    /// The first interior pixel that differs, else the first that does, with both values.
    first: Option<String>,
}

impl Tally {
    fn passes(&self) -> bool {
        self.differ_inside == 0 && self.differ as f64 <= SHARE * self.pixels as f64
    }
}

impl fmt::Display for Tally {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { property, pixels, interior, differ_inside, differ, first } = self;
        let verdict = if self.passes() { "agrees" } else { "DIFFERS" };
        write!(f, "{property} {verdict}: {differ_inside} of {interior} interior pixels and {differ} of all {pixels}")?;
        first.iter().try_for_each(|first| write!(f, "; {first}"))
    }
}

/// The outcome for all properties.
#[derive(Debug)]
pub struct Outcome(pub Vec<Tally>);

impl Outcome {
    /// All lines of it, as an error where one property fails.
    pub fn verdict(&self) -> Result<(), String> {
        if self.0.iter().all(Tally::passes) { Ok(()) } else { Err(self.to_string()) }
    }
}

impl fmt::Display for Outcome {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.iter().try_for_each(|tally| writeln!(f, "{tally}"))
    }
}

/// Compares a picture with a reference; an error where they cannot be compared at all.
pub fn compare(reference: &Reference, actual: &Frame) -> Result<Outcome, String> {
    if reference.frame.size != actual.size {
        return Err(format!("sizes differ: {:?} is wanted, {:?} is there", reference.frame.size, actual.size));
    }
    let (want, got) = (maps(&reference.frame)?, maps(actual)?);
    let width = actual.size[0] as usize;
    let (colors, there) = (&reference.frame.pixels, &actual.pixels);
    Ok(Outcome(vec![
        tally("region", width, &reference.region, &sets(want), &sets(got), PartialEq::eq),
        tally("stack", width, &reference.stack, &stacks(want), &stacks(got), PartialEq::eq),
        tally("node", width, &reference.node, &want.nodes, &got.nodes, PartialEq::eq),
        tally("layers", width, &reference.layers, &want.layers, &got.layers, PartialEq::eq),
        tally("depth", width, &reference.depth, &want.depth, &got.depth, same_depth),
        tally("colour", width, &reference.color, colors, there, same_color),
    ]))
}

fn maps(frame: &Frame) -> Result<&Aovs, String> {
    frame.aovs.as_ref().ok_or_else(|| "a picture without AOVs cannot be compared".into())
}

fn sets(aovs: &Aovs) -> Vec<Option<LensSet>> {
    (0..aovs.regions.len()).map(|at| aovs.region(at).map(|region| region.set)).collect()
}

fn stacks(aovs: &Aovs) -> Vec<Option<LensSet>> {
    (0..aovs.regions.len()).map(|at| aovs.region(at).map(|region| region.stack)).collect()
}

fn same_depth(want: &f64, got: &f64) -> bool {
    if want.is_finite() && got.is_finite() {
        (want - got).abs() <= DEPTH * want.abs().max(1.0)
    } else {
        want.is_finite() == got.is_finite()
    }
}

fn same_color(want: &[u8; 4], got: &[u8; 4]) -> bool {
    want.iter().zip(got).all(|(a, b)| a.abs_diff(*b) <= COLOR_STEPS)
}

fn tally<T: fmt::Debug>(
    property: &'static str,
    width: usize,
    rules: &Rules,
    want: &[T],
    got: &[T],
    same: impl Fn(&T, &T) -> bool,
) -> Tally {
    assert_eq!(want.len(), got.len(), "a {property} map has as many entries as its picture has pixels");
    let counts = |at: &usize| !rules.exempt[*at];
    let inside = |at: &usize| !rules.near_edge[*at];
    let differing: Vec<usize> = (0..want.len()).filter(counts).filter(|at| !same(&want[*at], &got[*at])).collect();
    let shown = differing.iter().copied().find(inside).or(differing.first().copied());
    Tally {
        property,
        pixels: want.len(),
        interior: (0..want.len()).filter(counts).filter(inside).count(),
        differ_inside: differing.iter().copied().filter(inside).count(),
        differ: differing.len(),
        first: shown.map(|at| {
            let (x, y) = (at % width, at / width);
            format!("at {x},{y} {:?} is wanted, {:?} is there", want[at], got[at])
        }),
    }
}
