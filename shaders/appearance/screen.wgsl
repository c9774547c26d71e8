// What the screen-space filters share.

// How far a filter looks, in pixels.
fn screen_reach(op: Op) -> f32 {
    if op.kind == OP_BLUR {
        return ceil(op.b.x);
    }
    if op.kind == OP_PIXELATE {
        return pixelate_side(op) - 1.0;
    }
    // A line, and the neighbour that makes it one.
    return line_reach(op) + 1.0;
}

// What is seen at a pixel.
struct Seen {
    // 0: nothing.
    found: u32,
    depth: f32,
    // Around the eye.
    position: vec3f,
    normal: vec3f,
    // Height of the picture at this depth, scene units.
    span: f32,
}

const BORDER_NONE: u32 = 0u;
// Other lenses are around the neighbour, or it is the cap of another node.
const BORDER_OF_REGION: u32 = 1u;
// The filter does not act on the neighbour.
const BORDER_OF_FILTER: u32 = 2u;

const MARK_NONE: u32 = 0u;
// The middle of a line lies on the pixel.
const MARK_SHARED: u32 = 1u;
// Its outer side does, and all of it within.
const MARK_ALONE: u32 = 2u;

// How the line lies that the pixel that sees `p` has because of a neighbour that sees `q`, of a filter that draws lines:
// `edges`, or the outline of caps. `comes_after`: the neighbour is to the right or below, so that of two pixels one has
// the line.
fn line_mark(op: Op, p: Seen, q: Seen, border: u32, comes_after: bool) -> u32 {
    let at_an_end = select(MARK_SHARED, MARK_ALONE, op.kind == OP_ERASE);
    if q.found == 0u || border == BORDER_OF_FILTER {
        return at_an_end;
    }
    let between = q.position - p.position;
    let gap = min(abs(dot(p.normal, between)), abs(dot(q.normal, between)));
    if gap > 0.1 * op.b.y * p.span {
        return select(MARK_NONE, at_an_end, p.depth < q.depth);
    }
    let turns = 1.0 - dot(p.normal, q.normal) > op.b.y;
    return select(MARK_NONE, MARK_SHARED, comes_after && (turns || border == BORDER_OF_REGION));
}

// How far from the pixel that has the mark a line is drawn, in pixels.
fn line_reach(op: Op) -> f32 {
    return floor(select(0.5, 1.0, op.kind == OP_ERASE) * op.b.x + 0.5);
}

// A colour (premultiplied) so many pixels from the nearest marks of both kinds.
fn under_lines(op: Op, before: vec4f, shared_away: f32, alone_away: f32) -> vec4f {
    let width = op.b.x;
    // The outermost pixel is covered whole, too.
    let within = max(alone_away - 0.5 * max(width - 1.0, 0.0), 0.0);
    let line = max(line_coverage(shared_away, width), line_coverage(within, width)) * op.a.a;
    return before * (1.0 - line) + vec4f(op.a.rgb, 1.0) * line;
}

// How many pixels of a line a filter that takes means reads at a time.
fn mean_side(op: Op) -> f32 {
    if op.kind == OP_PIXELATE {
        return pixelate_side(op);
    }
    return 2.0 * screen_reach(op) + 1.0;
}
