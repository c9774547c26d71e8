// Where a ray enters and leaves a part of a lens: closed forms in the part's own space, in f32.

struct Span {
    entry: f32,
    exit: f32,
    entry_face: u32,
    exit_face: u32,
    // False: the ray misses or only grazes.
    hit: bool,
}

struct LocalRay {
    origin: vec3f,
    direction: vec3f,
    // How far outside the surfaces of its form the origin is, as a square: of a ball, of the side of a cone or capsule, and
    // of the ball at the other end of a capsule. Close to a surface that is far larger it has digits that the origin has not.
    outside: vec3f,
}

const CONE_SIDE: u32 = 2u;

fn no_span() -> Span {
    return Span(0.0, 0.0, 0u, 0u, false);
}

// In a solid's own space: the point for which the products below do not cancel, and its parameter.
struct Anchored {
    origin: vec3f,
    shift: f32,
}

fn local_point(part: u32, p: vec3f) -> vec3f {
    let q = vec4f(p, 1.0);
    return vec3f(dot(parts[part].local_x, q), dot(parts[part].local_y, q), dot(parts[part].local_z, q));
}

fn local_vector(part: u32, v: vec3f) -> vec3f {
    return vec3f(dot(parts[part].local_x.xyz, v), dot(parts[part].local_y.xyz, v), dot(parts[part].local_z.xyz, v));
}

fn local_ray(part: u32, ray: LensRay) -> LocalRay {
    if MOVERS && ray.is_moved {
        return with_outside(part, local_point(part, ray.origin), local_vector(part, ray.direction));
    }
    let from_middle = ray.at - frame.middle;
    let across = parts[part].ray_dx.xyz * from_middle.x + parts[part].ray_dy.xyz * from_middle.y;
    let step = across * frame.shares.x;
    let middle = parts[part].ray_origin;
    let form = parts[part].form;
    // Squares grow by the step times twice the middle and itself.
    let twice = 2.0 * middle.xyz + step;
    let slope = select(0.0, parts[part].r1 - parts[part].r0, form == FORM_CONE);
    let radius = parts[part].r0 + slope * middle.z;
    let grown = vec3f(
        dot(twice, step),
        dot(twice.xy, step.xy) - slope * step.z * (2.0 * radius + slope * step.z),
        dot(twice - vec3f(0.0, 0.0, 2.0 * parts[part].length), step),
    );
    let outside = vec3f(middle.w, parts[part].ray_direction.w, parts[part].ray_dx.w) + grown;
    return LocalRay(middle.xyz + step, parts[part].ray_direction.xyz + across * frame.shares.y, outside);
}

// A ray of which that is not known any better.
fn with_outside(part: u32, origin: vec3f, direction: vec3f) -> LocalRay {
    let end = origin - vec3f(0.0, 0.0, parts[part].length);
    var radius = 1.0;
    if parts[part].form == FORM_CONE {
        radius = parts[part].r0 + (parts[part].r1 - parts[part].r0) * origin.z;
    }
    let side = dot(origin.xy, origin.xy) - radius * radius;
    return LocalRay(origin, direction, vec3f(dot(origin, origin) - 1.0, side, dot(end, end) - 1.0));
}

// A gradient over the part's own space as one over the world.
fn turned_normal(part: u32, n: vec3f) -> vec3f {
    return parts[part].normal_x.xyz * n.x + parts[part].normal_y.xyz * n.y + parts[part].normal_z.xyz * n.z;
}

// Starts a ray where it is nearest to `center`.
fn anchored(ray: LocalRay, center: vec3f) -> Anchored {
    let shift = dot(center - ray.origin, ray.direction) / dot(ray.direction, ray.direction);
    return Anchored(ray.origin + ray.direction * shift, shift);
}

fn part_span(asked: AskedPart, lens_ray: LensRay) -> Span {
    let part = asked.part;
    let ray = local_ray(part, lens_ray);
    var span = no_span();
    let form = parts[part].form;
    if SPHERES && form == FORM_SPHERE {
        span = ball_span(ray, vec3f(0.0), ray.outside.x);
    } else if CONES && form == FORM_CONE {
        span = cone_span(ray, parts[part].r0, parts[part].r1);
    } else if CAPSULES && form == FORM_CAPSULE {
        span = capsule_span(ray, parts[part].length);
    } else if HALF_SPACES && form == FORM_HALF_SPACES {
        span = half_space_span(asked, lens_ray);
    }
    span.hit = span.hit && span.exit > span.entry;
    return span;
}

// Nearer than this to a form, as a square in its own space, rays are taken from where they start.
const NEARBY: f32 = 4.0;

fn ball_span(ray: LocalRay, center: vec3f, outside: f32) -> Span {
    let start = anchored(ray, center);
    let a = dot(ray.direction, ray.direction);
    let from_center = ray.origin - center;
    if dot(from_center, from_center) < NEARBY {
        // The two ends, whose product is known, from the farther: the nearer may be far less than the ball is large.
        let c = outside - a * start.shift * start.shift;
        if c >= 0.0 {
            return no_span();
        }
        let half = sqrt(-c / a);
        let farther = start.shift + select(half, -half, start.shift < 0.0);
        let nearer = outside / (a * farther);
        return Span(min(nearer, farther), max(nearer, farther), 0u, 0u, true);
    }
    let offset = start.origin - center;
    let c = dot(offset, offset) - 1.0;
    if c >= 0.0 {
        return no_span();
    }
    let half = sqrt(-c / a);
    return Span(start.shift - half, start.shift + half, 0u, 0u, true);
}

