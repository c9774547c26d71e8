//! Copies from the device.

use super::{Error, alloc};

/// A buffer that the host can read once its copy has run.
#[derive(Debug)]
pub struct Readback {
    buffer: wgpu::Buffer,
}

impl Readback {
    /// Encodes a copy of a whole buffer.
    pub fn of_buffer(
        device: &wgpu::Device,
        encoder: &mut wgpu::CommandEncoder,
        source: &wgpu::Buffer,
    ) -> Result<Self, Error> {
        let readback = Self::new(device, source.size())?;
        encoder.copy_buffer_to_buffer(source, 0, &readback.buffer, 0, source.size());
        Ok(readback)
    }

    /// Encodes a copy of a texture with four bytes a pixel; rows are padded to [`row_bytes`].
    pub fn of_texture(
        device: &wgpu::Device,
        encoder: &mut wgpu::CommandEncoder,
        source: &wgpu::Texture,
    ) -> Result<Self, Error> {
        let row = row_bytes(source.width());
        let readback = Self::new(device, u64::from(row) * u64::from(source.height()))?;
        let layout = wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(row), rows_per_image: None };
        encoder.copy_texture_to_buffer(
            source.as_image_copy(),
            wgpu::TexelCopyBufferInfo { buffer: &readback.buffer, layout },
            source.size(),
        );
        Ok(readback)
    }

    fn new(device: &wgpu::Device, size: u64) -> Result<Self, Error> {
        let descriptor = wgpu::BufferDescriptor {
            label: Some("readback"),
            size,
            usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        };
        Ok(Self { buffer: alloc::buffer(device, "the copy of the picture", &descriptor)? })
    }

    /// Waits for the copy, which must have been submitted, and gives its bytes.
    pub fn bytes(&self, device: &wgpu::Device) -> Result<Vec<u8>, Error> {
        let (send, receive) = std::sync::mpsc::channel();
        self.buffer.map_async(wgpu::MapMode::Read, .., move |result| {
            // The receiver lives until the wait below is over.
            let _ = send.send(result);
        });
        device.poll(wgpu::PollType::wait_indefinitely()).map_err(|e| Error::Lost(e.to_string()))?;
        let mapped = receive.recv().map_err(|e| Error::Lost(e.to_string()))?;
        mapped.map_err(|e| Error::Lost(e.to_string()))?;
        let view = self.buffer.get_mapped_range(..).map_err(|e| Error::Lost(e.to_string()))?;
        Ok(view.to_vec())
    }
}

/// Bytes from one row of a copied texture to the next.
pub fn row_bytes(width: u32) -> u32 {
    (4 * width).next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT)
}
