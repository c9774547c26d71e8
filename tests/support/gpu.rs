//! Graphics devices for all tests of a process: one an engine, so that two tests draw at a time.
//!
//! Without an adapter GPU tests report as ignored; where `LENSPEEL_REQUIRE_GPU` is 1 they run and fail.

use std::sync::{Mutex, OnceLock};

use lenspeel::frame::Frame;
use lenspeel::gpu::{Engine, Headless, RenderOptions, Renderer, choose_named};

use crate::open::Opened;

/// Each engine and the name its tests carry.
pub const ENGINES: [(Engine, &str); 2] = [(Engine::Fused, "fused"), (Engine::Peel, "peel")];

/// Whether GPU tests are to be ignored here.
pub fn is_ignored() -> bool {
    let required = std::env::var_os("LENSPEEL_REQUIRE_GPU").is_some_and(|value| value == "1");
    !required && choose_named(None).is_err()
}

/// The picture with its AOVs.
pub fn render(opened: &Opened, engine: Engine) -> Result<Frame, String> {
    let device = device(engine)?.lock().map_err(|_| "a test that held the device has panicked")?;
    let options = RenderOptions { engine, aovs: true };
    device.render(&opened.scene, &opened.plan, options).map_err(|error| error.to_string())
}

/// What some work with the device and a renderer of a scene gives.
#[allow(dead_code, reason = "not every test that shares this file asks for single pixels")]
pub fn with_renderer<T>(
    opened: &Opened,
    work: impl FnOnce(&Headless, &mut Renderer) -> Result<T, String>,
) -> Result<T, String> {
    let device = device(Engine::Fused)?.lock().map_err(|_| "a test that held the device has panicked")?;
    let mut renderer = device.renderer(&opened.scene).map_err(|error| error.to_string())?;
    work(&device, &mut renderer)
}

fn device(engine: Engine) -> Result<&'static Mutex<Headless>, String> {
    static DEVICES: [OnceLock<Result<Mutex<Headless>, String>>; 2] = [const { OnceLock::new() }; 2];
    let open = || {
        let choice = choose_named(None).map_err(|error| error.to_string())?;
        let device = Headless::new(&choice).map_err(|error| error.to_string())?;
        eprintln!("adapter: {}", device.reason);
        Ok(Mutex::new(device))
    };
    let number = ENGINES.iter().position(|(known, _)| *known == engine).unwrap_or_default();
    DEVICES[number].get_or_init(open).as_ref().map_err(Clone::clone)
}
