// Who acts on a fragment: the walk down the order (SEMANTICS sections 3 to 5). Twin of `plan/walk.rs`.

struct Verdict {
    // The lenses around the fragment that apply to it.
    around: Set,
    // Those that act, or the rule that acts in their place.
    stack: Set,
    // It is there, in one version or another.
    there: bool,
    // The share of the triangles in the version that is seen.
    ratio: f32,
    // It is there, and in this version, or it fills a gap between versions.
    displayed: bool,
    // It is seen only where no surface lies within its spread behind it.
    fills: bool,
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

// A word of the lenses that may mean something to an item, of those around a point.
fn applying_word(item: u32, around: Set, word: u32) -> u32 {
    let reached = (around.words[word] & by_pixel_word(word)) | item_mask(item, MASK_OBJECT, word);
    return reached & (item_mask(item, MASK_SCOPE, word) | item_mask(item, MASK_SHOWN_BY, word));
}

// What the lenses do where the pixel's ray meets an item at a depth, inside the lenses `here`.
fn walk(item: u32, ray: PixelRay, depth: f32, here: Set) -> Verdict {
    if RULES {
        let rule = rule_for(item, here);
        if rule != NONE {
            return rule_verdict(item, rule, here);
        }
    }
    var verdict = Verdict(Set(), Set(), false, 1.0, false, false);
    var is_decided = false;
    var inside = here;
    var hidden = Set();
    var removed = false;
    var shown = false;
    var step = items[item].first_step;
    let last_step = step + items[item].step_count;
    for (var w = i32(WORDS) - 1; w >= 0; w -= 1) {
        let word = u32(w);
        let scope = item_mask(item, MASK_SCOPE, word);
        let shown_by = item_mask(item, MASK_SHOWN_BY, word);
        let removed_by = item_mask(item, MASK_REMOVED_BY, word);
        let movers = item_mask(item, MASK_MOVERS, word);
        var rest = applying_word(item, inside, word);
        if rest == 0u {
            continue;
        }
        loop {
            let bit = firstLeadingBit(rest);
            let flag = 1u << bit;
            let rank = word * 32u + bit;
            rest = rest & ~flag;
            let acts = (hidden.words[word] & flag) == 0u;
            let shows = acts && !shown && (shown_by & flag) != 0u;
            if !shows && (scope & flag) == 0u {
                continue;
            }
            verdict.around.words[word] |= flag;
            if !acts {
                continue;
            }
            verdict.stack.words[word] |= flag;
            for (var j = 0u; j < WORDS; j += 1u) {
                hidden.words[j] |= lenses[rank].hides[j];
            }
            if VERSIONS && !shown && !is_decided && (item_mask(item, MASK_SIMPLIFIED_BY, word) & flag) != 0u {
                is_decided = true;
                verdict.ratio = lenses[rank].lod;
            }
            if MOVERS && !shown && (movers & flag) != 0u {
                if step == last_step || steps[step].rank != rank {
                    // It is seen elsewhere; only an account asks who else acts here.
                    if frame.after_key == NONE {
                        return verdict;
                    }
                    removed = true;
                } else {
                    inside = set_below(item, step, ray, depth);
                    rest = applying_word(item, inside, word) & (flag - 1u);
                    step += 1u;
                }
            }
            if shows {
                shown = true;
            } else if !shown && (removed_by & flag) != 0u {
                removed = true;
            }
            continuing {
                break if rest == 0u;
            }
        }
    }
    let is_there = shown || (items[item].flags & ITEM_ALTERNATE) == 0u;
    verdict.there = step == last_step && !removed && is_there;
    verdict.displayed = verdict.there && is_version(item, verdict.ratio);
    return verdict;
}

fn is_version(item: u32, ratio: f32) -> bool {
    return !VERSIONS || ratio == items[item].ratio;
}

// How near another version must be seen for an item to fill gaps, in its spread; twin of `instances.rs`.
const FILLING_REACH: f32 = 4.0;

// The same at a depth of the pixel's own ray. Simplified surfaces do not quite meet those that they stand for: a ray may
// miss each of two versions where it is seen. So that no gap opens, all of an item fills in where another version is seen
// close by, as if it lay its spread farther from the eye. What is seen through does not: it would be seen twice.
fn verdict_at(item: u32, ray: PixelRay, tile: TileRecord, pixel: vec2u, depth: f32, here: Set) -> Verdict {
    var verdict = walk(item, ray, depth, here);
    if VERSIONS && verdict.there && !verdict.displayed && items[item].ratio == 1.0
        && !may_be_translucent(item, verdict.stack) {
        for (var side = -1.0; side < 2.0; side += 2.0) {
            let close_by = clamp(depth + side * FILLING_REACH * items[item].spread, frame.near, frame.far);
            let other = walk(item, ray, close_by, set_at(tile, pixel, close_by));
            verdict.fills = verdict.fills || (other.there && other.ratio != verdict.ratio);
        }
        verdict.displayed = verdict.fills;
    }
    return verdict;
}

// The rank of the last rule that holds where the given lenses are around an item, or NONE.
fn rule_for(item: u32, around: Set) -> u32 {
    for (var rank = frame.lens_count + frame.rule_count; rank > frame.lens_count; rank -= 1u) {
        if rule_holds(rank - 1u, item, around) {
            return rank - 1u;
        }
    }
    return NONE;
}

// The parts of a rule are the names in its condition: each is the set of lenses of which one must be there.
fn rule_holds(rank: u32, item: u32, around: Set) -> bool {
    inside_parts = array<u32, PART_WORDS>();
    for (var i = 0u; i < lenses[rank].part_count; i += 1u) {
        var met = 0u;
        for (var w = 0u; w < WORDS; w += 1u) {
            let containing = applying_word(item, around, w) & item_mask(item, MASK_SCOPE, w);
            met |= lens_words[lenses[rank].first_part + i * WORDS + w] & containing;
        }
        if met != 0u {
            cross_part(i);
        }
    }
    return program_holds(rank);
}

// A rule's filters are the whole stack, on the plain scene: what lenses move or show is not there.
fn rule_verdict(item: u32, rule: u32, here: Set) -> Verdict {
    var verdict = Verdict(Set(), Set(), false, 1.0, false, false);
    for (var w = 0u; w < WORDS; w += 1u) {
        verdict.around.words[w] = applying_word(item, here, w) & item_mask(item, MASK_SCOPE, w);
    }
    let word = rule / 32u;
    let flag = 1u << (rule % 32u);
    verdict.stack.words[word] = flag;
    let shown = (item_mask(item, MASK_SHOWN_BY, word) & flag) != 0u;
    let gone = (item_mask(item, MASK_REMOVED_BY, word) & flag) != 0u || (items[item].flags & ITEM_ALTERNATE) != 0u;
    if (item_mask(item, MASK_SIMPLIFIED_BY, word) & flag) != 0u {
        verdict.ratio = lenses[rule].lod;
    }
    verdict.there = items[item].step_count == 0u && (shown || !gone);
    verdict.displayed = verdict.there && is_version(item, verdict.ratio);
    return verdict;
}

fn may_be_translucent(item: u32, stack: Set) -> bool {
    var found = items[item].flags & ITEM_TRANSLUCENT;
    for (var w = 0u; w < WORDS; w += 1u) {
        found |= stack.words[w] & translucent_word(w);
    }
    return found != 0u;
}
