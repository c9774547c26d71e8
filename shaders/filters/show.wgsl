// Shows something else in the lens in place of the scene: an `alternate`, another model in the same space, or exactly the
// `nodes` of the scene that match, those hidden by `[scene] hide` too. `nodes` and `materials` beside an `alternate` say
// what of it is shown: what has one of the names, or one of the materials.
