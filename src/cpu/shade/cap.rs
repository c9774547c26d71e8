//! The colour of a cap.

use glam::Vec3;

use super::{Corners, Hit, Shaded, Shader, untextured};
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
        let mapped = source.transform_point3(position.as_dvec3() + self.origin) - space.origin;
        let direction = g3(wgsl::cap_direction(v3(normal), cap.variant));
        let along = direction.dot(mapped.as_vec3() * space.scale);
        let reach = source.matrix3.x_axis.length() as f32 * space.scale;
        let span = wgsl::cap_span(*ray, v3(position), v3(normal), v3(direction)) * reach;
        let mut stack = fragment.region.stack;
        stack.remove(maker);
        let corners = self.piece(item, ray, fragment.depth, normal);
        let weights = Vec3::X;
        let hit = Hit { instance, corners: &corners, weights, position, normal, ray };
        self.staged(wgsl::cap_surface(cap, own, along, span), &hit, stack, passed)
    }

    /// A triangle in a cap's plane, its first corner where a ray meets it.
    fn piece(&self, item: &Item, ray: &wgsl::PixelRay, depth: f32, normal: Vec3) -> Corners<'_> {
        let position = g3(ray.origin) + g3(ray.direction) * depth;
        let size = wgsl::cap_piece(*ray, depth);
        let corner = |number| g3(wgsl::cap_corner(number, v3(position), v3(normal), size));
        let primitive = &self.scene.models[item.model].meshes[item.mesh].primitives[item.primitive];
        Corners { primitive, indices: [0; 3], around: [0, 1, 2].map(corner), is_of_cap: true }
    }
}

fn record(cap: Cap, item: &Item) -> wgsl::Cap {
    let (kind, color) = cap.look();
    wgsl::Cap { kind, variant: item.node as u32, color: a4(color) }
}
