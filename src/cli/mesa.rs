//! A machine without a display: Mesa's layer that asks the display for its device complains there, on standard error.

use std::ffi::OsString;
use std::os::unix::process::CommandExt;
use std::process::Command;

/// Mesa reads it: the layer stays away.
const WITHOUT_LAYER: &str = "NODEVICE_SELECT";
/// With any of these there is something for the layer to do or to ask.
const USES: [&str; 5] = ["XDG_RUNTIME_DIR", "WAYLAND_DISPLAY", "DISPLAY", "MESA_VK_DEVICE_SELECT", "DRI_PRIME"];

/// Starts the program anew without the layer where that has nothing to do; where it cannot, the complaint does no harm.
/// A process may set a variable of its own only where nothing else reads them, which nobody can promise.
pub fn without_device_selection() {
    let is_set = |name: &str| std::env::var_os(name).is_some();
    if is_set(WITHOUT_LAYER) || USES.into_iter().any(is_set) {
        return;
    }
    let arguments: Vec<OsString> = std::env::args_os().collect();
    let Some((name, arguments)) = arguments.split_first() else { return };
    let _ = Command::new("/proc/self/exe").arg0(name).args(arguments).env(WITHOUT_LAYER, "1").exec();
}
