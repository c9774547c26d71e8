fn filter_surface(s: Surface) -> Surface {
    s.opacity = 0.5;
    return s;
}
