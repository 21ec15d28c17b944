//! Arguments of `frangible film`.

use std::path::PathBuf;

use clap::Args;

use super::{LevelArg, SceneArgs, sides};

#[derive(Args, Clone, Debug)]
pub(crate) struct FilmArgs {
    /// File to break: a mesh, a baked body (.frangible) or a scene (.toml)
    #[arg(value_name = "FILE", conflicts_with = "scene")]
    pub(crate) file: Option<PathBuf>,

    /// Film the first microseconds of the first break: tensile stress as colour on the body, and each crack as it grows; requires a build
    /// with `--features view`
    #[arg(long, conflicts_with = "slow")]
    pub(crate) microseconds: bool,

    /// Film to write: .gif, .mp4 (requires the program ffmpeg), .webp (requires a build with `--features view`), or a folder for separate
    /// pictures [default: out/NAME.gif]. An MP4 contains the sound track; the other formats get a separate WAV file. Slow motion lowers the
    /// pitch of the sound by the same factor
    #[arg(short, long, value_name = "FILE")]
    pub(crate) output: Option<PathBuf>,

    /// Path-trace each picture, like a still, which takes seconds per picture; always on in a build without `--features view`
    #[arg(long, conflicts_with = "microseconds")]
    pub(crate) traced: bool,

    /// Write no sound
    #[arg(long)]
    pub(crate) no_sound: bool,

    /// Level of the sound: at a loudness of −16 LUFS, with soft sounds raised and loud ones limited (loudness), or true to scale, as loud as fits
    /// (true)
    #[arg(
        long,
        value_name = "loudness|true",
        hide_possible_values = true,
        default_value = "loudness"
    )]
    pub(crate) level: LevelArg,

    /// Length of the film in seconds
    #[arg(
        long,
        value_name = "SECONDS",
        default_value_t = 6.0,
        allow_negative_numbers = true
    )]
    pub(crate) seconds: f64,

    /// Pictures per second
    #[arg(
        long,
        value_name = "N",
        default_value_t = 20.0,
        allow_negative_numbers = true
    )]
    pub(crate) rate: f64,

    /// Slow-motion factor: show the break this many times slower than real time
    #[arg(
        long,
        value_name = "TIMES",
        default_value_t = 8.0,
        allow_negative_numbers = true
    )]
    pub(crate) slow: f64,

    /// Size of the pictures in pixels
    #[arg(long = "frame", value_name = "WIDTHxHEIGHT", default_value = "640x480", value_parser = parse_frame)]
    pub(crate) frame: [u32; 2],

    #[command(flatten)]
    pub(crate) scene: SceneArgs,
}

impl FilmArgs {
    /// Number of pictures in the film.
    pub(crate) fn pictures(&self) -> usize {
        (self.seconds * self.rate).round().max(2.0) as usize
    }
}

/// Width and height of a film.
fn parse_frame(text: &str) -> Result<[u32; 2], String> {
    sides(text, 64..=4096)
        .ok_or_else(|| "give width and height in pixels, 64 to 4096, such as 640x480".into())
}
