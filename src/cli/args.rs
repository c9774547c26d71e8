//! The command line.

use std::path::{Path, PathBuf};

use clap::{Args, ColorChoice, Parser, Subcommand, ValueEnum};

use super::open::OpenArgs;
use super::outputs::is_stream;
use crate::InputError;
use crate::output::Aov;
use crate::spec::{ImageSpec, Spec};

#[derive(Debug, Parser)]
#[command(name = "lenspeel", version, about = "Composed 3D magic lenses", arg_required_else_help = true)]
#[command(after_help = "To begin: `lenspeel init MODEL -o SPEC.toml`, then `lenspeel render SPEC.toml -o PICTURE.png`")]
pub struct Cli {
    #[command(subcommand)]
    pub command: Command,
    /// Say nothing but warnings and errors
    #[arg(short, long, global = true)]
    pub quiet: bool,
    /// Whether messages have colours
    #[arg(long, global = true, value_enum, value_name = "WHEN", default_value_t = ColorChoice::Auto)]
    pub color: ColorChoice,
}

#[derive(Debug, Subcommand)]
pub enum Command {
    /// Render a lens-spec file to a picture
    Render(RenderArgs),
    /// Check a lens-spec file and everything it names
    Check {
        #[command(flatten)]
        spec: SpecArgs,
        /// Fail on warnings, too: lenses whose order only the file decides, patterns that match nothing
        #[arg(long)]
        strict: bool,
        #[command(flatten)]
        open: OpenArgs,
    },
    /// Explain the order of the lenses, what acts where, and how much of the picture each region takes
    Explain(ExplainArgs),
    /// Tell what is visible at a pixel
    Pick(PickArgs),
    /// Measure what the lenses of a lens-spec file cost on the GPU
    Bench(BenchArgs),
    /// Describe a glTF model: what it shows, and the names that specs select by
    Info(InfoArgs),
    /// Write a starter spec for a glTF model
    Init {
        /// A .glb or .gltf file
        model: PathBuf,
        /// Where to write it; left out, or `-`: standard output
        #[arg(short, long)]
        output: Option<PathBuf>,
        #[command(flatten)]
        open: OpenArgs,
    },
    /// List the filters with their parameters
    Filters {
        /// Only this one, with what its documentation says
        name: Option<String>,
        /// A page of all, in Markdown
        #[arg(long, conflicts_with = "name")]
        markdown: bool,
    },
    /// List the shapes of lenses with their keys
    Shapes {
        /// Only this one
        name: Option<String>,
        /// A table of all, in Markdown
        #[arg(long, conflicts_with = "name")]
        markdown: bool,
    },
    /// Print a JSON Schema of lens-spec files, for editors
    Schema {
        /// The keys as tables in Markdown instead
        #[arg(long)]
        markdown: bool,
    },
    /// Print completions for a shell
    Completions {
        #[arg(value_enum)]
        shell: clap_complete::Shell,
    },
    /// Print a manual page
    Man {
        /// The subcommand that it is of; left out: the program
        command: Option<String>,
    },
}

/// A spec and what is changed in it for this once.
#[derive(Debug, Args)]
pub struct SpecArgs {
    /// The lens-spec file; `-` is standard input, and paths in it start at the working folder
    pub spec: PathBuf,
    /// Give a key of the spec another value, as in lens.probe.center=[1,0,0] (repeatable; the last one holds)
    #[arg(long, value_name = "KEY=VALUE")]
    pub set: Vec<String>,
}

impl SpecArgs {
    pub fn load(&self) -> Result<Spec, InputError> {
        if !is_stream(&self.spec) {
            return Spec::load_with(&self.spec, &self.set);
        }
        Spec::read(std::io::stdin().lock(), "<stdin>", Path::new(""), &self.set)
    }
}

#[cfg(all(target_os = "linux", feature = "gpu"))]
impl Command {
    /// Whether a graphics device may be looked for.
    pub fn may_open_device(&self) -> bool {
        let backend = match self {
            Command::Render(args) => Some(args.backend),
            Command::Explain(ExplainArgs { view, .. }) | Command::Pick(PickArgs { view, .. }) => view.backend,
            Command::Bench(_) => Some(BackendChoice::Gpu),
            _ => None,
        };
        backend.is_some_and(|backend| backend != BackendChoice::Cpu)
    }
}

#[derive(Debug, Args)]
pub struct InfoArgs {
    /// A .glb or .gltf file
    pub model: PathBuf,
    /// Only nodes and materials of these names, as a spec would select them: 'Wheel*'
    #[arg(value_name = "PATTERN")]
    pub patterns: Vec<String>,
    /// Each node and each name whole, where otherwise siblings with like names are one line
    #[arg(long)]
    pub all: bool,
    /// Print JSON, always whole
    #[arg(long)]
    pub json: bool,
    #[command(flatten)]
    pub open: OpenArgs,
}

