fn filter_surface(s: Surface) -> Surface {
    if s.position.y > 1.0 {
        discard;
    }
    return s;
}
