//! Checked reading of accessors: types, strides, sparse values, ranges.

use gltf::json;
use gltf::json::accessor::{ComponentType, Type};
use gltf::json::validation::Checked;

use super::{File, object};
use crate::InputError;

/// Elements of one accessor that has no bytes of its own (all zero but for sparse values): 48 MiB of positions.
const MAX_ZERO_ELEMENTS: u64 = 1 << 22;

/// The most elements that an accessor can turn out to have: what it claims, or what its buffer has bytes for.
pub fn most_elements(root: &json::Root, index: usize) -> u64 {
    let Some(accessor) = root.accessors.get(index) else { return 0 };
    let view = accessor.buffer_view.as_ref().and_then(|view| root.buffer_views.get(view.value()));
    let bytes = view.and_then(|view| root.buffers.get(view.buffer.value())).map_or(u64::MAX, |b| b.byte_length.0);
    accessor.count.0.min(bytes)
}

/// One accessor, its types known.
pub struct Accessor<'f> {
    file: &'f File<'f>,
    json: &'f json::Accessor,
    /// How messages name it.
    place: String,
    pub component: ComponentType,
    pub kind: Type,
}

impl<'f> Accessor<'f> {
    /// `owner` is what the accessor belongs to, as messages name it.
    pub fn new(file: &'f File<'f>, index: usize, owner: &str) -> Result<Self, InputError> {
        let json = file
            .root()
            .accessors
            .get(index)
            .ok_or_else(|| file.error(owner, format!("accessor {index} is not in the file")))?;
        let place = format!("{owner}, {}", object("accessor", index, json.name.as_deref()));
        let (Checked::Valid(component), Checked::Valid(kind)) = (json.component_type, json.type_) else {
            return Err(file.error(place, "its type is not one that glTF 2.0 knows"));
        };
        Ok(Self { file, json, place, component: component.0, kind })
    }

    pub fn error(&self, what: impl std::fmt::Display) -> InputError {
        self.file.error(&self.place, what)
    }

    /// Elements it claims; held against its bytes when read.
    pub fn count(&self) -> u64 {
        self.json.count.0
    }

    /// Vectors with `N` components as floats; integers are mapped to `[0, 1]` or `[-1, 1]` if the accessor says so or
    /// `normalize` does.
    pub fn floats<const N: usize>(&self, normalize: bool) -> Result<Vec<[f32; N]>, InputError> {
        if self.kind.multiplicity() != N || matches!(self.kind, Type::Mat2 | Type::Mat3 | Type::Mat4) {
            let expected = if N == 1 { "SCALAR".to_string() } else { format!("VEC{N}") };
            return Err(self.error(format!("{}, expected {expected}", type_name(self.kind))));
        }
        if self.component == ComponentType::U32 {
            return Err(self.error("UNSIGNED_INT components, expected FLOAT or 8 or 16 bit integers"));
        }
        let (component, size) = (self.component, self.component.size());
        let normalize = normalize || self.json.normalized;
        self.read([0.0; N], |bytes| {
            std::array::from_fn(|i| float(component, normalize, &bytes[i * size..(i + 1) * size]))
        })
    }

    /// Unsigned integers, as vertex indices are.
    pub fn indices(&self) -> Result<Vec<u32>, InputError> {
        let unsigned = matches!(self.component, ComponentType::U8 | ComponentType::U16 | ComponentType::U32);
        if self.kind != Type::Scalar || !unsigned {
            return Err(self.error("expected SCALAR of an unsigned integer type, as indices are"));
        }
        self.read(0, unsigned_int)
    }

    /// All elements, sparse ones put in place; `decode` gets the bytes of one element.
    fn read<T: Copy>(&self, zero: T, decode: impl Fn(&[u8]) -> T) -> Result<Vec<T>, InputError> {
        let size = self.component.size() * self.kind.multiplicity();
        let count = self.json.count.0;
        let mut values = match self.json.buffer_view {
            Some(view) => {
                let offset = self.json.byte_offset.map_or(0, |o| o.0);
                self.rows(view.value(), offset, count, size, true)?.map(&decode).collect()
            }
            None if count <= MAX_ZERO_ELEMENTS => vec![zero; count as usize],
            None => {
                let limit = format!("{count} elements without a buffer view, at most {MAX_ZERO_ELEMENTS} can be");
                return Err(self.error(limit));
            }
        };
        if let Some(sparse) = &self.json.sparse {
            self.put_sparse(sparse, size, &mut values, decode)?;
        }
        Ok(values)
    }

    fn put_sparse<T>(
        &self,
        sparse: &json::accessor::sparse::Sparse,
        size: usize,
        values: &mut [T],
        decode: impl Fn(&[u8]) -> T,
    ) -> Result<(), InputError> {
        let Checked::Valid(index_type) = sparse.indices.component_type else {
            return Err(self.error("the type of its sparse indices is not one that glTF 2.0 knows"));
        };
        let (indices, new) = (&sparse.indices, &sparse.values);
        let count = sparse.count.0;
        let places =
            self.rows(indices.buffer_view.value(), indices.byte_offset.0, count, index_type.0.size(), false)?;
        let rows = self.rows(new.buffer_view.value(), new.byte_offset.0, count, size, false)?;
        let there = values.len();
        for (place, row) in places.map(unsigned_int).zip(rows) {
            let slot = values
                .get_mut(place as usize)
                .ok_or_else(|| self.error(format!("sparse index {place}, it has {there} elements")))?;
            *slot = decode(row);
        }
        Ok(())
    }