#[derive(Debug, Args)]
pub struct RenderArgs {
    #[command(flatten)]
    pub spec: SpecArgs,
    /// The picture to write (PNG); `-` is standard output, here and for maps and statistics
    #[arg(short, long)]
    pub output: PathBuf,
    /// Width and height in pixels, as in 1920x1080; left out: the spec's
    #[arg(long, value_parser = parse_size)]
    pub size: Option<[u32; 2]>,
    /// Samples a pixel: 1, 4, 9 or 16; left out: the spec's
    #[arg(long, value_parser = parse_samples)]
    pub samples: Option<u32>,
    /// What renders
    #[arg(long, value_enum, default_value_t = BackendChoice::Auto)]
    pub backend: BackendChoice,
    /// How the GPU composes; left out: fused
    #[arg(long, value_enum)]
    pub engine: Option<EngineChoice>,
    /// Also write a map: region, depth, normal, node or layers (repeatable)
    #[arg(long, value_name = "NAME=FILE", value_parser = parse_aov)]
    pub aov: Vec<(Aov, PathBuf)>,
    /// Draw how the picture comes about instead of the picture, with a legend
    #[arg(long, value_enum)]
    pub view: Option<ViewChoice>,
    /// The row that `--view depth-intervals` shows, from the top; left out: the middle one
    #[arg(long, requires = "view")]
    pub row: Option<u32>,
    /// Draw what false colours and contour lines stand for over the lower edge of the picture
    #[arg(long, conflicts_with = "view")]
    pub legend: bool,
    /// Print how long each stage took
    #[arg(long)]
    pub time: bool,
    /// Write the times of all stages and the sizes of things to a JSON file
    #[arg(long, value_name = "FILE.json")]
    pub stats: Option<PathBuf>,
    #[command(flatten)]
    pub open: OpenArgs,
}

/// A spec and how it is seen by the commands that tell about a picture.
#[derive(Debug, Args)]
pub struct ViewArgs {
    #[command(flatten)]
    pub spec: SpecArgs,
    /// Width and height in pixels, as in 1920x1080; left out: the spec's
    #[arg(long, value_parser = parse_size)]
    pub size: Option<[u32; 2]>,
    /// What finds out what is seen; left out: the CPU, which need not be started
    #[arg(long, value_enum)]
    pub backend: Option<BackendChoice>,
    #[command(flatten)]
    pub open: OpenArgs,
}

#[derive(Debug, Args)]
pub struct BenchArgs {
    #[command(flatten)]
    pub spec: SpecArgs,
    /// How many frames each contender draws, in turn; one more before them is not counted
    #[arg(long, value_name = "N", default_value_t = 7, value_parser = clap::value_parser!(u32).range(1..=100_000))]
    pub frames: u32,
    /// Width and height in pixels, as in 1920x1080; left out: the spec's
    #[arg(long, value_parser = parse_size)]
    pub size: Option<[u32; 2]>,
    /// Print JSON with every single frame instead of a table
    #[arg(long)]
    pub json: bool,
    #[command(flatten)]
    pub open: OpenArgs,
}

#[derive(Debug, Args)]
pub struct ExplainArgs {
    #[command(flatten)]
    pub view: ViewArgs,
    /// How it is told
    #[arg(long, value_enum, default_value_t = ExplainFormat::Text)]
    pub format: ExplainFormat,
    /// Explain one pixel, from the top left corner: column,row
    #[arg(long, value_name = "X,Y", value_parser = parse_pixel)]
    pub pixel: Option<[u32; 2]>,
}

#[derive(Debug, Args)]
pub struct PickArgs {
    #[command(flatten)]
    pub view: ViewArgs,
    /// Column and row from the top left corner, as in 640,360
    #[arg(value_name = "X,Y", value_parser = parse_pixel)]
    pub pixel: [u32; 2],
    /// How it is told
    #[arg(long, value_enum, default_value_t = PickFormat::Text)]
    pub format: PickFormat,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum BackendChoice {
    /// The GPU where there is one in hardware, else the CPU
    Auto,
    /// The GPU, in software where there is no other
    Gpu,
    /// The CPU
    Cpu,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum EngineChoice {
    /// The scene drawn once for each content; each fragment finds its layer
    Fused,
    /// The scene drawn once for each layer, back to front
    Peel,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum ViewChoice {
    /// How many layers each pixel's ray has
    Layers,
    /// The region of each visible surface
    Regions,
    /// Who acts on each visible surface, in the total order
    Order,
    /// Lenses and visible surfaces along one row, by depth
    DepthIntervals,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum ExplainFormat {
    /// For people
    Text,
    /// The same for programs
    Json,
    /// The priority graph for Graphviz
    Dot,
    /// The priority graph for Mermaid
    Mermaid,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum PickFormat {
    /// For people
    Text,
    /// One object, or null where nothing is
    Json,
}

fn pair(text: &str, separator: char) -> Option<[u32; 2]> {
    let (a, b) = text.split_once(separator)?;
    Some([a.trim().parse().ok()?, b.trim().parse().ok()?])
}

fn parse_size(text: &str) -> Result<[u32; 2], String> {
    let size = pair(text, 'x').ok_or("expected WIDTHxHEIGHT, as in 1280x720")?;
    let largest = ImageSpec::LARGEST_SIDE;
    if size.iter().all(|side| (1..=largest).contains(side)) {
        Ok(size)
    } else {
        Err(format!("each side must have 1 to {largest} pixels"))
    }
}

fn parse_samples(text: &str) -> Result<u32, String> {
    let samples = text.parse().map_err(|_| "expected 1, 4, 9 or 16")?;
    if [1, 4, 9, 16].contains(&samples) { Ok(samples) } else { Err("expected 1, 4, 9 or 16".into()) }
}

fn parse_pixel(text: &str) -> Result<[u32; 2], String> {
    pair(text, ',').ok_or_else(|| "expected COLUMN,ROW, as in 640,360".into())
}

fn parse_aov(text: &str) -> Result<(Aov, PathBuf), String> {
    let names = || Aov::ALL.map(|(name, _)| name).join(", ");
    let (name, file) = text.split_once('=').ok_or_else(|| format!("expected NAME=FILE with one of {}", names()))?;
    let (_, aov) = Aov::ALL
        .into_iter()
        .find(|(known, _)| *known == name)
        .ok_or_else(|| format!("there is no map `{name}`; there are {}", names()))?;
    if file.is_empty() {
        return Err("the file name is missing".into());
    }
    Ok((aov, PathBuf::from(file)))
}
