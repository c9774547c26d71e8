//! Which adapter is used and what is asked of it, in one place.

use super::Error;

/// An adapter and one line on why it was chosen.
#[derive(Debug, Clone)]
pub struct AdapterChoice {
    pub adapter: wgpu::Adapter,
    pub reason: String,
}

/// Every adapter of the native backends, hardware first.
pub fn adapters() -> Vec<wgpu::Adapter> {
    let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle_from_env());
    let mut found = pollster::block_on(instance.enumerate_adapters(wgpu::Backends::PRIMARY));
    found.sort_by_key(|adapter| preference(adapter.get_info().device_type));
    found
}

/// Discrete before integrated before virtual; software last.
fn preference(kind: wgpu::DeviceType) -> u32 {
    match kind {
        wgpu::DeviceType::DiscreteGpu => 0,
        wgpu::DeviceType::IntegratedGpu => 1,
        wgpu::DeviceType::VirtualGpu => 2,
        wgpu::DeviceType::Other => 3,
        wgpu::DeviceType::Cpu => 4,
    }
}

fn is_hardware(adapter: &wgpu::Adapter) -> bool {
    preference(adapter.get_info().device_type) <= 2
}

/// The adapter for `auto`: real hardware that can do what is needed, else an error that says what there is.
pub fn choose_hardware() -> Result<AdapterChoice, Error> {
    let found = adapters();
    match found.iter().find(|adapter| is_hardware(adapter) && lacking(adapter).is_none()) {
        Some(adapter) => Ok(chosen(adapter, "it is a hardware adapter")),
        None => Err(Error::NoAdapter { wanted: " that is hardware".into(), found: names(&found) }),
    }
}

/// The adapter when the GPU is asked for: the first whose name holds `name`, software ones included.
pub fn choose_named(name: Option<&str>) -> Result<AdapterChoice, Error> {
    let found = adapters();
    let matches = |adapter: &&wgpu::Adapter| {
        name.is_none_or(|n| adapter.get_info().name.to_lowercase().contains(&n.to_lowercase()))
    };
    let Some(adapter) = found.iter().find(matches) else {
        let wanted = name.map(|n| format!(" named `{n}`")).unwrap_or_default();
        return Err(Error::NoAdapter { wanted, found: names(&found) });
    };
    if let Some(what) = lacking(adapter) {
        return Err(Error::Lacking { adapter: format!("adapter {}", describe(adapter)), what });
    }
    let reason = match (name, is_hardware(adapter)) {
        (Some(_), _) => "it was asked for by name",
        (None, true) => "the GPU was asked for and it is the best hardware adapter",
        (None, false) => "the GPU was asked for and there is no hardware adapter",
    };
    Ok(chosen(adapter, reason))
}

fn chosen(adapter: &wgpu::Adapter, why: &str) -> AdapterChoice {
    AdapterChoice { adapter: adapter.clone(), reason: format!("{}: {why}", describe(adapter)) }
}

fn names(found: &[wgpu::Adapter]) -> String {
    let names: Vec<String> = found.iter().map(describe).collect();
    if names.is_empty() { "none".into() } else { names.join(", ") }
}

/// Name, kind and driver in a few words.
pub fn describe(adapter: &wgpu::Adapter) -> String {
    let info = adapter.get_info();
    let kind = match info.device_type {
        wgpu::DeviceType::DiscreteGpu => "discrete GPU",
        wgpu::DeviceType::IntegratedGpu => "integrated GPU",
        wgpu::DeviceType::VirtualGpu => "virtual GPU",
        wgpu::DeviceType::Cpu => "software",
        wgpu::DeviceType::Other => "unknown kind",
    };
    format!("{} ({kind}, {}, {})", info.name, info.backend, info.driver_info)
}

/// Times on the device between the stages of a frame, where an adapter has both.
pub const TIMESTAMPS: wgpu::Features =
    wgpu::Features::TIMESTAMP_QUERY.union(wgpu::Features::TIMESTAMP_QUERY_INSIDE_ENCODERS);

/// What is asked of an adapter beside limits: timestamps where it has them.
pub fn wanted_features(adapter: &wgpu::Adapter) -> wgpu::Features {
    if adapter.features().contains(TIMESTAMPS) { TIMESTAMPS } else { wgpu::Features::empty() }
}

/// Fails where a host's device was opened with smaller limits than frames need.
pub fn check_limits(device: &wgpu::Device) -> Result<(), Error> {
    let allowed = device.limits();
    match lacking_limits(&allowed) {
        Some(what) => Err(Error::Lacking { adapter: "device that was given".into(), what }),
        None => Ok(()),
    }
}

/// What an adapter does not have enough of, in words. No feature beyond WebGPU's own is needed.
fn lacking(adapter: &wgpu::Adapter) -> Option<String> {
    lacking_limits(&adapter.limits())
}

fn lacking_limits(allowed: &wgpu::Limits) -> Option<String> {
    let mut lacks = None;
    required_limits(allowed).check_limits_with_fail_fn(allowed, true, |name, needed, allowed| {
        lacks = Some(format!("`{name}`: it has {allowed}, and {needed} are needed"));
    });
    lacks
}

/// Storage buffers a shader stage binds: the scene (6), the plan (10), and the pixel's layers, lists and colours (4).
const STORAGE_BUFFERS: u32 = 21;

/// The limits asked for: the defaults, and as much memory and texture as the adapter has, since full pictures of
/// layers and fragments outgrow the defaults. Needs are checked against them before anything is drawn.
pub fn required_limits(adapter: &wgpu::Limits) -> wgpu::Limits {
    wgpu::Limits {
        max_storage_buffers_per_shader_stage: STORAGE_BUFFERS,
        max_storage_buffer_binding_size: adapter.max_storage_buffer_binding_size,
        max_buffer_size: adapter.max_buffer_size,
        max_texture_dimension_2d: adapter.max_texture_dimension_2d,
        max_texture_array_layers: adapter.max_texture_array_layers,
        ..wgpu::Limits::default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_unknown_adapter_is_refused_with_a_list_of_those_there_are() {
        let error = choose_named(Some("no adapter is named so")).expect_err("it must be refused");
        let Error::NoAdapter { wanted, found } = error else { panic!("another error: {error}") };
        assert_eq!(wanted, " named `no adapter is named so`");
        assert!(!found.is_empty());
    }
}
