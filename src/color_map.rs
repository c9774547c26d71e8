//! Colour maps for false colours, by name.

use colorgrad::{BlendMode, CatmullRomGradient, Color, Gradient, GradientBuilder, preset};

/// The names that filters take: perceptually even ones first, then the diverging.
pub const NAMES: &[&str] =
    &["viridis", "magma", "inferno", "plasma", "cividis", "turbo", "coolwarm", "spectral", "rdbu", "rdylbu", "brbg"];

/// Behind a name: the same colours from the high to the low end.
pub const REVERSED: &str = "-r";

/// Colours of a map.
pub const STEPS: u32 = 256;

/// The colours of a map from its low to its high end, sRGB. `None` for an unknown name.
pub fn colors(name: &str) -> Option<Vec<[u8; 4]>> {
    if let Some(name) = name.strip_suffix(REVERSED).filter(|name| !name.ends_with(REVERSED)) {
        return colors(name).map(|colors| colors.into_iter().rev().collect());
    }
    let gradient: Box<dyn Gradient> = match name {
        "viridis" => Box::new(preset::viridis()),
        "magma" => Box::new(preset::magma()),
        "inferno" => Box::new(preset::inferno()),
        "plasma" => Box::new(preset::plasma()),
        "cividis" => Box::new(preset::cividis()),
        "turbo" => Box::new(preset::turbo()),
        "coolwarm" => Box::new(cool_warm()?),
        "spectral" => Box::new(preset::spectral()),
        "rdbu" => Box::new(preset::rd_bu()),
        "rdylbu" => Box::new(preset::rd_yl_bu()),
        "brbg" => Box::new(preset::br_bg()),
        _ => return None,
    };
    Some((0..STEPS).map(|i| gradient.at(i as f32 / (STEPS - 1) as f32).to_rgba8()).collect())
}

/// Blue over light grey to red: Moreland's "Diverging Color Maps for Scientific Visualization" (2009), between the three
/// colours that it gives.
fn cool_warm() -> Option<CatmullRomGradient> {
    let colors = [(59, 76, 192), (221, 221, 221), (180, 4, 38)].map(|(r, g, b)| Color::from_rgba8(r, g, b, 255));
    GradientBuilder::new().colors(&colors).mode(BlendMode::Lab).build().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_name_has_colors_that_change_steadily() {
        for name in NAMES {
            let colors = colors(name).unwrap_or_else(|| panic!("{name}"));
            assert_eq!(colors.len(), STEPS as usize);
            let step = |pair: &[[u8; 4]]| (0..3).map(|c| pair[0][c].abs_diff(pair[1][c])).max();
            assert!(colors.windows(2).all(|pair| step(pair) <= Some(24)), "{name} has no jumps");
            assert!(colors.iter().all(|c| c[3] == 255), "{name} is opaque");
            assert_ne!(colors.first(), colors.last(), "{name}");
        }
        assert_eq!(colors("jet"), None);
        let reversed = colors("magma").map(|colors| colors.into_iter().rev().collect::<Vec<_>>());
        assert_eq!(colors("magma-r"), reversed);
        assert_eq!(colors("magma-r-r"), None);
    }

    /// The published ends and middles.
    #[test]
    fn known_colors() {
        let near = |name: &str, at: usize, expected: [u8; 3]| {
            let color = colors(name).expect("a map")[at];
            assert!((0..3).all(|c| color[c].abs_diff(expected[c]) <= 3), "{name} at {at}: {color:?}");
        };
        near("viridis", 0, [68, 1, 84]);
        near("viridis", 255, [253, 231, 37]);
        near("magma", 0, [0, 0, 4]);
        near("coolwarm", 0, [59, 76, 192]);
        near("coolwarm", 128, [221, 221, 221]);
        near("coolwarm", 255, [180, 4, 38]);
    }
}
