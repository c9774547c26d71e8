//! Filter files on the GPU against the interpreter: the same surfaces through both, in a compute shader.
//!
//! Without an adapter these report as ignored; with `LENSPEEL_REQUIRE_GPU=1` a missing adapter is a failure.

use std::process::ExitCode;
use std::sync::Arc;

use lenspeel::custom::{self, Custom, SURFACE_WORDS, SurfaceValue};
use lenspeel::gpu;
use lenspeel::spec::Source;
use libtest_mimic::{Arguments, Failed, Trial};
use wgpu::util::DeviceExt;

/// Surfaces that each filter is called for.
const CALLS: usize = 512;
/// Of one number against the other, relative above 1. GPUs may compute `pow`, `sin` and the like in few bits.
const TOLERANCE: f32 = 1e-3;
/// Words that one call reads or writes: a surface, and a colour behind it.
const WORDS: usize = SURFACE_WORDS + 3;

/// Filters that together use most of the language.
const FILTERS: [(&str, &str); 7] = [
    ("stripes", include_str!("../lens-specs/wgsl/stripes.wgsl")),
    ("rim", include_str!("../lens-specs/wgsl/rim.wgsl")),
    ("thermal", include_str!("../lens-specs/wgsl/thermal.wgsl")),
    ("noise", "fn filter_color(c: vec3f, s: Surface) -> vec3f { return c * noise3(s.position * 4.0) + vec3f(hash3(vec3i(s.pixel.xyx))); }"),
    ("budget", "fn filter_color(c: vec3f, s: Surface) -> vec3f {
        var n = 0.0; loop { n += 1.0; if n < 0.0 { break; } }
        for (var i = 0; i < 10; i++) { n += 1.0; }
        return vec3f(n, c.yz); }"),
    ("places", "struct Cell { at: array<vec3f, 3>, n: u32 }
        fn turn(cell: ptr<function, Cell>, i: i32) { (*cell).at[i] = (*cell).at[i].zxy; (*cell).n += 1u; }
        fn filter_color(c: vec3f, s: Surface) -> vec3f {
            var cell: Cell; cell.at[0] = c; cell.at[1] = s.position; cell.at[2] = s.normal;
            let i = i32(s.pixel.x) - 3; turn(&cell, i); turn(&cell, 1);
            switch cell.n % 3u { case 0u: { return c; } case 1u, 2u: { return cell.at[u32(s.pixel.y)] + cell.at[i]; } default: {} }
            return vec3f(0.0); }"),
    ("integers", "fn filter_color(c: vec3f, s: Surface) -> vec3f {
        let i = vec3i(c * 100.0) - 50; let n = vec3u(s.pixel.xyy);
        let a = i / (i - i.yzx) + i % (i.zxy - 3) + (i << n) + vec3i(reverseBits(n) >> (n + 30u));
        let b = extractBits(a, 2u, 7u) + firstLeadingBit(i) + clamp(i, vec3i(-20), vec3i(20));
        return vec3f(b % 1000); }"),
];

fn main() -> ExitCode {
    let arguments = Arguments::from_args();
    let device = device();
    let required = std::env::var("LENSPEEL_REQUIRE_GPU").is_ok_and(|v| v != "0" && !v.is_empty());
    let ignored = device.is_err() && !required;
    if let (Err(reason), true) = (&device, ignored) {
        eprintln!("GPU tests are ignored: {reason}");
    }
    let device = Arc::new(device);
    let trial = |name: &'static str, test: fn(&Gpu) -> Result<(), String>| {
        let device = device.clone();
        let run = move || match &*device {
            Ok(device) => test(device).map_err(Failed::from),
            Err(reason) => Err(Failed::from(reason.as_str())),
        };
        Trial::test(name, run).with_ignored_flag(ignored)
    };
    let trials = vec![
        trial("every_filter_gives_on_the_gpu_what_the_interpreter_gives", every_filter_agrees),
        trial("a_filter_that_differs_is_found", a_difference_is_found),
    ];
    libtest_mimic::run(&arguments, trials).exit_code()
}

struct Gpu {
    device: wgpu::Device,
    queue: wgpu::Queue,
}

fn device() -> Result<Gpu, String> {
    let choice = gpu::choose_named(None).map_err(|e| e.to_string())?;
    let request = choice.adapter.request_device(&wgpu::DeviceDescriptor::default());
    let (device, queue) = pollster::block_on(request).map_err(|e| e.to_string())?;
    Ok(Gpu { device, queue })
}

