// Composites each pixel's fragments and lens surfaces front to back, exactly, however many there are, and puts the mean
// of the samples over the background, as straight alpha in sRGB.

// Premultiplied linear colour summed over the samples, where there are several.
@group(2) @binding(4) var<storage, read_write> accumulated: array<vec4f>;
// Or all of one sample, for filters of the screen.
@group(2) @binding(4) var<storage, read_write> samples: array<ScreenSample>;

// A corner of a tile: those that lenses touch, and the others, are drawn by shaders that can do no more than they need.
@vertex
fn tile_vertex(@builtin(vertex_index) vertex: u32, @builtin(instance_index) index: u32) -> @builtin(position) vec4f {
    let corner = tile_corner(tile_in_order(index)) + vec2u(vertex & 1u, vertex >> 1u) * TILE;
    let at = vec2f(corner) / vec2f(frame.window_size);
    return vec4f(2.0 * at.x - 1.0, 1.0 - 2.0 * at.y, 0.0, 1.0);
}

// A pixel's premultiplied linear colour and, for filters of the screen, what is visible at it.
struct Composited {
    color: vec4f,
    visible: Visible,
}

fn composited(pixel: vec2u) -> Composited {
    let ray = pixel_ray(pixel);
    let tile = tile_at(pixel);
    if !TRANSLUCENT && !GLASS && !CAPS {
        return opaque_color(tile, pixel, ray);
    }
    let at = lens_ray(sample_point(pixel));
    let opaque = opaque_at(pixel, ray);
    var front = vec4f(0.0);
    var visible: Visible;
    var pick = Pick(-FAR_AWAY, 0u, 0u, 0u, false);
    var glass = no_glass(-FAR_AWAY, 0u);
    var passed = Set();
    var needs_pick = true;
    var needs_glass = GLASS;
    loop {
        if needs_pick {
            pick = next_fragment(pixel, opaque, pick);
        }
        if GLASS && needs_glass {
            glass = next_glass(tile, pixel, glass);
        }
        needs_glass = glass.found && is_in_front(glass, pick);
        needs_pick = !needs_glass;
        if GLASS && needs_glass {
            let color = glass_color(glass, at, ray);
            front = over(front, color.rgb, color.a);
            continue;
        }
        if !pick.found {
            break;
        }
        let met = met_at(pick, tile, pixel, ray);
        var shaded = shade(met.fragment, met.at, ray, passed);
        if CONTACT {
            shaded.color = with_contact_lines(shaded.color, met.fragment, met.at, tile, pixel, ray);
        }
        passed = also_passed(passed, met.fragment, shaded);
        if SCREEN {
            visible = and_seen(visible, met.fragment, shaded);
        }
        let opacity = shaded.opacity * shaded.coverage;
        front = over(front, shaded.color, opacity);
        if opacity >= OPAQUE_FROM {
            break;
        }
    }
    return Composited(front, visible);
}

// Whether a lens surface is in front of a fragment. A cap lies in one, and covers it whatever rounding makes of that.
fn is_in_front(glass: GlassHit, pick: Pick) -> bool {
    if is_cap(pick.triangle) {
        return starts_boundary(glass.depth, pick.depth);
    }
    return glass.depth < pick.depth;
}

// The same where nothing is seen through anything: one fragment at the most, met once.
fn opaque_color(tile: TileRecord, pixel: vec2u, ray: PixelRay) -> Composited {
    var visible: Visible;
    let seen = textureLoad(visibility, vec2i(pixel), 0);
    if seen.x == 0u {
        return Composited(vec4f(0.0), visible);
    }
    let met = meeting(seen.x - 1u, seen.y, ray);
    let pick = Pick(met.hit.depth, 0u, seen.x - 1u, seen.y, true);
    let fragment = classified(pick, tile, pixel, ray);
    let shaded = shade(fragment, met, ray, Set());
    if SCREEN {
        visible = and_seen(visible, fragment, shaded);
    }
    return Composited(over(vec4f(0.0), shaded.color, shaded.opacity * shaded.coverage), visible);
}

@fragment
fn resolve(@builtin(position) position: vec4f) -> @location(0) vec4f {
    let pixel = vec2u(position.xy);
    var sum = composited(pixel).color;
    if frame.samples > 1u {
        let at = pixel.y * frame.window_size.x + pixel.x;
        if frame.sample_index > 0u {
            sum += accumulated[at];
        }
        accumulated[at] = sum;
    }
    // Of several samples the last one draws the picture.
    return finished(sum / f32(frame.samples));
}

// One sample, for the filters of the screen (`screen.wgsl`), which come before samples are summed.
@compute @workgroup_size(8, 8)
fn resolve_sample(@builtin(global_invocation_id) id: vec3u) {
    if any(id.xy >= frame.window_size) {
        return;
    }
    let seen = composited(id.xy);
    let fragment = seen.visible.fragment;
    var item = select(0u, fragment.item + 1u, seen.visible.found);
    var outline = 0u;
    if item != 0u && is_cap(fragment.triangle) {
        item |= SEEN_CAP;
        let words = cap_words(fragment.item, fragment.triangle - FIRST_CAP);
        if words != NONE {
            outline = lens_words[words + 6u] + 1u;
        }
    }
    samples[id.y * frame.window_size.x + id.x] =
        ScreenSample(
            seen.color,
            seen.visible.normal,
            fragment.depth,
            item,
            outline,
            fragment.around,
            fragment.stack,
        );
}
