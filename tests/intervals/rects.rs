//! The pixels of a volume hold every pixel whose ray has an interval.

use crate::agreement::stage;
use crate::camera::Stand;
use crate::random::Random;
use crate::solid::KINDS;

const PLACEMENTS: usize = 20;

#[test]
fn every_pixel_with_an_interval_is_in_the_rectangle() {
    let mut random = Random::new(300);
    let (mut tight, mut all) = (0, 0);
    for kind in KINDS {
        for stand in Stand::ALL {
            for _ in 0..PLACEMENTS {
                let Some((solid, view)) = stage(kind, stand, &mut random) else { continue };
                let rect = solid.volume.pixel_rect(&view);
                for y in 0..view.size[1] {
                    for x in 0..view.size[0] {
                        let at = |p: u32, random: &mut Random| f64::from(p) + random.between(0.0, 1.0);
                        let (px, py) = (at(x, &mut random), at(y, &mut random));
                        let seen = solid.interval(&view.ray(px, py), view.near, view.far).is_some();
                        let held = (rect.min[0]..rect.max[0]).contains(&x) && (rect.min[1]..rect.max[1]).contains(&y);
                        assert!(!seen || held, "{kind} {stand:?}: {px},{py} is not in {rect:?}: {view:?}");
                    }
                }
                all += 1;
                tight += usize::from(rect.area() < u64::from(view.size[0] * view.size[1]));
            }
        }
    }
    assert!(tight * 4 > all, "only {tight} of {all} rectangles are smaller than the picture");
}