/// Numbers from 0 to 1, the same each time (SplitMix64).
struct Random(u64);

impl Random {
    fn next(&mut self) -> f32 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        (z >> 40) as f32 / (1_u64 << 24) as f32
    }

    fn direction(&mut self) -> [f32; 3] {
        let v = [0; 3].map(|_| self.next() - 0.5);
        let length = v.iter().map(|x| x * x).sum::<f32>().sqrt().max(1e-3);
        v.map(|x| x / length)
    }

    fn surface(&mut self) -> SurfaceValue {
        SurfaceValue {
            position: [0; 3].map(|_| 8.0 * self.next() - 4.0),
            normal: self.direction(),
            view: self.direction(),
            base_color: [0; 3].map(|_| self.next()),
            metallic: self.next(),
            roughness: self.next(),
            emissive: [0; 3].map(|_| self.next()),
            occlusion: self.next(),
            opacity: self.next(),
            unlit: self.next(),
            pixel: [0; 2].map(|_| (6.0 * self.next()).floor()),
            depth: 10.0 * self.next(),
        }
    }
}

/// All inputs, as the shader reads them.
fn inputs() -> Vec<([f32; 3], SurfaceValue)> {
    let mut random = Random(7);
    (0..CALLS).map(|_| ([0; 3].map(|_| random.next()), random.surface())).collect()
}

/// A shader that calls one filter for each input.
fn shader(custom: &Custom) -> String {
    let word = |i: usize| format!("inputs[at + {i}u]");
    let members = [3, 3, 3, 3, 1, 1, 3, 1, 1, 1, 2, 1];
    let mut at = 0;
    let mut arguments = Vec::new();
    for size in members {
        let parts: Vec<String> = (at..at + size).map(word).collect();
        arguments.push(if size == 1 { parts[0].clone() } else { format!("vec{size}f({})", parts.join(", ")) });
        at += size;
    }
    let names = [
        "position",
        "normal",
        "view",
        "base_color",
        "metallic",
        "roughness",
        "emissive",
        "occlusion",
        "opacity",
        "unlit",
        "pixel",
        "depth",
    ];
    let mut out = String::new();
    let mut to = 0;
    for (name, size) in names.iter().zip(members) {
        for part in 0..size {
            let index = if size == 1 { String::new() } else { format!("[{part}]") };
            out += &format!("    outputs[at + {to}u] = r.{name}{index};\n");
            to += 1;
        }
    }
    format!(
        "@group(0) @binding(0) var<storage> custom_words: array<u32>;
@group(0) @binding(1) var<storage> inputs: array<f32>;
@group(0) @binding(2) var<storage, read_write> outputs: array<f32>;
{}
@compute @workgroup_size(64) fn main(@builtin(global_invocation_id) id: vec3u) {{
    let at = id.x * {WORDS}u;
    let s = CustomSurface({});
    let r = custom_surface(0u, s, 1u);
{out}    let c = custom_color(0u, vec3f({}), s, 1u);
    outputs[at + {to}u] = c.x;
    outputs[at + {}u] = c.y;
    outputs[at + {}u] = c.z;
}}
",
        custom::wgsl(&[custom]),
        arguments.join(", "),
        (SURFACE_WORDS..WORDS).map(word).collect::<Vec<_>>().join(", "),
        to + 1,
        to + 2,
    )
}

