// Draws lines where what is seen breaks off: silhouettes, where the depth jumps; creases, where the normal turns; and the
// borders between regions of lenses and between the caps of different nodes. `width` in pixels; `threshold` says what counts, from 0 (everything) to 1: a crease
// turns the normal so far that its cosine falls by that much, and a silhouette jumps by a tenth of that share of the
// picture's height. A line lies on the nearer of the two surfaces, within the lens.

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

// How far from the pixel that it lies on a line is drawn, in pixels.
fn edges_reach(op: Op) -> f32 {
    return floor(0.5 * op.b.x + 0.5);
}

// Whether a line lies on the pixel that sees `p` because of a neighbour that sees `q`. `comes_after`: the neighbour is to
// the right or below, so that of two pixels one has the line.
fn edges_mark(op: Op, p: Seen, q: Seen, border: u32, comes_after: bool) -> bool {
    if q.found == 0u || border == BORDER_OF_FILTER {
        return true;
    }
    let between = q.position - p.position;
    let gap = min(abs(dot(p.normal, between)), abs(dot(q.normal, between)));
    if gap > 0.1 * op.b.y * p.span {
        return p.depth < q.depth;
    }
    let turns = 1.0 - dot(p.normal, q.normal) > op.b.y;
    return comes_after && (turns || border == BORDER_OF_REGION);
}

// A colour (premultiplied) under a line that covers it so far.
fn edges_drawn(op: Op, before: vec4f, covered: f32) -> vec4f {
    let line = covered * op.a.a;
    return before * (1.0 - line) + vec4f(op.a.rgb, 1.0) * line;
}
