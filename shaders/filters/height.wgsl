// False colour by height: the y of the scene, scene units. `range` gives the heights at the ends of the colours; left
// out, the lowest and the highest point of the scene.

fn height_surface(op: Op, before: Surface, reading: Reading) -> Surface {
    return false_colored(before, reading.texel.rgb);
}
