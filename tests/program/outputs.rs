//! Where `render` writes.

use std::fs;

use crate::call::{Call, Folder, call, call_with, project};

const SPEC: &str = "lens-specs/overlap/three-spheres.toml";
const PNG: &[u8] = b"\x89PNG\r\n\x1a\n";

fn render(spec: &str, outputs: &[&str]) -> Call {
    call(&[&["render", spec, "--size", "8x6", "--backend", "cpu", "-q"], outputs].concat())
}

#[test]
fn names_say_truly_what_files_hold() {
    let folder = Folder::new("outputs-names");
    let file = |name: &str| folder.file(name);
    let map = |map: &str, name: &str| format!("{map}={}", file(name));
    let spec = project(SPEC);
    for (outputs, told) in [
        (vec!["-o", &file("x.jpg")], "x.jpg: the picture is written as PNG"),
        (vec!["-o", &file("x.exr")], "name it"),
        (vec!["-o", &file("x.PNG"), "--aov", &map("depth", "d.png")], "the depth map is written as EXR"),
        (vec!["-o", &file("x.png"), "--aov", &map("node", "d.exr")], "the node map is written as PNG"),
        (vec!["-o", &file("x.png"), "--stats", &file("s.toml")], "written as JSON"),
    ] {
        let report = render(&spec, &outputs).refused();
        assert!(report.contains(told), "{report}");
        assert!(folder.names().is_empty(), "{outputs:?}");
    }
    render(&spec, &["-o", &file("a.PNG"), "--aov", &map("depth", "depth"), "--aov", &map("region", "region")]).good();
    assert_eq!(folder.names(), ["a.PNG", "depth", "region", "region.json"]);
}

#[test]
fn a_name_may_be_as_long_as_a_name_can_be() {
    let folder = Folder::new("outputs-long");
    let spec = project(SPEC);
    render(&spec, &["-o", &folder.file(&format!("{}.png", "x".repeat(251)))]).good();
    let report = render(&spec, &["-o", &folder.file(&format!("{}.png", "x".repeat(252)))]).refused();
    assert!(report.contains("too long"), "{report}");
    assert_eq!(folder.names().len(), 1);
}

#[test]
fn a_folder_that_is_a_file_is_told_before_anything_is_read() {
    let folder = Folder::new("outputs-folder");
    let spec = folder.write("spec.toml", "[scene]\nfile = 'none.glb'\n");
    let report = render(&spec, &["-o", &folder.file("spec.toml/x.png")]).refused();
    assert!(report.contains("it is a file") && !report.contains("none.glb"), "{report}");
}

