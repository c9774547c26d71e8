// Metallic-roughness shading of glTF 2.0 (appendix B), one light at a time.

const LIGHT_DIRECTIONAL: u32 = 0u;
const LIGHT_POINT: u32 = 1u;
const LIGHT_SPOT: u32 = 2u;

const PI: f32 = 3.14159265;

// Twin of `plan::LightRecord`.
struct Light {
    kind: u32,
    // Scene units; 0 is unlimited.
    range: f32,
    // Cosines of a spot's half angles.
    cos_inner: f32,
    cos_outer: f32,
    // As a surface's.
    position: vec4f,
    // The way the light travels, unit length.
    direction: vec4f,
    // Linear colour times intensity.
    color: vec4f,
}

// Radiance that arrives at `s` from `light`, without the cosine.
fn arriving(light: Light, s: Surface) -> vec3f {
    if light.kind == LIGHT_DIRECTIONAL {
        return light.color.rgb;
    }
    let to_light = light.position.xyz - s.position;
    let squared = max(dot(to_light, to_light), 1e-12);
    var strength = 1.0 / squared;
    if light.range > 0.0 {
        let reach = squared / (light.range * light.range);
        strength = strength * clamp(1.0 - reach * reach, 0.0, 1.0);
    }
    if light.kind == LIGHT_SPOT {
        let cosine = dot(-normalize(to_light), light.direction.xyz);
        let falloff = clamp((cosine - light.cos_outer) / max(light.cos_inner - light.cos_outer, 1e-4), 0.0, 1.0);
        strength = strength * falloff * falloff;
    }
    return light.color.rgb * strength;
}

// What one light adds to a surface, towards the viewer.
fn lit_by(light: Light, s: Surface) -> vec3f {
    var l = -light.direction.xyz;
    if light.kind != LIGHT_DIRECTIONAL {
        l = normalize(light.position.xyz - s.position + vec3f(0.0, 1e-12, 0.0));
    }
    let n_dot_l = dot(s.normal, l);
    if n_dot_l <= 0.0 {
        return vec3f(0.0);
    }
    let h = normalize(l + s.view + vec3f(0.0, 1e-12, 0.0));
    let n_dot_v = max(dot(s.normal, s.view), 1e-4);
    let n_dot_h = clamp(dot(s.normal, h), 0.0, 1.0);
    let v_dot_h = clamp(dot(s.view, h), 0.0, 1.0);
    let base = base_color(s);
    let f0 = mix(vec3f(0.04), base, s.metallic);
    let fresnel = f0 + (vec3f(1.0) - f0) * pow(1.0 - v_dot_h, 5.0);
    let alpha = max(s.roughness * s.roughness, 2e-3);
    let specular = fresnel * (ggx_distribution(n_dot_h, alpha) * smith_visibility(n_dot_l, n_dot_v, alpha));
    let diffuse = (vec3f(1.0) - fresnel) * base * ((1.0 - s.metallic) / PI);
    return (diffuse + specular) * arriving(light, s) * n_dot_l;
}

// Trowbridge and Reitz (GGX).
fn ggx_distribution(n_dot_h: f32, alpha: f32) -> f32 {
    let a2 = alpha * alpha;
    let f = (n_dot_h * a2 - n_dot_h) * n_dot_h + 1.0;
    return a2 / (PI * f * f);
}

// Square root of a positive number (the translation to Rust has no `sqrt`).
fn root(x: f32) -> f32 {
    return pow(x, 0.5);
}

// Height-correlated Smith masking over the microfacet denominator (Heitz 2014).
fn smith_visibility(n_dot_l: f32, n_dot_v: f32, alpha: f32) -> f32 {
    let a2 = alpha * alpha;
    let v = n_dot_l * root(n_dot_v * n_dot_v * (1.0 - a2) + a2);
    let l = n_dot_v * root(n_dot_l * n_dot_l * (1.0 - a2) + a2);
    return 0.5 / max(v + l, 1e-6);
}

// Light from everywhere, a little more of it from above (`up`), so that unlit sides keep their form.
fn ambient_light(s: Surface, ambient: f32, up: vec3f) -> vec3f {
    let base = base_color(s);
    let f0 = mix(vec3f(0.04), base, s.metallic);
    let facing = clamp(dot(s.normal, s.view), 0.0, 1.0);
    let fresnel = f0 + (max(vec3f(1.0 - s.roughness), f0) - f0) * pow(1.0 - facing, 5.0);
    let albedo = base * (1.0 - s.metallic) + fresnel * mix(1.0, 0.6, s.roughness);
    let sky = 0.8 + 0.2 * dot(s.normal, up);
    return albedo * (ambient * sky * s.occlusion);
}
