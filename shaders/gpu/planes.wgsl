// Triangles whose depths are those of their planes. Some lie over each other in one plane: one number for all, and a rank in
// it. Others are very large for how near they are: corners that are far off say too little of what is near.

// Words of one: the triangle's number in its primitive, its rank, the plane. Twin of `planes.rs`.
const IN_PLANE_WORDS: u32 = 6u;
// Seen more edge on than this, as the sine of the angle, single precision does not say where a plane is met.
const ALONG_PLANE: f32 = 1e-6;

// Where the words of a drawn triangle are, or NONE.
fn plane_at(item: u32, triangle: u32) -> u32 {
    if !PLANES || items[item].planes == NONE {
        return NONE;
    }
    let number = numbers[items[item].first_number + triangle];
    let first = items[item].planes + 1u;
    var low = 0u;
    var high = lens_words[first - 1u];
    while low < high {
        let middle = (low + high) / 2u;
        if lens_words[first + IN_PLANE_WORDS * middle] < number {
            low = middle + 1u;
        } else {
            high = middle;
        }
    }
    let at = first + IN_PLANE_WORDS * low;
    if low == lens_words[first - 1u] || lens_words[at] != number {
        return NONE;
    }
    return at;
}

// Where a ray meets the plane; `other` where it runs along it.
fn plane_depth(at: u32, ray: PixelRay, other: f32) -> f32 {
    let normal = lens_vector(at + 2u);
    let rate = dot(normal, ray.direction);
    if abs(rate) <= ALONG_PLANE * length(normal) * length(ray.direction) {
        return other;
    }
    return (bitcast<f32>(lens_words[at + 5u]) - dot(normal, ray.origin)) / rate;
}

// Some steps of f32 behind a place between the planes, one for each rank.
fn ranked(z: f32, rank: u32) -> f32 {
    let bits = bitcast<u32>(z);
    return bitcast<f32>(bits - min(bits, rank));
}
