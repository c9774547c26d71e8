// Lists of what each pixel's ray meets, in no order.

@group(2) @binding(0) var<storage, read> layers: array<u32>;
// For each pixel of the window its newest fragment plus one; where something may be cut, then likewise its newest
// crossing with that.
@group(2) @binding(1) var<storage, read_write> heads: array<atomic<u32>>;
// Depth, item, triangle (of a cap see `cap_number`; of a crossing how it winds), and the next of the list plus one.
@group(2) @binding(2) var<storage, read_write> fragments: array<vec4u>;
// Two counters a sample; the first: how many fragments there must be room for.
@group(2) @binding(3) var<storage, read_write> needed: array<atomic<u32>>;

fn head_of(pixel: vec2u) -> u32 {
    return pixel.y * frame.window_size.x + pixel.x;
}

// What the counter stays at: more would make it start again from nothing. Never do so many invocations run at once as there
// are numbers left.
const MOST_COUNTED: u32 = 0xe0000000u;

fn append(head: u32, depth: f32, item: u32, triangle: u32) {
    let counter = 2u * frame.sample_index;
    let slot = atomicAdd(&needed[counter], 1u);
    if slot < frame.fragment_capacity {
        let next = atomicExchange(&heads[head], slot + 1u);
        fragments[slot] = vec4u(bitcast<u32>(depth), item, triangle, next);
    } else if slot > MOST_COUNTED {
        atomicStore(&needed[counter], MOST_COUNTED);
    }
}
