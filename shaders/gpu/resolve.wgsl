// Composites each pixel's fragments and lens surfaces front to back, exactly, however many there are.

// Premultiplied linear colour, summed over the samples.
@group(2) @binding(4) var<storage, read_write> accumulated: array<vec4f>;

fn composited(pixel: vec2u) -> vec4f {
    let ray = pixel_ray(pixel);
    let at = lens_ray(sample_point(pixel));
    let tile = tile_at(pixel);
    let opaque = opaque_at(pixel, ray);
    var front = vec4f(0.0);
    var pick = Pick(-FAR_AWAY, 0u, 0u, 0u, false);
    var glass = no_glass(-FAR_AWAY, 0u);
    var needs_pick = true;
    var needs_glass = true;
    loop {
        if needs_pick {
            pick = next_fragment(pixel, opaque, pick);
        }
        if needs_glass {
            glass = next_glass(tile, pixel, glass);
        }
        needs_glass = glass.found && glass.depth < pick.depth;
        needs_pick = !needs_glass;
        if needs_glass {
            let color = glass_color(glass, at, ray);
            front = over(front, color.rgb, color.a);
            continue;
        }
        if !pick.found {
            break;
        }
        let shaded = shade(classified(pick, tile, pixel, ray), ray);
        let opacity = shaded.opacity * shaded.coverage;
        front = over(front, shaded.color, opacity);
        if opacity >= OPAQUE_FROM {
            break;
        }
    }
    return front;
}

@compute @workgroup_size(8, 8)
fn resolve(@builtin(global_invocation_id) id: vec3u) {
    if any(id.xy >= frame.window_size) {
        return;
    }
    let at = id.y * frame.window_size.x + id.x;
    var sum = composited(id.xy);
    if frame.sample_index > 0u {
        sum += accumulated[at];
    }
    accumulated[at] = sum;
}
