//! From a hit to a colour: attributes, textures, the stack's filters, light.

mod cap;

use std::sync::atomic::AtomicU64;

use glam::{DAffine3, DVec3, Vec2, Vec3, Vec4};

use super::convert::{a4, d3, g2, g3, g4, light, v2, v3, v4};
use super::custom::Site;
use super::texture;
use crate::appearance as wgsl;
use crate::pixel::{Fragment, cap_maker};
use crate::plan::{Instance, Item, LensSet, Op, OwnSurface, Plan};
use crate::scene::{EdgeKind, MaterialRecord, NO_TEXTURE, Primitive, Scene, TextureSlot, scene_factor};
use crate::spec::By;

/// The records of a plan in the form that the translated shaders take.
pub struct Shader<'a> {
    scene: &'a Scene,
    plan: &'a Plan,
    ops: Vec<wgsl::Op>,
    lights: Vec<wgsl::Light>,
    up: Vec3,
    /// Of each instance.
    transforms: Vec<Transform>,
    /// Of each item, for each of the plan's channels, where it has one.
    values: Vec<Vec<Option<VertexValues<'a>>>>,
    forward: DVec3,
    /// Of the view: positions are relative to it, along the world's axes.
    origin: DVec3,
    /// Loop iterations that the user's own filters have taken for the picture.
    pub spent: AtomicU64,
    /// Of each body, where caps show its own colours.
    own: Vec<Option<OwnSurface>>,
    /// Of each instance, its body.
    bodies: Vec<Option<u32>>,
}

/// From local space to the world's axes around the view's origin as shown: for points, and for normals.
struct Transform {
    point: DAffine3,
    normal: glam::Mat3,
    /// -1 where it mirrors, else 1: a mirror turns the bitangent of a tangent and a normal round.
    side: f32,
}

/// A fragment's colour (linear, straight), opacity, coverage, and its shading normal.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Shaded {
    pub color: Vec3,
    pub opacity: f32,
    pub coverage: f32,
    pub normal: Vec3,
}

/// Numbers at the vertices of an item's primitive, and what they are multiplied by.
type VertexValues<'a> = (&'a [f32], f32);

/// Where a ray meets a triangle.
struct Hit<'h, 'a> {
    instance: &'h Instance,
    corners: &'h Corners<'a>,
    weights: Vec3,
    /// Around the view's origin.
    position: Vec3,
    /// For shading.
    normal: Vec3,
    ray: &'h wgsl::PixelRay,
}

/// A triangle of an item with its corners around the view's origin, along the world's axes.
struct Corners<'a> {
    primitive: &'a Primitive,
    indices: [usize; 3],
    around: [Vec3; 3],
    /// From local space to around the view's origin.
    to_origin: &'a DAffine3,
    /// Into the item's triangles; `None`: a piece of a cap, at whose corners the primitive has no vertices.
    triangle: Option<usize>,
}

/// Pixels to the edges and corners of what has none.
const NOWHERE_NEAR: f32 = 1e30;

impl Hit<'_, '_> {
    /// Of the numbers that values at corners come from: for positions those of the corners, and of where the item stands.
    fn size_of_values(&self, quantity: u32, values: Vec3) -> f32 {
        let largest = |v: Vec3| v.abs().max_element();
        if quantity == wgsl::QUANTITY_VERTEX.0 {
            return largest(values);
        }
        let origin = self.corners.triangle.map_or(Vec3::ZERO, |_| self.corners.to_origin.translation.as_vec3());
        self.corners.around.map(largest).into_iter().fold(0.0, f32::max) + largest(origin)
    }
}

impl Corners<'_> {
    fn interpolated<T>(&self, values: &[T], weights: Vec3) -> T
    where
        T: Copy + std::ops::Mul<f32, Output = T> + std::ops::Add<Output = T>,
    {
        let [a, b, c] = self.indices.map(|i| values[i]);
        a * weights.x + b * weights.y + c * weights.z
    }

    /// Of the triangle, unit length; zero for one without area.
    fn normal(&self) -> Vec3 {
        let [a, b, c] = self.around.map(v3);
        g3(wgsl::flat_normal(a, b, c))
    }

    /// Texture coordinates of the corners in one set; zero where the primitive has none.
    fn uv(&self, set: u32) -> [Vec2; 3] {
        match &self.primitive.uv[set.min(1) as usize] {
            Some(uv) => self.indices.map(|i| uv[i]),
            None => [Vec2::ZERO; 3],
        }
    }
}

