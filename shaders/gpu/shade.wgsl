// From a hit to a colour: attributes, textures, the stack's filters, light. Twin of `cpu/shade.rs`.

// A surface sample on a ray, classified.
struct Fragment {
    item: u32,
    triangle: u32,
    depth: f32,
    around: Set,
    stack: Set,
}

// A fragment's colour (linear, straight), opacity, coverage, and its shading normal.
struct ShadedFragment {
    color: vec3f,
    opacity: f32,
    coverage: f32,
    normal: vec3f,
}

fn attribute2(start: u32, corners: vec3u, index: u32) -> vec2f {
    let at = start + 2u * corners[index];
    return vec2f(attributes[at], attributes[at + 1u]);
}

fn interpolated3(start: u32, corners: vec3u, weights: vec3f) -> vec3f {
    var sum = vec3f(0.0);
    for (var i = 0u; i < 3u; i += 1u) {
        let at = start + 3u * corners[i];
        sum += vec3f(attributes[at], attributes[at + 1u], attributes[at + 2u]) * weights[i];
    }
    return sum;
}

fn interpolated4(start: u32, corners: vec3u, weights: vec3f) -> vec4f {
    var sum = vec4f(0.0);
    for (var i = 0u; i < 3u; i += 1u) {
        let at = start + 4u * corners[i];
        sum += vec4f(attributes[at], attributes[at + 1u], attributes[at + 2u], attributes[at + 3u]) * weights[i];
    }
    return sum;
}

// Texture coordinates of a triangle's corners.
struct CornerUv {
    a: vec2f,
    b: vec2f,
    c: vec2f,
}

fn corner_uv(item: u32, corners: vec3u, uv_set: u32) -> CornerUv {
    let start = select(items[item].uv1, items[item].uv0, uv_set == 0u);
    if start == NONE {
        return CornerUv(vec2f(0.0), vec2f(0.0), vec2f(0.0));
    }
    return CornerUv(
        attribute2(start, corners, 0u),
        attribute2(start, corners, 1u),
        attribute2(start, corners, 2u),
    );
}

fn slot_uv(item: u32, corners: vec3u, slot: TextureSlot) -> CornerUv {
    let uv = corner_uv(item, corners, slot.uv_set);
    return CornerUv(
        transform_uv(uv.a, slot.offset, slot.matrix),
        transform_uv(uv.b, slot.offset, slot.matrix),
        transform_uv(uv.c, slot.offset, slot.matrix),
    );
}

fn sample_on(texture: u32, uv: CornerUv, t: Triangle, weights: vec3f, ray: PixelRay) -> vec4f {
    let footprint = uv_footprint(ray, t.a, t.b, t.c, uv.a, uv.b, uv.c, texture_size(texture));
    return sample_texture(texture, uv.a * weights.x + uv.b * weights.y + uv.c * weights.z, footprint);
}

// A slot's texel; white where it has no texture.
fn slot_texel(item: u32, slot: TextureSlot, t: Triangle, weights: vec3f, ray: PixelRay) -> vec4f {
    if slot.texture == NONE {
        return vec4f(1.0);
    }
    return sample_on(slot.texture, slot_uv(item, t.corners, slot), t, weights, ray);
}

fn normalize_or(v: vec3f, other: vec3f) -> vec3f {
    let size = length(v);
    if size > 1e-30 {
        return v / size;
    }
    return other;
}

fn shading_normal(item: u32, t: Triangle, weights: vec3f, geometric: vec3f, view: vec3f, ray: PixelRay) -> vec3f {
    var normal = geometric;
    if items[item].normals != NONE {
        let n = interpolated3(items[item].normals, t.corners, weights);
        let turned = vec3f(
            dot(items[item].normal_x.xyz, n),
            dot(items[item].normal_y.xyz, n),
            dot(items[item].normal_z.xyz, n),
        );
        normal = normalize_or(turned, geometric);
    }
    let slot = materials[items[item].material].normal_texture;
    if slot.texture != NONE {
        var tangent = vec4f(0.0);
        if items[item].tangents != NONE {
            let along = interpolated4(items[item].tangents, t.corners, weights);
            let turned = vec3f(
                dot(items[item].row_x.xyz, along.xyz),
                dot(items[item].row_y.xyz, along.xyz),
                dot(items[item].row_z.xyz, along.xyz),
            );
            tangent = vec4f(normalize_or(turned, vec3f(0.0)), select(1.0, -1.0, along.w < 0.0));
        } else {
            let uv = slot_uv(item, t.corners, slot);
            tangent = triangle_tangent(t.a, t.b, t.c, uv.a, uv.b, uv.c, normal);
        }
        let texel = slot_texel(item, slot, t, weights, ray).xyz;
        normal = bent_normal(normal, tangent, texel, materials[items[item].material].normal_scale);
    }
    return facing_normal(normal, geometric, view);
}

