// Sets of lenses, the layer of a depth, and the walk down the order: twin of `plan/walk.rs`.

// Bit i of word w stands for the lens of rank 32 w + i.
struct Set {
    words: array<u32, WORDS>,
}

struct Verdict {
    // The lenses around the fragment that apply to it.
    around: Set,
    // Those that act.
    stack: Set,
    displayed: bool,
}

fn item_mask(item: u32, mask: u32, word: u32) -> u32 {
    return items[item].masks[mask * WORDS + word];
}

fn by_pixel_word(word: u32) -> u32 {
    return frame.by_pixel[word / 4u][word % 4u];
}

fn translucent_word(word: u32) -> u32 {
    return frame.translucent[word / 4u][word % 4u];
}

// Who acts on a fragment of an item inside the given lenses (SEMANTICS section 4).
fn walk(item: u32, inside: Set) -> Verdict {
    var around = Set();
    var stack = Set();
    var hidden = Set();
    var displayed = true;
    var shown = false;
    for (var w = i32(WORDS) - 1; w >= 0; w -= 1) {
        let word = u32(w);
        let scope = item_mask(item, MASK_SCOPE, word);
        let shown_by = item_mask(item, MASK_SHOWN_BY, word);
        let removed_by = item_mask(item, MASK_REMOVED_BY, word);
        var rest = ((inside.words[word] & by_pixel_word(word)) | item_mask(item, MASK_OBJECT, word)) & (scope | shown_by);
        while rest != 0u {
            let bit = firstLeadingBit(rest);
            let flag = 1u << bit;
            rest = rest & ~flag;
            let acts = (hidden.words[word] & flag) == 0u;
            let shows = acts && !shown && (shown_by & flag) != 0u;
            if !shows && (scope & flag) == 0u {
                continue;
            }
            around.words[word] |= flag;
            if !acts {
                continue;
            }
            stack.words[word] |= flag;
            for (var j = 0u; j < WORDS; j += 1u) {
                hidden.words[j] |= lenses[word * 32u + bit].hides[j];
            }
            if shows {
                shown = true;
            } else if !shown && (removed_by & flag) != 0u {
                displayed = false;
            }
        }
    }
    displayed = displayed && (shown || (items[item].flags & ITEM_ALTERNATE) == 0u);
    return Verdict(around, stack, displayed);
}

fn may_be_translucent(item: u32, stack: Set) -> bool {
    var found = items[item].flags & ITEM_TRANSLUCENT;
    for (var w = 0u; w < WORDS; w += 1u) {
        found |= stack.words[w] & translucent_word(w);
    }
    return found != 0u;
}
