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

// The normal of the material, given the texel of its normal map.
fn shading_normal(item: u32, t: Triangle, weights: vec3f, geometric: vec3f, view: vec3f, texel: vec3f) -> vec3f {
    var normal = geometric;
    if items[item].normals != NONE {
        let n = interpolated3(items[item].normals, t.corners, weights);
        normal = normalize_or(normal_as_shown(t.placement, n), geometric);
    }
    if TEXTURES && (items[item].slots & (1u << SLOT_NORMAL)) != 0u {
        var tangent = vec4f(0.0);
        if items[item].tangents != NONE {
            let along = interpolated4(items[item].tangents, t.corners, weights);
            let shown = normalize_or(as_shown(t.placement, along.xyz), vec3f(0.0));
            // A mirror turns the bitangent of a tangent and a normal round.
            tangent = vec4f(shown, select(1.0, -1.0, along.w < 0.0) * side_as_shown(t.placement));
        } else {
            let uv = slot_uv(item, t.corners, materials[items[item].material].slots[SLOT_NORMAL]);
            tangent = triangle_tangent(t.a, t.b, t.c, uv.a, uv.b, uv.c, normal);
        }
        normal = bent_normal(normal, tangent, texel, materials[items[item].material].normal_scale);
    }
    return facing_normal(normal, geometric, view);
}

// One texture read at a fragment: which, where, and how many of its texels the pixel spans.
struct Read {
    texture: u32,
    uv: vec2f,
    footprint: f32,
}

fn read_at_corners(texture: u32, uv: CornerUv, t: Triangle, weights: vec3f, ray: PixelRay) -> Read {
    let footprint = uv_footprint(ray, t.a, t.b, t.c, uv.a, uv.b, uv.c, texture_size(texture));
    return Read(texture, uv.a * weights.x + uv.b * weights.y + uv.c * weights.z, footprint);
}

// The read of a `texture` filter of the lens of a rank, which acts where the lenses above move its content from.
fn filter_read(op: Op, rank: u32, item: u32, t: Triangle, weights: vec3f, s: Surface, ray: PixelRay) -> Read {
    let scale = op.a.xy;
    if op.flags == UV_MESH {
        let uv = corner_uv(item, t.corners, 0u);
        return read_at_corners(op.texture, CornerUv(uv.a * scale, uv.b * scale, uv.c * scale), t, weights, ray);
    }
    var position = s.position;
    let step = step_before(item, rank, op.inner != 0u);
    if MOVERS && step != 0u {
        position = step_point(step - 1u, position);
    }
    let mapped = (position - frame.texture_space.xyz) * frame.texture_space.w;
    // The mapping may jump inside a triangle, so its footprint is taken at the hit, not from the corners.
    let span = steps_at_source(step, steps_at(ray, s.position, s.normal));
    let texels = abs(scale) * texture_size(op.texture);
    let footprint = max(length(span.right), length(span.down)) * frame.texture_space.w * max(texels.x, texels.y);
    return Read(op.texture, projected_uv(op.flags, mapped, s.normal) * scale, footprint);
}

// What a filter looks up, and whether there is such a thing: where a surface has no such value the filter does not act.
struct Looked {
    reading: Reading,
    found: bool,
}

fn look_up(op: Op, rank: u32, f: Fragment, at: Meeting, s: Surface, ray: PixelRay) -> Looked {
    let item = f.item;
    var reading = Reading(vec4f(1.0), 0.0, 0.0);
    let t = at.triangle;
    let quantity = op_quantity(op);
    var read = Read(op.texture, vec2f(0.0), 0.0);
    var reads = TEXTURES && HAS_TEXTURE && op.kind == OP_TEXTURE;
    // A cap has neither texture coordinates nor numbers at its corners.
    if is_cap(f.triangle) && op.flags == UV_MESH {
        reads = false;
    }
    if TEXTURES && HAS_TEXTURE && reads {
        read = filter_read(op, rank, item, t, at.hit.weights, s, ray);
    }
    if QUANTITIES && quantity != QUANTITY_NONE {
        if quantity == QUANTITY_SLOPE {
            reading.value = s.normal.y;
        } else {
            if quantity == QUANTITY_VERTEX && (is_cap(f.triangle) || items[item].channels[2u * op_channel(op)] == NONE) {
                return Looked(reading, false);
            }
            let values = corner_values(op, rank, item, t);
            let value = value_on_triangle(ray, t.a, t.b, t.c, values, size_of_values(op, t, values));
            reading.value = value.x;
            reading.change = value.y;
        }
        reads = (op.flags & MAPPED) != 0u;
        read = Read(op.texture, vec2f(in_range(op, reading.value), 0.5), 0.0);
    }
    if TEXTURES && reads {
        reading.texel = sample_texture(read.texture, read.uv, read.footprint);
    }
    return Looked(reading, true);
}

