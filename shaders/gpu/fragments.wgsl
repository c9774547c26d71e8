// What a pixel's ray met, nearest first: listed fragments and the opaque one that ends them.

@group(2) @binding(0) var<storage, read> layers: array<u32>;
@group(2) @binding(1) var<storage, read> heads: array<u32>;
@group(2) @binding(2) var<storage, read> fragments: array<vec4u>;
@group(2) @binding(3) var visibility: texture_2d<u32>;

struct Pick {
    depth: f32,
    // At equal depths the lower is in front.
    key: u32,
    item: u32,
    triangle: u32,
    found: bool,
}

fn nothing() -> Pick {
    return Pick(FAR_AWAY, NONE, 0u, 0u, false);
}

fn is_before(a: Pick, b: Pick) -> bool {
    return a.depth < b.depth || (a.depth == b.depth && a.key < b.key);
}

fn opaque_at(pixel: vec2u, ray: PixelRay) -> Pick {
    let seen = textureLoad(visibility, vec2i(pixel), 0);
    if seen.x == 0u {
        return nothing();
    }
    let item = seen.x - 1u;
    return Pick(meeting(item, seen.y, ray).hit.depth, triangle_number(item, seen.y), item, seen.y, true);
}

// The number by which fragments at one depth are ordered; a cap comes before all triangles of its item.
fn listed_key(item: u32, triangle: u32) -> u32 {
    if is_cap(triangle) {
        return items[item].first_triangle;
    }
    return triangle_number(item, triangle);
}

// The nearest listed fragment behind `after`.
fn next_listed(pixel: vec2u, after: Pick) -> Pick {
    var best = nothing();
    var slot = heads[pixel.y * frame.window_size.x + pixel.x];
    while slot != 0u {
        let f = fragments[slot - 1u];
        slot = f.w;
        let candidate = Pick(bitcast<f32>(f.x), listed_key(f.y, f.z), f.y, f.z, true);
        if is_before(after, candidate) && is_before(candidate, best) {
            best = candidate;
        }
    }
    return best;
}

// The nearest fragment behind `after`; the opaque one is the last.
fn next_fragment(pixel: vec2u, opaque: Pick, after: Pick) -> Pick {
    if !TRANSLUCENT && !CAPS {
        if is_before(after, opaque) {
            return opaque;
        }
        return nothing();
    }
    let listed = next_listed(pixel, after);
    if !opaque.found || is_before(listed, opaque) {
        return listed;
    }
    if is_before(after, opaque) {
        return opaque;
    }
    return nothing();
}

// The lenses and rules that act on fragments up to a shaded one; what has no opacity hides no lines.
fn also_passed(passed: Set, fragment: Fragment, shaded: ShadedFragment) -> Set {
    if !HIDDEN_LINES || shaded.opacity <= 0.0 {
        return passed;
    }
    var all = passed;
    for (var w = 0u; w < WORDS; w += 1u) {
        all.words[w] |= fragment.stack.words[w];
    }
    return all;
}

// The visible fragment (SEMANTICS 6.4) of those that a ray has met so far, nearest first.
struct Visible {
    found: bool,
    // It is opaque.
    ends: bool,
    fragment: Fragment,
    normal: vec3f,
}

// The same after one more fragment.
fn and_seen(before: Visible, fragment: Fragment, shaded: ShadedFragment) -> Visible {
    if before.ends || shaded.opacity * shaded.coverage <= 0.0 || shaded.coverage < 0.5 {
        return before;
    }
    let ends = shaded.opacity >= OPAQUE_FROM;
    if before.found && !ends {
        return before;
    }
    return Visible(true, ends, fragment, shaded.normal);
}

// A fragment, and where the pixel's ray meets it.
struct Met {
    fragment: Fragment,
    at: Meeting,
}

fn met_at(pick: Pick, tile: TileRecord, pixel: vec2u, ray: PixelRay) -> Met {
    if is_cap(pick.triangle) {
        let closed = closing(pick.item, ray, tile, pixel, pick.depth);
        let fragment = Fragment(pick.item, pick.triangle, pick.depth, closed.around, closed.stack);
        return Met(fragment, cap_meeting(pick.item, closed, ray, pixel, pick.depth));
    }
    let at = meeting(pick.item, pick.triangle, ray);
    return Met(classified(pick, tile, pixel, ray), at);
}

fn classified(pick: Pick, tile: TileRecord, pixel: vec2u, ray: PixelRay) -> Fragment {
    // Without filters that act on what is seen nobody asks.
    if !LENSES || !(SURFACE_FILTERS || COLOR_FILTERS || COVERAGE_FILTERS || SCREEN || ACCOUNTS) {
        return Fragment(pick.item, pick.triangle, pick.depth, Set(), Set());
    }
    let verdict = walk(pick.item, ray, pick.depth, set_at(tile, pixel, pick.depth));
    return Fragment(pick.item, pick.triangle, pick.depth, verdict.around, verdict.stack);
}
