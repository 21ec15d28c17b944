//! The command line.

use std::path::PathBuf;

use clap::{Args, Parser, Subcommand};

/// Runs the validation and benchmarks of Frangible, and writes the numbers as JSON.
#[derive(Debug, Parser)]
#[command(name = "frangible-lab", version)]
pub(crate) struct Cli {
    #[command(subcommand)]
    pub(crate) command: Command,
}

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Check modes, responses and contacts against closed-form solutions; fail if one exceeds its tolerance (seconds)
    Verify(Write),
    /// Compare cracks and pieces with published experiments (minutes)
    Experiments(Write),
    /// Compare approximate vibration modes of fragments with a full analysis of each fragment (minutes)
    Pieces(PiecesArgs),
    /// Measure the near field, the residual vector and the force of a blow (a minute)
    NearField(Write),
    /// Compare synthesised sounds with closed-form solutions and published spectra (minutes)
    Sound(Write),
    /// Level the sound of all scenes by loudness, and compare landings, decays and glasses (minutes)
    Levels(Write),
    /// Compute the numbers behind the figures of the paper on which the model is based (minutes)
    Figures(FiguresArgs),
    /// Measure the time of breaks, of rejected contacts and of scenes
    Bench(BenchArgs),
    /// Compare fracture methods on the first impact of a scene: ours, quasi-static, along element faces, Voronoi cells by strain energy,
    /// Voronoi cells around the impact
    Compare(CompareArgs),
    /// Draw the pictures of the documentation's gallery, or with --hero the film on the first page (a minute each)
    Gallery(GalleryArgs),
    /// Count cracks and pieces of struck scenes, for the comparison with descriptions of real breaks (minutes)
    RealBreaks(RealBreaksArgs),
    /// Fill the quotations of data in the pages of a folder
    Pages {
        /// Folder of the pages
        #[arg(default_value = "docs")]
        docs: PathBuf,
    },
}

#[derive(Args, Clone, Debug)]
pub(crate) struct Write {
    /// Write DIR/data/NAME.json and fill the quotations in the pages of DIR, instead of printing JSON
    #[arg(long, value_name = "DIR")]
    pub(crate) write: Option<PathBuf>,
}

#[derive(Args, Clone, Debug)]
pub(crate) struct PiecesArgs {
    #[command(flatten)]
    pub(crate) write: Write,

    /// Number of fragments to analyse, 1 to 10000 [default: 200]
    #[arg(long, value_name = "N", value_parser = clap::builder::RangedU64ValueParser::<usize>::new().range(1..=10_000))]
    pub(crate) count: Option<usize>,
}

#[derive(Args, Clone, Debug)]
pub(crate) struct FiguresArgs {
    /// Figures to compute, such as fig3 fig12 [default: all]
    #[arg(value_name = "NAME", conflicts_with = "write")]
    pub(crate) names: Vec<String>,

    #[command(flatten)]
    pub(crate) write: Write,
}

#[derive(Args, Clone, Debug)]
pub(crate) struct RealBreaksArgs {
    #[command(flatten)]
    pub(crate) write: Write,

    /// Number of bodies of each subject, 1 to 1000; they differ in their weak points [default: 10]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..=1000))]
    pub(crate) seeds: Option<u64>,
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
    /// The initiation on bodies of Table 1, compared with the peaks of this machine
    Roofline,
    /// Scenes with pieces that break again, with a game's settings
    Again,
}

#[derive(Args, Clone, Debug)]
pub(crate) struct BenchArgs {
    /// Benchmark to run
    #[arg(value_enum)]
    pub(crate) what: Measured,

    #[command(flatten)]
    pub(crate) write: Write,

    /// Measure only this body of Table 1 or of the gallery; may be repeated
    #[arg(long = "body", value_name = "NAME", conflicts_with = "write")]
    pub(crate) bodies: Vec<String>,

    /// Number of runs, 1 to 10000 [default: 30 of each body, fewer if they take over ten seconds; 3 of each scene]
    #[arg(long, value_name = "N", value_parser = clap::builder::RangedU64ValueParser::<usize>::new().range(1..=10_000))]
    pub(crate) runs: Option<usize>,

    /// Skip the literal implementation of the paper's algorithms, which takes most of the time
    #[arg(long)]
    pub(crate) no_reference: bool,

    /// Folder for the baked bodies, created if it does not exist
    #[arg(long, value_name = "DIR", default_value = "target/bench")]
    pub(crate) cache: PathBuf,

    /// Bake all bodies again
    #[arg(long)]
    pub(crate) rebake: bool,
}

#[derive(Args, Clone, Debug)]
pub(crate) struct CompareArgs {
    /// Scene (.toml), mesh or baked body to use instead of a built-in scene
    #[arg(value_name = "FILE", conflicts_with_all = ["scene", "write"])]
    pub(crate) file: Option<PathBuf>,

    /// Built-in scene, simulated up to its first break [default: glass]
    #[arg(long, value_name = "NAME", conflicts_with = "write")]
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

    /// Also draw the pieces of each method into this file (PNG)
    #[arg(long, value_name = "FILE", conflicts_with = "write")]
    pub(crate) picture: Option<PathBuf>,

    #[command(flatten)]
    pub(crate) write: Write,
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
