//! Compares pictures of two backends; see SEMANTICS section 7 for what may differ.

use lenspeel::frame::Frame;

/// Share of the pixels that may differ at edges.
const OUTLIERS: f64 = 0.002;
/// Steps of a channel that may differ elsewhere.
const CHANNEL: u8 = 2;

/// An error that says how many pixels differ in what, when more do than may.
pub fn agree(expected: &Frame, actual: &Frame) -> Result<(), String> {
    if expected.size != actual.size {
        return Err(format!("sizes differ: {:?} and {:?}", expected.size, actual.size));
    }
    let (Some(a), Some(b)) = (&expected.aovs, &actual.aovs) else { return Err("maps are missing".into()) };
    let count = expected.pixels.len();
    let color = |i: usize| (0..4).any(|c| expected.pixels[i][c].abs_diff(actual.pixels[i][c]) > CHANNEL);
    let depth = |i: usize| (a.depth[i] - b.depth[i]).abs() > 1e-4 * a.depth[i].abs();
    let normal = |i: usize| (0..3).any(|c| (a.normals[i][c] - b.normals[i][c]).abs() > 1e-2);
    let tallies = [
        ("colour", differing(count, color)),
        ("region", differing(count, |i| a.region(i) != b.region(i))),
        ("node", differing(count, |i| a.nodes[i] != b.nodes[i])),
        ("layers", differing(count, |i| a.layers[i] != b.layers[i])),
        ("depth", differing(count, depth)),
        ("normal", differing(count, normal)),
    ];
    let allowed = (OUTLIERS * count as f64) as usize;
    let bad: Vec<String> = tallies
        .iter()
        .filter(|(_, pixels)| pixels.len() > allowed)
        .map(|(what, pixels)| {
            let (x, y) = (pixels[0] as u32 % expected.size[0], pixels[0] as u32 / expected.size[0]);
            format!("{what} in {} pixels, first ({x}, {y})", pixels.len())
        })
        .collect();
    if bad.is_empty() { Ok(()) } else { Err(format!("of {count} pixels {allowed} may differ: {}", bad.join("; "))) }
}

fn differing(count: usize, differs: impl Fn(usize) -> bool) -> Vec<usize> {
    (0..count).filter(|i| differs(*i)).collect()
}
