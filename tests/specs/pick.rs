//! Picking and the reports of single pixels, against the maps and against each other.

use lenspeel::cpu;
use lenspeel::frame::{Aovs, NOTHING};
use lenspeel::pick::Pick;

use crate::entry::Entry;
use crate::open::Opened;

/// Specs that take away, show, move, rule, simplify, and shine through.
pub const SPECS: [&str; 13] = [
    "filters/erase",
    "filters/show-alternate",
    "movers/two-magnifiers-hides",
    "movers/displace-nodes",
    "rules/with-magnify",
    "scope/by-object-erase",
    "transparency/panes-two-lenses",
    "filters/wireframe",
    "caps/own",
    "caps/translucent",
    "caps/magnified",
    "caps/hides",
    "lod/erased",
];

/// At every pixel the CPU backend picks what its maps have, and what is picked from the maps is the same.
pub fn on_cpu(entry: &Entry) -> Result<(), String> {
    let (_, opened) = entry.open()?;
    let aovs = entry.reference()?.frame.aovs.as_ref().ok_or("the reference has no AOVs")?;
    let renderer = cpu::Renderer::new(&opened.scene, &opened.plan).expect("a plan of this scene");
    check(&opened, aovs, 1, |[x, y]| Ok(renderer.pick(x, y)))
}

/// Compares picks with maps in every n-th column and row.
fn check(
    opened: &Opened,
    aovs: &Aovs,
    step: usize,
    mut pick: impl FnMut([u32; 2]) -> Result<Option<Pick>, String>,
) -> Result<(), String> {
    let [width, height] = opened.plan.view.size;
    let mut picked = 0;
    for pixel in (0..height).step_by(step).flat_map(|y| (0..width).step_by(step).map(move |x| [x, y])) {
        let at = (pixel[1] * width + pixel[0]) as usize;
        let found = pick(pixel)?;
        let here = |what: &str| format!("pixel {pixel:?}: {what} of {found:?} differs from the maps");
        let node = |pick: &Pick| {
            let item = &opened.plan.items[opened.plan.instances[pick.instance as usize].item];
            item.node as u32 + 1
        };
        let or_nothing = |value: Option<u32>| value.unwrap_or(NOTHING);
        let wrong = [
            ("the node", found.as_ref().map_or(0, node) != aovs.nodes[at]),
            ("the depth", found.map_or(f64::INFINITY, |pick| pick.depth) != aovs.depth[at]),
            ("the region", found.map(|pick| pick.region) != aovs.region(at)),
            ("the instance", or_nothing(found.map(|pick| pick.instance)) != aovs.instances[at]),
            ("the triangle", or_nothing(found.map(|pick| pick.triangle)) != aovs.triangles[at]),
            ("what is picked from the maps", found != Pick::from_aovs(&opened.plan, aovs, pixel)),
        ];
        if let Some((what, _)) = wrong.iter().find(|(_, wrong)| *wrong) {
            return Err(here(what));
        }
        picked += usize::from(found.is_some());
    }
    if picked == 0 { Err("nothing was picked".into()) } else { Ok(()) }
}

#[cfg(feature = "gpu")]
pub use on_device::{on_gpu, reports_agree};

#[cfg(feature = "gpu")]
mod on_device {
    use lenspeel::gpu::Engine;
    use lenspeel::pixel::PixelReport;

    use super::*;
    use crate::gpu;

    /// Every so many columns and rows are looked at: each pixel is a frame of its own.
    const STEP: usize = 9;
    /// Share of the pixels at which an edge may fall to the other side.
    const EDGES: f64 = 0.06;

    /// The GPU backend picks what its maps have.
    pub fn on_gpu(entry: &Entry) -> Result<(), String> {
        let (_, opened) = entry.open()?;
        let frame = gpu::render(&opened, Engine::Fused)?;
        let aovs = frame.aovs.as_ref().ok_or("the picture has no AOVs")?;
        gpu::with_renderer(&opened, |device, renderer| {
            let pick = |pixel| device.pick(renderer, &opened.scene, &opened.plan, pixel).map_err(|e| e.to_string());
            check(&opened, aovs, STEP, pick)
        })
    }

    /// Both backends report the same of a pixel: layers, fragments, what lenses take away.
    pub fn reports_agree(entry: &Entry) -> Result<(), String> {
        let (_, opened) = entry.open()?;
        let renderer = cpu::Renderer::new(&opened.scene, &opened.plan).expect("a plan of this scene");
        let [width, height] = opened.plan.view.size;
        let pixels: Vec<[u32; 2]> =
            (4..height).step_by(STEP).flat_map(|y| (4..width).step_by(STEP).map(move |x| [x, y])).collect();
        let mut wrong = Vec::new();
        let mut told = 0;
        gpu::with_renderer(&opened, |device, on_device| {
            for pixel in &pixels {
                let want = renderer.explain(pixel[0], pixel[1]);
                let got = device.explain(on_device, &opened.scene, &opened.plan, *pixel).map_err(|e| e.to_string())?;
                told += want.fragments.len() + want.removed.len();
                if !same(&want, &got) {
                    wrong.push(format!("pixel {pixel:?}: {want:?} is wanted, {got:?} is there"));
                }
            }
            Ok(())
        })?;
        if told == 0 {
            return Err("no fragment was met".into());
        }
        if wrong.len() as f64 <= EDGES * pixels.len() as f64 {
            return Ok(());
        }
        Err(format!("{} of {} pixels differ; {}", wrong.len(), pixels.len(), wrong[0]))
    }

    fn same(a: &PixelReport, b: &PixelReport) -> bool {
        let near = |a: f64, b: f64| (a - b).abs() <= 1e-4 * a.abs().max(1.0);
        let layers = || a.layers.iter().zip(&b.layers).all(|(a, b)| a.set == b.set && near(a.depth, b.depth));
        let fragments = || {
            a.fragments.iter().zip(&b.fragments).all(|(a, b)| {
                let (f, g) = (&a.fragment, &b.fragment);
                (f.instance, f.triangle, f.region) == (g.instance, g.triangle, g.region)
                    && near(f.depth.into(), g.depth.into())
                    && (f.weights - g.weights).abs().max_element() < 1e-2
                    && (a.opacity - b.opacity).abs() < 0.02
                    && (a.coverage - b.coverage).abs() < 0.05
            })
        };
        let removed = || {
            a.removed.iter().zip(&b.removed).all(|(a, b)| {
                let (f, g) = (&a.fragment, &b.fragment);
                (f.instance, f.region, a.by) == (g.instance, g.region, b.by) && near(f.depth.into(), g.depth.into())
            })
        };
        let visible = |report: &PixelReport| report.visible.map(|v| (v.fragment.instance, v.fragment.region));
        let counts = |report: &PixelReport| [report.layers.len(), report.fragments.len(), report.removed.len()];
        counts(a) == counts(b) && visible(a) == visible(b) && layers() && fragments() && removed()
    }
}
