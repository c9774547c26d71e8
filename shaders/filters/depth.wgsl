// False colour by depth: the distance from the eye along the camera's forward axis, scene units. `range` gives the depths
// at the ends of the colours; left out, the nearest and the farthest depth of the scene's bounds in view.

fn depth_surface(op: Op, before: Surface, reading: Reading) -> Surface {
    return false_colored(before, reading.texel.rgb);
}
