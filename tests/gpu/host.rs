//! As an application that has its own device: the renderer draws into the host's encoder and target.

use lenspeel::gpu::{Headless, RenderOptions, Renderer};

use crate::cases::on_cpu;
use crate::scene::{PERSPECTIVE, planned};

const SIZE: [u32; 2] = [64, 48];

/// An sRGB target gets the same picture; the GPU encodes it.
pub fn a_target_of_a_host(device: &Headless) -> Result<(), String> {
    let lens = "[[lens]]\nname = \"a\"\nshape.sphere = { center = [0, 0, 0], radius = 0.6 }\nfilters = [\"normals\"]";
    let (scene, plan) = planned(SIZE, 1, PERSPECTIVE, lens);
    let (device, queue) = device.parts();
    let format = wgpu::TextureFormat::Rgba8UnormSrgb;
    let target = device.create_texture(&wgpu::TextureDescriptor {
        label: Some("the host's target"),
        size: wgpu::Extent3d { width: SIZE[0], height: SIZE[1], depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC,
        view_formats: &[],
    });
    let mut renderer = Renderer::new(device, queue, &scene, format).map_err(|e| e.to_string())?;
    let mut encoder = device.create_command_encoder(&Default::default());
    let view = target.create_view(&Default::default());
    let encoded = renderer
        .render(device, &mut encoder, &view, &scene, &plan, RenderOptions::default())
        .map_err(|e| e.to_string())?;
    let pixels = download(device, queue, encoder, &target)?;
    let expected = on_cpu(&scene, &plan);
    let off = expected.pixels.iter().zip(&pixels).filter(|(a, b)| (0..4).any(|c| a[c].abs_diff(b[c]) > 2)).count();
    if encoded.room.fragments == 0 || off > pixels.len() / 500 {
        return Err(format!("{off} pixels of {} differ", pixels.len()));
    }
    Ok(())
}

/// Rows of 256 bytes need no padding at 64 pixels.
fn download(
    device: &wgpu::Device,
    queue: &wgpu::Queue,
    mut encoder: wgpu::CommandEncoder,
    target: &wgpu::Texture,
) -> Result<Vec<[u8; 4]>, String> {
    let buffer = device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("download"),
        size: u64::from(4 * SIZE[0] * SIZE[1]),
        usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    });
    let layout = wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(4 * SIZE[0]), rows_per_image: None };
    let copy = wgpu::TexelCopyBufferInfo { buffer: &buffer, layout };
    encoder.copy_texture_to_buffer(target.as_image_copy(), copy, target.size());
    queue.submit([encoder.finish()]);
    buffer.map_async(wgpu::MapMode::Read, .., |result| result.expect("the buffer can be read"));
    device.poll(wgpu::PollType::wait_indefinitely()).map_err(|e| e.to_string())?;
    let view = buffer.get_mapped_range(..).map_err(|e| e.to_string())?;
    Ok(view.chunks_exact(4).map(|p| [p[0], p[1], p[2], p[3]]).collect())
}
