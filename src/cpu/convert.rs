//! Between glam and the types of the translated shaders.

use glam::{DVec3, Vec2, Vec3, Vec4};
use naga_rust_rt as rt;

use crate::appearance as wgsl;
use crate::plan::{GlassRecord, LightRecord};

pub fn v2(v: Vec2) -> rt::Vec2<f32> {
    rt::Vec2::new(v.x, v.y)
}

pub fn v3(v: Vec3) -> rt::Vec3<f32> {
    rt::Vec3::new(v.x, v.y, v.z)
}

pub fn v4(v: Vec4) -> rt::Vec4<f32> {
    rt::Vec4::new(v.x, v.y, v.z, v.w)
}

pub fn d3(v: DVec3) -> rt::Vec3<f32> {
    v3(v.as_vec3())
}

pub fn a4(v: [f32; 4]) -> rt::Vec4<f32> {
    rt::Vec4::new(v[0], v[1], v[2], v[3])
}

pub fn g2(v: rt::Vec2<f32>) -> Vec2 {
    Vec2::new(v.x, v.y)
}

pub fn g3(v: rt::Vec3<f32>) -> Vec3 {
    Vec3::new(v.x, v.y, v.z)
}

pub fn g4(v: rt::Vec4<f32>) -> Vec4 {
    Vec4::new(v.x, v.y, v.z, v.w)
}

pub fn light(light: &LightRecord) -> wgsl::Light {
    wgsl::Light {
        kind: light.kind,
        range: light.range,
        cos_inner: light.cos_inner,
        cos_outer: light.cos_outer,
        position: a4(light.position),
        direction: a4(light.direction),
        color: a4(light.color),
    }
}

pub fn glass(glass: &GlassRecord) -> wgsl::Glass {
    wgsl::Glass {
        color: a4(glass.color),
        opacity: glass.opacity,
        rim: glass.rim,
        outline: glass.outline,
        contact: glass.contact,
    }
}