// The slab between the caps and the inside of the side; where a ray goes through a rim or the apex, rounding moves
// the crossing from one to the other, and nothing is lost. Twin of `cone_span` and `side_span` in `lens/form.rs`.
fn cone_span(ray: LocalRay, r0: f32, r1: f32) -> Span {
    var start = anchored(ray, vec3f(0.0, 0.0, 0.5));
    let is_nearby = dot(ray.origin, ray.origin) < NEARBY;
    if is_nearby {
        start = Anchored(ray.origin, 0.0);
    }
    let o = start.origin;
    let d = ray.direction;
    var t0 = -FAR_AWAY;
    var t1 = FAR_AWAY;
    if d.z != 0.0 {
        let low = clamp(-o.z / d.z, -FAR_AWAY, FAR_AWAY);
        let high = clamp((1.0 - o.z) / d.z, -FAR_AWAY, FAR_AWAY);
        t0 = min(low, high);
        t1 = max(low, high);
    } else if o.z < 0.0 || o.z > 1.0 {
        return no_span();
    }
    let slope = r1 - r0;
    let radius = r0 + slope * o.z;
    let widening = slope * d.z;
    let a = dot(d.xy, d.xy) - widening * widening;
    let b = dot(o.xy, d.xy) - widening * radius;
    let c = select(dot(o.xy, o.xy) - radius * radius, ray.outside.y, is_nearby);
    var inward = -FAR_AWAY;
    var outward = FAR_AWAY;
    // Where a t^2 + 2 b t + c falls and rises through zero, without cancellation, for any a.
    let discriminant = b * b - a * c;
    if discriminant > 0.0 {
        let root = sqrt(discriminant);
        var falls = 0.0;
        var rises = 0.0;
        if b > 0.0 {
            falls = (-b - root) / select(a, 1e-30, a == 0.0);
            rises = c / (-b - root);
        } else {
            falls = c / (-b + root);
            rises = (-b + root) / select(a, 1e-30, a == 0.0);
        }
        // Steeper than the side, the ray is inside both halves of the double cone, and one of them is meant.
        if a >= 0.0 || widening > 0.0 {
            inward = falls;
        }
        if a >= 0.0 || widening <= 0.0 {
            outward = rises;
        }
    } else if a < 0.0 {
        if widening > 0.0 {
            inward = -radius / widening;
        } else {
            outward = -radius / widening;
        }
    } else if a > 0.0 || c >= 0.0 {
        return no_span();
    }
    var span = Span(t0, t1, select(1u, 0u, d.z > 0.0), select(0u, 1u, d.z > 0.0), true);
    if inward > t0 {
        span.entry = inward;
        span.entry_face = CONE_SIDE;
    }
    if outward < t1 {
        span.exit = outward;
        span.exit_face = CONE_SIDE;
    }
    if span.entry >= span.exit {
        return no_span();
    }
    span.entry += start.shift;
    span.exit += start.shift;
    return span;
}

// Two balls and the cylinder between them: their union is convex.
fn capsule_span(ray: LocalRay, length: f32) -> Span {
    let end = vec3f(0.0, 0.0, length);
    var span = united(ball_span(ray, vec3f(0.0), ray.outside.x), ball_span(ray, end, ray.outside.z));
    if length > 0.0 {
        let squeeze = vec3f(1.0, 1.0, 1.0 / length);
        span = united(span, cone_span(LocalRay(ray.origin * squeeze, ray.direction * squeeze, ray.outside), 1.0, 1.0));
    }
    span.entry_face = 0u;
    span.exit_face = 0u;
    return span;
}

fn united(a: Span, b: Span) -> Span {
    if !a.hit {
        return b;
    }
    if !b.hit {
        return a;
    }
    return Span(min(a.entry, b.entry), max(a.exit, b.exit), 0u, 0u, true);
}

fn half_space_span(asked: AskedPart, ray: LensRay) -> Span {
    let part = asked.part;
    let is_listed = asked.first != NONE;
    let count = select(parts[part].plane_count, asked.end - asked.first, is_listed);
    var span = Span(-FAR_AWAY, FAR_AWAY, 0u, 0u, count != 0u);
    for (var i = 0u; i < count; i += 1u) {
        var face = i;
        if is_listed {
            face = tiles[asked.first + i];
        }
        let crossing = plane_crossing(part, face, ray);
        if crossing.rate == 0.0 {
            if crossing.distance > 0.0 {
                return no_span();
            }
        } else if crossing.rate < 0.0 {
            if crossing.t > span.entry {
                span.entry = crossing.t;
                span.entry_face = face;
            }
        } else if crossing.t < span.exit {
            span.exit = crossing.t;
            span.exit_face = face;
        }
    }
    return span;
}
