// Shows something else in the lens in place of the scene: an `alternate`, another model in the same space, or exactly the
// `nodes` of the scene that match, those hidden by `[scene] hide` too.
