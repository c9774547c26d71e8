// False colour by a vertex attribute of the file, such as `_TEMPERATURE`: one number a vertex, or the length of two to
// four. Surfaces without the attribute stay as they are. `range` left out, the least and the greatest value of the scene.

fn attribute_surface(op: Op, before: Surface, reading: Reading) -> Surface {
    return false_colored(before, reading.texel.rgb);
}
