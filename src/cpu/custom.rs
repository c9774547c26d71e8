//! The user's own filters on the CPU: the work of `shaders/gpu/custom.wgsl`.

use std::sync::atomic::{AtomicU64, Ordering};

use glam::Vec3;

use super::convert::{g2, g3, v3, v4};
use crate::appearance as wgsl;
use crate::custom::SurfaceValue;
use crate::plan::Plan;

/// Where a filter acts: around the view's origin, along the world's axes.
pub struct Site<'a> {
    pub plan: &'a Plan,
    pub position: Vec3,
    /// Loop iterations that the filters of a picture have taken; see [`crate::limits::FILTER_ITERATIONS`].
    pub spent: &'a AtomicU64,
}

impl Site<'_> {
    fn seen(&self, s: &wgsl::Surface) -> SurfaceValue {
        let view = &self.plan.view;
        SurfaceValue {
            position: (self.position.as_dvec3() + view.origin()).as_vec3().to_array(),
            normal: g3(s.normal).to_array(),
            view: g3(s.view).to_array(),
            base_color: g3(wgsl::base_color(*s)).to_array(),
            metallic: s.metallic,
            roughness: s.roughness,
            emissive: g3(s.emissive).to_array(),
            occlusion: s.occlusion,
            opacity: wgsl::surface_opacity(*s),
            unlit: s.unlit,
            pixel: g2(s.pixel).to_array(),
            depth: view.from_eye(self.position.as_dvec3().dot(view.forward)) as f32,
        }
    }

    pub fn filtered(&self, op: &wgsl::Op, before: wgsl::Surface) -> wgsl::Surface {
        let seen = self.seen(&before);
        let mut spent = 0;
        let made = self.plan.customs[op.texture as usize].surface_spending(&seen, self.words(op), &mut spent);
        self.spend(spent);
        let mut s = before;
        s.normal = v3(Vec3::from_array(made.normal).normalize_or(g3(before.normal)));
        if made.base_color != seen.base_color {
            s = wgsl::with_base_color(s, v4(Vec3::from_array(made.base_color).extend(1.0)));
        }
        let share = |x: f32| x.clamp(0.0, 1.0);
        s.metallic = share(made.metallic);
        s.roughness = share(made.roughness);
        s.emissive = v3(Vec3::from_array(made.emissive));
        s.occlusion = share(made.occlusion);
        // What the filter makes of the whole opacity, the stack makes of its share.
        s.opacity = before.opacity * (share(made.opacity) / seen.opacity.max(1e-6));
        s.unlit = share(made.unlit);
        s
    }

    pub fn colored(&self, op: &wgsl::Op, color: Vec3, s: &wgsl::Surface) -> Vec3 {
        let custom = &self.plan.customs[op.texture as usize];
        let mut spent = 0;
        let made = custom.color_spending(color.to_array(), &self.seen(s), self.words(op), &mut spent);
        self.spend(spent);
        Vec3::from_array(made)
    }

    fn spend(&self, spent: u32) {
        if spent > 0 {
            self.spent.fetch_add(u64::from(spent), Ordering::Relaxed);
        }
    }

    /// The values of the filter's parameters, and of those behind it.
    fn words(&self, op: &wgsl::Op) -> &[u32] {
        &self.plan.custom_words[wgsl::op_channel(*op) as usize..]
    }
}
