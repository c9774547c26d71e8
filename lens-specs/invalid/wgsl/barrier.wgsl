fn filter_color(c: vec3f, s: Surface) -> vec3f {
    workgroupBarrier();
    return c;
}