// The surface as its material has it.
fn material_surface(item: u32, t: Triangle, weights: vec3f, ray: PixelRay) -> Surface {
    let m = items[item].material;
    let view = -normalize(ray.direction);
    let geometric = normalize_or(cross(t.b - t.a, t.c - t.a), vec3f(0.0));
    var s: Surface;
    s.position = t.a * weights.x + t.b * weights.y + t.c * weights.z;
    s.normal = shading_normal(item, t, weights, geometric, view, ray);
    s.view = view;
    s.factor = materials[m].base_color;
    if items[item].colors != NONE {
        s.factor *= interpolated4(items[item].colors, t.corners, weights);
    }
    s.texel = slot_texel(item, materials[m].base_color_texture, t, weights, ray);
    let metal_rough = slot_texel(item, materials[m].metallic_roughness_texture, t, weights, ray);
    s.metallic = materials[m].metallic * metal_rough.z;
    s.roughness = materials[m].roughness * metal_rough.y;
    s.emissive = materials[m].emissive * slot_texel(item, materials[m].emissive_texture, t, weights, ray).xyz;
    let occlusion = slot_texel(item, materials[m].occlusion_texture, t, weights, ray).x;
    s.occlusion = 1.0 + materials[m].occlusion_strength * (occlusion - 1.0);
    s.alpha_mode = materials[m].alpha_mode;
    s.alpha_cutoff = materials[m].alpha_cutoff;
    s.opacity = 1.0;
    s.unlit = materials[m].unlit;
    return s;
}

// The texel of a `texture` filter; `normal` is the material's.
fn filter_texel(op: Op, item: u32, t: Triangle, weights: vec3f, position: vec3f, normal: vec3f, ray: PixelRay) -> vec4f {
    let scale = op.a.xy;
    if op.flags == UV_MESH {
        let uv = corner_uv(item, t.corners, 0u);
        return sample_on(op.texture, CornerUv(uv.a * scale, uv.b * scale, uv.c * scale), t, weights, ray);
    }
    let mapped = (position - frame.texture_space.xyz) * frame.texture_space.w;
    // The mapping may jump inside a triangle, so its footprint is taken at the hit, not from the corners.
    let span = position_footprint(ray, position, normal);
    let texels = abs(scale) * texture_size(op.texture);
    let footprint = max(span.x, span.y) * frame.texture_space.w * max(texels.x, texels.y);
    return sample_texture(op.texture, projected_uv(op.flags, mapped, normal) * scale, footprint);
}

// Light that a surface sends to the viewer.
fn lit(s: Surface) -> vec3f {
    if s.unlit != 0u {
        return vec3f(0.0);
    }
    var sum = ambient_light(s, frame.ambient.w, frame.ambient.xyz);
    for (var i = 0u; i < frame.light_count; i += 1u) {
        sum += lit_by(lights[i], s);
    }
    return sum;
}

// Runs the stack on a fragment that a pixel's ray has met.
fn shade(f: Fragment, ray: PixelRay) -> ShadedFragment {
    let t = fetch_triangle(f.item, f.triangle);
    let weights = surface_hit(ray, t).weights;
    var surface = material_surface(f.item, t, weights, ray);
    let normal = surface.normal;
    // Bit s: some filter of the stack acts in stage s.
    var stages = 0u;
    for (var w = 0u; w < WORDS; w += 1u) {
        var rest = f.stack.words[w];
        while rest != 0u {
            let rank = w * 32u + firstTrailingBit(rest);
            rest = rest & (rest - 1u);
            let end = lenses[rank].first_op + lenses[rank].op_count;
            for (var i = lenses[rank].first_op; i < end; i += 1u) {
                let op = ops[i];
                var texel = vec4f(1.0);
                if op.kind == OP_TEXTURE {
                    texel = filter_texel(op, f.item, t, weights, surface.position, normal, ray);
                }
                surface = filter_surface(op, surface, texel);
                stages |= 1u << op_stage(op.kind);
            }
        }
    }
    var shaded = Shaded(emitted(surface, lit(surface)), surface_opacity(surface), 1.0);
    if (stages & (1u << STAGE_COLOR)) != 0u {
        shaded.color = filtered_color(f.stack, shaded.color);
    }
    if (stages & (1u << STAGE_COVERAGE)) != 0u {
        shaded = covered(f.stack, shaded, wire_distance(ray, t.a, t.b, t.c));
    }
    return ShadedFragment(shaded.color, shaded.opacity, shaded.coverage, normal);
}

fn filtered_color(stack: Set, color: vec3f) -> vec3f {
    var result = color;
    for (var w = 0u; w < WORDS; w += 1u) {
        var rest = stack.words[w];
        while rest != 0u {
            let rank = w * 32u + firstTrailingBit(rest);
            rest = rest & (rest - 1u);
            let end = lenses[rank].first_op + lenses[rank].op_count;
            for (var i = lenses[rank].first_op; i < end; i += 1u) {
                result = filter_color(ops[i], result);
            }
        }
    }
    return result;
}

fn covered(stack: Set, before: Shaded, edge: f32) -> Shaded {
    var result = before;
    for (var w = 0u; w < WORDS; w += 1u) {
        var rest = stack.words[w];
        while rest != 0u {
            let rank = w * 32u + firstTrailingBit(rest);
            rest = rest & (rest - 1u);
            let end = lenses[rank].first_op + lenses[rank].op_count;
            for (var i = lenses[rank].first_op; i < end; i += 1u) {
                if ops[i].kind == OP_WIREFRAME {
                    result = filter_wireframe(ops[i], result, edge);
                }
            }
        }
    }
    return result;
}