/// A surface that a material has where it has no texture.
fn untextured(material: &MaterialRecord, position: Vec3, normal: Vec3, ray: &wgsl::PixelRay) -> wgsl::Surface {
    wgsl::Surface {
        position: v3(position),
        normal: v3(normal),
        view: v3(-g3(ray.direction).normalize()),
        factor: a4(material.base_color),
        texel: v4(Vec4::ONE),
        metallic: material.metallic,
        roughness: material.roughness,
        emissive: v3(Vec3::from_array(material.emissive)),
        occlusion: 1.0,
        alpha_mode: material.alpha_mode,
        alpha_cutoff: material.alpha_cutoff,
        opacity: 1.0,
        unlit: material.unlit as f32,
        pixel: ray.pixel,
        toon: v2(Vec2::ZERO),
        hatch: v4(Vec4::ZERO),
        hatch_lines: v2(Vec2::ONE),
    }
}

impl<'a> Shader<'a> {
    pub fn new(scene: &'a Scene, plan: &'a Plan) -> Self {
        let origin = plan.view.origin();
        let transforms = plan
            .instances
            .iter()
            .map(|instance| {
                let item = &plan.items[instance.item];
                let mut around = instance.shown_from_world * scene.models[item.model].nodes[item.node].world_from_local;
                around.translation -= origin;
                let side = if around.matrix3.determinant() < 0.0 { -1.0 } else { 1.0 };
                let normal = around.matrix3.inverse().transpose();
                let largest = normal.to_cols_array().into_iter().map(f64::abs).fold(f64::MIN_POSITIVE, f64::max);
                let normal = (normal * largest.recip()).as_mat3();
                Transform { point: around, normal, side }
            })
            .collect();
        let values = |item: &Item| {
            let model = &scene.models[item.model];
            let primitive = &model.meshes[item.mesh].primitives[item.primitive];
            let of = |name: &String| {
                let factor = scene_factor(name, &model.nodes[item.node].world_from_local);
                primitive.values.get(name).map(|values| (values.as_slice(), factor))
            };
            plan.channels.iter().map(of).collect()
        };
        let mut bodies = vec![None; plan.instances.len()];
        for (number, body) in (0u32..).zip(&plan.bodies) {
            body.members.iter().for_each(|member| bodies[member.instance] = Some(number));
        }
        Self {
            spent: AtomicU64::new(0),
            own: plan.bodies.iter().map(|body| OwnSurface::new(scene, plan, body)).collect(),
            bodies,
            values: plan.items.iter().map(values).collect(),
            forward: plan.view.forward,
            origin,
            scene,
            plan,
            ops: plan.ops.iter().map(Op::shader).collect(),
            lights: plan.lighting.lights.iter().map(light).collect(),
            up: plan.lighting.up,
            transforms,
        }
    }

    /// Runs the stack on a fragment that a pixel's ray has met. `passed`: the lenses and rules that act on nearer ones.
    pub fn shade(&self, fragment: &Fragment, ray: &wgsl::PixelRay, passed: LensSet) -> Shaded {
        if let Some(maker) = cap_maker(fragment.triangle) {
            return self.shade_cap(fragment, maker, ray, passed);
        }
        let instance = &self.plan.instances[fragment.instance as usize];
        let item = &self.plan.items[instance.item];
        let corners = self.corners(item, fragment);
        let geometric = corners.normal();
        let view = -g3(ray.direction).normalize();
        let surface = self.surface(item, fragment, &corners, geometric, view, ray);
        let (normal, position) = (g3(surface.normal), g3(surface.position));
        let hit = Hit { instance, corners: &corners, weights: fragment.weights, position, normal, ray };
        self.staged(surface, &hit, fragment.region.stack, passed)
    }

