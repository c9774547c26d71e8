//! Models beside the project: each loads with the triangles its index lists, and invalid ones are refused.

use std::path::{Path, PathBuf};

use lenspeel::scene::{Mesh, Model};

/// The folder with models, where the project has one.
fn assets() -> Option<PathBuf> {
    let folder = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../shared/assets"));
    if !folder.is_dir() {
        println!("not run: there is no folder ../shared/assets");
        return None;
    }
    Some(folder.to_path_buf())
}

/// File, triangles stored, triangles shown, of a line of the index's table of models.
fn row(line: &str) -> Option<(String, usize, usize)> {
    let mut cells = line.trim_matches('|').split('|').map(str::trim);
    let file = cells.next()?.to_string();
    let counts = cells.nth(1)?.replace(',', "");
    let mut numbers = counts.split(|c: char| !c.is_ascii_digit()).filter(|n| !n.is_empty());
    let stored = numbers.next()?.parse().ok()?;
    Some((file, stored, numbers.next().map_or(Ok(stored), str::parse).ok()?))
}

fn triangles(mesh: &Mesh) -> usize {
    mesh.primitives.iter().map(|p| p.triangles.len()).sum()
}

/// Triangles that the warnings say were left out.
fn left_out(model: &Model) -> usize {
    let count = |w: &String| {
        w.split_once("a repeated corner")
            .and_then(|(head, _)| head.rsplit(": ").next()?.split(' ').next()?.parse::<usize>().ok())
    };
    model.warnings.iter().filter_map(count).sum::<usize>()
}

#[test]
fn models_load_with_the_triangles_of_the_index() {
    let Some(folder) = assets() else { return };
    let index = std::fs::read_to_string(folder.join("INDEX.md")).expect("the index");
    let models = index
        .lines()
        .filter(|l| l.contains(".gl") && !["compressed/", "invalid_samples/"].iter().any(|f| l.contains(f)))
        .filter_map(row);
    let mut seen = 0;
    for (file, stored, shown) in models {
        let model = Model::load(&folder.join(&file), None).unwrap_or_else(|e| panic!("{e}"));
        let found: usize = model.meshes.iter().map(triangles).sum();
        assert_eq!(found + left_out(&model), stored, "{file}: {:?}", model.warnings);
        let drawn = model.nodes.iter().filter(|n| n.drawn).filter_map(|n| n.mesh);
        let drawn: usize = drawn.map(|m| triangles(&model.meshes[m])).sum();
        if left_out(&model) == 0 {
            assert_eq!(drawn, shown, "{file}");
        }
        println!("{file}: {found} triangles, {drawn} shown, warnings {:?}", model.warnings);
        seen += 1;
    }
    assert!(seen >= 18, "the index's table has changed: {seen} models found");
}

#[test]
fn compressed_models_are_refused_by_their_extensions() {
    let Some(folder) = assets() else { return };
    for (file, extension) in [
        ("agi_photogrammetry_ktx2.glb", "KHR_texture_basisu"),
        ("pirate_meshopt.glb", "EXT_meshopt_compression"),
        ("DenseSphere_draco.glb", "KHR_draco_mesh_compression"),
    ] {
        let error = Model::load(&folder.join("compressed").join(file), None).expect_err(file);
        assert!(error.message.ends_with(&format!("not supported: {extension}")), "{error}");
    }
}

#[test]
fn invalid_samples_are_refused() {
    let Some(folder) = assets() else { return };
    let folder = folder.join("invalid_samples");
    let mut texts = String::new();
    for file in [
        "RecursiveNodes.gltf",
        "IndexOutOfRange/AllIndicesOutOfRange.gltf",
        "IndexOutOfRange/IndexOutOfRange.gltf",
        "invalid-primitive-indices.gltf",
        "BoxWithInfinites.glb",
    ] {
        let path = folder.join(file);
        let bytes = std::fs::read(&path).expect(file);
        let beside = path.parent().expect("a folder");
        let error = Model::from_bytes(&bytes, file, None, &mut |uri| Ok(std::fs::read(beside.join(uri)).expect(uri)));
        texts.push_str(&format!("{}\n", error.expect_err(file)));
    }
    insta::assert_snapshot!(texts);
}

#[test]
fn a_real_file_cut_anywhere_is_an_error() {
    let Some(folder) = assets() else { return };
    let bytes = std::fs::read(folder.join("odd/UnlitTest.glb")).expect("the model");
    for length in (0..bytes.len()).step_by(97) {
        assert!(super::builder::load(&bytes[..length], None).is_err(), "cut to {length} bytes");
    }
}
