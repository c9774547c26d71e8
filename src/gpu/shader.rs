//! Shaders as drivers get them.

use std::borrow::Cow;
use std::fmt::{self, Write};
use std::hash::{DefaultHasher, Hasher};

use super::prune::pruned;

/// The entry points of a pipeline, and what they need.
#[derive(Debug)]
pub struct Shader {
    label: &'static str,
    /// What it does: of two that are alike one is enough.
    pub key: ShaderKey,
    source: wgpu::ShaderSource<'static>,
}

/// Shaders with the same one do the same.
pub type ShaderKey = [u64; 2];

impl Shader {
    /// From WGSL, without what the constants in it rule out.
    pub fn new(label: &'static str, wgsl: String, entries: &[&str]) -> Self {
        let mut digest = Digest::default();
        let source = match naga::front::wgsl::parse_str(&wgsl) {
            Ok(parsed) => {
                let module = pruned(parsed, entries);
                _ = write!(digest, "{module:?}");
                wgpu::ShaderSource::Naga(Cow::Owned(module))
            }
            // The device reports what is wrong.
            Err(_) => {
                _ = digest.write_str(&wgsl);
                wgpu::ShaderSource::Wgsl(wgsl.into())
            }
        };
        Self { label, key: digest.key(), source }
    }

    pub fn compiled(&self, device: &wgpu::Device) -> wgpu::ShaderModule {
        let source = self.source.clone();
        device.create_shader_module(wgpu::ShaderModuleDescriptor { label: Some(self.label), source })
    }
}

/// Two hashes of a text: that both are those of another one does not happen.
struct Digest([DefaultHasher; 2]);

impl Default for Digest {
    fn default() -> Self {
        let mut second = DefaultHasher::new();
        second.write_u8(1);
        Self([DefaultHasher::new(), second])
    }
}

impl Digest {
    fn key(&self) -> ShaderKey {
        [self.0[0].finish(), self.0[1].finish()]
    }
}

impl Write for Digest {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        self.0.iter_mut().for_each(|hasher| hasher.write(text.as_bytes()));
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn key(doubles: bool, unused: &str) -> ShaderKey {
        let wgsl = format!(
            "const DOUBLES: bool = {doubles};
            {unused}
            @group(0) @binding(0) var<storage, read_write> out: array<f32>;
            fn twice(x: f32) -> f32 {{ return x * 2.0; }}
            @compute @workgroup_size(1) fn run() {{ if DOUBLES {{ out[0] = twice(out[0]); }} out[1] = 1.0; }}
            @compute @workgroup_size(1) fn other() {{ if !DOUBLES {{ out[2] = 1.0; }} }}"
        );
        Shader::new("test", wgsl, &["run"]).key
    }

    #[test]
    fn what_is_not_needed_makes_no_other_shader() {
        let plain = key(false, "");
        assert_eq!(key(false, "const ELSEWHERE: u32 = 3u; fn idle() -> u32 { return ELSEWHERE; }"), plain);
        assert_ne!(key(true, ""), plain);
    }
}
