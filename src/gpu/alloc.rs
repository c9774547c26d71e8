//! Memory of the device: every buffer and texture is made here, in an error scope, so that a full device is an error with
//! numbers and not the end of the program.

use super::Error;

/// Makes something of so many bytes, or says that there is no room for it.
fn in_scope<T>(device: &wgpu::Device, what: &str, bytes: u64, make: impl FnOnce() -> T) -> Result<T, Error> {
    let invalid = device.push_error_scope(wgpu::ErrorFilter::Validation);
    let full = device.push_error_scope(wgpu::ErrorFilter::OutOfMemory);
    let made = make();
    // In the reverse order of their beginnings; natively both are there at once.
    let full = pollster::block_on(full.pop());
    let invalid = pollster::block_on(invalid.pop());
    match full.or(invalid) {
        None => Ok(made),
        Some(error) => Err(Error::NoRoom { what: what.into(), bytes, reason: error.to_string() }),
    }
}

pub fn buffer(device: &wgpu::Device, what: &str, descriptor: &wgpu::BufferDescriptor) -> Result<wgpu::Buffer, Error> {
    in_scope(device, what, descriptor.size, || device.create_buffer(descriptor))
}

/// A buffer with contents.
pub fn filled_buffer(
    device: &wgpu::Device,
    what: &str,
    contents: &[u8],
    usage: wgpu::BufferUsages,
) -> Result<wgpu::Buffer, Error> {
    let size = (contents.len() as u64).next_multiple_of(wgpu::COPY_BUFFER_ALIGNMENT).max(wgpu::COPY_BUFFER_ALIGNMENT);
    let descriptor = wgpu::BufferDescriptor { label: Some(what), size, usage, mapped_at_creation: true };
    let buffer = buffer(device, what, &descriptor)?;
    let no_room = |reason: String| Error::NoRoom { what: what.into(), bytes: size, reason };
    buffer
        .get_mapped_range_mut(..)
        .map_err(|error| no_room(error.to_string()))?
        .slice(..contents.len())
        .copy_from_slice(contents);
    buffer.unmap();
    Ok(buffer)
}

/// A texture of one level.
pub fn texture(
    device: &wgpu::Device,
    what: &str,
    descriptor: &wgpu::TextureDescriptor,
) -> Result<wgpu::Texture, Error> {
    let wgpu::Extent3d { width, height, depth_or_array_layers } = descriptor.size;
    let pixel = descriptor.format.block_copy_size(None).unwrap_or(4);
    let bytes = u64::from(pixel) * u64::from(width) * u64::from(height) * u64::from(depth_or_array_layers);
    in_scope(device, what, bytes, || device.create_texture(descriptor))
}
