//! The colour of a cap.

use glam::Vec3;

use super::{Corners, Hit, Shaded, Shader, steps_at_source, untextured};
use crate::appearance as wgsl;
use crate::cpu::convert::{a4, g2, g3, g4, v3, v4};
use crate::cpu::texture;
use crate::pixel::Fragment;
use crate::plan::{Item, LensSet, Region};
use crate::scene::NO_TEXTURE;
use crate::spec::Cap;

impl Shader<'_> {
    /// Runs the stack on a cap, without the lens that makes it.
    pub(super) fn shade_cap(&self, fragment: &Fragment, maker: usize, ray: &wgsl::PixelRay, passed: LensSet) -> Shaded {
        let instance = &self.plan.instances[fragment.instance as usize];
        let item = &self.plan.items[instance.item];
        let normal = fragment.weights;
        let position = g3(ray.origin) + g3(ray.direction) * fragment.depth;
        let look = item.cap(maker).map_or(Cap::Own, |cap| cap.look);
        let own = match look {
            Cap::Own => self.own_surface(fragment.instance, position, normal, ray),
            _ => untextured(&self.scene.materials[item.material], position, normal, ray),
        };
        let cap = record(look, item);
        // Its lines lie where it is cut.
        let source = instance.source_from_shown(maker, false);
        let space = &self.plan.texture_space;
        let mapped = source.transform_point3(position.as_dvec3() + self.origin) - space.origin;
        let direction = g3(wgsl::cap_direction(v3(normal), cap.variant));
        let along = direction.dot(mapped.as_vec3() * space.scale);
        let steps = steps_at_source(&source, wgsl::steps_at(*ray, v3(position), v3(normal)));
        let span = wgsl::cap_span(steps, v3(direction)) * space.scale;
        let mut stack = fragment.region.stack;
        stack.remove(maker);
        let corners = self.piece(fragment, ray, normal);
        let weights = Vec3::X;
        let hit = Hit { instance, corners: &corners, weights, position, normal, ray };
        self.staged(wgsl::cap_surface(cap, own, along, span), &hit, stack, passed)
    }

    /// The surface that a solid has where it is cut: that of its nearest point, with the cap's normal.
    fn own_surface(&self, instance: u32, position: Vec3, normal: Vec3, ray: &wgsl::PixelRay) -> wgsl::Surface {
        let plain = |instance: u32| {
            let item = &self.plan.items[self.plan.instances[instance as usize].item];
            (item, untextured(&self.scene.materials[item.material], position, normal, ray))
        };
        let place = self.plan.instances[instance as usize].place_of(position.as_dvec3() + self.origin);
        let nearest = || {
            let body = self.bodies[instance as usize]? as usize;
            let (face, weights) = self.own[body].as_ref()?.nearest(place)?;
            Some((self.plan.bodies[body].members[face.member as usize].instance as u32, face.triangle, weights))
        };
        let Some((instance, triangle, weights)) = nearest() else { return plain(instance).1 };
        let (item, mut own) = plain(instance);
        let on_surface = Fragment { instance, triangle, depth: 0.0, weights, region: Region::PLAIN };
        let corners = self.corners(item, &on_surface);
        if let Some(colors) = &corners.primitive.colors {
            own.factor = v4(g4(own.factor) * corners.interpolated(colors, weights));
        }
        let slot = &self.scene.materials[item.material].base_color_texture;
        if slot.texture != NO_TEXTURE {
            let [ua, ub, uc] = self.slot_uv(slot, &corners);
            let size = texture::size(&self.scene.textures, slot.texture);
            // As many texels as there are on the surface over the length that a pixel spans on the cap.
            let texels = ((ub - ua) * size).perp_dot((uc - ua) * size).abs();
            let [a, b, c] = corners.around;
            let area = (b - a).as_dvec3().cross((c - a).as_dvec3()).length().max(f64::from(f32::MIN_POSITIVE)) as f32;
            let span = g2(wgsl::position_footprint(*ray, v3(position), v3(normal))).max_element();
            let at = ua * weights.x + ub * weights.y + uc * weights.z;
            own.texel = v4(texture::sample(&self.scene.textures, slot.texture, at, span * (texels / area).sqrt()));
        }
        own
    }

    /// A triangle in a cap's plane, its first corner where a ray meets it.
    fn piece(&self, fragment: &Fragment, ray: &wgsl::PixelRay, normal: Vec3) -> Corners<'_> {
        let position = g3(ray.origin) + g3(ray.direction) * fragment.depth;
        let size = wgsl::cap_piece(*ray, fragment.depth);
        let corner = |number| g3(wgsl::cap_corner(number, v3(position), v3(normal), size));
        let number = fragment.instance as usize;
        let primitive = self.plan.items[self.plan.instances[number].item].primitive_of(self.scene);
        let (around, to_origin) = ([0, 1, 2].map(corner), &self.transforms[number].point);
        Corners { primitive, indices: [0; 3], around, to_origin, triangle: None }
    }
}

fn record(cap: Cap, item: &Item) -> wgsl::Cap {
    let (kind, color) = cap.look();
    wgsl::Cap { kind, variant: item.node as u32, color: a4(color) }
}
