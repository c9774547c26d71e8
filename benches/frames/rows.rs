//! The rows of the table: which frames are held against which, and the bars.

use lenspeel::bench::{Bar, Case};

pub const MINIMAL: &str = "a minimal program";
pub const NONE: &str = "no lens";
pub const SPHERE: &str = "1 sphere";
pub const DRAGGED: &str = "1 sphere, dragged";
pub const OFF_SCREEN: &str = "1 sphere off screen";
pub const BOX: &str = "1 box";
pub const X_RAY: &str = "1 sphere, x-ray";
pub const FINE_MESH: &str = "1 mesh of 81,920 faces";
pub const COARSE_MESH: &str = "1 mesh of 20 faces";
pub const SPHERES: &str = "8 spheres";
pub const HULLS: &str = "8 hulls of 200 faces";
pub const BOXES: &str = "8 boxes";
pub const GROUPS: &str = "32 spheres in groups";
pub const SMALL: &str = "256 small spheres";
pub const HEAP: &str = "8 spheres that all overlap";
pub const APART: &str = "8 spheres apart";
pub const PEEL: &str = "`peel`, 8 spheres";
pub const MASK_1: &str = "mask patch, 1 sphere";
pub const MASK_8: &str = "mask patch, 8 spheres";
pub const ANALYTIC_SPHERES: &str = "single-pass analytic, 8 spheres";
pub const ANALYTIC_HULLS: &str = "single-pass analytic, 8 hulls of 200 faces";
pub const THREE_PASS: &str = "three passes (2004), 1 sphere";
pub const CLIP_PLANES: &str = "clipping planes (1996), 1 box";

pub fn rows() -> Vec<Case> {
    let (most, least) = (|ratio| Some(Bar::AtMost(ratio)), |ratio| Some(Bar::AtLeast(ratio)));
    [
        (NONE, MINIMAL, most(1.10)),
        (SPHERE, NONE, most(1.08)),
        (SPHERES, NONE, most(1.20)),
        (HULLS, NONE, most(1.25)),
        (BOXES, NONE, most(1.25)),
        (GROUPS, NONE, most(1.40)),
        (SMALL, NONE, most(1.60)),
        (HEAP, APART, most(1.10)),
        (DRAGGED, SPHERE, most(1.05)),
        (OFF_SCREEN, NONE, most(1.01)),
        (FINE_MESH, COARSE_MESH, most(1.10)),
        (X_RAY, NONE, most(1.35)),
        (PEEL, SPHERES, least(12.0)),
        (HULLS, ANALYTIC_HULLS, most(1.0)),
        (SPHERES, ANALYTIC_SPHERES, most(1.0)),
        (SPHERE, MASK_1, most(1.0)),
        (SPHERES, MASK_8, most(1.0)),
        // What other ways cost of the minimal program, which they are built on.
        (MASK_1, MINIMAL, None),
        (MASK_8, MINIMAL, None),
        (ANALYTIC_SPHERES, MINIMAL, None),
        (ANALYTIC_HULLS, MINIMAL, None),
        (THREE_PASS, MINIMAL, None),
        (CLIP_PLANES, MINIMAL, None),
        (BOX, NONE, None),
    ]
    .map(|(of, to, bar)| Case { name: format!("{of} / {to}"), of: of.into(), to: to.into(), bar })
    .into()
}
