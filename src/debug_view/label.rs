//! Where to write a number into the areas of a map.

use std::collections::BTreeMap;

/// For each value of a map the pixel deepest inside its areas, and how many pixels around that are of the value, too
/// (along the axes and the diagonals). The first such pixel where several are as deep.
pub fn deepest<T: PartialEq + Ord + Copy>(values: &[T], [width, height]: [usize; 2]) -> BTreeMap<T, (usize, usize)> {
    let depths = depths(values, [width, height]);
    let mut best: BTreeMap<T, (usize, usize)> = BTreeMap::new();
    for (at, value) in values.iter().enumerate() {
        let entry = best.entry(*value).or_insert((at, depths[at]));
        if depths[at] > entry.1 {
            *entry = (at, depths[at]);
        }
    }
    best
}

/// How many steps each pixel is away from another value or the border: a chessboard distance, in two passes
/// (Rosenfeld and Pfaltz 1966).
fn depths<T: PartialEq>(values: &[T], [width, height]: [usize; 2]) -> Vec<usize> {
    let mut depths = vec![0; values.len()];
    // With the neighbours that a pass has been at: before the pixel by rows, or behind it.
    let near = |depths: &[usize], at: usize, ahead: bool| {
        let (row, beside) = if ahead { (at + width, at + 1) } else { (at - width, at - 1) };
        let step = |other: usize| if values[other] == values[at] { depths[other] + 1 } else { 0 };
        [row - 1, row, row + 1, beside].map(step).into_iter().min().unwrap_or(0)
    };
    let inner = |side: usize| 1..side.saturating_sub(1);
    for at in inner(height).flat_map(|y| inner(width).map(move |x| y * width + x)) {
        depths[at] = near(&depths, at, false);
    }
    for at in inner(height).rev().flat_map(|y| inner(width).rev().map(move |x| y * width + x)) {
        depths[at] = depths[at].min(near(&depths, at, true));
    }
    depths
}

#[cfg(test)]
mod tests {
    use super::deepest;

    #[test]
    fn the_middle_of_an_area_is_deepest() {
        // A square of 5 ones in a frame of zeros.
        let side = 9;
        let inside = |i: usize| (2..7).contains(&(i % side)) && (2..7).contains(&(i / side));
        let values: Vec<u8> = (0..side * side).map(|i| u8::from(inside(i))).collect();
        let found = deepest(&values, [side, side]);
        assert_eq!(found[&1], (4 * side + 4, 2));
        assert_eq!(found[&0].1, 0, "a frame of two pixels has no depth");
    }
}
