// Where a ray crosses a closed mesh: every crossing once, also at the edges and corners that triangles share.
//
// The mesh is seen along the ray, after Woop, Benthin and Wald (2013), "Watertight Ray/Triangle Intersection": a corner
// becomes one point of the plane across the ray, and an edge one number, whichever triangle asks.

// Words of a node in `lens_words`, twin of `lens::MeshNode`: the lower corner of its box, its first triangle (a leaf) or
// the node to go on with where the ray misses it (an inner node), the upper corner, how many triangles (0: inner node).
const NODE_WORDS: u32 = 8u;
// Boxes are larger by this, so that rounding loses no triangle of a mesh between -1 and 1.
const BOX_PADDING: f32 = 4e-6;

// A ray in the mesh's own space.
struct MeshLine {
    // The point of the picture.
    at: vec2f,
    // The point nearest to the mesh's middle, and its parameter.
    origin: vec3f,
    shift: f32,
    direction: vec3f,
    // Two axes across the ray.
    u: vec3f,
    v: vec3f,
}

struct MeshCrossing {
    t: f32,
    triangle: u32,
    // Its node; where to go on.
    node: u32,
    found: bool,
    // See `crossing_word`.
    word: u32,
}

// A triangle's first corner has in its upper bits the slot of its piece, one more where it is told by parity.
const SLOT_SHIFT: u32 = 26u;
const INDEX_MASK: u32 = 0x03ffffffu;

fn mesh_word(part: u32, triangle: u32, left: bool) -> u32 {
    var slot = 0u;
    if (parts[part].flags & PART_PARITY) != 0u {
        slot = lens_words[parts[part].first_triangle + 3u * triangle] >> SLOT_SHIFT;
    }
    return crossing_word(slot, left);
}

fn mesh_line(part: u32, lens_ray: LensRay) -> MeshLine {
    return line_along(local_ray(part, lens_ray), lens_ray.at);
}

fn line_along(ray: LocalRay, at: vec2f) -> MeshLine {
    let start = anchored(ray, vec3f(0.0));
    let d = abs(ray.direction);
    let least = select(select(vec3f(0.0, 0.0, 1.0), vec3f(0.0, 1.0, 0.0), d.y <= d.z), vec3f(1.0, 0.0, 0.0), d.x <= min(d.y, d.z));
    let u = normalize(cross(ray.direction, least));
    return MeshLine(at, start.origin, start.shift, ray.direction, u, normalize(cross(ray.direction, u)));
}

fn lens_vector(at: u32) -> vec3f {
    return vec3f(bitcast<f32>(lens_words[at]), bitcast<f32>(lens_words[at + 1u]), bitcast<f32>(lens_words[at + 2u]));
}

// Before the first crossing.
fn before_mesh() -> MeshCrossing {
    return MeshCrossing(-FAR_AWAY, NONE, 0u, true, 1u);
}

// The crossing after another in the order of the triangles: of those listed, or else of all. One walk over the nodes in
// their order, children after their parents, then visits all boxes that the ray meets; it goes on anywhere.
fn next_in_mesh(asked: AskedPart, line: MeshLine, last: MeshCrossing) -> MeshCrossing {
    let part = asked.part;
    var node = last.node;
    if asked.first != NONE {
        // Places in the list stand for nodes.
        while asked.first + node < asked.end {
            let triangle = tiles[asked.first + node];
            let crossing = projected_crossing(part, line.at, triangle);
            node += 1u;
            if crossing.found {
                return MeshCrossing(crossing.t, triangle, node, true, mesh_word(part, triangle, crossing.left));
            }
        }
        return MeshCrossing(0.0, 0u, node, false, 1u);
    }
    while node < parts[part].node_count {
        let at = parts[part].first_node + node * NODE_WORDS;
        let first = lens_words[at + 3u];
        let count = lens_words[at + 7u];
        if meets_box(line, lens_vector(at), lens_vector(at + 4u)) {
            for (var triangle = max(first, last.triangle + 1u); triangle < first + count; triangle += 1u) {
                let crossing = triangle_crossing(part, line, triangle);
                if crossing.found {
                    return MeshCrossing(crossing.t, triangle, node, true, mesh_word(part, triangle, crossing.left));
                }
            }
            node += 1u;
        } else {
            node = select(node + 1u, first, count == 0u);
        }
    }
    return MeshCrossing(0.0, 0u, node, false, 1u);
}

