//! Translates the appearance shaders (plain WGSL functions) to Rust, so that the CPU backend and the GPU
//! backend share one source, and joins the filters into the functions that run them.

use std::{env, error::Error, fmt::Write as _, fs, path::Path};

/// In the order in which they are joined; a file may use what an earlier or later one declares.
const FILES: [&str; 9] = ["surface", "color", "filters", "geometry", "texture", "light", "glass", "screen", "cap"];
const FILTERS: &str = "shaders/filters";

/// Where filters act on a fragment: the end of their functions' names, the joined function's parameters, and its result.
const STAGES: [(&str, &str, &str); 3] = [
    ("surface", "op: Op, before: Surface, reading: Reading", "Surface"),
    ("color", "op: Op, before: vec3f", "vec3f"),
    ("coverage", "op: Op, before: Shaded, spot: Spot", "Shaded"),
];

/// One file of a filter.
struct Filter {
    name: String,
    wgsl: String,
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut functions = String::new();
    for file in FILES {
        let path = format!("shaders/appearance/{file}.wgsl");
        println!("cargo::rerun-if-changed={path}");
        functions += &fs::read_to_string(path)?;
    }
    let filters = filters()?;
    filters.iter().for_each(|filter| functions += &filter.wgsl);
    functions += &joined(&filters)?;
    // The GPU backend says itself which filters a plan has; everybody else has all.
    let all: String = filters.iter().map(|filter| format!("const HAS_{}: bool = true;\n", filter.upper())).collect();
    let wgsl = all + &functions;
    let module = naga::front::wgsl::parse_str(&wgsl).map_err(|e| e.emit_to_string(&wgsl))?;
    let info = naga::valid::Validator::new(naga::valid::ValidationFlags::all(), naga::valid::Capabilities::empty())
        .validate(&module)
        .map_err(|e| e.emit_to_string(&wgsl))?;
    let config = naga_rust_back::Config::new()
        .public_items(true)
        .rule(naga_rust_back::Effect::Inline(naga_rust_back::Inline::Maybe));
    let rust = naga_rust_back::write_string(&module, &info, config)?;
    let out = env::var("OUT_DIR")?;
    fs::write(Path::new(&out).join("appearance.rs"), rust)?;
    fs::write(Path::new(&out).join("appearance.wgsl"), wgsl)?;
    fs::write(Path::new(&out).join("functions.wgsl"), functions)?;
    fs::write(Path::new(&out).join("filters.rs"), table(&filters)?)?;
    Ok(())
}

/// The files of the filters, by name.
fn filters() -> Result<Vec<Filter>, Box<dyn Error>> {
    println!("cargo::rerun-if-changed={FILTERS}");
    let mut filters = Vec::new();
    for entry in fs::read_dir(FILTERS)? {
        let path = entry?.path();
        let name = path.file_stem().and_then(|stem| stem.to_str()).ok_or("a filter's file without a name")?.to_owned();
        filters.push(Filter { name, wgsl: fs::read_to_string(&path)? });
    }
    filters.sort_by(|a, b| a.name.cmp(&b.name));
    Ok(filters)
}

impl Filter {
    fn upper(&self) -> String {
        self.name.to_uppercase()
    }

    /// The parameters of its function for a stage, if it has one.
    fn stage(&self, stage: &str) -> Option<&str> {
        let (_, rest) = self.wgsl.split_once(&format!("fn {}_{stage}(", self.name))?;
        rest.split_once(')').map(|(params, _)| params)
    }

    /// The lines of text at the start of the file.
    fn documentation(&self) -> String {
        let lines = self.wgsl.lines().map_while(|line| line.strip_prefix("//"));
        lines.map(str::trim).collect::<Vec<_>>().join(" ")
    }
}

/// A number for each filter, and for each stage the function that runs any filter's work there.
fn joined(filters: &[Filter]) -> Result<String, std::fmt::Error> {
    let mut text = String::new();
    for (number, filter) in filters.iter().enumerate() {
        writeln!(text, "const OP_{}: u32 = {number}u;", filter.upper())?;
    }
    for (stage, params, result) in STAGES {
        writeln!(text, "fn filter_{stage}({params}) -> {result} {{\n    var after = before;\n    switch op.kind {{")?;
        for filter in filters {
            let Some(params) = filter.stage(stage) else { continue };
            let names: Vec<&str> = params.split(", ").filter_map(|param| param.split(':').next()).collect();
            let (name, upper, last) = (&filter.name, filter.upper(), names[2..].iter().map(|n| format!(", {n}")));
            let call = format!("{name}_{stage}(op, before{})", last.collect::<String>());
            writeln!(text, "        case OP_{upper}: {{ if HAS_{upper} {{ after = {call}; }} }}")?;
        }
        text += "        default: { }\n    }\n    return after;\n}\n";
    }
    Ok(text)
}

/// Name, documentation and stages of each filter, for the catalogue and the backends.
fn table(filters: &[Filter]) -> Result<String, std::fmt::Error> {
    let mut text = format!("pub const FILTERS: [FilterFile; {}] = [\n", filters.len());
    for filter in filters {
        let stages = STAGES.map(|(stage, ..)| filter.stage(stage).is_some());
        let Filter { name, .. } = filter;
        writeln!(text, "    FilterFile {{ name: {name:?}, text: {:?}, stages: {stages:?} }},", filter.documentation())?;
    }
    Ok(text + "];\n")
}
