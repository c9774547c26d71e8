// False colour by the surface normal: its x, y and z from -1 to 1 as red, green and blue. With a `colormap` it is the
// slope that is shown: the normal's part along the scene's up axis (y), from `range`'s low to its high end; 1 is level
// ground seen from above, 0 upright.

fn normals_surface(op: Op, before: Surface, reading: Reading) -> Surface {
    if (op.flags & MAPPED) != 0u {
        return false_colored(before, reading.texel.rgb);
    }
    return false_colored(before, linear_from_srgb3(before.normal * 0.5 + vec3f(0.5)));
}