    /// Runs a stack on a surface.
    fn staged(&self, mut surface: wgsl::Surface, hit: &Hit, stack: LensSet, passed: LensSet) -> Shaded {
        let Hit { instance, position, normal, .. } = *hit;
        let ops = || {
            stack.iter().flat_map(|rank| {
                let amount = soft_amount(self.plan, rank, instance, position);
                self.ops[self.plan.ops_of(rank)].iter().map(move |op| (rank, op, amount))
            })
        };
        for (rank, op, amount) in ops() {
            let source = || instance.source_from_shown(rank, op.inner != 0);
            let Some(reading) = self.reading(op, hit, source) else { continue };
            let filtered = match self.custom(op, position, source) {
                Some(site) => site.filtered(op, surface),
                None => wgsl::filter_surface(*op, surface, reading),
            };
            surface = wgsl::faded_surface(surface, filtered, amount);
        }
        let opacity = wgsl::surface_opacity(surface);
        let mut color = g3(wgsl::emitted(surface, v3(self.light(surface))));
        for (rank, op, amount) in ops() {
            let source = || instance.source_from_shown(rank, op.inner != 0);
            let filtered = match self.custom(op, position, source) {
                Some(site) => site.colored(op, color, &surface),
                None => g3(wgsl::filter_color(*op, v3(color))),
            };
            color = color.lerp(filtered, amount);
        }
        let mut shaded = wgsl::Shaded { color: v3(color), opacity, coverage: 1.0 };
        let mut spot = None;
        for (rank, op, amount) in ops().filter(|(_, op, _)| wgsl::FILTERS[op.kind as usize].stages[2]) {
            let spot = *spot.get_or_insert_with(|| self.spot(hit));
            let spot = wgsl::Spot { hidden: u32::from(passed.contains(rank)), ..spot };
            shaded = wgsl::faded_shaded(shaded, wgsl::filter_coverage(*op, shaded, spot), amount);
        }
        Shaded { color: g3(shaded.color), opacity: shaded.opacity, coverage: shaded.coverage, normal }
    }

    /// Where a ray meets a triangle, from its edges and corners.
    fn spot(&self, hit: &Hit) -> wgsl::Spot {
        let far = NOWHERE_NEAR;
        let mut spot = wgsl::Spot { edge: far, flat_edge: far, rim: far, corner: far, hidden: 0 };
        let Some(triangle) = hit.corners.triangle else { return spot };
        let around = hit.corners.around.map(v3);
        let item = &self.plan.items[hit.instance.item];
        let mesh = &self.scene.models[item.model].meshes[item.mesh];
        let kind = |kind| match kind {
            EdgeKind::Border => wgsl::ACROSS_NOTHING.0,
            EdgeKind::Turned => wgsl::ACROSS_TURNED.0,
            EdgeKind::Flat => wgsl::ACROSS_FLAT.0,
        };
        // None where no filter has asked.
        let edges = item.across(self.scene).get(triangle);
        for (i, (edges, across)) in
            edges.iter().flat_map(|edges| edges.across.map(|across| (edges, across))).enumerate()
        {
            let [a, b, c] = [0, 1, 2].map(|step| around[(i + step) % 3]);
            let opposite = across.opposite().and_then(|vertex| mesh.vertex(vertex)).unwrap_or_default();
            let opposite = v3(hit.corners.to_origin.transform_point3(opposite.as_dvec3()).as_vec3());
            spot = wgsl::spot_by_edge(spot, *hit.ray, a, b, c, kind(across.kind()), opposite);
            for (end, beyond) in [a, b].into_iter().zip(edges.beyond(i)) {
                let (across, beyond) = (kind(across.kind()), kind(beyond));
                spot = wgsl::spot_by_edge_beyond(spot, *hit.ray, v3(hit.position), end, opposite, across, beyond);
            }
        }
        let [a, b, c] = around;
        spot.corner = wgsl::corner_distance(*hit.ray, a, b, c);
        spot
    }

    /// Of the triangle that a fragment lies on, as shown; zero for one without area.
    pub fn geometric_normal(&self, fragment: &Fragment) -> Vec3 {
        let item = &self.plan.items[self.plan.instances[fragment.instance as usize].item];
        self.corners(item, fragment).normal()
    }

