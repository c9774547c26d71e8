//! Compiled pipelines for one size of lens sets.

use super::bindings::Layouts;
use super::draws::Culling;
use super::{Module, source};

/// Formats of what the visibility pass draws into.
pub const ID_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rg32Uint;
pub const DEPTH_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;

/// The drawing pipelines of one fragment function, by culling.
#[derive(Debug)]
pub struct ByCulling([wgpu::RenderPipeline; 3]);

impl ByCulling {
    pub fn get(&self, culling: Culling) -> &wgpu::RenderPipeline {
        &self.0[culling as usize]
    }
}

/// Everything that is compiled; independent of scene and plan but for the number of words of a lens set.
#[derive(Debug)]
pub struct Pipelines {
    pub layers: wgpu::ComputePipeline,
    pub plain: ByCulling,
    pub fused: ByCulling,
    pub peel: ByCulling,
    pub resolve: wgpu::ComputePipeline,
    pub aov: wgpu::ComputePipeline,
    pub finish: wgpu::RenderPipeline,
}

impl Pipelines {
    /// `words`: 32-bit words of a lens set; `target`: the format that pictures are drawn into.
    pub fn new(device: &wgpu::Device, layouts: &Layouts, words: u32, target: wgpu::TextureFormat) -> Self {
        let compile = |module| compile(device, module, words);
        let pipeline_layout = |work: &wgpu::BindGroupLayout| pipeline_layout(device, layouts, work);
        let compute = |module, layout: &wgpu::BindGroupLayout, entry| {
            compute_pipeline(device, &compile(module), &pipeline_layout(layout), entry)
        };
        let visibility = compile(Module::Visibility);
        let drawing = pipeline_layout(&layouts.visibility);
        let draw = |entry: &str| {
            ByCulling(
                [Culling::None, Culling::Back, Culling::BackMirrored]
                    .map(|culling| draw_pipeline(device, &visibility, &drawing, entry, culling)),
            )
        };
        Self {
            layers: compute(Module::Layers, &layouts.layers, "find_layers"),
            plain: draw("plain"),
            fused: draw("fused"),
            peel: draw("peel"),
            resolve: compute(Module::Resolve, &layouts.resolve, "resolve"),
            aov: compute(Module::Aov, &layouts.resolve, "aovs"),
            finish: finish_pipeline(device, &compile(Module::Finish), &pipeline_layout(&layouts.finish), target),
        }
    }
}

fn compile(device: &wgpu::Device, module: Module, words: u32) -> wgpu::ShaderModule {
    device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some(module.name()),
        source: wgpu::ShaderSource::Wgsl(source(module, words).into()),
    })
}

fn pipeline_layout(device: &wgpu::Device, layouts: &Layouts, work: &wgpu::BindGroupLayout) -> wgpu::PipelineLayout {
    device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: None,
        bind_group_layouts: &[Some(&layouts.scene), Some(&layouts.plan), Some(work)],
        immediate_size: 0,
    })
}

fn compute_pipeline(
    device: &wgpu::Device,
    module: &wgpu::ShaderModule,
    layout: &wgpu::PipelineLayout,
    entry: &str,
) -> wgpu::ComputePipeline {
    device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
        label: Some(entry),
        layout: Some(layout),
        module,
        entry_point: Some(entry),
        compilation_options: Default::default(),
        cache: None,
    })
}

fn draw_pipeline(
    device: &wgpu::Device,
    module: &wgpu::ShaderModule,
    layout: &wgpu::PipelineLayout,
    entry: &str,
    culling: Culling,
) -> wgpu::RenderPipeline {
    let attributes = wgpu::vertex_attr_array![0 => Float32x3];
    let front_face = if culling == Culling::BackMirrored { wgpu::FrontFace::Cw } else { wgpu::FrontFace::Ccw };
    device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some(entry),
        layout: Some(layout),
        vertex: wgpu::VertexState {
            module,
            entry_point: Some("vertex"),
            compilation_options: Default::default(),
            buffers: &[Some(wgpu::VertexBufferLayout {
                array_stride: 12,
                step_mode: wgpu::VertexStepMode::Vertex,
                attributes: &attributes,
            })],
        },
        primitive: wgpu::PrimitiveState {
            front_face,
            cull_mode: (culling != Culling::None).then_some(wgpu::Face::Back),
            ..Default::default()
        },
        // Reverse-Z; at equal depths what was drawn first stays in front.
        depth_stencil: Some(wgpu::DepthStencilState {
            format: DEPTH_FORMAT,
            depth_write_enabled: Some(true),
            depth_compare: Some(wgpu::CompareFunction::Greater),
            stencil: Default::default(),
            bias: Default::default(),
        }),
        multisample: Default::default(),
        fragment: Some(wgpu::FragmentState {
            module,
            entry_point: Some(entry),
            compilation_options: Default::default(),
            targets: &[Some(ID_FORMAT.into())],
        }),
        multiview_mask: None,
        cache: None,
    })
}

fn finish_pipeline(
    device: &wgpu::Device,
    module: &wgpu::ShaderModule,
    layout: &wgpu::PipelineLayout,
    target: wgpu::TextureFormat,
) -> wgpu::RenderPipeline {
    device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some("finish"),
        layout: Some(layout),
        vertex: wgpu::VertexState {
            module,
            entry_point: Some("whole_target"),
            compilation_options: Default::default(),
            buffers: &[],
        },
        primitive: Default::default(),
        depth_stencil: None,
        multisample: Default::default(),
        fragment: Some(wgpu::FragmentState {
            module,
            entry_point: Some("finish"),
            compilation_options: Default::default(),
            targets: &[Some(target.into())],
        }),
        multiview_mask: None,
        cache: None,
    })
}
