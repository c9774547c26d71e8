//! Reads the one kind of `.npy` file that the cases hold: a little-endian float32 array of two dimensions in C order.

use std::fs;
use std::path::Path;

const MAGIC: &[u8] = b"\x93NUMPY\x01\x00";

/// The values, row 0 first; an error when there are not `size` (width, height) of them.
pub fn read_f32(path: &Path, size: [u32; 2]) -> Result<Vec<f32>, String> {
    let wrong = |what: &str| format!("{}: {what}", path.display());
    let bytes = fs::read(path).map_err(|error| wrong(&error.to_string()))?;
    let rest = bytes.strip_prefix(MAGIC).ok_or_else(|| wrong("not a version 1.0 .npy file"))?;
    let (length, rest) = rest.split_first_chunk::<2>().ok_or_else(|| wrong("it ends in its header"))?;
    let (header, data) = rest
        .split_at_checked(usize::from(u16::from_le_bytes(*length)))
        .ok_or_else(|| wrong("it ends in its header"))?;
    let header = String::from_utf8_lossy(header);
    let shape = format!("'shape': ({}, {})", size[1], size[0]);
    for part in ["'descr': '<f4'", "'fortran_order': False", &shape] {
        if !header.contains(part) {
            return Err(wrong(&format!("its header has no {part}: {}", header.trim())));
        }
    }
    let values: Vec<f32> = data.chunks_exact(4).map(|b| f32::from_le_bytes([b[0], b[1], b[2], b[3]])).collect();
    let count = size[0] as usize * size[1] as usize;
    if values.len() == count && data.len() == 4 * count { Ok(values) } else { Err(wrong("it has another length")) }
}
