fn filter_surface(s: Surface, p: Params) -> Surface {
    return s;
}
