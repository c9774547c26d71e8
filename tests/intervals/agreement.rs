//! The closed form against half-spaces, rays and raster depth, wherever the lens lies to the eye and the planes.

use lenspeel::lens::Interval;
use lenspeel::view::View;

use crate::camera::{Stand, camera, eye, set_planes};
use crate::random::Random;
use crate::routes::{Bounds, Raster, by_halfspaces, by_mesh};
use crate::solid::{KINDS, Solid, placement};

/// Placements of each shape for each way it may stand.
const PLACEMENTS: usize = 12;
const RAYS: usize = 12;
const SIZE: [u32; 2] = [22, 18];

/// A solid before a camera. Drawn again where the random numbers leave no such stand.
pub fn stage(kind: &str, stand: Stand, random: &mut Random) -> Option<(Solid, View)> {
    (0..20).find_map(|_| {
        let seed = random.index(1 << 30) as u64;
        let mut view = camera(random, SIZE);
        let placed = placement(random, &view);
        // What is attached to the camera moves with the eye, so the eye is chosen for the solid as it stands; a flat
        // lens is then made anew, for that eye.
        let solid = Solid::new(kind, &mut Random::new(seed), &placed, &view)?;
        view.eye = eye(stand, random, &view, &solid);
        let solid = Solid::new(kind, &mut Random::new(seed), &placed, &view)?;
        set_planes(stand, random, &mut view, &solid)?;
        Some((solid, view))
    })
}

fn bounds(solid: &Solid, view: &View, ray: &lenspeel::view::Ray) -> Bounds {
    let scale = solid.size + ray.origin.length();
    Bounds { outer: by_halfspaces(solid, ray), inner: None, near: view.near, far: view.far, scale }
}

#[derive(Default)]
struct Tally {
    hits: usize,
    misses: usize,
}

impl Tally {
    fn count(&mut self, interval: Option<Interval>) {
        if interval.is_some() { self.hits += 1 } else { self.misses += 1 }
    }
}

/// Rays through the solid and past it, against half-spaces and the mesh.
fn along_rays(solid: &Solid, view: &View, random: &mut Random, tally: &mut Tally) -> Result<(), String> {
    for number in 0..RAYS {
        let (w, h) = (f64::from(view.size[0]), f64::from(view.size[1]));
        let aimed = view.project(solid.inner(random)).filter(|_| number % 3 > 0);
        let pixel = aimed.unwrap_or_else(|| glam::DVec2::new(random.between(0.0, w), random.between(0.0, h)));
        let ray = view.ray(pixel.x, pixel.y);
        let closed = solid.interval(&ray, view.near, view.far);
        let with_mesh = Bounds { inner: by_mesh(solid, &ray), ..bounds(solid, view, &ray) };
        with_mesh.check(closed).map_err(|e| format!("ray {pixel}: {e}"))?;
        membership(solid, &ray, view).map_err(|e| format!("ray {pixel}: {e}"))?;
        tally.count(closed);
    }
    Ok(())
}

/// A point of a ray is in the volume if and only if its depth is in the span.
fn membership(solid: &Solid, ray: &lenspeel::view::Ray, view: &View) -> Result<(), String> {
    let (near, far) = (view.near, view.far);
    let interval = solid.interval(ray, near, far);
    for step in 0..16 {
        let depth = near + (far - near) * (f64::from(step) + 0.5) / 16.0;
        let margin = 1e-6 * (solid.size + depth.abs());
        let (inside, outside) = match interval {
            Some(i) => (
                depth > i.entry + margin && depth < i.exit - margin,
                depth < i.entry - margin || depth > i.exit + margin,
            ),
            // A ray that only grazes touches the volume.
            None => (false, by_halfspaces(solid, ray).is_none()),
        };
        let contained = solid.volume.contains(ray.at(depth));
        if (inside && !contained) || (outside && contained) {
            return Err(format!("depth {depth} of {interval:?}: contains says {contained}"));
        }
    }
    Ok(())
}

/// Every pixel centre against the depth buffer.
fn over_pixels(solid: &Solid, view: &View, tally: &mut Tally) -> Result<(), String> {
    let raster = Raster::draw(solid, view);
    for y in 0..view.size[1] {
        for x in 0..view.size[0] {
            let ray = view.ray(f64::from(x) + 0.5, f64::from(y) + 0.5);
            let closed = solid.interval(&ray, view.near, view.far);
            let drawn = Bounds { inner: raster.bracket(x, y), ..bounds(solid, view, &ray) };
            drawn.check(closed).map_err(|e| format!("pixel {x},{y}: {e}"))?;
            tally.count(closed);
        }
    }
    Ok(())
}

