// Gives surfaces another material. What is not given stays the surface's own: `color` replaces the base colour with its
// texture, `metallic` and `roughness` the two numbers of glTF's metallic-roughness model, `emissive` the light that the
// surface sends out by itself.

const MATERIAL_COLOR: u32 = 1u;
const MATERIAL_METALLIC: u32 = 2u;
const MATERIAL_ROUGHNESS: u32 = 4u;
const MATERIAL_EMISSIVE: u32 = 8u;

fn material_surface(op: Op, before: Surface) -> Surface {
    var s = before;
    if (op.flags & MATERIAL_COLOR) != 0u {
        s = with_base_color(s, op.a);
    }
    if (op.flags & MATERIAL_METALLIC) != 0u {
        s.metallic = op.b.x;
    }
    if (op.flags & MATERIAL_ROUGHNESS) != 0u {
        s.roughness = op.b.y;
    }
    if (op.flags & MATERIAL_EMISSIVE) != 0u {
        s.emissive = op.c.rgb;
        s.opacity = s.opacity * op.c.a;
    }
    return s;
}
