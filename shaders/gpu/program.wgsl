// The tree of a lens with several parts or a mesh, or the condition of a rule, as a program in postfix order: twin of
// `program.rs`.

// The lower two bits of a word of a program; the others number a part of the lens or a name of the condition.
const TOKEN_INSIDE: u32 = 0u;
const TOKEN_OUTSIDE: u32 = 1u;
const TOKEN_BOTH: u32 = 2u;
const TOKEN_EITHER: u32 = 3u;

// Which parts of the lens at hand hold the point at hand, or which names of the condition do.
var<private> inside_parts: array<u32, PART_WORDS>;

fn is_inside_part(number: u32) -> bool {
    return (inside_parts[number / 32u] & (1u << (number % 32u))) != 0u;
}

fn cross_part(number: u32) {
    inside_parts[number / 32u] ^= 1u << (number % 32u);
}

// Of a flat lens (`LENS_FLAT`), whose program is all its parts in turn, joined in one way: whether a part is as it needs it.
fn is_met(rank: u32, part: u32) -> bool {
    let token = lens_words[lenses[rank].first_token + select(2u * part - 1u, 0u, part == 0u)];
    return is_inside_part(part) == ((token & 3u) == TOKEN_INSIDE);
}

fn met_parts(rank: u32) -> u32 {
    var met = 0u;
    for (var part = 0u; part < lenses[rank].part_count; part += 1u) {
        met += select(0u, 1u, is_met(rank, part));
    }
    return met;
}

// Whether it then holds: all of its parts are as it needs them, or one is.
fn flat_holds(rank: u32, met: u32) -> bool {
    let all = (lens_words[lenses[rank].first_token + 2u] & 3u) == TOKEN_BOTH;
    return met >= select(1u, lenses[rank].part_count, all);
}

// Whether the lens or the condition as a whole then holds. A lens without a program is its only part.
fn program_holds(rank: u32) -> bool {
    // One bit a value, the newest lowest: the host orders programs so that they never need more than 32.
    var stack = inside_parts[0] & 1u;
    let first = lenses[rank].first_token;
    for (var i = first; i < first + lenses[rank].token_count; i += 1u) {
        let token = lens_words[i];
        switch token & 3u {
            case TOKEN_BOTH: {
                stack = (stack >> 1u) & (stack | 0xfffffffeu);
            }
            case TOKEN_EITHER: {
                stack = (stack >> 1u) | (stack & 1u);
            }
            default: {
                let inside = is_inside_part(token >> 2u) == ((token & 3u) == TOKEN_INSIDE);
                stack = (stack << 1u) | select(0u, 1u, inside);
            }
        }
    }
    return (stack & 1u) != 0u;
}
