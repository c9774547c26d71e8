// Single-pass lenses: every fragment asks the closed form of every lens whether it is inside, and goes through the
// filters of those that hold it, lowest rank first.

struct Lens {
    // Centre and squared radius; negative where it is bounded by planes.
    sphere: vec4f,
    first_plane: u32,
    plane_count: u32,
    first_op: u32,
    op_count: u32,
}

@group(0) @binding(1) var<storage, read> lenses: array<Lens>;
// Unit normal and offset.
@group(0) @binding(2) var<storage, read> planes: array<vec4f>;
@group(0) @binding(3) var<storage, read> ops: array<Op>;

fn contains(lens: u32, p: vec3f) -> bool {
    let sphere = lenses[lens].sphere;
    if sphere.w >= 0.0 {
        let from_center = p - sphere.xyz;
        return dot(from_center, from_center) <= sphere.w;
    }
    let end = lenses[lens].first_plane + lenses[lens].plane_count;
    for (var i = lenses[lens].first_plane; i < end; i += 1u) {
        if dot(planes[i].xyz, p) > planes[i].w {
            return false;
        }
    }
    return true;
}

@fragment
fn composed(in: Varying) -> @location(0) vec4f {
    var color = shaded(in);
    for (var lens = 0u; lens < arrayLength(&lenses); lens += 1u) {
        if contains(lens, in.position) {
            let end = lenses[lens].first_op + lenses[lens].op_count;
            for (var i = lenses[lens].first_op; i < end; i += 1u) {
                color = filter_color(ops[i], color);
            }
        }
    }
    return encoded(color);
}