// The quantity of a filter at the corners of a triangle, heights and depths counted from the view's origin: where the lenses above move its content from.
fn corner_values(op: Op, rank: u32, item: u32, t: Triangle) -> vec3f {
    let quantity = op_quantity(op);
    if quantity == QUANTITY_VERTEX {
        let start = items[item].channels[2u * op_channel(op)];
        let factor = bitcast<f32>(items[item].channels[2u * op_channel(op) + 1u]);
        let c = t.corners;
        return vec3f(attributes[start + c.x], attributes[start + c.y], attributes[start + c.z]) * factor;
    }
    var corners = mat3x3f(t.a, t.b, t.c);
    let step = step_before(item, rank, op.inner != 0u);
    if MOVERS && step != 0u {
        corners = mat3x3f(step_point(step - 1u, t.a), step_point(step - 1u, t.b), step_point(step - 1u, t.c));
    }
    if quantity == QUANTITY_DEPTH {
        return frame.forward.xyz * corners;
    }
    return vec3f(corners[0].y, corners[1].y, corners[2].y);
}

// Of the numbers that values at corners come from: for positions those of the corners, and of where the item stands.
fn size_of_values(op: Op, t: Triangle, values: vec3f) -> f32 {
    if op_quantity(op) == QUANTITY_VERTEX {
        return largest(values);
    }
    let corners = max(largest(t.a), max(largest(t.b), largest(t.c)));
    return corners + largest(vec3f(t.placement.row_x.w, t.placement.row_y.w, t.placement.row_z.w));
}

// A surface as its material has it.
fn surface_of_material(f: Fragment, t: Triangle, weights: vec3f, ray: PixelRay) -> Surface {
    let item = f.item;
    let m = items[item].material;
    let view = -normalize(ray.direction);
    let geometric = flat_normal(t.a, t.b, t.c);
    // White where there is no texture. One loop over all slots in use, so that the reading stands here once.
    var texels = array<vec4f, 5>(vec4f(1.0), vec4f(1.0), vec4f(1.0), vec4f(1.0), vec4f(1.0));
    var slots = select(0u, items[item].slots, TEXTURES);
    while TEXTURES && slots != 0u {
        let slot = firstTrailingBit(slots);
        slots = slots & (slots - 1u);
        let uv = slot_uv(item, t.corners, materials[m].slots[slot]);
        let read = read_at_corners(materials[m].slots[slot].texture, uv, t, weights, ray);
        texels[slot] = sample_texture(read.texture, read.uv, read.footprint);
    }
    // Not from the corners, which may be far off.
    let position = ray.origin + ray.direction * f.depth;
    var s = untextured(item, position, shading_normal(item, t, weights, geometric, view, texels[SLOT_NORMAL].xyz), ray);
    if VERTEX_COLORS && items[item].colors != NONE {
        s.factor *= interpolated4(items[item].colors, t.corners, weights);
    }
    s.texel = texels[SLOT_BASE_COLOR];
    s.metallic *= texels[SLOT_METALLIC_ROUGHNESS].z;
    s.roughness *= texels[SLOT_METALLIC_ROUGHNESS].y;
    s.emissive *= texels[SLOT_EMISSIVE].xyz;
    if TEXTURES {
        s.occlusion += materials[m].occlusion_strength * (texels[SLOT_OCCLUSION].x - 1.0);
    }
    return s;
}

// A surface that an item's material has where it has no texture.
fn untextured(item: u32, position: vec3f, normal: vec3f, ray: PixelRay) -> Surface {
    let m = items[item].material;
    var s: Surface;
    s.position = position;
    s.normal = normal;
    s.view = -normalize(ray.direction);
    s.factor = materials[m].base_color;
    s.texel = vec4f(1.0);
    s.metallic = materials[m].metallic;
    s.roughness = materials[m].roughness;
    s.emissive = materials[m].emissive;
    s.occlusion = 1.0;
    s.alpha_mode = ALPHA_OPAQUE;
    if TRANSLUCENT {
        s.alpha_mode = materials[m].alpha_mode;
        s.alpha_cutoff = materials[m].alpha_cutoff;
    }
    s.opacity = 1.0;
    s.unlit = f32(materials[m].unlit);
    s.pixel = ray.pixel;
    return s;
}

// Light that a surface sends to the viewer.
fn lit(s: Surface) -> vec3f {
    if s.unlit >= 1.0 {
        return vec3f(0.0);
    }
    var sum = ambient_light(s, frame.ambient.w, frame.ambient.xyz);
    for (var i = 0u; i < LIGHTS; i += 1u) {
        sum += lit_by(lights[i], s);
    }
    return sum;
}

