fn add(count: ptr<function, atomic<u32>>) -> u32 {
    return atomicAdd(count, 1u);
}

fn filter_color(c: vec3f, s: Surface) -> vec3f {
    return c;
}
