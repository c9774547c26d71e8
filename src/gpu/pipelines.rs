//! Compiled pipelines.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::mem::offset_of;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use super::bindings::Layouts;
use super::draws::Culling;
use super::item_data::item_stride;
use super::prune::pruned;
use super::records::ItemRecord;
use super::{Module, Needs, source};

/// Formats of what the visibility pass draws into.
pub const ID_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rg32Uint;
pub const DEPTH_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;

/// Which fragment function draws an item.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Program {
    Plain,
    Fused,
    Peel,
    /// Likewise, with triangles that lie over others in one plane.
    FusedInPlanes,
    PeelInPlanes,
    /// For accounts of one pixel, fragment after fragment.
    NextBehind,
}

impl Program {
    fn entry(self) -> &'static str {
        match self {
            Program::Plain => "plain",
            Program::Fused => "fused",
            Program::Peel => "peel",
            Program::FusedInPlanes => "fused_in_planes",
            Program::PeelInPlanes => "peel_in_planes",
            Program::NextBehind => "next_behind",
        }
    }
}

/// What shaders are compiled for: what a plan needs, and the text of the user's own filters.
type Variant = (Needs, Arc<str>);

/// Compiles pipelines when they are first needed and keeps them: for any number of scenes on one device.
#[derive(Debug)]
pub struct PipelineStore {
    pub layouts: Layouts,
    /// Of the views that pictures are drawn into.
    pub target: wgpu::TextureFormat,
    device: wgpu::Device,
    kept: Mutex<BTreeMap<Variant, Arc<Pipelines>>>,
}

impl PipelineStore {
    pub fn new(device: &wgpu::Device, target: wgpu::TextureFormat) -> Self {
        Self { layouts: Layouts::new(device), target, device: device.clone(), kept: Mutex::default() }
    }

    /// The pipelines for plans with the same needs and filters of the user's own, as WGSL.
    pub fn get(&self, needs: Needs, custom: &Arc<str>) -> Arc<Pipelines> {
        let mut kept = self.kept.lock().unwrap_or_else(PoisonError::into_inner);
        let new = || Arc::new(Pipelines::new(needs, Arc::clone(custom)));
        kept.entry((needs, Arc::clone(custom))).or_insert_with(new).clone()
    }
}

/// Pipelines for all plans with the same needs, and any scene.
#[derive(Debug)]
pub struct Pipelines {
    needs: Needs,
    custom: Arc<str>,
    layers: OnceLock<wgpu::ComputePipeline>,
    resolve: OnceLock<wgpu::RenderPipeline>,
    resolve_sample: OnceLock<wgpu::ComputePipeline>,
    aov: OnceLock<wgpu::ComputePipeline>,
    explain: OnceLock<wgpu::ComputePipeline>,
    screen: OnceLock<ScreenPipelines>,
    visibility: OnceLock<wgpu::ShaderModule>,
    crossings: OnceLock<wgpu::RenderPipeline>,
    lids: OnceLock<wgpu::RenderPipeline>,
    find_caps: OnceLock<wgpu::ComputePipeline>,
    draws: Mutex<BTreeMap<(Program, Culling), wgpu::RenderPipeline>>,
}

/// What runs the filters of the screen, each in a few passes, and draws the picture after them.
#[derive(Debug, Clone)]
pub struct ScreenPipelines {
    /// Of filters that take means.
    pub means: Vec<wgpu::ComputePipeline>,
    /// Of those that draw lines.
    pub lines: Vec<wgpu::ComputePipeline>,
    pub finish: wgpu::RenderPipeline,
}

impl Pipelines {
    fn new(needs: Needs, custom: Arc<str>) -> Self {
        Self {
            needs,
            custom,
            layers: OnceLock::new(),
            resolve: OnceLock::new(),
            resolve_sample: OnceLock::new(),
            aov: OnceLock::new(),
            explain: OnceLock::new(),
            screen: OnceLock::new(),
            visibility: OnceLock::new(),
            crossings: OnceLock::new(),
            lids: OnceLock::new(),
            find_caps: OnceLock::new(),
            draws: Mutex::default(),
        }
    }

    pub fn layers(&self, store: &PipelineStore) -> wgpu::ComputePipeline {
        self.compute(&self.layers, store, Module::Layers, &store.layouts.layers, "find_layers")
    }

