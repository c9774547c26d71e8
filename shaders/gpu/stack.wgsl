// The filters of a stack, lowest lens first.
//
// One flat sequence, and loops over it that ask at their end whether to go on: where many pixels run side by side, a
// loop within a loop is paid for by all of them, and a question at the start by one more round.

struct StackPlace {
    // The lens, and the next filter among `ops`; those of the lens end at `end`.
    rank: u32,
    op: u32,
    end: u32,
    // The lenses that come after it.
    rest: Set,
    found: bool,
}

fn stack_start(stack: Set) -> StackPlace {
    return next_in_stack(StackPlace(0u, 0u, 0u, stack, true));
}

// The next filter, or the next lens, which may have none.
fn stack_next(place: StackPlace) -> StackPlace {
    if place.op + 1u < place.end {
        var next = place;
        next.op += 1u;
        return next;
    }
    return next_in_stack(place);
}

fn next_in_stack(place: StackPlace) -> StackPlace {
    var next = place;
    next.found = false;
    for (var w = 0u; w < WORDS; w += 1u) {
        let word = next.rest.words[w];
        if !next.found && word != 0u {
            next.rest.words[w] = word & (word - 1u);
            next.rank = w * 32u + firstTrailingBit(word);
            next.found = true;
        }
    }
    if next.found {
        next.op = lenses[next.rank].first_op;
        next.end = next.op + lenses[next.rank].op_count;
    }
    return next;
}

fn is_filter(place: StackPlace) -> bool {
    return place.op < place.end;
}
