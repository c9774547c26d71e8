struct Surface {
    color: vec3f,
}

fn filter_surface(s: Surface) -> Surface {
    return s;
}