/// What the GPU gives for every input.
fn on_gpu(gpu: &Gpu, custom: &Custom, words: &[u32]) -> Vec<f32> {
    let inputs: Vec<f32> = inputs().iter().flat_map(|(c, s)| s.numbers().into_iter().chain(*c)).collect();
    let device = &gpu.device;
    // The filter's words begin at 1, so that a filter that ignores `first` is found.
    let words: Vec<u32> = [0xdead_beef].iter().chain(words).copied().collect();
    let buffer = |contents: &[u8], usage| {
        device.create_buffer_init(&wgpu::util::BufferInitDescriptor { label: None, contents, usage })
    };
    let words = buffer(bytemuck::cast_slice(&words), wgpu::BufferUsages::STORAGE);
    let given = buffer(bytemuck::cast_slice(&inputs), wgpu::BufferUsages::STORAGE);
    let size = (inputs.len() * 4) as u64;
    let empty =
        |usage| device.create_buffer(&wgpu::BufferDescriptor { label: None, size, usage, mapped_at_creation: false });
    let outputs = empty(wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC);
    let read = empty(wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST);
    let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: None,
        source: wgpu::ShaderSource::Wgsl(shader(custom).into()),
    });
    let pipeline = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
        label: None,
        layout: None,
        module: &module,
        entry_point: Some("main"),
        compilation_options: wgpu::PipelineCompilationOptions::default(),
        cache: None,
    });
    let bound = [&words, &given, &outputs];
    let layout = pipeline.get_bind_group_layout(0);
    let used: Vec<u32> = if custom.params().is_empty() { vec![1, 2] } else { vec![0, 1, 2] };
    let entries: Vec<_> = used
        .iter()
        .map(|i| wgpu::BindGroupEntry { binding: *i, resource: bound[*i as usize].as_entire_binding() })
        .collect();
    let group =
        device.create_bind_group(&wgpu::BindGroupDescriptor { label: None, layout: &layout, entries: &entries });
    let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    {
        let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
        pass.set_pipeline(&pipeline);
        pass.set_bind_group(0, &group, &[]);
        pass.dispatch_workgroups((CALLS / 64) as u32, 1, 1);
    }
    encoder.copy_buffer_to_buffer(&outputs, 0, &read, 0, size);
    gpu.queue.submit([encoder.finish()]);
    read.slice(..).map_async(wgpu::MapMode::Read, |mapped| mapped.expect("a buffer that can be read"));
    device.poll(wgpu::PollType::wait_indefinitely()).expect("the device goes on");
    let view = read.slice(..).get_mapped_range().expect("a mapped buffer");
    bytemuck::cast_slice(&view).to_vec()
}

fn on_cpu(custom: &Custom, words: &[u32]) -> Vec<f32> {
    let both = |(c, s): &([f32; 3], SurfaceValue)| {
        custom.surface(s, words).numbers().into_iter().chain(custom.color(*c, s, words)).collect::<Vec<_>>()
    };
    inputs().iter().flat_map(both).collect()
}

/// The first number that differs.
fn difference(cpu: &[f32], gpu: &[f32]) -> Option<String> {
    // What is no number differs, too.
    let differs = |(a, b): (&f32, &f32)| {
        let distance = (a - b).abs();
        distance.is_nan() || distance > TOLERANCE * a.abs().max(1.0)
    };
    let at = cpu.iter().zip(gpu).position(differs)?;
    Some(format!("number {} of call {}: {} on the CPU, {} on the GPU", at % WORDS, at / WORDS, cpu[at], gpu[at]))
}

fn every_filter_agrees(gpu: &Gpu) -> Result<(), String> {
    for (name, text) in FILTERS {
        let custom = Custom::parse(text, name).map_err(|error| error.to_string())?;
        let spec = Source { name: "spec.toml".into(), text: "".into() };
        let words = custom.values(&spec, &[]).map_err(|error| error.to_string())?;
        let (cpu, gpu) = (on_cpu(&custom, &words), on_gpu(gpu, &custom, &words));
        assert_eq!(cpu.len(), gpu.len());
        let changed = inputs().iter().flat_map(|(c, s)| s.numbers().into_iter().chain(*c)).ne(cpu.iter().copied());
        if !changed {
            return Err(format!("{name} changes nothing"));
        }
        if let Some(difference) = difference(&cpu, &gpu) {
            return Err(format!("{name}: {difference}"));
        }
    }
    Ok(())
}

/// The comparison finds a parameter that is off by a hundredth.
fn a_difference_is_found(gpu: &Gpu) -> Result<(), String> {
    let (name, text) = FILTERS[1];
    let custom = Custom::parse(text, name).map_err(|error| error.to_string())?;
    let spec = Source { name: "spec.toml".into(), text: "".into() };
    let words = custom.values(&spec, &[]).map_err(|error| error.to_string())?;
    let mut other = words.clone();
    other[3] = (f32::from_bits(words[3]) * 1.01).to_bits();
    match difference(&on_cpu(&custom, &words), &on_gpu(gpu, &custom, &other)) {
        Some(_) => Ok(()),
        None => Err("a strength that is off by a hundredth goes unnoticed".to_owned()),
    }
}