#[test]
fn nothing_that_is_read_is_written() {
    let folder = Folder::new("outputs-inputs");
    let file = |name: &str| folder.file(name);
    for name in ["m.json", "b.png", "t.png", "f.wgsl", "l.glb", "m2.gltf"] {
        folder.write(name, "x");
    }
    // Read as JSON whatever it is called; it need not be good.
    folder.write("m.json", r#"{"images": [{"uri": "b.png"}], "buffers": [{"uri": "data%2Ebin"}]}"#);
    folder.write("data.bin", "x");
    let lens = "shape.mesh = { file = 'l.glb' }\nfilters = [{ texture = { file = 't.png' } }, { wgsl = { file = 'f.wgsl' } }]\n";
    let text = format!("[scene]\nfile = 'm.json'\n[scene.alternates]\nb = 'm2.gltf'\n[[lens]]\nname = 'a'\n{lens}");
    let spec = folder.write("s.toml", &text);
    let region = |name: &str| format!("region={}", file(name));
    let before = folder.names();
    for (outputs, what) in [
        (vec!["-o", &file("b.png")], "would be the picture and a file of the model"),
        (vec!["-o", &file("t.png")], "would be the picture and the image of a filter"),
        (vec!["-o", &file("data.bin")], "would be the picture and a file of the model"),
        (vec!["-o", &file("f.wgsl")], "would be the picture and the file of a filter"),
        (vec!["-o", &file("l.glb")], "would be the picture and the mesh of a lens"),
        (vec!["-o", &file("m2.gltf")], "would be the picture and the model of an alternate"),
        (vec!["-o", &file("./s.toml")], "would be the picture and the spec"),
        (vec!["-o", &file("x.png"), "--aov", &region("m.png")], "would be the table of the region map and the model"),
        (vec!["-o", &file("x.png"), "--stats", &file("m.json")], "would be the statistics and the model"),
    ] {
        let report = render(&spec, &outputs).refused();
        assert!(report.contains(what), "{outputs:?}: {report}");
        assert_eq!(folder.names(), before, "{outputs:?}");
    }
}

#[test]
fn a_hyphen_is_standard_output_and_standard_input() {
    let folder = Folder::new("outputs-hyphen");
    let (spec, whole) = (project(SPEC), folder.file("a.png"));
    render(&spec, &["-o", &whole]).good();
    let run = |arguments: &[&str], input: &str| {
        let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_lenspeel"));
        command.args(arguments).current_dir(project("lens-specs/overlap"));
        command.stdin(fs::File::open(input).expect("an input")).output().expect("the program starts")
    };
    let more = ["--size", "8x6", "--backend", "cpu"];
    let picture = run(&[&["render", &spec, "-o", "-"], &more[..]].concat(), "/dev/null");
    assert!(picture.status.success() && picture.stdout == folder.read("a.png"));
    // Paths of a spec that has no folder start where one is.
    let piped = run(&[&["render", "-", "-o", "-"], &more[..]].concat(), &spec);
    assert!(piped.status.success() && piped.stdout == picture.stdout, "{}", String::from_utf8_lossy(&piped.stderr));
    assert!(run(&["check", "-"], &spec).status.success());
    let stats = run(&[&["render", &spec, "-o", &whole, "--stats", "-"], &more[..]].concat(), "/dev/null");
    assert!(serde_json::from_slice::<serde_json::Value>(&stats.stdout).is_ok());
    let wrong = folder.write("wrong.toml", "[scene]\nfile = 1\n");
    assert!(String::from_utf8_lossy(&run(&["check", "-"], &wrong).stderr).contains("<stdin>:2"));
    for (outputs, told) in [
        (vec!["-o", "-", "--stats", "-"], "standard output would be the statistics and the picture"),
        (vec!["-o", &whole, "--aov", "region=-"], "its table has no place beside it"),
    ] {
        assert!(render(&spec, &outputs).refused().contains(told), "{outputs:?}");
    }
}

#[cfg(unix)]
mod unix {
    use std::io::Read;
    use std::os::unix::fs::{FileTypeExt, PermissionsExt, symlink};
    use std::process::Command;

    use super::*;

    #[test]
    fn links_devices_and_modes_stay() {
        let folder = Folder::new("outputs-kinds");
        let (spec, file) = (project(SPEC), |name: &str| folder.file(name));
        symlink("real.png", file("link.png")).expect("a link");
        folder.write("real.png", "old");
        fs::set_permissions(file("real.png"), fs::Permissions::from_mode(0o604)).expect("a mode");
        symlink("later.png", file("dangling.png")).expect("a link");
        for path in [file("link.png"), file("dangling.png"), "/dev/null".to_owned()] {
            render(&spec, &["-o", &path]).good();
        }
        assert_eq!(folder.names(), ["dangling.png", "later.png", "link.png", "real.png"]);
        assert!(["real.png", "later.png"].iter().all(|name| folder.read(name).starts_with(PNG)));
        assert!(fs::symlink_metadata(file("link.png")).expect("there").is_symlink());
        assert_eq!(fs::metadata(file("real.png")).expect("there").permissions().mode() & 0o777, 0o604);
        assert!(fs::metadata("/dev/null").expect("a device").file_type().is_char_device());
        let full = render(&spec, &["-o", "/dev/full"]);
        assert!(cfg!(not(target_os = "linux")) || full.refused().contains("/dev/full"));
        // A link to an input is the input.
        fs::copy(&spec, file("copy.toml")).expect("copied");
        symlink("copy.toml", file("x.png")).expect("a link");
        assert!(render(&file("copy.toml"), &["-o", &file("x.png")]).refused().contains("give each its own name"));
    }

    #[test]
    fn a_pipe_gets_the_bytes_and_stays() {
        let folder = Folder::new("outputs-pipe");
        let pipe = folder.file("pipe");
        assert!(Command::new("mkfifo").arg(&pipe).status().expect("there is mkfifo").success());
        let reader = std::thread::spawn({
            let pipe = pipe.clone();
            move || {
                let mut bytes = Vec::new();
                fs::File::open(pipe).and_then(|mut file| file.read_to_end(&mut bytes)).expect("bytes");
                bytes
            }
        });
        render(&project(SPEC), &["-o", &pipe]).good();
        assert!(reader.join().expect("a reader").starts_with(PNG));
        assert!(fs::metadata(&pipe).expect("there").file_type().is_fifo());
    }

    #[test]
    fn an_open_descriptor_is_written_to() {
        let folder = Folder::new("outputs-descriptor");
        let file = fs::File::create(folder.file("out")).expect("a file");
        let arguments = ["render", &project(SPEC), "-o", "/dev/stdout", "--size", "8x6", "--backend", "cpu"];
        call_with(&arguments, |command| _ = command.stdout(file)).good();
        assert!(folder.read("out").starts_with(PNG));
    }
}
