requires readonly_and_readwrite_storage_textures;

fn filter_color(c: vec3f, s: Surface) -> vec3f {
    return c;
}
