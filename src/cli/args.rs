//! The command line.

use std::path::PathBuf;

use clap::{Args, Parser, Subcommand, ValueEnum};

use super::open::OpenArgs;
use crate::output::Aov;
use crate::spec::ImageSpec;

#[derive(Debug, Parser)]
#[command(name = "lenspeel", version, about = "Composed 3D magic lenses", arg_required_else_help = true)]
pub struct Cli {
    #[command(subcommand)]
    pub command: Command,
}

#[derive(Debug, Subcommand)]
pub enum Command {
    /// Render a lens-spec file to a picture
    Render(RenderArgs),
    /// Check a lens-spec file and everything it names
    Check {
        /// The lens-spec file
        spec: PathBuf,
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
        /// Where to write it; left out: to the terminal
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
    /// The lens-spec file
    pub spec: PathBuf,
    /// The picture to write (PNG)
    #[arg(short, long)]
    pub output: PathBuf,
    /// Width and height in pixels, as in 1920x1080; left out: the spec's
    #[arg(long, value_parser = parse_size)]
    pub size: Option<[u32; 2]>,
    /// Samples a pixel: 1, 4, 9 or 16; left out: the spec's
    #[arg(long, value_parser = parse_samples)]
    pub samples: Option<u32>,
    /// What renders: the GPU, the CPU, or the GPU where there is a real one
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
    /// The lens-spec file
    pub spec: PathBuf,
    /// Width and height in pixels, as in 1920x1080; left out: the spec's
    #[arg(long, value_parser = parse_size)]
    pub size: Option<[u32; 2]>,
    /// Who finds what is seen: the CPU, which need not be started, the GPU, or the GPU where there is a real one
    #[arg(long, value_enum, default_value_t = BackendChoice::Cpu)]
    pub backend: BackendChoice,
    #[command(flatten)]
    pub open: OpenArgs,
}

#[derive(Debug, Args)]
pub struct BenchArgs {
    /// The lens-spec file
    pub spec: PathBuf,
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
    #[arg(long, value_enum, default_value_t = PickFormat::Text)]
    pub format: PickFormat,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum BackendChoice {
    Auto,
    Gpu,
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
    Text,
    Json,
    /// The priority graph for Graphviz
    Dot,
    /// The priority graph for Mermaid
    Mermaid,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum PickFormat {
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