// Whether an endless line meets a box: no axis across the line and a side of the box separates them.
fn meets_box(line: MeshLine, low: vec3f, high: vec3f) -> bool {
    let half = 0.5 * (high - low) + BOX_PADDING;
    let d = abs(line.direction);
    let away = abs(cross(line.direction, 0.5 * (low + high) - line.origin));
    return all(away <= half.yzx * d.zxy + half.zxy * d.yzx);
}

// A corner of a triangle as the ray sees it.
struct SeenCorner {
    index: u32,
    // In the plane across the ray, which is at the origin.
    across: vec2f,
    along: f32,
}

fn seen_corner(part: u32, line: MeshLine, index: u32) -> SeenCorner {
    let p = lens_vector(parts[part].first_vertex + 3u * index) - line.origin;
    return SeenCorner(index, vec2f(dot(line.u, p), dot(line.v, p)), dot(line.direction, p));
}

struct TriangleCrossing {
    t: f32,
    found: bool,
    // Its corners run to the left.
    left: bool,
}

fn triangle_crossing(part: u32, line: MeshLine, triangle: u32) -> TriangleCrossing {
    let at = parts[part].first_triangle + 3u * triangle;
    let a = seen_corner(part, line, lens_words[at] & INDEX_MASK);
    let b = seen_corner(part, line, lens_words[at + 1u]);
    let c = seen_corner(part, line, lens_words[at + 2u]);
    let areas = vec3f(edge_area(b, c), edge_area(c, a), edge_area(a, b));
    let left = vec3<bool>(is_left(b, c, areas.x), is_left(c, a, areas.y), is_left(a, b, areas.z));
    if any(left) && !all(left) {
        return TriangleCrossing(0.0, false, false);
    }
    let along = dot(areas, vec3f(a.along, b.along, c.along)) / (areas.x + areas.y + areas.z);
    return TriangleCrossing(line.shift + along / dot(line.direction, line.direction), true, all(left));
}

// The same for a triangle in front of the eye, as the picture shows it.
fn projected_crossing(part: u32, at: vec2f, triangle: u32) -> TriangleCrossing {
    let first = parts[part].first_projected + 4u * triangle;
    let p = at - parts[part].origin;
    let a = lens_data[first];
    let b = lens_data[first + 1u];
    let c = lens_data[first + 2u];
    let left = vec3<bool>(is_left_of(a, p), is_left_of(b, p), is_left_of(c, p));
    if any(left) && !all(left) {
        return TriangleCrossing(0.0, false, false);
    }
    let slope = lens_data[first + 3u];
    let counted = slope.x * (p.x - a.w) + slope.y * (p.y - b.w) + slope.z;
    // Linear over the picture is, of a perspective camera, the inverse of the depth from the eye, or its part behind a
    // reference depth as a share of it.
    let reference = parts[part].reference;
    var t = counted;
    if frame.perspective != 0u {
        t = select(1.0, reference * counted, reference > 0.0) / max(select(counted, 1.0 - counted, reference > 0.0), 1e-30)
            + (reference - frame.anchor);
    }
    return TriangleCrossing(clamp(t, c.w, slope.w), true, all(left));
}

// Whether a point has a side of a projected triangle on its left. On the side it counts as moved, as in `is_left`.
fn is_left_of(side: vec4f, p: vec2f) -> bool {
    let area = side.x * p.x + side.y * p.y + side.z;
    if area != 0.0 {
        return area > 0.0;
    }
    return side.x > 0.0 || (side.x == 0.0 && side.y > 0.0);
}

// Twice the area between the ray and an edge; from the other end it is the same number with the other sign.
fn edge_area(tail: SeenCorner, head: SeenCorner) -> f32 {
    let turned = tail.index > head.index;
    let a = select(tail.across, head.across, turned);
    let b = select(head.across, tail.across, turned);
    let area = a.x * b.y - a.y * b.x;
    return select(area, -area, turned);
}

// Whether the ray has an edge on its left. Through an edge or a corner it counts as moved by (e, e squared) for a very
// small e: exactly one side of every edge holds it, and at a corner all edges agree.
fn is_left(tail: SeenCorner, head: SeenCorner, area: f32) -> bool {
    if area != 0.0 {
        return area > 0.0;
    }
    let step = head.across - tail.across;
    if step.y != 0.0 {
        return step.y < 0.0;
    }
    return step.x > 0.0 || (step.x == 0.0 && tail.index < head.index);
}

// Runs along no symmetry that a mesh is likely to have.
const ANYWHERE: vec3f = vec3f(0.527348, 0.331907, 0.782154);

