//! What is told about a frame's cost: by the library, and by `lenspeel bench`.

use std::process::Command;

use lenspeel::gpu::{Engine, Headless, LensStorage, RenderOptions, STAGES, Triangles};
use serde_json::Value;

use crate::scene::{PERSPECTIVE, planned};

const SIZE: [u32; 2] = [64, 48];

fn ball(radius: f64) -> String {
    format!(
        "[[lens]]\nname = \"a\"\nshape.sphere = {{ center = [0, 0, 0], radius = {radius} }}\nfilters = [\"invert\"]\nglass = false\n"
    )
}

/// A frame has a wall time with or without marks between its stages, and each stage has a time where it was asked for.
pub fn frames_have_costs(device: &Headless) -> Result<(), String> {
    for samples in [1, 4] {
        let (scene, plan) = planned(SIZE, samples, PERSPECTIVE, &ball(0.6));
        let mut renderer = device.renderer(&scene).map_err(|e| e.to_string())?;
        for engine in [Engine::Fused, Engine::Peel] {
            let options = RenderOptions { engine, aovs: false };
            device.render_with(&mut renderer, &scene, &plan, options, &mut None).map_err(|e| e.to_string())?;
            for asked in [false, true] {
                let cost =
                    device.time_frame(&mut renderer, &scene, &plan, options, asked).map_err(|e| e.to_string())?;
                assert!(cost.prepare > 0.0 && cost.prepare < cost.wall, "{cost:?}");
                assert_eq!(cost.stages.is_some(), asked && device.has_timestamps(), "{cost:?}");
                if let Some(stages) = cost.stages {
                    let sum: f64 = stages.iter().sum();
                    assert!(stages.iter().all(|seconds| *seconds >= 0.0) && sum > 0.0, "{cost:?}");
                    // What the device does is within what the caller waits for; the two clocks are not the same one.
                    assert!(sum <= 2.0 * cost.wall, "{cost:?}");
                }
            }
        }
    }
    Ok(())
}

/// Layers are kept for the tiles that lenses touch, and nowhere else.
pub fn storage_grows_with_the_lenses(device: &Headless) -> Result<(), String> {
    let storage = |lenses: &str| -> Result<LensStorage, String> {
        let (scene, plan) = planned(SIZE, 1, PERSPECTIVE, lenses);
        let mut renderer = device.renderer(&scene).map_err(|e| e.to_string())?;
        let options = RenderOptions::default();
        device.render_with(&mut renderer, &scene, &plan, options, &mut None).map_err(|e| e.to_string())?;
        device.lens_storage(&mut renderer, &scene, &plan, options).map_err(|e| e.to_string())
    };
    let (none, small, large) = (storage("")?, storage(&ball(0.1))?, storage(&ball(0.8))?);
    assert!(none.layers < small.layers && small.layers < large.layers, "{none:?} {small:?} {large:?}");
    assert_eq!(none.records, 0);
    let blurred = storage(&ball(0.8).replace("filters = [", "filters = [\"blur\", "))?;
    let pixels = u64::from(SIZE[0] * SIZE[1]);
    assert_eq!(
        (large.screen, blurred.screen),
        (0, pixels * (48 + 16 + 4)),
        "a sample, a sum and a mark for each pixel"
    );
    assert_eq!(small.records, large.records, "one sphere is as large as another");
    assert_eq!(large.total(), large.parts().iter().map(|(_, bytes)| bytes).sum::<u64>());
    Ok(())
}

/// What lenses take away is not drawn, what they do not reach asks none, and what they bring in is drawn where they are.
pub fn what_is_drawn_is_what_may_be_seen(device: &Headless) -> Result<(), String> {
    let drawn = |lenses: &str, engine| -> Result<Triangles, String> {
        let (scene, plan) = planned(SIZE, 1, PERSPECTIVE, lenses);
        let mut renderer = device.renderer(&scene).map_err(|e| e.to_string())?;
        let options = RenderOptions { engine, aovs: false };
        device.render_with(&mut renderer, &scene, &plan, options, &mut None).map_err(|e| e.to_string())?;
        let cost = device.time_frame(&mut renderer, &scene, &plan, options, false).map_err(|e| e.to_string())?;
        Ok(cost.triangles)
    };
    let lens = |shape: &str, filter: &str| {
        format!("[[lens]]\nname = \"a\"\nglass = false\nshape.{shape}\nfilters = [{filter}]\n")
    };
    let half = "box = { min = [-2, -2, -2], max = [0, 2, 2] }";
    let none = drawn("", Engine::Fused)?;
    let panes = 2 * crate::scene::PANES as u64;
    assert_eq!(none.asking, panes, "of a scene without lenses only what is translucent asks");
    let inverted = drawn(&lens(half, "\"invert\""), Engine::Fused)?;
    assert_eq!(inverted, none, "what changes colours alone is asked once a pixel");
    let erased = drawn(&lens(half, "\"erase\""), Engine::Fused)?;
    assert!(erased.drawn < none.drawn * 7 / 8 && erased.drawn > none.drawn / 4, "{erased:?} of {none:?}");
    assert!(erased.asking > panes && erased.asking < erased.drawn, "clusters at the boundary ask: {erased:?}");
    let small = drawn(&lens("sphere = { center = [0, 0, 0], radius = 0.1 }", "\"magnify\""), Engine::Fused)?;
    assert!(small.drawn > none.drawn && small.drawn < none.drawn * 3 / 2, "a magnifier draws what it shows: {small:?}");
    let peeled = drawn(&lens(half, "\"invert\""), Engine::Peel)?;
    assert_eq!(peeled.drawn, 3 * none.drawn, "a pass for each of three layers");
    Ok(())
}

