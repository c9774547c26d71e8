// How rays count the triangles of surfaces that enclose something. Twin of `pieces/mod.rs`.

// Bit 0 of a role: it is turned round, of a piece that faces one way. The others: 0 for such a piece, else one more than the
// slot of a piece that is told by parity, or SLOT_OPEN for one that encloses nothing.
const SLOT_OPEN: u32 = 63u;

// What lies around a point, by the crossings of a ray from it.
struct Around {
    winding: i32,
    // Bit i: the pieces of slot i are crossed an odd number of times.
    odd: u32,
}

// How a crossing counts, in a word; `left`: the triangle's corners run to the left, or all to the right where they should.
fn crossing_word(slot: u32, left: bool) -> u32 {
    return select(slot + 1u, select(0xffffffffu, 1u, left), slot == 0u);
}

fn also_crossed(before: Around, word: u32) -> Around {
    if word == 1u || word == 0xffffffffu {
        return Around(before.winding + bitcast<i32>(word), before.odd);
    }
    return Around(before.winding, before.odd ^ (1u << (word - 2u)));
}

fn is_enclosed(around: Around) -> bool {
    return around.winding != 0 || around.odd != 0u;
}
