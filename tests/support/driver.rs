//! How a software GPU is set up for tests.

/// To be called before the first thread starts and before an adapter is looked for. Tests draw small pictures with many
/// shaders: Mesa's drivers shall translate them fast rather than make fast code of them. What the user has set stays.
#[allow(dead_code, reason = "tests that have no `main` of their own start threads before they could call it")]
pub fn translate_fast() {
    if std::env::var_os("GALLIVM_PERF").is_none() {
        // SAFETY: there is one thread.
        unsafe { std::env::set_var("GALLIVM_PERF", "nopt") };
    }
}