    /// The bytes of `count` elements of a buffer view, which must hold them all.
    fn rows(
        &self,
        view: usize,
        offset: u64,
        count: u64,
        size: usize,
        strided: bool,
    ) -> Result<impl Iterator<Item = &'f [u8]>, InputError> {
        let bytes = view_bytes(self.file, view, &self.place)?;
        let stride = self.file.root().buffer_views[view].byte_stride.as_ref().filter(|_| strided).map_or(size, |s| s.0);
        if stride < size {
            return Err(self.error(format!("byte stride {stride}, an element takes {size} bytes")));
        }
        let end = match count {
            0 => Some(0),
            _ => (count - 1)
                .checked_mul(stride as u64)
                .and_then(|n| n.checked_add(size as u64))
                .and_then(|n| n.checked_add(offset)),
        };
        if end.is_none_or(|end| end > bytes.len() as u64) {
            let what = format!(
                "{count} elements of {size} bytes from byte {offset} do not fit buffer view {view} of {} bytes",
                bytes.len()
            );
            return Err(self.error(what).help("the file is damaged or cut short"));
        }
        let bytes = if count == 0 { &[][..] } else { &bytes[offset as usize..] };
        // The last element may end before a whole stride does.
        Ok(bytes.chunks(stride).map(move |chunk| &chunk[..size.min(chunk.len())]).take(count as usize))
    }
}

/// The bytes of a buffer view; `owner` is what asks, as messages name it.
pub fn view_bytes<'f>(file: &'f File<'_>, view: usize, owner: &str) -> Result<&'f [u8], InputError> {
    let missing = || file.error(owner, format!("buffer view {view} is not in the file"));
    let json = file.root().buffer_views.get(view).ok_or_else(missing)?;
    let index = json.buffer.value();
    let Some(buffer) = file.buffers.get(index).ok_or_else(missing)? else {
        return Err(file
            .error(owner, format!("its bytes are in buffer {index}, which has neither a URI nor a binary chunk"))
            .help("only buffer 0 of a GLB file may leave its URI out"));
    };
    let start = json.byte_offset.map_or(0, |o| o.0);
    let range = start.checked_add(json.byte_length.0).filter(|end| *end <= buffer.len() as u64);
    let Some(end) = range else {
        let (length, index, there) = (json.byte_length.0, json.buffer, buffer.len());
        let what = format!(
            "buffer view {view} takes {length} bytes from byte {start}, buffer {index} has {there} bytes in all"
        );
        return Err(file.error(owner, what).help("the file is damaged or cut short"));
    };
    Ok(&buffer[start as usize..end as usize])
}

fn type_name(kind: Type) -> &'static str {
    match kind {
        Type::Scalar => "SCALAR",
        Type::Vec2 => "VEC2",
        Type::Vec3 => "VEC3",
        Type::Vec4 => "VEC4",
        Type::Mat2 => "MAT2",
        Type::Mat3 => "MAT3",
        Type::Mat4 => "MAT4",
    }
}

/// One component as glTF maps it to a float (specification, section 3.11).
fn float(component: ComponentType, normalize: bool, bytes: &[u8]) -> f32 {
    let short = || u16::from_le_bytes([bytes[0], bytes[1]]);
    let (value, limit) = match component {
        ComponentType::I8 => (f32::from(bytes[0] as i8), 127.0),
        ComponentType::U8 => (f32::from(bytes[0]), 255.0),
        ComponentType::I16 => (f32::from(short() as i16), 32767.0),
        ComponentType::U16 => (f32::from(short()), 65535.0),
        ComponentType::U32 => (unsigned_int(bytes) as f32, 1.0),
        ComponentType::F32 => return f32::from_bits(unsigned_int(bytes)),
    };
    if normalize { (value / limit).max(-1.0) } else { value }
}

/// A little-endian number of one, two or four bytes.
fn unsigned_int(bytes: &[u8]) -> u32 {
    bytes.iter().rev().fold(0, |n, b| n << 8 | u32::from(*b))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn components_map_to_floats() {
        for (component, normalize, bytes, expected) in [
            (ComponentType::I8, true, &[0x80u8][..], -1.0),
            (ComponentType::I8, true, &[127], 1.0),
            (ComponentType::I8, false, &[0xfe], -2.0),
            (ComponentType::U8, true, &[255], 1.0),
            (ComponentType::U16, true, &[0xff, 0xff], 1.0),
            (ComponentType::U16, false, &[1, 2], 513.0),
            (ComponentType::I16, true, &[1, 0x80], -1.0),
            (ComponentType::F32, false, &[0, 0, 0x80, 0x3f], 1.0),
        ] {
            assert_eq!(float(component, normalize, bytes), expected, "{component:?} {bytes:?}");
        }
    }
}
