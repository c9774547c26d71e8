//! What lenses cost, as ratios from one interleaved run, against lenspeel without a lens and against other ways to
//! draw the same pictures.
//!
//! `cargo bench --bench frames` draws a surface of a million triangles at 1280x720, one sample a pixel, on the best
//! adapter there is; `-- NAME` only the rows whose names hold NAME; `--rounds N`, `--size WxH` and `--json` as their
//! names say. See `benches/README.md`.

mod balls;
mod baselines;
mod contenders;
mod lens_sets;
mod rows;
#[path = "../support/mod.rs"]
mod support;

use std::process::ExitCode;

use lenspeel::bench::{Case, Verdict, interleaved, json, text};
use lenspeel::gpu::choose_named;

use contenders::Field;

/// The arguments behind `--`.
struct Args {
    rounds: usize,
    size: [u32; 2],
    json: bool,
    name: String,
}

fn main() -> ExitCode {
    match Args::parse(std::env::args().skip(1)).and_then(|args| run(&args)) {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("{message}");
            ExitCode::FAILURE
        }
    }
}

fn run(args: &Args) -> Result<(), String> {
    let cases: Vec<Case> = rows::rows().into_iter().filter(|case| case.name.contains(&args.name)).collect();
    if cases.is_empty() {
        return Err(format!("no row is named like `{}`", args.name));
    }
    let adapter = choose_named(None).map_err(|error| error.to_string())?;
    eprintln!("{}", adapter.reason);
    let field = Field::new(&adapter, args.size)?;
    let mut names: Vec<&str> = Vec::new();
    for name in cases.iter().flat_map(|case| [case.to.as_str(), case.of.as_str()]) {
        if !names.contains(&name) {
            names.push(name);
        }
    }
    let mut contenders = Vec::new();
    for name in names {
        contenders.extend(field.contender(name)?);
    }
    let progress = |round| eprintln!("round {round} of {}", args.rounds);
    let measured = interleaved(&mut contenders, args.rounds, progress)?;
    let verdicts: Vec<Verdict> = cases.iter().filter_map(|case| Verdict::new(case, &measured)).collect();
    let missing: Vec<&str> = field.left_out();
    if args.json {
        let mut all = json(&verdicts, &measured);
        all["adapter"] = adapter.reason.as_str().into();
        all["size"] = serde_json::json!(args.size);
        all["left_out"] = serde_json::json!(missing);
        println!("{all:#}");
        return Ok(());
    }
    println!("{}, {}x{}, {} rounds\n", adapter.reason, args.size[0], args.size[1], args.rounds);
    print!("{}", text(&verdicts, &measured));
    for why in missing {
        println!("\nleft out: {why}");
    }
    Ok(())
}

impl Args {
    fn parse(mut words: impl Iterator<Item = String>) -> Result<Self, String> {
        let mut args = Self { rounds: 7, size: [1280, 720], json: false, name: String::new() };
        while let Some(word) = words.next() {
            let mut value = || words.next().ok_or(format!("{word} needs a value"));
            match word.as_str() {
                // Cargo says so to every benchmark.
                "--bench" => {}
                "--json" => args.json = true,
                "--rounds" => {
                    let rounds = value()?.parse().ok().filter(|rounds| *rounds > 0);
                    args.rounds = rounds.ok_or("--rounds needs a number from 1 on")?;
                }
                "--size" => {
                    let text = value()?;
                    let sides = text.split_once('x').map(|(w, h)| (w.parse(), h.parse()));
                    let Some((Ok(width), Ok(height))) = sides else {
                        return Err("--size needs WIDTHxHEIGHT, as in 1280x720".into());
                    };
                    args.size = [width, height];
                }
                flag if flag.starts_with('-') => return Err(format!("there is no {flag}")),
                name => args.name = name.into(),
            }
        }
        Ok(args)
    }
}