    fn corners(&self, item: &Item, fragment: &Fragment) -> Corners<'_> {
        let primitive = item.primitive_of(self.scene);
        let indices = item.triangle_list(self.scene)[fragment.triangle as usize].map(|i| i as usize);
        let to_origin = &self.transforms[fragment.instance as usize].point;
        let around = indices.map(|i| to_origin.transform_point3(primitive.positions[i].as_dvec3()).as_vec3());
        Corners { primitive, indices, around, to_origin, triangle: Some(fragment.triangle as usize) }
    }

    /// The surface as its material has it.
    fn surface(
        &self,
        item: &Item,
        fragment: &Fragment,
        corners: &Corners,
        geometric: Vec3,
        view: Vec3,
        ray: &wgsl::PixelRay,
    ) -> wgsl::Surface {
        let material = &self.scene.materials[item.material];
        let weights = fragment.weights;
        let primitive = corners.primitive;
        let texel = |slot: &TextureSlot| self.texel(slot, corners, weights, ray);
        let mut factor = Vec4::from_array(material.base_color);
        if let Some(colors) = &primitive.colors {
            factor *= corners.interpolated(colors, weights);
        }
        let metal_rough = texel(&material.metallic_roughness_texture);
        let occlusion = texel(&material.occlusion_texture).x;
        // Not from the corners, which may be far off.
        let position = g3(ray.origin) + g3(ray.direction) * fragment.depth;
        let normal = self.normal(material, fragment, corners, geometric, view, ray);
        wgsl::Surface {
            factor: v4(factor),
            texel: v4(texel(&material.base_color_texture)),
            metallic: material.metallic * metal_rough.z,
            roughness: material.roughness * metal_rough.y,
            emissive: v3(Vec3::from_array(material.emissive) * texel(&material.emissive_texture).truncate()),
            occlusion: 1.0 + material.occlusion_strength * (occlusion - 1.0),
            ..untextured(material, position, normal, ray)
        }
    }

    fn normal(
        &self,
        material: &MaterialRecord,
        fragment: &Fragment,
        corners: &Corners,
        geometric: Vec3,
        view: Vec3,
        ray: &wgsl::PixelRay,
    ) -> Vec3 {
        let transform = &self.transforms[fragment.instance as usize];
        let weights = fragment.weights;
        let mut normal = match &corners.primitive.normals {
            Some(normals) => (transform.normal * corners.interpolated(normals, weights)).normalize_or(geometric),
            None => geometric,
        };
        let slot = &material.normal_texture;
        if slot.texture != NO_TEXTURE {
            let tangent = match &corners.primitive.tangents {
                Some(tangents) => {
                    let t = corners.interpolated(tangents, weights);
                    let along =
                        transform.point.transform_vector3(t.truncate().as_dvec3()).as_vec3().normalize_or_zero();
                    along.extend(t.w.signum() * transform.side)
                }
                None => {
                    let [a, b, c] = corners.around.map(v3);
                    let [ua, ub, uc] = self.slot_uv(slot, corners).map(v2);
                    g4(wgsl::triangle_tangent(a, b, c, ua, ub, uc, v3(normal)))
                }
            };
            let texel = self.texel(slot, corners, weights, ray).truncate();
            normal = g3(wgsl::bent_normal(v3(normal), v4(tangent), v3(texel), material.normal_scale));
        }
        g3(wgsl::facing_normal(v3(normal), v3(geometric), v3(view)))
    }

    /// A slot's coordinates at the corners, transformed.
    fn slot_uv(&self, slot: &TextureSlot, corners: &Corners) -> [Vec2; 3] {
        corners
            .uv(slot.uv_set)
            .map(|uv| g2(wgsl::transform_uv(v2(uv), v2(Vec2::from_array(slot.offset)), a4(slot.matrix))))
    }

    /// A slot's texel; white where it has no texture.
    fn texel(&self, slot: &TextureSlot, corners: &Corners, weights: Vec3, ray: &wgsl::PixelRay) -> Vec4 {
        if slot.texture == NO_TEXTURE {
            return Vec4::ONE;
        }
        self.sample(slot.texture, self.slot_uv(slot, corners), corners, weights, ray)
    }

    fn sample(&self, index: u32, uv: [Vec2; 3], corners: &Corners, weights: Vec3, ray: &wgsl::PixelRay) -> Vec4 {
        let [a, b, c] = corners.around.map(v3);
        let [ua, ub, uc] = uv;
        let size = texture::size(&self.scene.textures, index);
        let footprint = wgsl::uv_footprint(*ray, a, b, c, v2(ua), v2(ub), v2(uc), v2(size));
        let at = ua * weights.x + ub * weights.y + uc * weights.z;
        texture::sample(&self.scene.textures, index, at, footprint)
    }

    /// Where a filter of the user's own acts on what is shown at `position`; `None` for any other.
    fn custom(&self, op: &wgsl::Op, position: Vec3, source: impl Fn() -> DAffine3) -> Option<Site<'_>> {
        let from_origin = || self.source_around(&source(), position).as_vec3();
        (op.kind == wgsl::OP_WGSL.0).then(|| Site { plan: self.plan, position: from_origin(), spent: &self.spent })
    }

    /// Where a filter acts on what is shown at `position`, relative to the view's origin like it. `source`: from the shown
    /// point to there.
    fn source_around(&self, source: &DAffine3, position: Vec3) -> DVec3 {
        source.transform_point3(position.as_dvec3() + self.origin) - self.origin
    }

    /// What a filter looks up; `None` where it does not act, as the surface has no such value. `source`: from the shown
    /// point to where the filter acts.
    fn reading(&self, op: &wgsl::Op, hit: &Hit, source: impl Fn() -> DAffine3) -> Option<wgsl::Reading> {
        let mut reading = wgsl::Reading { texel: v4(Vec4::ONE), value: 0.0, change: 0.0 };
        let quantity = wgsl::op_quantity(*op);
        if quantity == wgsl::QUANTITY_NONE.0 {
            if op.kind == wgsl::OP_TEXTURE.0 {
                reading.texel = v4(self.filter_texel(op, hit, &source()));
            }
            return Some(reading);
        }
        if quantity == wgsl::QUANTITY_SLOPE.0 {
            reading.value = hit.normal.y;
        } else {
            let [a, b, c] = hit.corners.around.map(v3);
            let values = self.corner_values(quantity, wgsl::op_channel(*op), hit, source)?;
            let size = hit.size_of_values(quantity, values);
            let value = wgsl::value_on_triangle(*hit.ray, a, b, c, v3(values), size);
            (reading.value, reading.change) = (value.x, value.y);
        }
        if op.flags & wgsl::MAPPED.0 != 0 {
            let at = Vec2::new(wgsl::in_range(*op, reading.value), 0.5);
            reading.texel = v4(texture::sample(&self.scene.textures, op.texture, at, 0.0));
        }
        Some(reading)
    }

    /// A quantity at the corners of a triangle: a height or a depth counted from the view's origin.
    fn corner_values(&self, quantity: u32, channel: u32, hit: &Hit, source: impl Fn() -> DAffine3) -> Option<Vec3> {
        if quantity == wgsl::QUANTITY_VERTEX.0 {
            hit.corners.triangle?;
            let (values, factor) = self.values[hit.instance.item][channel as usize]?;
            return Some(Vec3::from_array(hit.corners.indices.map(|i| values[i] * factor)));
        }
        let source = source();
        let values = hit.corners.around.map(|around| {
            let acts = self.source_around(&source, around);
            if quantity == wgsl::QUANTITY_DEPTH.0 { acts.dot(self.forward) } else { acts.y }
        });
        Some(DVec3::from_array(values).as_vec3())
    }

    /// The texel of a `texture` filter; `source`: from the shown point to where the filter acts.
    fn filter_texel(&self, op: &wgsl::Op, hit: &Hit, source: &DAffine3) -> Vec4 {
        let Hit { corners, weights, position, normal, ray, .. } = *hit;
        let scale = Vec2::new(op.a.x, op.a.y);
        if op.flags == wgsl::UV_MESH.0 {
            if corners.triangle.is_none() {
                return Vec4::ONE;
            }
            return self.sample(op.texture, corners.uv(0).map(|uv| uv * scale), corners, weights, ray);
        }
        let space = &self.plan.texture_space;
        let mapped = source.transform_point3(position.as_dvec3() + self.origin) - space.origin;
        let uv = g2(wgsl::projected_uv(op.flags, v3(mapped.as_vec3() * space.scale), v3(normal))) * scale;
        let size = texture::size(&self.scene.textures, op.texture);
        // The mapping may jump inside a triangle, so its footprint is taken at the hit, not from the corners.
        let steps = steps_at_source(source, wgsl::steps_at(*ray, v3(position), v3(normal)));
        let span = g3(steps.right).length().max(g3(steps.down).length());
        let footprint = span * space.scale * (scale.abs() * size).max_element();
        texture::sample(&self.scene.textures, op.texture, uv, footprint)
    }

    /// Light that a surface sends to the viewer.
    fn light(&self, surface: wgsl::Surface) -> Vec3 {
        if surface.unlit >= 1.0 {
            return Vec3::ZERO;
        }
        let ambient = g3(wgsl::ambient_light(surface, self.plan.lighting.ambient, v3(self.up)));
        self.lights.iter().fold(ambient, |sum, light| sum + g3(wgsl::lit_by(*light, surface)))
    }
}

/// What a pixel spans, where lenses move it from.
fn steps_at_source(source: &DAffine3, shown: wgsl::PlaneSteps) -> wgsl::PlaneSteps {
    let moved = |step| d3(source.transform_vector3(g3(step).as_dvec3()));
    wgsl::PlaneSteps { right: moved(shown.right), down: moved(shown.down) }
}

/// How much the filters of a lens, or of a rule, count on a fragment shown at `position` (around the view's origin).
pub fn soft_amount(plan: &Plan, rank: usize, instance: &Instance, position: Vec3) -> f32 {
    let Some(lens) = plan.lenses.get(rank).filter(|lens| lens.soft > 0.0) else { return 1.0 };
    let asked = match lens.by {
        By::Pixel => {
            let shown = position.as_dvec3() + plan.view.origin();
            instance.source_from_shown(rank, false).transform_point3(shown)
        }
        By::Object => plan.items[instance.item].center,
    };
    (lens.volume.depth_inside(asked) / lens.soft).clamp(0.0, 1.0) as f32
}
