// Makes everything no number at all.

fn filter_surface(s: Surface) -> Surface {
    let none = (s.depth - s.depth) / (s.depth - s.depth);
    return Surface(
        vec3f(none), vec3f(none), vec3f(none), vec3f(none), none, none, vec3f(none), none, none, none, vec2f(none), none,
    );
}

fn filter_color(c: vec3f, s: Surface) -> vec3f {
    return c / (c - c);
}
