//! The command line.

use std::path::PathBuf;

use clap::{Args, Parser, Subcommand};

/// Runs the validation and benchmarks of Frangible and writes the results as documentation pages.
#[derive(Debug, Parser)]
#[command(name = "frangible-lab", version)]
pub(crate) struct Cli {
    #[command(subcommand)]
    pub(crate) command: Command,
}

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Check modes, responses and contacts against closed-form solutions; fail if one exceeds its tolerance (seconds; verification.md)
    Verify(PageArgs),
    /// Compare cracks and pieces with published experiments (minutes; experiments.md)
    Experiments(PageArgs),
    /// Compare approximate vibration modes of fragments with a full analysis of each fragment (minutes; recursive.md)
    Pieces(PiecesArgs),
    /// Tabulate the near field, the residual vector and the force of a blow (a minute; near-field.md)
    NearField(PageArgs),
    /// Compare synthesised sounds with closed-form solutions and published spectra (minutes; sound.md)
    Sound(PageArgs),
    /// Reproduce the figures of the paper on which the model is based, and check each of its claims (minutes; figures.md)
    Figures(FiguresArgs),
    /// Measure the time of breaks of the bodies in the paper's Table 1, the time to reject harmless contacts, and more (performance.md)
    Bench(BenchArgs),
    /// Draw the pictures of the documentation's gallery, or with --hero the film on the first page (a minute each)
    Gallery(GalleryArgs),
    /// Compare fracture methods on the same impact: ours, quasi-static, along element faces, Voronoi cells by strain energy, Voronoi
    /// cells around the impact; write a picture (PNG) and a table (Markdown, JSON)
    Compare(CompareArgs),
}

#[derive(Args, Clone, Debug)]
pub(crate) struct PageArgs {
    /// Print JSON instead of a table
    #[arg(long)]
    pub(crate) json: bool,

    /// Also write the command's page and its pictures to this folder, created if it does not exist
    #[arg(long, value_name = "DIR")]
    pub(crate) write: Option<PathBuf>,
}

#[derive(Args, Clone, Debug)]
pub(crate) struct GalleryArgs {
    /// Scenes to draw [default: all scenes of the gallery]
    #[arg(value_name = "SCENE")]
    pub(crate) scenes: Vec<String>,

    /// Make the film of five breaks (hero.webp) instead
    #[arg(long, conflicts_with = "scenes")]
    pub(crate) hero: bool,

    /// Folder for the pictures, created if it does not exist
    #[arg(long, default_value = "docs/gallery", value_name = "DIR")]
    pub(crate) write: PathBuf,
}

#[derive(Args, Clone, Debug)]
pub(crate) struct PiecesArgs {
    #[command(flatten)]
    pub(crate) page: PageArgs,

    /// Number of fragments to analyse, 1 to 10000 [default: 200]
    #[arg(long, value_name = "N", value_parser = clap::builder::RangedU64ValueParser::<usize>::new().range(1..=10_000))]
    pub(crate) count: Option<usize>,
}

#[derive(Args, Clone, Debug)]
pub(crate) struct FiguresArgs {
    /// Figures to compute, such as fig3 fig12 [default: all]
    #[arg(value_name = "NAME")]
    pub(crate) names: Vec<String>,

    /// Folder for figures.md and its pictures, created if it does not exist; figures that are not computed stay unchanged on the page
    #[arg(short = 'o', long, default_value = "out", value_name = "DIR")]
    pub(crate) write: PathBuf,

    /// Print JSON instead of text: claims, verdicts and tables
    #[arg(long)]
    pub(crate) json: bool,
}

/// Subject of a benchmark.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum Measured {
    /// The bodies of the paper's Table 1
    Table1,
    /// The bodies of the gallery: whole breaks, compared with the project's goals
    Gallery,
    /// Rejected contacts
    Contacts,
    /// Haptics: a plate touched at 1000 Hz
    Haptic,
    /// A bull in a china shop
    Shop,
    /// Scenes with pieces that break again, with a game's settings
    Again,
    /// Batches of impacts on the GPU and on the CPU
    Gpu,
    /// All of these
    All,
    /// Roofline of crack initiation: achieved and peak rates of arithmetic and memory (roofline.md)
    Roofline,
}

