// Where lenses that move content take a shown point.

fn step_point(step: u32, p: vec3f) -> vec3f {
    let q = vec4f(p, 1.0);
    return vec3f(dot(steps[step].row_x, q), dot(steps[step].row_y, q), dot(steps[step].row_z, q));
}

fn step_vector(step: u32, v: vec3f) -> vec3f {
    return vec3f(dot(steps[step].row_x.xyz, v), dot(steps[step].row_y.xyz, v), dot(steps[step].row_z.xyz, v));
}

// The same for what a pixel spans. `step`: as `step_before` gives it.
fn steps_at_source(step: u32, shown: PlaneSteps) -> PlaneSteps {
    if !MOVERS || step == 0u {
        return shown;
    }
    return PlaneSteps(step_vector(step - 1u, shown.right), step_vector(step - 1u, shown.down));
}

// How an item's ray is moved before the lens of a rank is asked: the number of the step plus one, or 0. `inner`: for a
// filter that stands before those of its own lens that move.
fn step_before(item: u32, rank: u32, inner: bool) -> u32 {
    var found = 0u;
    let first = items[item].first_step;
    for (var step = first; step < first + items[item].step_count; step += 1u) {
        if steps[step].rank > rank || (inner && steps[step].rank == rank) {
            found = step + 1u;
        }
    }
    return found;
}
