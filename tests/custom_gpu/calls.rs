//! The same calls of filters on both sides: by the interpreter, and in one compute shader.

use lenspeel::custom::{self, Custom, MEMBERS, SURFACE_WORDS, SurfaceValue};
use lenspeel::gpu::Headless;
use lenspeel::spec::Source;
use wgpu::util::DeviceExt;

use crate::random::Random;

/// Surfaces that each filter is called for.
const CALLS: usize = 512;
const WORKGROUP: usize = 64;
/// Words that one call reads or writes: a surface, and a colour behind it.
pub const WORDS: usize = SURFACE_WORDS + 3;

/// Filters with the defaults of their parameters.
pub struct Filters {
    pub files: Vec<Custom>,
    pub words: Vec<Vec<u32>>,
}

impl Filters {
    /// Reads named files.
    pub fn read<'a>(files: impl IntoIterator<Item = (&'a str, &'a str)>) -> Result<Self, String> {
        let spec = Source::new("spec.toml", "");
        let (mut read, mut words) = (Vec::new(), Vec::new());
        for (name, text) in files {
            let file = Custom::parse(text, name).map_err(|error| format!("{error}\n{text}"))?;
            words.push(file.values(&spec, &[]).map_err(|error| error.to_string())?);
            read.push(file);
        }
        Ok(Self { files: read, words })
    }

    /// All calls of all filters by the interpreter.
    pub fn on_cpu(&self) -> Vec<f32> {
        let inputs = inputs();
        let of_file = |(file, words): (&Custom, &Vec<u32>)| -> Vec<f32> {
            let both = |(c, s): &([f32; 3], SurfaceValue)| {
                let surface: [f32; SURFACE_WORDS] = bytemuck::cast(file.surface(s, words));
                surface.into_iter().chain(file.color(*c, s, words))
            };
            inputs.iter().flat_map(both).collect()
        };
        self.files.iter().zip(&self.words).flat_map(of_file).collect()
    }

    /// The same on a device.
    pub fn on_gpu(&self, device: &Headless) -> Result<Vec<f32>, String> {
        let (device, queue) = device.parts();
        let scope = device.push_error_scope(wgpu::ErrorFilter::Validation);
        let inputs = input_numbers();
        let words: Vec<u32> = std::iter::once(BEFORE_WORDS).chain(self.words.concat()).collect();
        let buffer = |contents: &[u8]| {
            let usage = wgpu::BufferUsages::STORAGE;
            device.create_buffer_init(&wgpu::util::BufferInitDescriptor { label: None, contents, usage })
        };
        let (words, given) = (buffer(bytemuck::cast_slice(&words)), buffer(bytemuck::cast_slice(&inputs)));
        let size = (self.files.len() * inputs.len() * size_of::<f32>()) as u64;
        let empty = |usage| {
            device.create_buffer(&wgpu::BufferDescriptor { label: None, size, usage, mapped_at_creation: false })
        };
        let outputs = empty(wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC);
        let read = empty(wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST);
        let source = wgpu::ShaderSource::Wgsl(self.shader().into());
        let module = device.create_shader_module(wgpu::ShaderModuleDescriptor { label: None, source });
        let pipeline = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: None,
            layout: None,
            module: &module,
            entry_point: Some("main"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            cache: None,
        });
        let entries = [&words, &given, &outputs]
            .iter()
            .enumerate()
            .map(|(i, bound)| wgpu::BindGroupEntry { binding: i as u32, resource: bound.as_entire_binding() })
            .collect::<Vec<_>>();
        let layout = pipeline.get_bind_group_layout(0);
        let group =
            device.create_bind_group(&wgpu::BindGroupDescriptor { label: None, layout: &layout, entries: &entries });
        let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        {
            let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
            pass.set_pipeline(&pipeline);
            pass.set_bind_group(0, &group, &[]);
            pass.dispatch_workgroups((CALLS / WORKGROUP) as u32, self.files.len() as u32, 1);
        }
        encoder.copy_buffer_to_buffer(&outputs, 0, &read, 0, size);
        queue.submit([encoder.finish()]);
        read.slice(..).map_async(wgpu::MapMode::Read, |mapped| mapped.expect("a buffer that can be read"));
        device.poll(wgpu::PollType::wait_indefinitely()).expect("the device goes on");
        if let Some(error) = pollster::block_on(scope.pop()) {
            return Err(error.to_string());
        }
        let view = read.slice(..).get_mapped_range().expect("a mapped buffer");
        Ok(bytemuck::cast_slice(&view).to_vec())
    }

    /// A shader that calls one filter of each row for each input.
    fn shader(&self) -> String {
        // The first word belongs to no filter, so that one that ignores `first` is found.
        let firsts = self.words.iter().scan(1, |at, words| {
            let first = *at;
            *at += words.len();
            Some(format!("{first}u"))
        });
        let firsts: Vec<String> = firsts.collect();
        let words = |range: std::ops::Range<usize>| -> String {
            range.map(|i| format!("inputs[input + {i}u]")).collect::<Vec<_>>().join(", ")
        };
        let (mut members, mut results, mut at) = (Vec::new(), Vec::new(), 0);
        for (name, count) in MEMBERS {
            members.push(format!("vec{count}f({})", words(at..at + count)).replace("vec1f", "f32"));
            let of = |i| if count == 1 { format!("r.{name}") } else { format!("r.{name}[{i}]") };
            results.extend((0..count).map(of));
            at += count;
        }
        results.extend(["x", "y", "z"].map(|part| format!("color.{part}")));
        let results: Vec<String> =
            results.iter().enumerate().map(|(i, result)| format!("    outputs[output + {i}u] = {result};\n")).collect();
        format!(
            "@group(0) @binding(0) var<storage> custom_words: array<u32>;
@group(0) @binding(1) var<storage> inputs: array<f32>;
@group(0) @binding(2) var<storage, read_write> outputs: array<f32>;
{filters}
@compute @workgroup_size({WORKGROUP}) fn main(@builtin(global_invocation_id) id: vec3u) {{
    var firsts = array({firsts});
    // Also where no filter has parameters, there is a buffer of them.
    let first = select(0u, firsts[id.y], custom_words[0] == {BEFORE_WORDS}u);
    let input = id.x * {WORDS}u;
    let output = (id.y * {CALLS}u + id.x) * {WORDS}u;
    let s = CustomSurface({members});
    let r = custom_surface(id.y, s, first);
    let color = custom_color(id.y, vec3f({color}), s, first);
{results}}}
",
            filters = custom::wgsl(&self.files.iter().collect::<Vec<_>>()),
            firsts = firsts.join(", "),
            members = members.join(", "),
            color = words(SURFACE_WORDS..WORDS),
            results = results.concat(),
        )
    }
}

