//! The command line.

use std::path::PathBuf;

use clap::{Args, Parser, Subcommand};

/// Breaks things where and as hard as they are hit.
///
/// Without a command, drops the default scene's glass: the same as `frangible break`.
#[derive(Debug, Parser)]
#[command(name = "frangible", version, args_conflicts_with_subcommands = true)]
pub(crate) struct Cli {
    #[command(subcommand)]
    pub(crate) command: Option<Command>,

    #[command(flatten)]
    pub(crate) break_args: BreakArgs,
}

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Bake a scene, break it, write the animation (GLB) and a contact sheet (PNG)
    Break(Box<BreakArgs>),
    /// List the built-in scenes, materials and what each shows
    Scenes,
}

#[derive(Args, Clone, Debug)]
pub(crate) struct BreakArgs {
    /// Built-in scene; `frangible scenes` lists them
    #[arg(long, default_value = "glass", value_name = "NAME")]
    pub(crate) scene: String,

    /// Material of the body that breaks [default: the scene's own]
    #[arg(long, value_name = "M")]
    pub(crate) material: Option<String>,

    /// Drop the body so that its lowest point starts HEIGHT metres above the floor
    #[arg(long, value_name = "HEIGHT", conflicts_with_all = ["ball", "at", "toward"], allow_hyphen_values = true)]
    pub(crate) drop: Option<f64>,

    /// Throw a ball instead: mass in kg, radius in m, speed in m/s, and its material [default: steel]
    #[arg(
        long,
        value_name = "MASS,RADIUS,SPEED[,MATERIAL]",
        allow_hyphen_values = true
    )]
    pub(crate) ball: Option<String>,

    /// Point the ball is aimed at: x,y,z in m from the body's centre of mass, y up [default: 0,0,0]
    #[arg(
        long,
        value_name = "x,y,z",
        requires = "ball",
        allow_hyphen_values = true
    )]
    pub(crate) at: Option<String>,

    /// Direction of the ball's flight: x,y,z, any length [default: 0,0,-1]
    #[arg(
        long,
        value_name = "x,y,z",
        requires = "ball",
        allow_hyphen_values = true
    )]
    pub(crate) toward: Option<String>,

    /// Seed of the weak points and of the cracks' roughness [default: the scene's own]
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    pub(crate) seed: Option<u64>,

    /// Number of vibration modes [default: the scene's own]
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    pub(crate) modes: Option<i64>,

    /// Folder for the results, made when it is missing
    #[arg(long, default_value = "out", value_name = "DIR")]
    pub(crate) out: PathBuf,

    /// Break with N seeds, from --seed on, and show them in one sheet, to choose a good one
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    pub(crate) contact_sheet: Option<i64>,

    /// Print the report as JSON instead of a table
    #[arg(long)]
    pub(crate) json: bool,

    /// No pictures (GLB and report only)
    #[arg(long)]
    pub(crate) no_pictures: bool,
}