#[derive(Args, Clone, Debug)]
pub(crate) struct BenchArgs {
    /// Benchmark to run
    #[arg(value_enum, default_value = "all")]
    pub(crate) what: Measured,

    /// Measure only this body of Table 1 or of the gallery; may be repeated
    #[arg(long = "body", value_name = "NAME")]
    pub(crate) bodies: Vec<String>,

    /// Number of runs, 1 to 10000: for Table 1 and the gallery, warm runs of each body [default: 30, fewer if they take over ten seconds];
    /// for the plate, the shop and the scenes, runs of which the shortest time of each tick or frame counts [default: 5]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=10_000))]
    pub(crate) runs: Option<u32>,

    /// Number of ticks of 1 ms in the haptics benchmark, 100 to 10000000
    #[arg(long, value_name = "N", default_value_t = 20_000, value_parser = clap::value_parser!(u32).range(100..=10_000_000))]
    pub(crate) ticks: u32,

    /// Skip the literal implementation of the paper's algorithms, which takes most of the time
    #[arg(long)]
    pub(crate) no_reference: bool,

    /// Folder for the baked bodies, created if it does not exist
    #[arg(long, value_name = "DIR", default_value = "target/bench")]
    pub(crate) cache: PathBuf,

    /// Bake all bodies again
    #[arg(long)]
    pub(crate) rebake: bool,

    /// Print JSON instead of tables
    #[arg(long)]
    pub(crate) json: bool,

    /// Also write the results to their section of performance.md, or to roofline.md, in this folder, created if it does not exist; measures all
    /// bodies, baked again
    #[arg(long, value_name = "DIR")]
    pub(crate) write: Option<PathBuf>,
}

#[derive(Args, Clone, Debug)]
pub(crate) struct CompareArgs {
    /// Scene (.toml), mesh or baked body to use instead of a built-in scene
    #[arg(value_name = "FILE", conflicts_with = "scene")]
    pub(crate) file: Option<PathBuf>,

    /// Built-in scene, simulated up to its first break [default: glass]
    #[arg(long, value_name = "NAME")]
    pub(crate) scene: Option<String>,

    /// Random seed for the weak points, the roughness of the cracks and the Voronoi sites [default: the scene's own]
    #[arg(long, value_name = "N")]
    pub(crate) seed: Option<u64>,

    /// Methods to compare [default: all]: ours, quasi-static, elements, energy-voronoi, voronoi
    #[arg(long, value_name = "NAME,NAME", value_delimiter = ',')]
    pub(crate) methods: Vec<String>,

    /// Duration over which the quasi-static method spreads the impulse, in ms [default: 0.26, one rigid-body step]
    #[arg(long, value_name = "MS", allow_negative_numbers = true)]
    pub(crate) step: Option<f64>,

    /// Number of Voronoi sites sampled by strain energy [default: 100]
    #[arg(long, value_name = "N")]
    pub(crate) sites: Option<usize>,

    /// Number of Voronoi sites around the impact point [default: the number of pieces of our method, at least 2]
    #[arg(long, value_name = "N")]
    pub(crate) cells: Option<usize>,

    /// Folder for the results, created if it does not exist
    #[arg(long, default_value = "out", value_name = "DIR")]
    pub(crate) out: PathBuf,

    /// Print the report as JSON instead of a table
    #[arg(long)]
    pub(crate) json: bool,

    /// Write no picture
    #[arg(long)]
    pub(crate) no_pictures: bool,

    /// Compare the methods on several built-in scenes instead, and write compare.md and its pictures to this folder
    #[arg(long, value_name = "DIR", conflicts_with_all = ["file", "scene", "seed", "methods", "json", "no_pictures"])]
    pub(crate) write: Option<PathBuf>,
}