/// What stands in front of all parameters.
const BEFORE_WORDS: u32 = 0xdead_beef;

/// The colour and surface of each call.
fn inputs() -> Vec<([f32; 3], SurfaceValue)> {
    let mut random = Random::new(7);
    (0..CALLS).map(|_| (numbers(&mut random), surface(&mut random))).collect()
}

/// The same, as a filter that changes nothing gives them.
pub fn input_numbers() -> Vec<f32> {
    let words = |(c, s): ([f32; 3], SurfaceValue)| bytemuck::cast::<_, [f32; SURFACE_WORDS]>(s).into_iter().chain(c);
    inputs().into_iter().flat_map(words).collect()
}

/// From 0 to 1.
fn numbers<const N: usize>(random: &mut Random) -> [f32; N] {
    [0; N].map(|_| random.between(0.0, 1.0) as f32)
}

fn direction(random: &mut Random) -> [f32; 3] {
    let v = numbers::<3>(random).map(|x| x - 0.5);
    let length = v.iter().map(|x| x * x).sum::<f32>().sqrt().max(1e-3);
    v.map(|x| x / length)
}

fn surface(random: &mut Random) -> SurfaceValue {
    let numbers: [f32; 6] = numbers(random);
    SurfaceValue {
        position: [0; 3].map(|_| random.between(-4.0, 4.0) as f32),
        normal: direction(random),
        view: direction(random),
        base_color: self::numbers(random),
        metallic: numbers[0],
        roughness: numbers[1],
        emissive: self::numbers(random),
        occlusion: numbers[2],
        opacity: numbers[3],
        unlit: numbers[4],
        pixel: [0; 2].map(|_| random.index(6) as f32),
        depth: 10.0 * numbers[5],
    }
}