fn program(arguments: &[&str]) -> Result<String, String> {
    let spec = concat!(env!("CARGO_MANIFEST_DIR"), "/lens-specs/overlap/three-spheres.toml");
    let mut command = Command::new(env!("CARGO_BIN_EXE_lenspeel"));
    let output = command.args(["bench", spec, "--size", "48x36", "--frames", "3"]).args(arguments).output();
    let output = output.map_err(|e| e.to_string())?;
    let text = |bytes: Vec<u8>| String::from_utf8_lossy(&bytes).into_owned();
    if output.status.success() { Ok(text(output.stdout)) } else { Err(text(output.stderr)) }
}

pub fn the_program_prints_a_table(_: &Headless) -> Result<(), String> {
    let out = program(&[])?;
    let row = |name: &str| out.lines().find(|line| line.starts_with(name)).unwrap_or_else(|| panic!("{name}: {out}"));
    for (name, ratio) in [("no lens", Some("1.00")), ("fused", None), ("peel", None)] {
        let numbers: Vec<&str> = row(name)[8..].split_whitespace().collect();
        assert_eq!(numbers.len(), 2 + STAGES.len() + 2, "{out}");
        assert!(numbers.iter().all(|n| n.parse::<f64>().is_ok_and(|n| n >= 0.0)), "{out}");
        assert!(ratio.is_none_or(|ratio| numbers[1] == ratio), "{out}");
    }
    for part in [
        "fused: draws ",
        "3 enabled lenses, 48 x 36",
        "medians of 3 interleaved frames each",
        "visibility",
        "lens records",
    ] {
        assert!(out.contains(part), "{part}: {out}");
    }
    Ok(())
}

pub fn the_program_prints_json(device: &Headless) -> Result<(), String> {
    let out: Value = serde_json::from_str(&program(&["--json"])?).map_err(|e| e.to_string())?;
    assert_eq!(out["size"], serde_json::json!([48, 36]));
    assert_eq!(out["lenses"], 3);
    assert_eq!(out["clock"], if device.has_timestamps() { "device" } else { "wall" });
    let frames = out["frames"].as_array().expect("a list");
    assert_eq!(frames.iter().map(|f| &f["name"]).collect::<Vec<_>>(), ["no lens", "fused", "peel"]);
    for frame in frames {
        let mut rounds: Vec<f64> = serde_json::from_value(frame["rounds"].clone()).map_err(|e| e.to_string())?;
        rounds.sort_by(f64::total_cmp);
        assert_eq!((rounds.len(), frame["seconds"].as_f64()), (3, Some(rounds[1])), "{frame}");
        assert!(frame["triangles"]["drawn"].as_u64().is_some_and(|drawn| drawn > 0), "{frame}");
        assert!(frame["triangles"]["asking"].is_u64(), "{frame}");
        for stage in STAGES.iter().chain(&["upload", "whole frame"]) {
            assert!(frame["stages"][stage].as_f64().is_some_and(|s| s >= 0.0), "{stage}: {frame}");
        }
    }
    let cases: Vec<&str> = out["cases"].as_array().expect("a list").iter().filter_map(|c| c["case"].as_str()).collect();
    assert_eq!(cases, ["fused / no lens", "peel / no lens", "peel / fused"]);
    let storage = out["lens_storage"].as_object().expect("a table");
    let total: u64 = storage.iter().filter(|(what, _)| *what != "total").filter_map(|(_, bytes)| bytes.as_u64()).sum();
    assert_eq!(storage["total"], total);
    assert!(storage["layers"].as_u64() > Some(0) && storage["lens_records"].as_u64() > Some(0), "{storage:?}");
    Ok(())
}
