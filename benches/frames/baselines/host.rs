//! A device of the baselines' own, with the mesh in vertex buffers.

use std::sync::{Arc, Mutex};

use lenspeel::appearance::WGSL;
use lenspeel::gpu::AdapterChoice;
use lenspeel::plan::Plan;
use lenspeel::scene::{MaterialRecord, Scene};
use lenspeel::view::Projection;
use wgpu::util::{BufferInitDescriptor, DeviceExt};

use super::frame::{Draw, Mesh};

pub const DEPTH_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;
pub const COLOR_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;
const COMMON: &str = include_str!("common.wgsl");
const MOST_LIGHTS: usize = 8;

pub struct Host {
    pub device: wgpu::Device,
    pub queue: wgpu::Queue,
    /// Vertex shaders can cut triangles off.
    pub clips: bool,
    /// The first complaint of the device.
    reported: Arc<Mutex<Option<String>>>,
}

/// The surface of the benchmarks on the device.
pub struct Surface {
    pub mesh: Mesh,
    material: MaterialRecord,
}

/// `Scene` of `common.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
struct SceneRecord {
    clip_from_eye: [[f32; 4]; 4],
    eye: [f32; 4],
    ambient: [f32; 4],
    base_color: [f32; 4],
    metallic: f32,
    roughness: f32,
    light_count: u32,
    pad: u32,
    lights: [[u32; 16]; MOST_LIGHTS],
}

/// What a pipeline draws with.
pub struct Program<'a> {
    /// Behind what all share.
    pub wgsl: &'a str,
    pub vertex: &'a str,
    /// `None`: only depths are drawn.
    pub fragment: Option<&'a str>,
    pub cull: Option<wgpu::Face>,
}

impl Host {
    pub fn new(choice: &AdapterChoice) -> Result<Self, String> {
        let clips = choice.adapter.features() & wgpu::Features::CLIP_DISTANCES;
        let request = choice.adapter.request_device(&wgpu::DeviceDescriptor {
            label: Some("baselines"),
            required_features: clips,
            ..Default::default()
        });
        let (device, queue) = pollster::block_on(request).map_err(|error| error.to_string())?;
        let reported = Arc::new(Mutex::new(None));
        let first = reported.clone();
        device.on_uncaptured_error(Arc::new(move |error: wgpu::Error| {
            if let Ok(mut slot) = first.lock() {
                slot.get_or_insert(error.to_string());
            }
        }));
        Ok(Self { device, queue, clips: !clips.is_empty(), reported })
    }

    /// Fails when the device has complained.
    pub fn check(&self) -> Result<(), String> {
        match self.reported.lock().map(|mut slot| slot.take()) {
            Ok(None) => Ok(()),
            Ok(Some(message)) => Err(message),
            Err(error) => Err(error.to_string()),
        }
    }

    pub fn buffer<T: bytemuck::NoUninit>(&self, contents: &[T], usage: wgpu::BufferUsages) -> wgpu::Buffer {
        let contents = bytemuck::cast_slice(contents);
        self.device.create_buffer_init(&BufferInitDescriptor { label: None, contents, usage })
    }

    /// The only primitive of a scene, which stands where its node's space is the world's.
    pub fn surface(&self, scene: &Scene) -> Surface {
        let primitive = &scene.models[0].meshes[0].primitives[0];
        let normals = primitive.normals.as_ref().expect("the surface has normals");
        let vertex = wgpu::BufferUsages::VERTEX;
        Surface {
            mesh: Mesh {
                vertices: vec![self.buffer(&primitive.positions, vertex), self.buffer(normals, vertex)],
                indices: self.buffer(&primitive.triangles, wgpu::BufferUsages::INDEX),
                index_count: 3 * primitive.triangles.len() as u32,
            },
            material: scene.materials[primitive.material],
        }
    }

