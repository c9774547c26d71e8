//! Graphics devices for all tests of a process: a few, so that a few tests draw at a time.
//!
//! A software GPU takes seconds to compile the shaders of a plan and keeps few of them, so a plan goes to the device that
//! has just drawn one which needs the same. Without an adapter GPU tests report as ignored; where `LENSPEEL_REQUIRE_GPU`
//! is 1 they run and fail.

use std::sync::{Mutex, MutexGuard, OnceLock, TryLockError};

use lenspeel::frame::Frame;
use lenspeel::gpu::{Engine, Headless, Needs, RenderOptions, Renderer, choose_named};

use crate::open::Opened;

/// Each engine and the name its tests carry.
pub const ENGINES: [(Engine, &str); 2] = [(Engine::Fused, "fused"), (Engine::Peel, "peel")];

/// How many devices there are.
const DEVICES: usize = 2;

/// Whether GPU tests are to be ignored here.
pub fn is_ignored() -> bool {
    let required = std::env::var_os("LENSPEEL_REQUIRE_GPU").is_some_and(|value| value == "1");
    !required && choose_named(None).is_err()
}

/// What plans have in common that need the same shaders, however large triangles are.
pub fn needs(opened: &Opened) -> Needs {
    Needs::of(&opened.scene, &opened.plan, !opened.plan.coincident.is_empty())
}

/// The picture with its AOVs.
pub fn render(opened: &Opened, engine: Engine) -> Result<Frame, String> {
    let device = device(needs(opened))?;
    let options = RenderOptions { engine, aovs: true };
    device.render(&opened.scene, &opened.plan, options).map_err(|error| error.to_string())
}

/// What some work with the device and a renderer of a scene gives.
#[allow(dead_code, reason = "not every test that shares this file asks for single pixels")]
pub fn with_renderer<T>(
    opened: &Opened,
    work: impl FnOnce(&Headless, &mut Renderer) -> Result<T, String>,
) -> Result<T, String> {
    let device = device(needs(opened))?;
    let mut renderer = device.renderer(&opened.scene).map_err(|error| error.to_string())?;
    work(&device, &mut renderer)
}

/// Waits for the device that has last drawn what needs the same, else for any.
fn device(needs: Needs) -> Result<MutexGuard<'static, Headless>, String> {
    static OPEN: [OnceLock<Result<Mutex<Headless>, String>>; DEVICES] = [const { OnceLock::new() }; DEVICES];
    static LAST: Mutex<[Option<Needs>; DEVICES]> = Mutex::new([None; DEVICES]);
    let panicked = "a test that held the device has panicked";
    let number = {
        let mut last = LAST.lock().map_err(|_| panicked)?;
        let is_free = |number: &usize| {
            let device = OPEN[*number].get().and_then(|opened| opened.as_ref().ok());
            device.is_none_or(|device| !matches!(device.try_lock(), Err(TryLockError::WouldBlock)))
        };
        let same = last.iter().position(|drawn| *drawn == Some(needs));
        let number = same.or_else(|| (0..DEVICES).find(is_free)).unwrap_or_default();
        last[number] = Some(needs);
        number
    };
    let opened = OPEN[number].get_or_init(open).as_ref().map_err(Clone::clone)?;
    opened.lock().map_err(|_| panicked.to_owned())
}

fn open() -> Result<Mutex<Headless>, String> {
    let choice = choose_named(None).map_err(|error| error.to_string())?;
    let device = Headless::new(&choice).map_err(|error| error.to_string())?;
    eprintln!("adapter: {}", device.reason);
    Ok(Mutex::new(device))
}
