// What is patched into a renderer's fragment shader for lenses that invert: one mask over all spheres.

struct Spheres {
    count: u32,
    // Centre and squared radius.
    list: array<vec4f, 256>,
}

@group(0) @binding(1) var<uniform> spheres: Spheres;

@fragment
fn masked(in: Varying) -> @location(0) vec4f {
    var color = shaded(in);
    // Inverting twice changes nothing.
    var odd = false;
    for (var i = 0u; i < spheres.count; i += 1u) {
        let from_center = in.position - spheres.list[i].xyz;
        odd = odd != (dot(from_center, from_center) <= spheres.list[i].w);
    }
    if odd {
        color = inverted(color);
    }
    return encoded(color);
}