    /// A draw of a mesh. Binding 0 of a pipeline is the scene's record, those in `bindings` are all others that its
    /// functions use.
    pub fn draw(
        &self,
        program: &Program,
        mesh: &Mesh,
        record: &wgpu::Buffer,
        bindings: &[(u32, wgpu::BindingResource)],
    ) -> Draw {
        let pipeline = self.pipeline(program, mesh.vertices.len());
        let scene = [(0, record.as_entire_binding())];
        let entries: Vec<wgpu::BindGroupEntry> = scene
            .iter()
            .chain(bindings)
            .map(|(binding, resource)| wgpu::BindGroupEntry { binding: *binding, resource: resource.clone() })
            .collect();
        let group = self.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: None,
            layout: &pipeline.get_bind_group_layout(0),
            entries: &entries,
        });
        Draw { pipeline, group, mesh: mesh.clone(), instances: 0..1 }
    }

    /// A pipeline whose first attribute is the position and whose second, where there is one, the normal.
    fn pipeline(&self, program: &Program, attributes: usize) -> wgpu::RenderPipeline {
        // Extensions are enabled before all else.
        let enable = if self.clips { "enable clip_distances;\n" } else { "" };
        let module = self.device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: program.fragment,
            source: wgpu::ShaderSource::Wgsl(format!("{enable}{WGSL}{COMMON}{}", program.wgsl).into()),
        });
        let formats = [wgpu::vertex_attr_array![0 => Float32x3], wgpu::vertex_attr_array![1 => Float32x3]];
        let buffers: Vec<Option<wgpu::VertexBufferLayout>> = formats[..attributes]
            .iter()
            .map(|attributes| {
                Some(wgpu::VertexBufferLayout { array_stride: 12, step_mode: wgpu::VertexStepMode::Vertex, attributes })
            })
            .collect();
        let targets = [Some(COLOR_FORMAT.into())];
        self.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: program.fragment,
            layout: None,
            vertex: wgpu::VertexState {
                module: &module,
                entry_point: Some(program.vertex),
                compilation_options: Default::default(),
                buffers: &buffers,
            },
            primitive: wgpu::PrimitiveState { cull_mode: program.cull, ..Default::default() },
            depth_stencil: Some(wgpu::DepthStencilState {
                format: DEPTH_FORMAT,
                depth_write_enabled: Some(true),
                depth_compare: Some(wgpu::CompareFunction::Greater),
                stencil: Default::default(),
                bias: Default::default(),
            }),
            multisample: Default::default(),
            fragment: program.fragment.map(|entry| wgpu::FragmentState {
                module: &module,
                entry_point: Some(entry),
                compilation_options: Default::default(),
                targets: &targets,
            }),
            multiview_mask: None,
            cache: None,
        })
    }

    pub fn texture(
        &self,
        [width, height]: [u32; 2],
        format: wgpu::TextureFormat,
        usage: wgpu::TextureUsages,
    ) -> wgpu::Texture {
        self.device.create_texture(&wgpu::TextureDescriptor {
            label: None,
            size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format,
            usage: usage | wgpu::TextureUsages::RENDER_ATTACHMENT,
            view_formats: &[],
        })
    }
}

impl Surface {
    /// Back faces are left out where lenspeel leaves them out.
    pub fn cull(&self, plan: &Plan) -> Option<wgpu::Face> {
        (plan.cull_backfaces && self.material.double_sided == 0).then_some(wgpu::Face::Back)
    }

    /// The uniform record of a plan's picture.
    pub fn record(&self, plan: &Plan) -> Vec<u8> {
        let view = &plan.view;
        let Projection::Perspective { tan_half_y } = view.projection else {
            panic!("the benchmarks look in perspective");
        };
        let aspect = f64::from(view.size[0]) / f64::from(view.size[1]);
        // Reverse-Z with an infinite far plane. Such a camera's anchor is its eye.
        let rows = [
            (view.right / (tan_half_y * aspect)).extend(0.0),
            (view.up / tan_half_y).extend(0.0),
            glam::DVec4::new(0.0, 0.0, 0.0, view.from_eye(view.near)),
            view.forward.extend(0.0),
        ];
        let clip_from_eye = glam::DMat4::from_cols(rows[0], rows[1], rows[2], rows[3]).transpose().as_mat4();
        let mut lights = [[0; 16]; MOST_LIGHTS];
        for (record, light) in lights.iter_mut().zip(&plan.lighting.lights) {
            *record = bytemuck::cast(*light);
        }
        let record = SceneRecord {
            clip_from_eye: clip_from_eye.to_cols_array_2d(),
            eye: view.eye.as_vec3().extend(0.0).to_array(),
            ambient: plan.lighting.up.extend(plan.lighting.ambient).to_array(),
            base_color: self.material.base_color,
            metallic: self.material.metallic,
            roughness: self.material.roughness,
            light_count: plan.lighting.lights.len().min(MOST_LIGHTS) as u32,
            pad: 0,
            lights,
        };
        bytemuck::bytes_of(&record).to_vec()
    }
}
