// Replaces the base colour texture with `file`. `uv` says where it lies: as the mesh has its coordinates, projected along
// an axis (`planar-x`, `planar-y`, `planar-z`), along the axis that each surface faces most (`box`), or onto a sphere
// around the middle of the scene (`sphere`). Projections map the scene's bounds by their longest side to 0..1; `scale`
// repeats the image over that, or over the unit of the mesh's coordinates.

fn texture_surface(op: Op, before: Surface, reading: Reading) -> Surface {
    var s = before;
    s.texel = reading.texel;
    return s;
}
