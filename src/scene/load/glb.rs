//! The container: plain JSON, or the chunks of a binary glTF file.

use crate::InputError;

/// The two parts of a glTF file, borrowed from its bytes.
pub struct Container<'a> {
    pub json: &'a [u8],
    pub bin: Option<&'a [u8]>,
}

const HEADER: usize = 12;
const CHUNK_HEADER: usize = 8;
const JSON: &[u8] = b"JSON";
const BIN: &[u8] = b"BIN\0";

/// Tells a GLB file by its magic; all else is taken for JSON.
pub fn split<'a>(bytes: &'a [u8], name: &str) -> Result<Container<'a>, InputError> {
    if bytes.starts_with(b"glTF") {
        if let Some(version) = word(bytes, 4).filter(|v| *v != 2) {
            return Err(InputError::new(format!("{name}: GLB version {version}")).help("expected 2"));
        }
        return chunks(bytes).map_err(|what| {
            InputError::new(format!("{name}: not a whole GLB file: {what}")).help("it may be cut short; get it again")
        });
    }
    // Some exporters write a byte-order mark, which JSON does not know.
    Ok(Container { json: bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes), bin: None })
}

fn chunks(bytes: &[u8]) -> Result<Container<'_>, String> {
    let Some(length) = word(bytes, 8) else {
        return Err(format!("its header takes {HEADER} bytes, {} are there", bytes.len()));
    };
    if length > bytes.len() || length < HEADER {
        return Err(format!("its header says {length} bytes, {} are there", bytes.len()));
    }
    let mut rest = &bytes[HEADER..length];
    let (kind, json) = chunk(&mut rest)?;
    if kind != JSON {
        return Err("the first chunk is not JSON".to_string());
    }
    // Unknown chunks are to be ignored; the binary one, if any, comes next.
    let bin = if rest.len() >= CHUNK_HEADER { Some(chunk(&mut rest)?) } else { None };
    Ok(Container { json, bin: bin.filter(|(kind, _)| *kind == BIN).map(|(_, data)| data) })
}

/// Takes one chunk (its type and its data) off the front.
fn chunk<'a>(rest: &mut &'a [u8]) -> Result<(&'a [u8], &'a [u8]), String> {
    let Some(length) = word(rest, 0).filter(|_| rest.len() >= CHUNK_HEADER) else {
        return Err(format!("a chunk header takes {CHUNK_HEADER} bytes, {} are there", rest.len()));
    };
    let (kind, data) = (&rest[4..CHUNK_HEADER], &rest[CHUNK_HEADER..]);
    if length > data.len() {
        return Err(format!("a chunk says {length} bytes, {} are there", data.len()));
    }
    *rest = &data[length..];
    Ok((kind, &data[..length]))
}

fn word(bytes: &[u8], at: usize) -> Option<usize> {
    let word: [u8; 4] = bytes.get(at..at + 4)?.try_into().ok()?;
    usize::try_from(u32::from_le_bytes(word)).ok()
}
