//! A region map as text: one letter a region, with a legend.

use lenspeel::frame::Aovs;
use lenspeel::output::RegionMap;
use lenspeel::plan::Plan;

/// The most characters a line and the most lines.
const MOST: [usize; 2] = [64, 32];
const NOTHING: char = '.';
const PLAIN: char = '-';

/// Every n-th pixel of the map, from the middle of the first n, and what the letters mean.
pub fn of(plan: &Plan, size: [u32; 2], aovs: &Aovs) -> String {
    let map = RegionMap::new(plan, &[], aovs).expect("few regions");
    let [width, height] = size.map(|side| side as usize);
    let (across, down) = (width.div_ceil(MOST[0]), height.div_ceil(MOST[1]));
    let mut text = String::new();
    for y in (down / 2..height).step_by(down) {
        let line = (across / 2..width).step_by(across).map(|x| letter(map.ids[y * width + x]));
        text.extend(line);
        text.push('\n');
    }
    text += &format!("\none of {across} x {down} pixels\n{NOTHING} nothing\n{PLAIN} no lens\n");
    for region in &map.regions {
        let stack: Vec<String> = region.stack.iter().map(|entry| entry.to_string()).collect();
        text += &format!("{} {}: {}\n", letter(region.id), region.lenses.join(" + "), stack.join(" < "));
    }
    text
}

/// Region 1 is `A`; beyond `Z` and `z` follow other letters, so that no two regions share one.
fn letter(id: u16) -> char {
    match u32::from(id) {
        0xffff => NOTHING,
        0 => PLAIN,
        id @ 1..=26 => char::from_u32(u32::from('A') + id - 1).unwrap_or('?'),
        id @ 27..=52 => char::from_u32(u32::from('a') + id - 27).unwrap_or('?'),
        // Greek, Cyrillic and what follows.
        id => char::from_u32(0x3b1 + id - 53).unwrap_or('?'),
    }
}
