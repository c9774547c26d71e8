// Who closes an item at a lens boundary (SEMANTICS 6.6). Twin of `plan/caps.rs`.

// A cap has no triangle: in its place stands this plus the rank of the lens or rule that makes it; twin of `pixel.rs`.
const FIRST_CAP: u32 = 0xfffffdffu;

fn is_cap(triangle: u32) -> bool {
    return CAPS && triangle >= FIRST_CAP && triangle != NONE;
}

struct Closing {
    // The lens or rule whose cap it is; NONE: nothing is closed.
    maker: u32,
    // The lens whose boundary it is, and whether the ray enters it.
    boundary: u32,
    enters: bool,
    // Behind the boundary.
    around: Set,
    stack: Set,
}

// What an item is closed with: in `lens_words` the number of those who close it, then for each its rank, how its caps look,
// their colour, and the filter that draws the line around them, or NONE.
const CAP_WORDS: u32 = 7u;

// Where the cap of a lens or rule stands, or NONE.
fn cap_words(item: u32, maker: u32) -> u32 {
    let first = items[item].caps;
    if first == NONE {
        return NONE;
    }
    for (var i = 0u; i < lens_words[first]; i += 1u) {
        let at = first + 1u + i * CAP_WORDS;
        if lens_words[at] == maker {
            return at;
        }
    }
    return NONE;
}

// Just before a boundary: at such a depth it is not reached, and lenses that meet there are not either.
fn before_boundary(depth: f32) -> f32 {
    return depth - 2.0 * merge_at(depth);
}

fn closing(item: u32, ray: PixelRay, tile: TileRecord, pixel: vec2u, depth: f32) -> Closing {
    var found = Closing(NONE, NONE, false, Set(), Set());
    let here_before = set_at(tile, pixel, before_boundary(depth));
    let here_behind = set_at(tile, pixel, depth);
    let before = walk(item, ray, before_boundary(depth), here_before);
    let behind = walk(item, ray, depth, here_behind);
    if before.displayed == behind.displayed {
        return found;
    }
    var erased = behind.stack;
    if behind.displayed {
        erased = before.stack;
    }
    let maker = maker_of(item, erased);
    if maker == NONE {
        return found;
    }
    // Which lenses change there: each is asked at the point to which the movers above it carry the ray.
    let first = items[item].first_step;
    for (var passed = 0u; passed <= items[item].step_count; passed += 1u) {
        var inside_before = here_before;
        var inside_behind = here_behind;
        if MOVERS && passed != 0u {
            inside_before = set_below(item, first + passed - 1u, ray, before_boundary(depth));
            inside_behind = set_below(item, first + passed - 1u, ray, depth);
        }
        for (var w = 0u; w < WORDS; w += 1u) {
            var asked = by_pixel_word(w) & (item_mask(item, MASK_SCOPE, w) | item_mask(item, MASK_SHOWN_BY, w));
            if MOVERS && passed < items[item].step_count {
                asked &= ~word_below(steps[first + passed].rank, w);
            }
            if MOVERS && passed != 0u {
                asked &= word_below(steps[first + passed - 1u].rank, w);
            }
            let changed = (inside_before.words[w] ^ inside_behind.words[w]) & asked;
            if changed == 0u {
                continue;
            }
            let top = 32u * w + firstLeadingBit(changed);
            let is_maker = maker / 32u == w && (changed >> (maker % 32u) & 1u) != 0u;
            if is_maker || (found.boundary != maker && (found.boundary == NONE || top > found.boundary)) {
                found.boundary = select(top, maker, is_maker);
                found.enters = (inside_behind.words[w] >> (found.boundary % 32u) & 1u) != 0u;
            }
        }
    }
    found.maker = select(maker, NONE, found.boundary == NONE);
    found.around = behind.around;
    found.stack = behind.stack;
    // It keeps the look that the lens which makes it gives it: lower lenses do not act on it.
    for (var w = 0u; w < WORDS && maker < frame.lens_count; w += 1u) {
        found.stack.words[w] &= ~word_below(maker, w);
    }
    return found;
}

// The bits of a word that stand for ranks below one.
fn word_below(rank: u32, word: u32) -> u32 {
    if rank / 32u != word {
        return select(0u, 0xffffffffu, rank / 32u > word);
    }
    return (1u << (rank % 32u)) - 1u;
}

// The highest of a stack that erases an item and closes it; NONE where a mover takes it elsewhere, or nothing shows it.
fn maker_of(item: u32, stack: Set) -> u32 {
    var maker = NONE;
    var shown = (items[item].flags & ITEM_ALTERNATE) == 0u;
    var brought_in = false;
    var step = items[item].first_step;
    let last_step = step + items[item].step_count;
    for (var w = i32(WORDS) - 1; w >= 0; w -= 1) {
        let word = u32(w);
        var rest = stack.words[word];
        while rest != 0u {
            let bit = firstLeadingBit(rest);
            let flag = 1u << bit;
            let rank = 32u * word + bit;
            rest = rest & ~flag;
            if MOVERS && rank < frame.lens_count && !brought_in && (item_mask(item, MASK_MOVERS, word) & flag) != 0u {
                if step == last_step || steps[step].rank != rank {
                    return NONE;
                }
                step += 1u;
            }
            if !brought_in && (item_mask(item, MASK_SHOWN_BY, word) & flag) != 0u {
                brought_in = true;
                shown = true;
            } else if !brought_in && maker == NONE && (item_mask(item, MASK_REMOVED_BY, word) & flag) != 0u
                && cap_words(item, rank) != NONE {
                maker = rank;
            }
        }
    }
    return select(NONE, maker, step == last_step && shown);
}
