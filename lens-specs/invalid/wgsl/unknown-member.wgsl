fn filter_surface(s: Surface) -> Surface {
    var r = s;
    r.colour = vec3f(1.0);
    return r;
}
