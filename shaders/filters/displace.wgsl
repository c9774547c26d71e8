// Moves the `nodes` that match, or everything, while they are seen in the lens: by `offset` along the scene's axes, and by
// `explode` times the way from the lens's centre to the centre of each node's bounds.