// Whether a point of the mesh's own space is inside.
fn is_in_mesh(part: u32, p: vec3f) -> bool {
    let line = line_along(LocalRay(p, ANYWHERE, vec3f(0.0)), vec2f(0.0));
    var crossing = before_mesh();
    var around = Around(0, 0u);
    loop {
        crossing = next_in_mesh(with_all_faces(part), line, crossing);
        if !crossing.found {
            break;
        }
        if crossing.t > 0.0 {
            around = also_crossed(around, crossing.word);
        }
    }
    return is_enclosed(around);
}

// The point of the surface nearest to a point of the mesh's own space.
fn nearest_in_mesh(part: u32, p: vec3f) -> vec3f {
    var best = p;
    var least = FAR_AWAY;
    var node = 0u;
    while node < parts[part].node_count {
        let at = parts[part].first_node + node * NODE_WORDS;
        let first = lens_words[at + 3u];
        let count = lens_words[at + 7u];
        let away = p - clamp(p, lens_vector(at), lens_vector(at + 4u));
        if dot(away, away) >= least {
            node = select(node + 1u, first, count == 0u);
            continue;
        }
        for (var triangle = first; triangle < first + count; triangle += 1u) {
            let q = nearest_on_triangle(p, mesh_triangle(part, triangle));
            if dot(q - p, q - p) < least {
                least = dot(q - p, q - p);
                best = q;
            }
        }
        node += 1u;
    }
    return best;
}

fn mesh_triangle(part: u32, triangle: u32) -> array<vec3f, 3> {
    let at = parts[part].first_triangle + 3u * triangle;
    let first = parts[part].first_vertex;
    return array<vec3f, 3>(
        lens_vector(first + 3u * (lens_words[at] & INDEX_MASK)),
        lens_vector(first + 3u * lens_words[at + 1u]),
        lens_vector(first + 3u * lens_words[at + 2u]),
    );
}

// On a side, or within all of them on the plane.
fn nearest_on_triangle(p: vec3f, corners: array<vec3f, 3>) -> vec3f {
    var t = corners;
    let normal = cross(t[1] - t[0], t[2] - t[0]);
    var best = t[0];
    var is_within = dot(normal, normal) > 0.0;
    for (var i = 0u; i < 3u; i += 1u) {
        let a = t[i];
        let side = t[(i + 1u) % 3u] - a;
        let share = clamp(dot(p - a, side) / max(dot(side, side), 1e-30), 0.0, 1.0);
        let q = a + side * share;
        if dot(q - p, q - p) < dot(best - p, best - p) {
            best = q;
        }
        is_within = is_within && dot(cross(side, p - a), normal) >= 0.0;
    }
    if is_within {
        return p - normal * (dot(p - t[0], normal) / dot(normal, normal));
    }
    return best;
}

// Normal of a triangle in the mesh's own space, of any length.
fn triangle_normal(part: u32, triangle: u32) -> vec3f {
    let t = mesh_triangle(part, triangle);
    return cross(t[1] - t[0], t[2] - t[0]);
}

// What the ray has inside the mesh around a boundary at `depth`.
fn mesh_span(part: u32, ray: LensRay, depth: f32) -> Span {
    let line = mesh_line(part, ray);
    var entry = before_mesh();
    var last = entry;
    var around = Around(0, 0u);
    loop {
        last = crossing_behind(part, line, last);
        if !last.found {
            return no_span();
        }
        let was_enclosed = is_enclosed(around);
        around = also_crossed(around, last.word);
        if !was_enclosed && is_enclosed(around) {
            entry = last;
        } else if was_enclosed && !is_enclosed(around) && last.t >= depth - merge_at(depth) {
            break;
        }
    }
    return Span(entry.t, last.t, entry.triangle, last.triangle, true);
}

// The nearest crossing behind another; at one depth the order of the triangles counts.
fn crossing_behind(part: u32, line: MeshLine, after: MeshCrossing) -> MeshCrossing {
    var best = MeshCrossing(FAR_AWAY, NONE, 0u, false, 1u);
    var crossing = before_mesh();
    loop {
        crossing = next_in_mesh(with_all_faces(part), line, crossing);
        if !crossing.found {
            break;
        }
        let behind = crossing.t > after.t || (crossing.t == after.t && crossing.triangle > after.triangle);
        if behind && (crossing.t < best.t || (crossing.t == best.t && crossing.triangle < best.triangle)) {
            best = crossing;
        }
    }
    return best;
}
