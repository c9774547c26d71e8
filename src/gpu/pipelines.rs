//! Compiled pipelines.

use std::collections::BTreeMap;
use std::mem::offset_of;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use super::bindings::Layouts;
use super::draws::Culling;
use super::item_data::item_stride;
use super::records::ItemRecord;
use super::shader::{Shader, ShaderKey};
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
    /// Likewise, with triangles that have their depths from their planes.
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

/// What shaders are written for: what a plan needs, and the text of the user's own filters.
type Variant = (Needs, Arc<str>);

/// A compute pipeline, by its shader and entry point.
type ComputeKey = (ShaderKey, &'static str);
/// One that draws: its shader, the entry points of vertices and fragments, how it culls, and the stride of items.
type RenderKey = (ShaderKey, [&'static str; 2], Culling, u64);
type Kept<K, P> = Mutex<BTreeMap<K, Arc<OnceLock<P>>>>;

/// Compiles pipelines when they are first needed and keeps them: for any number of scenes on one device.
///
/// Plans of different needs share what comes out alike once what they do not need is taken out of a shader.
#[derive(Debug)]
pub struct PipelineStore {
    pub layouts: Layouts,
    /// Of the views that pictures are drawn into.
    pub target: wgpu::TextureFormat,
    device: wgpu::Device,
    variants: Mutex<BTreeMap<Variant, Arc<Pipelines>>>,
    compute: Kept<ComputeKey, wgpu::ComputePipeline>,
    render: Kept<RenderKey, wgpu::RenderPipeline>,
}

impl PipelineStore {
    pub fn new(device: &wgpu::Device, target: wgpu::TextureFormat) -> Self {
        Self {
            layouts: Layouts::new(device),
            target,
            device: device.clone(),
            variants: Mutex::default(),
            compute: Mutex::default(),
            render: Mutex::default(),
        }
    }

    /// The pipelines for plans with the same needs and filters of the user's own, as WGSL.
    pub fn get(&self, needs: Needs, custom: &Arc<str>) -> Arc<Pipelines> {
        let mut variants = self.variants.lock().unwrap_or_else(PoisonError::into_inner);
        let new = || Arc::new(Pipelines::new(needs, Arc::clone(custom)));
        variants.entry((needs, Arc::clone(custom))).or_insert_with(new).clone()
    }

    fn layout(&self, module: Module) -> wgpu::PipelineLayout {
        let Layouts { scene, plan, layers, visibility, resolve, screen } = &self.layouts;
        let (scene, work) = match module {
            Module::Layers => (Some(scene), layers),
            Module::Visibility | Module::Caps => (Some(scene), visibility),
            Module::Resolve | Module::Aov | Module::Explain => (Some(scene), resolve),
            // Nothing of the scene.
            Module::Screen => (None, screen),
        };
        self.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some(module.name()),
            bind_group_layouts: &[scene, Some(plan), Some(work)],
            immediate_size: 0,
        })
    }
}

/// The one that is kept, or a new one. Others may be made meanwhile.
fn kept<K: Ord, P: Clone>(all: &Kept<K, P>, key: K, new: impl FnOnce() -> P) -> P {
    let slot = all.lock().unwrap_or_else(PoisonError::into_inner).entry(key).or_default().clone();
    slot.get_or_init(new).clone()
}

/// Pipelines for all plans with the same needs, and any scene. Shaders are written once for each.
#[derive(Debug)]
pub struct Pipelines {
    needs: Needs,
    custom: Arc<str>,
    compute: Kept<(Module, &'static str), wgpu::ComputePipeline>,
    render: Kept<(Module, [&'static str; 2], Culling), wgpu::RenderPipeline>,
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
        Self { needs, custom, compute: Mutex::default(), render: Mutex::default() }
    }

    pub fn layers(&self, store: &PipelineStore) -> wgpu::ComputePipeline {
        self.compute(store, Module::Layers, "find_layers")
    }

    pub fn resolve(&self, store: &PipelineStore) -> wgpu::RenderPipeline {
        self.picture(store, Module::Resolve, ["tile_vertex", "resolve"])
    }

    pub fn aov(&self, store: &PipelineStore) -> wgpu::ComputePipeline {
        self.compute(store, Module::Aov, "aovs")
    }

    pub fn explain(&self, store: &PipelineStore) -> wgpu::ComputePipeline {
        self.compute(store, Module::Explain, "explain")
    }

    /// Composites each pixel of a sample into a buffer.
    pub fn resolve_sample(&self, store: &PipelineStore) -> wgpu::ComputePipeline {
        self.compute(store, Module::Resolve, "resolve_sample")
    }

    pub fn screen(&self, store: &PipelineStore) -> ScreenPipelines {
        let compute = |entry| self.compute(store, Module::Screen, entry);
        ScreenPipelines {
            means: ["sum_rows", "sum_columns"].map(compute).into(),
            lines: ["mark_lines", "find_in_rows", "draw_lines"].map(compute).into(),
            finish: self.picture(store, Module::Screen, ["window_vertex", "finish"]),
        }
    }

    pub fn draw(&self, store: &PipelineStore, program: Program, culling: Culling) -> wgpu::RenderPipeline {
        self.drawing(store, Module::Visibility, ["vertex", program.entry()], culling, Keeps::Nearest)
    }

    /// Lists what rays meet of what may be cut.
    pub fn crossings(&self, store: &PipelineStore) -> wgpu::RenderPipeline {
        self.drawing(store, Module::Caps, ["cut_vertex", "crossing"], Culling::None, Keeps::Nothing)
    }

    /// The same of what closes holes of it over.
    pub fn lids(&self, store: &PipelineStore) -> wgpu::RenderPipeline {
        self.drawing(store, Module::Caps, ["lid_vertex", "crossing"], Culling::None, Keeps::Nothing)
    }

    pub fn find_caps(&self, store: &PipelineStore) -> wgpu::ComputePipeline {
        self.compute(store, Module::Caps, "find_caps")
    }

    fn compute(&self, store: &PipelineStore, module: Module, entry: &'static str) -> wgpu::ComputePipeline {
        kept(&self.compute, (module, entry), || {
            let shader = self.shader(module, &[entry]);
            kept(&store.compute, (shader.key, entry), || {
                compute_pipeline(&store.device, &shader.compiled(&store.device), &store.layout(module), entry)
            })
        })
    }

    fn drawing(
        &self,
        store: &PipelineStore,
        module: Module,
        entries: [&'static str; 2],
        culling: Culling,
        keeps: Keeps,
    ) -> wgpu::RenderPipeline {
        kept(&self.render, (module, entries, culling), || {
            let stride = item_stride(self.needs.set_words, self.needs.channels);
            let shader = self.shader(module, &entries);
            kept(&store.render, (shader.key, entries, culling, stride), || {
                let compiled = shader.compiled(&store.device);
                draw_pipeline(&store.device, &compiled, &store.layout(module), entries, culling, keeps, stride)
            })
        })
    }

    fn picture(&self, store: &PipelineStore, module: Module, entries: [&'static str; 2]) -> wgpu::RenderPipeline {
        kept(&self.render, (module, entries, Culling::None), || {
            let shader = self.shader(module, &entries);
            kept(&store.render, (shader.key, entries, Culling::None, 0), || {
                let compiled = shader.compiled(&store.device);
                picture_pipeline(&store.device, &compiled, &store.layout(module), entries, store.target)
            })
        })
    }

    fn shader(&self, module: Module, entries: &[&str]) -> Shader {
        Shader::new(module.name(), source(module, &self.needs, &self.custom), entries)
    }
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
    [vertex, fragment]: [&str; 2],
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
