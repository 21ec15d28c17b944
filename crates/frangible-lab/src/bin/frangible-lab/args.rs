//! The command line.

use std::path::PathBuf;

use clap::{Args, Parser, Subcommand};

/// Computes the evidence for frangible and writes the pages of the documentation.
#[derive(Debug, Parser)]
#[command(name = "frangible-lab", version)]
pub(crate) struct Cli {
    #[command(subcommand)]
    pub(crate) command: Command,
}

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Check modes, responses and contacts against closed forms, and fail when one is off (seconds; verification.md)
    Verify(PageArgs),
    /// Compare cracks and pieces with published experiments (minutes; experiments.md)
    Experiments(PageArgs),
    /// Compare the ways to find how fragments vibrate with a full analysis of each fragment (minutes; recursive.md)
    Pieces(PiecesArgs),
    /// Tabulate the near field, the residual vector and the force of a blow (a minute; near-field.md)
    NearField(PageArgs),
    /// Strike and break things, listen, and compare with closed forms and published spectra (minutes; sound.md)
    Sound(PageArgs),
    /// Compute the figures of the paper this model is taken from, and judge each claim (minutes; figures.md)
    Figures(FiguresArgs),
    /// Measure how fast the bodies of the paper's Table 1 break, how fast harmless contacts are refused, and more (performance.md)
    Bench(BenchArgs),
    /// Draw the pictures of the documentation's gallery, and with --hero the film of its first page (a minute each)
    Gallery(GalleryArgs),
    /// Break the same impact by several methods, side by side: ours, quasi-static, along element faces, Voronoi cells by strain
    /// energy, Voronoi cells around the impact; write a picture (PNG) and a table (Markdown, JSON)
    Compare(CompareArgs),
}

#[derive(Args, Clone, Debug)]
pub(crate) struct PageArgs {
    /// Print JSON instead of a table
    #[arg(long)]
    pub(crate) json: bool,

    /// Also write the command's page and its pictures into this folder, made when it is missing
    #[arg(long, value_name = "DIR")]
    pub(crate) write: Option<PathBuf>,
}

#[derive(Args, Clone, Debug)]
pub(crate) struct GalleryArgs {
    /// Scenes to draw [default: all that the gallery shows]
    #[arg(value_name = "SCENE")]
    pub(crate) scenes: Vec<String>,

    /// Make the film of five breaks (hero.webp) instead
    #[arg(long, conflicts_with = "scenes")]
    pub(crate) hero: bool,

    /// Folder for the pictures, made when it is missing
    #[arg(long, default_value = "docs/gallery", value_name = "DIR")]
    pub(crate) write: PathBuf,
}

#[derive(Args, Clone, Debug)]
pub(crate) struct PiecesArgs {
    #[command(flatten)]
    pub(crate) page: PageArgs,

    /// How many fragments are analysed, 1 to 10000 [default: 200]
    #[arg(long, value_name = "N", value_parser = clap::builder::RangedU64ValueParser::<usize>::new().range(1..=10_000))]
    pub(crate) count: Option<usize>,
}

#[derive(Args, Clone, Debug)]
pub(crate) struct FiguresArgs {
    /// Figures to compute, such as fig3 fig12 [default: all]
    #[arg(value_name = "NAME")]
    pub(crate) names: Vec<String>,

    /// Folder for figures.md and its pictures, made when it is missing; figures not computed keep their place on the page
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
    /// The bodies of the gallery: whole breaks beside the project's goals
    Gallery,
    /// Refused contacts
    Contacts,
    /// A plate under a hand, a thousand times a second
    Haptic,
    /// A bull in a china shop
    Shop,
    /// Scenes whose pieces break again, as a game plays them
    Again,
    /// Many impacts on a GPU beside the CPU
    Gpu,
    /// All of these
    All,
    /// How near the initiation comes to the machine's peaks of arithmetic and memory; written as roofline.md
    Roofline,
}

#[derive(Args, Clone, Debug)]
pub(crate) struct BenchArgs {
    /// What to measure
    #[arg(value_enum, default_value = "all")]
    pub(crate) what: Measured,

    /// Only this body of Table 1, or of the gallery; repeat it for several
    #[arg(long = "body", value_name = "NAME")]
    pub(crate) bodies: Vec<String>,

    /// Equal runs, 1 to 10000: of Table 1 and the gallery warm runs of each body (30, fewer where they take longer than ten seconds), of
    /// the plate, the shop and the scenes runs of which each tick's and frame's least time counts (5)
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=10_000))]
    pub(crate) runs: Option<u32>,

    /// Ticks of 1 ms that the plate is felt for, 100 to 10000000
    #[arg(long, value_name = "N", default_value_t = 20_000, value_parser = clap::value_parser!(u32).range(100..=10_000_000))]
    pub(crate) ticks: u32,

    /// Leave out the paper's algorithms word for word, which take most of the time
    #[arg(long)]
    pub(crate) no_reference: bool,

    /// Folder of the baked bodies, made when it is missing
    #[arg(long, value_name = "DIR", default_value = "target/bench")]
    pub(crate) cache: PathBuf,

    /// Bake all bodies anew
    #[arg(long)]
    pub(crate) rebake: bool,

    /// Print JSON instead of tables
    #[arg(long)]
    pub(crate) json: bool,

    /// Also write what was measured into its section of performance.md in this folder, made when it is missing, of all bodies and baked anew; or roofline.md
    #[arg(long, value_name = "DIR")]
    pub(crate) write: Option<PathBuf>,
}

#[derive(Args, Clone, Debug)]
pub(crate) struct CompareArgs {
    /// Scene (.toml), mesh or baked body instead of a built-in scene
    #[arg(value_name = "FILE", conflicts_with = "scene")]
    pub(crate) file: Option<PathBuf>,

    /// Built-in scene, played up to its first break [default: glass]
    #[arg(long, value_name = "NAME")]
    pub(crate) scene: Option<String>,

    /// Seed of the weak points, of the cracks' roughness and of Voronoi sites [default: the scene's own]
    #[arg(long, value_name = "N")]
    pub(crate) seed: Option<u64>,

    /// Only these methods: ours, quasi-static, elements, energy-voronoi, voronoi
    #[arg(long, value_name = "NAME,NAME", value_delimiter = ',')]
    pub(crate) methods: Vec<String>,

    /// Time over which the quasi-static method spreads the impulse, ms [default: 0.26, a step of the rigid bodies]
    #[arg(long, value_name = "MS", allow_negative_numbers = true)]
    pub(crate) step: Option<f64>,

    /// Voronoi sites drawn by strain energy [default: 100]
    #[arg(long, value_name = "N")]
    pub(crate) sites: Option<usize>,

    /// Voronoi sites around the impact point [default: as many as ours has pieces, 2 at least]
    #[arg(long, value_name = "N")]
    pub(crate) cells: Option<usize>,

    /// Folder for the results, made when it is missing
    #[arg(long, default_value = "out", value_name = "DIR")]
    pub(crate) out: PathBuf,

    /// Print the report as JSON instead of a table
    #[arg(long)]
    pub(crate) json: bool,

    /// No picture
    #[arg(long)]
    pub(crate) no_pictures: bool,

    /// Write compare.md, about some of the built-in scenes, and its pictures into this folder instead
    #[arg(long, value_name = "DIR", conflicts_with_all = ["file", "scene", "seed", "methods", "json", "no_pictures"])]
    pub(crate) write: Option<PathBuf>,
}