// Runs the stack on a fragment where a pixel's ray meets it: surface filters, lighting once, colour filters, coverage.
// `passed`: the lenses and rules that act on nearer ones.
fn shade(fragment: Fragment, at: Meeting, ray: PixelRay, passed: Set) -> ShadedFragment {
    var f = fragment;
    var surface: Surface;
    if is_cap(f.triangle) {
        surface = surface_of_cap(f, at, ray);
        f = without_maker(f);
    } else {
        surface = surface_of_material(f, at.triangle, at.hit.weights, ray);
    }
    let normal = surface.normal;
    if LENSES && SURFACE_FILTERS {
        surface = surface_stage(surface, f, at, ray);
    }
    var shaded = Shaded(vec3f(0.0), surface_opacity(surface), 1.0);
    if !ACCOUNTS {
        shaded.color = emitted(surface, lit(surface));
    }
    if LENSES && COLOR_FILTERS {
        shaded.color = color_stage(shaded.color, f, surface);
    }
    if LENSES && COVERAGE_FILTERS {
        shaded = coverage_stage(shaded, f, at, ray, surface.position, passed);
    }
    return ShadedFragment(shaded.color, shaded.opacity, shaded.coverage, normal);
}

fn surface_stage(material: Surface, f: Fragment, at: Meeting, ray: PixelRay) -> Surface {
    var s = material;
    var place = stack_start(f.stack);
    if place.found {
        loop {
            if is_filter(place) {
                let op = ops[place.op];
                let looked = look_up(op, place.rank, f, at, s, ray);
                if looked.found {
                    let amount = soft_amount(place.rank, f.item, s.position);
                    var after = s;
                    if HAS_WGSL && op.kind == OP_WGSL {
                        after = custom_filtered(op, s, source_position(op, place.rank, f.item, s.position));
                    } else {
                        after = filter_surface(op, s, looked.reading);
                    }
                    s = faded_surface(s, after, amount);
                }
            }
            continuing {
                place = stack_next(place);
                break if !place.found;
            }
        }
    }
    return s;
}

fn color_stage(lit: vec3f, f: Fragment, s: Surface) -> vec3f {
    var color = lit;
    var place = stack_start(f.stack);
    if place.found {
        loop {
            if is_filter(place) {
                let op = ops[place.op];
                let amount = soft_amount(place.rank, f.item, s.position);
                var after = color;
                if HAS_WGSL && op.kind == OP_WGSL {
                    after = custom_colored(op, color, s, source_position(op, place.rank, f.item, s.position));
                } else {
                    after = filter_color(op, color);
                }
                color = mix(color, after, amount);
            }
            continuing {
                place = stack_next(place);
                break if !place.found;
            }
        }
    }
    return color;
}

// The lower bits of what lies across an edge: the vertex opposite, or these. The highest: the surface turns there.
const NO_VERTEX: u32 = 0x7fffffffu;

fn spot_by_edges(nowhere: Spot, f: Fragment, t: Triangle, p: vec3f, ray: PixelRay) -> Spot {
    var spot = nowhere;
    let corners = array<vec3f, 3>(t.a, t.b, t.c);
    let first = items[f.item].across + 4u * f.triangle;
    let beyond = numbers[first + 3u];
    for (var i = 0u; i < 3u; i += 1u) {
        let word = numbers[first + i];
        var across = select(ACROSS_TURNED, ACROSS_FLAT, word == (word & NO_VERTEX));
        var opposite = vec3f(0.0);
        if (word & NO_VERTEX) == NO_VERTEX {
            across = ACROSS_NOTHING;
        } else {
            opposite = placed(t.placement, (word & NO_VERTEX) - t.placement.base_vertex);
        }
        let ends = array<vec3f, 2>(corners[i], corners[(i + 1u) % 3u]);
        spot = spot_by_edge(spot, ray, ends[0], ends[1], corners[(i + 2u) % 3u], across, opposite);
        spot = spot_by_edge_beyond(spot, ray, p, ends[0], opposite, across, beyond >> (4u * i) & 3u);
        spot = spot_by_edge_beyond(spot, ray, p, ends[1], opposite, across, beyond >> (4u * i + 2u) & 3u);
    }
    return spot;
}

fn coverage_stage(full: Shaded, f: Fragment, at: Meeting, ray: PixelRay, position: vec3f, passed: Set) -> Shaded {
    let t = at.triangle;
    var spot = Spot(FAR_AWAY, FAR_AWAY, FAR_AWAY, FAR_AWAY, 0u);
    // A cap has no edges and no corners.
    if HAS_WIREFRAME && !is_cap(f.triangle) && items[f.item].across != NONE {
        spot = spot_by_edges(spot, f, t, position, ray);
    }
    if HAS_POINTS && !is_cap(f.triangle) {
        spot.corner = corner_distance(ray, t.a, t.b, t.c);
    }
    var shaded = full;
    var place = stack_start(f.stack);
    if place.found {
        loop {
            if is_filter(place) {
                let amount = soft_amount(place.rank, f.item, position);
                if HIDDEN_LINES {
                    spot.hidden = passed.words[place.rank / 32u] >> (place.rank % 32u) & 1u;
                }
                shaded = faded_shaded(shaded, filter_coverage(ops[place.op], shaded, spot), amount);
            }
            continuing {
                place = stack_next(place);
                break if !place.found;
            }
        }
    }
    return shaded;
}
