//! The picture of a spec against the one beside it.

use std::path::Path;

use lenspeel::frame::Frame;
use lenspeel::output::write_picture;

use crate::entry::Entry;

/// Steps of 255 by which a channel may differ. The powers and tangents of another host's maths library may round a
/// value that lies between two steps the other way.
const STEPS: u8 = 1;
/// The share of pixels for which that may happen.
const SHARE: f64 = 0.005;

/// Compares with the golden, or writes it where `LENSPEEL_UPDATE_GOLDENS` is 1.
pub fn check(entry: &Entry) -> Result<(), String> {
    let path = entry.path.with_extension("png");
    let frame = &entry.picture()?;
    if std::env::var_os("LENSPEEL_UPDATE_GOLDENS").is_some_and(|value| value == "1") {
        return write_picture(&path, frame).map_err(|error| error.to_string());
    }
    let golden = read(&path).map_err(|error| {
        format!("{error}; write it with LENSPEEL_UPDATE_GOLDENS=1 cargo test --test specs, and look at it")
    })?;
    compare(&golden, frame).map_err(|difference| format!("{}: {difference}", path.display()))
}

fn read(path: &Path) -> Result<Frame, String> {
    let image = image::open(path).map_err(|error| format!("{}: {error}", path.display()))?.into_rgba8();
    let pixels = image.pixels().map(|pixel| pixel.0).collect();
    Ok(Frame { size: [image.width(), image.height()], pixels, aovs: None })
}

/// An error with the number of pixels that differ and the first that differs most.
pub fn compare(golden: &Frame, frame: &Frame) -> Result<(), String> {
    if golden.size != frame.size {
        return Err(format!("the golden has {:?} pixels, the picture {:?}", golden.size, frame.size));
    }
    let difference = |at: &usize| {
        let channels = golden.pixels[*at].iter().zip(frame.pixels[*at]);
        channels.map(|(a, b)| a.abs_diff(b)).max().unwrap_or_default()
    };
    let differing: Vec<usize> = (0..frame.pixels.len()).filter(|at| difference(at) > 0).collect();
    let Some(worst) = differing.iter().copied().max_by_key(difference) else { return Ok(()) };
    if difference(&worst) <= STEPS && differing.len() as f64 <= SHARE * frame.pixels.len() as f64 {
        return Ok(());
    }
    let (x, y) = (worst % frame.size[0] as usize, worst / frame.size[0] as usize);
    let (want, got) = (golden.pixels[worst], frame.pixels[worst]);
    Err(format!("{} pixels differ; at {x},{y} {want:?} is wanted, {got:?} is there", differing.len()))
}