    pub fn resolve(&self, store: &PipelineStore) -> wgpu::RenderPipeline {
        let build = || {
            let module = self.compile(&store.device, Module::Resolve);
            let layout = pipeline_layout(store, &store.layouts.resolve);
            let entries = ("tile_vertex", "resolve");
            picture_pipeline(&store.device, &module, &layout, entries, store.target)
        };
        self.resolve.get_or_init(build).clone()
    }

    pub fn aov(&self, store: &PipelineStore) -> wgpu::ComputePipeline {
        self.compute(&self.aov, store, Module::Aov, &store.layouts.resolve, "aovs")
    }

    pub fn explain(&self, store: &PipelineStore) -> wgpu::ComputePipeline {
        self.compute(&self.explain, store, Module::Explain, &store.layouts.resolve, "explain")
    }

    /// Composites each pixel of a sample into a buffer.
    pub fn resolve_sample(&self, store: &PipelineStore) -> wgpu::ComputePipeline {
        self.compute(&self.resolve_sample, store, Module::Resolve, &store.layouts.resolve, "resolve_sample")
    }

    pub fn screen(&self, store: &PipelineStore) -> ScreenPipelines {
        let build = || {
            let module = self.compile(&store.device, Module::Screen);
            // Nothing of the scene.
            let layout = store.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
                label: Some("screen"),
                bind_group_layouts: &[None, Some(&store.layouts.plan), Some(&store.layouts.screen)],
                immediate_size: 0,
            });
            let compute = |entry| compute_pipeline(&store.device, &module, &layout, entry);
            ScreenPipelines {
                means: ["sum_rows", "sum_columns"].map(compute).into(),
                lines: ["mark_lines", "find_in_rows", "draw_lines"].map(compute).into(),
                finish: picture_pipeline(&store.device, &module, &layout, ("window_vertex", "finish"), store.target),
            }
        };
        self.screen.get_or_init(build).clone()
    }

    pub fn draw(&self, store: &PipelineStore, program: Program, culling: Culling) -> wgpu::RenderPipeline {
        let module = self.visibility.get_or_init(|| self.compile(&store.device, Module::Visibility));
        let build = || {
            let layout = pipeline_layout(store, &store.layouts.visibility);
            draw_pipeline(
                &store.device,
                module,
                &layout,
                ["vertex", program.entry()],
                culling,
                Keeps::Nearest,
                item_stride(self.needs.set_words, self.needs.channels),
            )
        };
        let mut kept = self.draws.lock().unwrap_or_else(PoisonError::into_inner);
        kept.entry((program, culling)).or_insert_with(build).clone()
    }

    fn compile(&self, device: &wgpu::Device, module: Module) -> wgpu::ShaderModule {
        let text = source(module, &self.needs, &self.custom);
        let source = match naga::front::wgsl::parse_str(&text) {
            Ok(parsed) => wgpu::ShaderSource::Naga(Cow::Owned(pruned(parsed))),
            // The device reports what is wrong.
            Err(_) => wgpu::ShaderSource::Wgsl(text.into()),
        };
        device.create_shader_module(wgpu::ShaderModuleDescriptor { label: Some(module.name()), source })
    }

    /// Lists what rays meet of what may be cut.
    pub fn crossings(&self, store: &PipelineStore) -> wgpu::RenderPipeline {
        self.crossings.get_or_init(|| self.listing(store, "cut_vertex")).clone()
    }

    /// The same of what closes holes of it over.
    pub fn lids(&self, store: &PipelineStore) -> wgpu::RenderPipeline {
        self.lids.get_or_init(|| self.listing(store, "lid_vertex")).clone()
    }

    fn listing(&self, store: &PipelineStore, vertex: &str) -> wgpu::RenderPipeline {
        let module = self.compile(&store.device, Module::Caps);
        let layout = pipeline_layout(store, &store.layouts.visibility);
        let stride = item_stride(self.needs.set_words, self.needs.channels);
        draw_pipeline(&store.device, &module, &layout, [vertex, "crossing"], Culling::None, Keeps::Nothing, stride)
    }

    pub fn find_caps(&self, store: &PipelineStore) -> wgpu::ComputePipeline {
        self.compute(&self.find_caps, store, Module::Caps, &store.layouts.visibility, "find_caps")
    }

    fn compute(
        &self,
        slot: &OnceLock<wgpu::ComputePipeline>,
        store: &PipelineStore,
        module: Module,
        layout: &wgpu::BindGroupLayout,
        entry: &str,
    ) -> wgpu::ComputePipeline {
        let build = || {
            let module = self.compile(&store.device, module);
            compute_pipeline(&store.device, &module, &pipeline_layout(store, layout), entry)
        };
        slot.get_or_init(build).clone()
    }
}

