// No lens: the mesh as it is.

@fragment
fn plain(in: Varying) -> @location(0) vec4f {
    return encoded(shaded(in));
}