fn agree(kind: &str) {
    let mut random = Random::new(100 + KINDS.iter().position(|k| *k == kind).expect("a kind") as u64);
    for stand in Stand::ALL {
        let mut tally = Tally::default();
        let mut staged = 0;
        for number in 0..PLACEMENTS {
            let Some((solid, view)) = stage(kind, stand, &mut random) else { continue };
            staged += 1;
            let place = || format!("{kind} {stand:?} {number}, {view:?}, {:?}", solid.volume);
            along_rays(&solid, &view, &mut random, &mut tally).unwrap_or_else(|e| panic!("{e}: {}", place()));
            over_pixels(&solid, &view, &mut tally).unwrap_or_else(|e| panic!("{e}: {}", place()));
            let nowhere = stand.is_nowhere(&view);
            assert!(!nowhere || tally.hits == 0, "{} rays have an interval: {}", tally.hits, place());
            if stand == Stand::Behind {
                tally.hits = 0;
            }
        }
        // A flat lens has no end that a near plane could be beyond.
        let possible = kind != "flat" || stand != Stand::BeforeNear;
        assert!(!possible || staged > PLACEMENTS / 2, "{kind}: only {staged} placements were {stand:?}");
        let seen = matches!(stand, Stand::Between | Stand::AcrossNear | Stand::AcrossFar | Stand::AcrossBoth);
        assert!(!seen || (tally.hits > 50 && tally.misses > 50), "{kind} {stand:?}: {} hits", tally.hits);
    }
}

macro_rules! shapes {
    ($($kind:ident)*) => { $(
        #[test]
        fn $kind() {
            agree(stringify!($kind));
        }
    )* };
}

shapes! { sphere ellipsoid cuboid cylinder cone apex capsule ball polytope hull flat }

/// Inside means that every ray starts at the near plane.
#[test]
fn around_the_eye_every_ray_enters_at_near() {
    let mut random = Random::new(50);
    for kind in KINDS.iter().filter(|kind| **kind != "flat") {
        for _ in 0..PLACEMENTS {
            let Some((solid, view)) = stage(kind, Stand::Inside, &mut random) else { panic!("{kind} has an inside") };
            for pixel in 0..SIZE[0] {
                let ray = view.ray(f64::from(pixel) + 0.5, 3.5);
                let entry = solid.interval(&ray, view.near, view.far).map(|i| i.entry);
                // An orthographic ray does not start at the eye.
                assert!(entry == Some(view.near) || !view.is_perspective(), "{kind}: {entry:?}, near {}", view.near);
            }
        }
    }
}

/// Negative controls: what is wrong with one boundary is noticed.
#[test]
fn a_shifted_or_swapped_interval_is_noticed() {
    let mut random = Random::new(60);
    let (mut asked, mut shifts) = (0, 0);
    for kind in KINDS {
        for _ in 0..PLACEMENTS {
            let Some((solid, view)) = stage(kind, Stand::Between, &mut random) else { continue };
            let Some(pixel) = view.project(solid.middle) else { continue };
            let ray = view.ray(pixel.x, pixel.y);
            let Some(Interval { entry, exit }) = solid.interval(&ray, view.near, view.far) else { continue };
            let bounds = Bounds { inner: by_mesh(&solid, &ray), ..bounds(&solid, &view, &ray) };
            assert!(bounds.check(Some(Interval { entry, exit })).is_ok());
            assert!(bounds.check(Some(Interval { entry: exit, exit: entry })).is_err(), "{kind}: swapped");
            assert!(bounds.check(None).is_err(), "{kind}: left out");
            let shift = 0.01 * (exit - entry);
            for (entry, exit) in
                [(entry + shift, exit), (entry - shift, exit), (entry, exit + shift), (entry, exit - shift)]
            {
                asked += 1;
                shifts += usize::from(bounds.check(Some(Interval { entry, exit })).is_err());
            }
        }
    }
    assert!(asked > 300, "only {asked} shifts");
    // A mesh is a little inside of what it stands for, and a shift within that cannot be told.
    assert!(shifts * 100 >= asked * 90, "{shifts} of {asked} shifts were noticed");
}
