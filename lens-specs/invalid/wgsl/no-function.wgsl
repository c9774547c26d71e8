fn brighten(c: vec3f) -> vec3f {
    return 2.0 * c;
}
