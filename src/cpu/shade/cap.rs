//! The colour of a cap.

use glam::Vec3;

use super::{Corners, Hit, Shaded, Shader, steps_at_source, untextured};
use crate::appearance as wgsl;
use crate::cpu::convert::{a4, g3, v3};
use crate::pixel::Fragment;
use crate::plan::{Item, LensSet};
use crate::spec::Cap;

impl Shader<'_> {
    /// Runs the stack on a cap, without the lens that makes it.
    pub(super) fn shade_cap(&self, fragment: &Fragment, maker: usize, ray: &wgsl::PixelRay, passed: LensSet) -> Shaded {
        let instance = &self.plan.instances[fragment.instance as usize];
        let item = &self.plan.items[instance.item];
        let normal = fragment.weights;
        let position = g3(ray.origin) + g3(ray.direction) * fragment.depth;
        let own = untextured(&self.scene.materials[item.material], position, normal, ray);
        let cap = record(item.cap(maker).unwrap_or(Cap::Own), item);
        // Its lines lie where it is cut.
        let source = instance.source_from_shown(maker, false);
        let space = &self.plan.texture_space;
        let mapped = source.transform_point3(position.as_dvec3() + self.plan.view.eye) - space.origin.as_dvec3();
        let direction = g3(wgsl::cap_direction(v3(normal), cap.variant));
        let along = direction.dot(mapped.as_vec3() * space.scale);
        let steps = steps_at_source(&source, wgsl::steps_at(*ray, v3(position), v3(normal)));
        let span = wgsl::cap_span(steps, v3(direction)) * space.scale;
        let mut stack = fragment.region.stack;
        stack.remove(maker);
        let corners = self.piece(fragment, position, normal);
        let weights = Vec3::X;
        let hit = Hit { instance, corners: &corners, weights, position, normal, ray };
        self.staged(wgsl::cap_surface(cap, own, along, span), &hit, stack, passed)
    }

    /// A triangle in a cap's plane, its first corner where a ray meets it.
    fn piece(&self, fragment: &Fragment, position: Vec3, normal: Vec3) -> Corners<'_> {
        let size = wgsl::CAP_PIECE.0 * position.length();
        let corner = |number| g3(wgsl::cap_corner(number, v3(position), v3(normal), size));
        let number = fragment.instance as usize;
        let primitive = self.plan.items[self.plan.instances[number].item].primitive_of(self.scene);
        let (around, to_eye) = ([0, 1, 2].map(corner), &self.transforms[number].point);
        Corners { primitive, indices: [0; 3], around, to_eye, triangle: None }
    }
}

fn record(cap: Cap, item: &Item) -> wgsl::Cap {
    let (kind, color) = cap.look();
    wgsl::Cap { kind, variant: item.node as u32, color: a4(color) }
}
