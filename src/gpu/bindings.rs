//! Bind group layouts: group 0 is the scene, group 1 the plan, group 2 what a pass works on.

/// All layouts; the same for every plan.
#[derive(Debug)]
pub struct Layouts {
    pub scene: wgpu::BindGroupLayout,
    pub plan: wgpu::BindGroupLayout,
    pub layers: wgpu::BindGroupLayout,
    pub visibility: wgpu::BindGroupLayout,
    pub resolve: wgpu::BindGroupLayout,
    pub screen: wgpu::BindGroupLayout,
}

/// What a binding holds.
#[derive(Clone, Copy)]
enum Kind {
    Read,
    ReadWrite,
    /// At an offset that each pass chooses. Not a uniform: some software adapters compile shaders anew for the values that
    /// branches read from uniforms, with each draw, and keep them all.
    Record,
    TexturePages,
    IdTexture,
}

impl Layouts {
    pub fn new(device: &wgpu::Device) -> Self {
        use Kind::{IdTexture, Read, ReadWrite, Record, TexturePages};
        let compute = wgpu::ShaderStages::COMPUTE;
        let fragment = wgpu::ShaderStages::FRAGMENT;
        let everywhere = compute | fragment | wgpu::ShaderStages::VERTEX;
        let plan = [Record, Read, Read, Read, Read, Read, Read, Read, Read, Read, Read];
        Self {
            scene: layout(
                device,
                "scene",
                compute | fragment,
                &[Read, Read, Read, Read, Read, TexturePages, TexturePages, Read],
            ),
            plan: layout(device, "plan", everywhere, &plan),
            layers: layout(device, "layers", compute | fragment, &[ReadWrite, ReadWrite]),
            visibility: layout(device, "visibility", compute | fragment, &[Read, ReadWrite, ReadWrite, ReadWrite]),
            resolve: layout(device, "resolve", compute | fragment, &[Read, Read, Read, IdTexture, ReadWrite]),
            screen: layout(device, "screen", compute | fragment, &[ReadWrite, ReadWrite, ReadWrite, Record, ReadWrite]),
        }
    }
}

fn layout(device: &wgpu::Device, label: &str, visibility: wgpu::ShaderStages, kinds: &[Kind]) -> wgpu::BindGroupLayout {
    let entries: Vec<wgpu::BindGroupLayoutEntry> = (0u32..)
        .zip(kinds)
        .map(|(binding, kind)| wgpu::BindGroupLayoutEntry { binding, visibility, ty: binding_type(*kind), count: None })
        .collect();
    device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label: Some(label), entries: &entries })
}

fn binding_type(kind: Kind) -> wgpu::BindingType {
    let storage = |read_only| wgpu::BindingType::Buffer {
        ty: wgpu::BufferBindingType::Storage { read_only },
        has_dynamic_offset: false,
        min_binding_size: None,
    };
    let texture =
        |sample_type, view_dimension| wgpu::BindingType::Texture { sample_type, view_dimension, multisampled: false };
    match kind {
        Kind::Read => storage(true),
        Kind::ReadWrite => storage(false),
        Kind::Record => wgpu::BindingType::Buffer {
            ty: wgpu::BufferBindingType::Storage { read_only: true },
            has_dynamic_offset: true,
            min_binding_size: None,
        },
        Kind::TexturePages => {
            texture(wgpu::TextureSampleType::Float { filterable: false }, wgpu::TextureViewDimension::D2Array)
        }
        Kind::IdTexture => texture(wgpu::TextureSampleType::Uint, wgpu::TextureViewDimension::D2),
    }
}

/// A bind group with the resources at bindings 0, 1, ...
pub fn group(
    device: &wgpu::Device,
    label: &str,
    layout: &wgpu::BindGroupLayout,
    resources: &[wgpu::BindingResource<'_>],
) -> wgpu::BindGroup {
    let entries: Vec<wgpu::BindGroupEntry<'_>> = (0u32..)
        .zip(resources)
        .map(|(binding, resource)| wgpu::BindGroupEntry { binding, resource: resource.clone() })
        .collect();
    device.create_bind_group(&wgpu::BindGroupDescriptor { label: Some(label), layout, entries: &entries })
}