fn pipeline_layout(store: &PipelineStore, work: &wgpu::BindGroupLayout) -> wgpu::PipelineLayout {
    store.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: None,
        bind_group_layouts: &[Some(&store.layouts.scene), Some(&store.layouts.plan), Some(work)],
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

/// What a pass over triangles keeps of them.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Keeps {
    Nearest,
    /// Each lists itself.
    Nothing,
}

/// `entries`: of the vertex and the fragment function.
fn draw_pipeline(
    device: &wgpu::Device,
    module: &wgpu::ShaderModule,
    layout: &wgpu::PipelineLayout,
    entries: [&str; 2],
    culling: Culling,
    keeps: Keeps,
    item_stride: u64,
) -> wgpu::RenderPipeline {
    let [vertex, entry] = entries;
    let keeps_nearest = keeps == Keeps::Nearest;
    // Lids bring their corners with them.
    let has_corners = vertex != "lid_vertex";
    let targets = [Some(ID_FORMAT.into())];
    let corner = wgpu::vertex_attr_array![0 => Float32x3];
    let field = |shader_location, format, offset: usize| wgpu::VertexAttribute {
        shader_location,
        format,
        offset: offset as u64,
    };
    // An attribute of the whole draw: a software adapter reads it once, where it would look a record up for each vertex.
    let shown = [
        field(1, wgpu::VertexFormat::Float32x4, offset_of!(ItemRecord, row_x)),
        field(2, wgpu::VertexFormat::Float32x4, offset_of!(ItemRecord, row_y)),
        field(3, wgpu::VertexFormat::Float32x4, offset_of!(ItemRecord, row_z)),
        field(4, wgpu::VertexFormat::Uint32, offset_of!(ItemRecord, base_vertex)),
    ];
    let front_face = if culling == Culling::BackMirrored { wgpu::FrontFace::Cw } else { wgpu::FrontFace::Ccw };
    device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some(entry),
        layout: Some(layout),
        vertex: wgpu::VertexState {
            module,
            entry_point: Some(vertex),
            compilation_options: Default::default(),
            buffers: &[
                has_corners.then_some(wgpu::VertexBufferLayout {
                    array_stride: 12,
                    step_mode: wgpu::VertexStepMode::Vertex,
                    attributes: &corner,
                }),
                Some(wgpu::VertexBufferLayout {
                    array_stride: item_stride,
                    step_mode: wgpu::VertexStepMode::Instance,
                    attributes: &shown,
                }),
            ],
        },
        primitive: wgpu::PrimitiveState {
            front_face,
            cull_mode: (culling != Culling::None).then_some(wgpu::Face::Back),
            ..Default::default()
        },
        // Reverse-Z; at equal depths what was drawn first stays in front.
        depth_stencil: Some(wgpu::DepthStencilState {
            format: DEPTH_FORMAT,
            depth_write_enabled: Some(keeps_nearest),
            depth_compare: Some(if keeps_nearest {
                wgpu::CompareFunction::Greater
            } else {
                wgpu::CompareFunction::Always
            }),
            stencil: Default::default(),
            bias: Default::default(),
        }),
        multisample: Default::default(),
        fragment: Some(wgpu::FragmentState {
            module,
            entry_point: Some(entry),
            compilation_options: Default::default(),
            targets: if keeps_nearest { &targets } else { &[] },
        }),
        multiview_mask: None,
        cache: None,
    })
}

/// Draws the picture. `entries`: of vertices, which make strips, and of fragments.
fn picture_pipeline(
    device: &wgpu::Device,
    module: &wgpu::ShaderModule,
    layout: &wgpu::PipelineLayout,
    (vertex, fragment): (&str, &str),
    target: wgpu::TextureFormat,
) -> wgpu::RenderPipeline {
    device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some(fragment),
        layout: Some(layout),
        vertex: wgpu::VertexState {
            module,
            entry_point: Some(vertex),
            compilation_options: Default::default(),
            buffers: &[],
        },
        primitive: wgpu::PrimitiveState { topology: wgpu::PrimitiveTopology::TriangleStrip, ..Default::default() },
        depth_stencil: None,
        multisample: Default::default(),
        fragment: Some(wgpu::FragmentState {
            module,
            entry_point: Some(fragment),
            compilation_options: Default::default(),
            targets: &[Some(target.into())],
        }),
        multiview_mask: None,
        cache: None,
    })
}
