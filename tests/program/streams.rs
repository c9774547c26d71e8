//! Standard output and standard error: what cannot be said costs nothing, what cannot be given is an error.

use std::process::Command;

use crate::call::{Call, Folder, call, call_with, project};

/// Renders a small picture.
fn render(picture: &str, more: &[&str], change: impl FnOnce(&mut Command)) -> Call {
    let spec = project("lens-specs/overlap/three-spheres.toml");
    let arguments = ["render", &spec, "-o", picture, "--size", "8x6", "--backend", "cpu"];
    call_with(&[&arguments[..], more].concat(), change)
}

#[test]
fn messages_are_not_broken_where_no_terminal_is() {
    let folder = Folder::new(
        "streams-a-folder-with-a-name-that-is-long-and-has a space in it/so that no line of a hundred columns holds it",
    );
    let spec = folder.write("a spec.toml", "[scene]\nfile = 'no such model.glb'\n");
    for arguments in [vec!["check", &spec], vec!["explain", &spec]] {
        let report = call(&arguments).refused();
        assert!(report.contains(&folder.file("no such model.glb")), "{report}");
        assert!(report.contains(&format!("{spec}:2")), "{report}");
    }
    // What is told of a picture, too.
    let out = call(&["explain", &project("lens-specs/planet.toml"), "--size", "8x6"]).good();
    assert!(out.lines().any(|line| line.chars().count() > 100), "{out}");
}

#[test]
fn colours_are_a_matter_of_choice() {
    let color = |arguments: &[&str]| call(&[&["check", "none.toml"], arguments].concat()).err.contains('\u{1b}');
    assert!(
        !color(&[]) && !color(&["--color", "never"]) && color(&["--color", "always"]) && color(&["--color=always"])
    );
    assert_eq!(call(&["check", "none.toml", "--color", "blue"]).code, Some(2));
}

#[test]
fn quiet_leaves_warnings_and_errors() {
    let folder = Folder::new("streams-quiet");
    let picture = folder.file("a.png");
    let told = format!("cpu: it was asked for\nwrote {picture}\n");
    assert_eq!(render(&picture, &[], |_| ()).err, told);
    assert_eq!(render(&picture, &["-q"], |_| ()).err, "");
    assert!(!call(&["check", "none.toml", "-q"]).err.is_empty());
    // Nobody asked.
    let explain = ["explain", &project("lens-specs/overlap/three-spheres.toml"), "--size", "8x6"];
    assert_eq!(call(&explain).err, "");
    assert_eq!(call(&[&explain[..], &["--backend", "cpu"]].concat()).err, "cpu: it was asked for\n");
}

#[cfg(target_os = "linux")]
mod linux {
    use std::fs::{File, OpenOptions};
    use std::process::Stdio;

    use super::*;

    fn full() -> Stdio {
        OpenOptions::new().write(true).open("/dev/full").expect("Linux has it").into()
    }

    /// Calls through a shell, for what only it can redirect.
    fn shell(script: &str, picture: &str) -> std::process::Output {
        let mut command = Command::new("sh");
        command.args(["-c", script, "sh", env!("CARGO_BIN_EXE_lenspeel")]);
        command.args([&project("lens-specs/overlap/three-spheres.toml"), picture]).env("NO_COLOR", "1");
        command.output().expect("there is a shell")
    }

    #[test]
    fn what_cannot_be_said_costs_nothing() {
        let folder = Folder::new("streams-stderr");
        let picture = folder.file("a.png");
        let good = render(&picture, &["--time"], |_| ());
        assert_eq!(good.code, Some(0), "{}", good.err);
        let bytes = folder.read("a.png");
        std::fs::remove_file(&picture).expect("it is there");
        render(&picture, &["--time"], |command| _ = command.stderr(full())).good();
        assert_eq!(folder.read("a.png"), bytes);
        std::fs::remove_file(&picture).expect("it is there");
        let closed = shell("\"$1\" render \"$2\" -o \"$3\" --size 8x6 --backend cpu 2>&-", &picture);
        assert!(closed.status.success() && folder.read("a.png") == bytes);
        // Errors end as errors, and usage as usage.
        let code = |arguments: &[&str]| call_with(arguments, |command| _ = command.stderr(full())).code;
        assert_eq!([code(&["check", "none.toml"]), code(&["check"])], [Some(1), Some(2)]);
    }

    #[test]
    fn what_cannot_be_given_is_an_error() {
        let spec = project("lens-specs/overlap/three-spheres.toml");
        let model = project("lens-specs/models/cubes.glb");
        let commands: [&[&str]; 11] = [
            &["schema"],
            &["filters"],
            &["filters", "tint"],
            &["info", &model],
            &["init", &model],
            &["check", &spec],
            &["explain", &spec, "--size", "8x6"],
            &["pick", &spec, "1,1", "--size", "8x6"],
            &["render", &spec, "-o", "-", "--size", "8x6", "--backend", "cpu"],
            &["help"],
            &["--version"],
        ];
        for arguments in commands {
            let full = call_with(arguments, |command| _ = command.stdout(full()));
            assert!(full.refused().contains("standard output cannot be written: No space left"), "{arguments:?}");
            // Opened for reading only.
            let other = call_with(arguments, |command| _ = command.stdout(File::open("/dev/null").expect("a device")));
            // Those of clap, which takes what cannot be written for written.
            assert!(["help", "--version"].contains(&arguments[0]) || other.code == Some(1), "{arguments:?}");
        }
    }

    #[cfg(feature = "gpu")]
    #[test]
    fn a_machine_without_a_display_is_no_trouble() {
        let folder = Folder::new("streams-display");
        let picture = folder.file("a.png");
        let spec = project("lens-specs/overlap/three-spheres.toml");
        let arguments = ["render", &spec, "-o", &picture, "--size", "8x6", "-q"];
        let call = call_with(&arguments, |command| {
            ["XDG_RUNTIME_DIR", "WAYLAND_DISPLAY", "DISPLAY"].into_iter().for_each(|name| _ = command.env_remove(name));
        });
        assert_eq!((call.code, call.err.as_str()), (Some(0), ""));
        assert!(!folder.read("a.png").is_empty());
    }

    #[test]
    fn closed_standard_output_is_an_error_and_a_device_that_takes_all_is_none() {
        for script in ["\"$1\" schema >&-", "\"$1\" --version >&-", "\"$1\" check \"$2\" >&-"] {
            let closed = shell(script, "");
            assert_eq!(closed.status.code(), Some(1), "{script}");
            assert!(
                String::from_utf8_lossy(&closed.stderr).contains("standard output cannot be written: it is closed")
            );
        }
        assert!(shell("\"$1\" schema 1<>/dev/null", "").status.success());
        // Who says nothing there misses nothing.
        let folder = Folder::new("streams-closed");
        let render = shell("\"$1\" render \"$2\" -o \"$3\" --size 8x6 --backend cpu >&-", &folder.file("a.png"));
        assert!(render.status.success() && !folder.read("a.png").is_empty());
    }

    #[test]
    fn a_reader_that_went_away_is_no_error() {
        let went = shell("{ \"$1\" schema; echo $? >&2; } | head -c 1", "");
        assert_eq!(String::from_utf8_lossy(&went.stderr), "0\n");
    }
}
