//! The command line.

mod film;

use std::path::PathBuf;

use clap::{Args, Parser, Subcommand};

pub(crate) use self::film::FilmArgs;

/// Simulates brittle fracture: how a body breaks depends on where and how hard it is hit.
///
/// Without a command, runs `frangible break` on the default scene, which drops a drinking glass.
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
    /// Break a scene, a mesh or a baked body, and write an animation (GLB), its sound (WAV) and a contact sheet (PNG)
    Break(Box<BreakCommand>),
    /// Bake a mesh, or the body of a scene, into a file that `frangible break` loads without precomputation
    Bake(BakeArgs),
    /// List the vibration modes of a body, draw the mode shapes coloured by stress (PNG), and export them to ParaView (VTU)
    Modes(ModesArgs),
    /// Film a break in slow motion, or the stress waves and cracks of its first microseconds (GIF, MP4, WebP, separate pictures)
    Film(Box<FilmArgs>),
    /// Open the interactive viewer: throw things, adjust the model's parameters, inspect the last contact; requires a build with `--features view`
    View(ViewArgs),
    /// List the built-in scenes and materials, or print one scene as a template for a scene file
    Scenes {
        /// Scene to print as TOML; saved to a file and passed to `break`, it plays the same scene
        name: Option<String>,
    },
}

#[derive(Args, Clone, Debug)]
pub(crate) struct ViewArgs {
    /// Built-in scene, or a file: scene (.toml), mesh or baked body [default: glass]
    #[arg(value_name = "SCENE|FILE")]
    pub(crate) what: Option<String>,

    /// Run the commands in this file, one per line, instead of interactive input; simulated time advances only on command, and the window closes at the end
    #[arg(long, value_name = "FILE", conflicts_with = "what")]
    pub(crate) script: Option<PathBuf>,

    /// Folder for files saved with keys and buttons, and for relative file names in scripts
    #[arg(long, value_name = "DIR", default_value = "out")]
    pub(crate) shots: PathBuf,

    /// Size of the window in pixels
    #[arg(long, value_name = "WIDTHxHEIGHT", default_value = "1280x800", value_parser = parse_size)]
    pub(crate) size: [u32; 2],
}

/// Two numbers of pixels, if both are within the range.
fn sides(text: &str, within: std::ops::RangeInclusive<u32>) -> Option<[u32; 2]> {
    let (width, height) = text.split_once('x')?;
    let sides = [width.parse::<u32>().ok()?, height.parse::<u32>().ok()?];
    sides
        .iter()
        .all(|side| within.contains(side))
        .then_some(sides)
}

/// Width and height of the window.
fn parse_size(text: &str) -> Result<[u32; 2], String> {
    sides(text, 320..=8192)
        .ok_or_else(|| "give width and height in pixels, 320 to 8192, such as 1280x800".into())
}

fn parse_seed(text: &str) -> Result<u64, String> {
    text.parse()
        .map_err(|_| format!("the seed must be a whole number from 0 to {}", u64::MAX))
}

#[derive(Args, Clone, Debug)]
pub(crate) struct BreakCommand {
    /// File to break: a mesh (.obj .stl .ply .gltf .glb, or tetrahedra .msh .node .ele .mesh; dropped, of porcelain), a baked body (.frangible) or a scene (.toml)
    #[arg(value_name = "FILE", conflicts_with = "scene")]
    pub(crate) file: Option<PathBuf>,

    #[command(flatten)]
    pub(crate) args: BreakArgs,
}

/// Options for making a body from a mesh file.
#[derive(Args, Clone, Debug, Default)]
pub(crate) struct MeshArgs {
    /// Length of the longest side of a mesh or baked body, in metres [default: the size in the file, read as metres]
    #[arg(long, value_name = "METRES", allow_hyphen_values = true)]
    pub(crate) size: Option<f64>,

    /// Approximate number of tetrahedra in the fracture mesh [default: the scene's own, or 42000]
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    pub(crate) resolution: Option<i64>,

    /// Make a wall of this thickness, in metres, centred on the mesh's surface, instead of a solid body
    #[arg(long, value_name = "METRES", allow_hyphen_values = true)]
    pub(crate) wall: Option<f64>,

    /// What to make of a mesh with several separate parts: a body of each (separate), the largest alone, or one body of all (weld) [default: a
    /// body of each, where layers that share faces are one]
    #[arg(long, value_name = "separate|largest|weld")]
    pub(crate) parts: Option<String>,

    /// With --parts weld, fill gaps between the parts up to this width, in metres [default: only parts that touch]
    #[arg(long, value_name = "METRES", allow_hyphen_values = true)]
    pub(crate) gap: Option<f64>,

    /// Axis of the file that points up: x, y or z [default: z for STL, PLY and tetrahedral meshes, otherwise y]
    #[arg(long, value_name = "AXIS")]
    pub(crate) up: Option<String>,
}

#[derive(Args, Clone, Debug)]
pub(crate) struct BakeArgs {
    /// Mesh (.obj .stl .ply .gltf .glb, or tetrahedra .msh .node .ele .mesh) or scene of one body (.toml)
    #[arg(
        value_name = "FILE",
        conflicts_with = "scene",
        required_unless_present = "scene"
    )]
    pub(crate) file: Option<PathBuf>,

    /// Bake the body of this built-in scene instead of a file
    #[arg(long, value_name = "NAME")]
    pub(crate) scene: Option<String>,

    /// File to write; its name must end in .frangible
    #[arg(short, long, value_name = "FILE.frangible")]
    pub(crate) output: PathBuf,

    /// Material of the body [default: the scene's own, or porcelain]
    #[arg(long, value_name = "M")]
    pub(crate) material: Option<String>,

    /// Number of vibration modes to keep, 1 to 400 [default: the scene's own, or 200]
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    pub(crate) modes: Option<i64>,

    /// Number of modes integrated through time during a blow; the rest respond statically [default: chosen by a trial blow on the body]
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    pub(crate) followed: Option<i64>,

    /// Store the mode shapes in half precision to make the file smaller; the report states the change of the stresses
    #[arg(long)]
    pub(crate) compact: bool,

    /// Fix a part of the body in place, before and after the break: below:z:0.01, above:x:0.3, box:x,y,z,x,y,z,
    /// sphere:x,y,z,r or group:NAME, in m in the coordinates of the shape (y is up in a mesh that was read); append @xy to fix x and y only. Repeat
    /// the option for several supports, for example --support below:x:0.01 --support group:frame@z
    #[arg(long = "support", value_name = "SPEC", allow_hyphen_values = true)]
    pub(crate) supports: Vec<String>,

    #[command(flatten)]
    pub(crate) mesh: MeshArgs,
}

#[derive(Args, Clone, Debug)]
pub(crate) struct ModesArgs {
    /// Baked body (.frangible), mesh (.obj .stl .ply .gltf .glb, or tetrahedra .msh .node .ele .mesh) or scene of one body (.toml)
    #[arg(
        value_name = "FILE",
        conflicts_with = "scene",
        required_unless_present = "scene"
    )]
    pub(crate) file: Option<PathBuf>,

    /// Analyse the body of this built-in scene instead of a file
    #[arg(long, value_name = "NAME")]
    pub(crate) scene: Option<String>,

    /// Picture to write; its name must end in .png [default: out/NAME-modes.png]
    #[arg(short, long, value_name = "FILE.png", conflicts_with = "no_pictures")]
    pub(crate) output: Option<PathBuf>,

    /// Number of modes to draw and list, 1 to 36
    #[arg(
        long,
        value_name = "N",
        default_value_t = 12,
        allow_negative_numbers = true
    )]
    pub(crate) modes: i64,

    /// File for the analysis mesh with all mode shapes and stresses; its name must end in .vtu
    #[arg(long, value_name = "FILE.vtu")]
    pub(crate) vtu: Option<PathBuf>,

    /// File for the fracture mesh, which follows the body's own shape, with the same fields; its name must end in .vtu
    #[arg(long, value_name = "FILE.vtu")]
    pub(crate) fracture_vtu: Option<PathBuf>,

    /// Material of the body [default: the scene's own, or porcelain]
    #[arg(long, value_name = "M")]
    pub(crate) material: Option<String>,

    /// Print JSON instead of a table
    #[arg(long)]
    pub(crate) json: bool,

    /// Write no picture
    #[arg(long)]
    pub(crate) no_pictures: bool,

    #[command(flatten)]
    pub(crate) mesh: MeshArgs,
}

/// Scene to play: the body and the blow that it takes.
#[derive(Args, Clone, Debug)]
pub(crate) struct SceneArgs {
    /// Built-in scene; `frangible scenes` lists them [default: glass]
    #[arg(long, value_name = "NAME")]
    pub(crate) scene: Option<String>,

    /// Material of the body that breaks [default: the scene's own]
    #[arg(long, value_name = "M")]
    pub(crate) material: Option<String>,

    /// Drop the body, with its lowest point starting HEIGHT metres above the floor
    #[arg(long, value_name = "HEIGHT", conflicts_with_all = ["ball", "at", "toward"], allow_hyphen_values = true)]
    pub(crate) drop: Option<f64>,

    /// Throw a ball at the body: mass in kg, radius in m, speed in m/s and material [default: steel]
    #[arg(
        long,
        value_name = "MASS,RADIUS,SPEED[,MATERIAL]",
        allow_hyphen_values = true
    )]
    pub(crate) ball: Option<String>,

    /// Point at which the ball is aimed, with --ball: x,y,z in m from the body's centre of mass, y up [default: 0,0,0]
    #[arg(
        long,
        value_name = "x,y,z",
        requires = "ball",
        allow_hyphen_values = true
    )]
    pub(crate) at: Option<String>,

    /// Direction in which the ball flies, with --ball: x,y,z, of any length [default: 0,0,-1]
    #[arg(
        long,
        value_name = "x,y,z",
        requires = "ball",
        allow_hyphen_values = true
    )]
    pub(crate) toward: Option<String>,

    /// Random seed for the weak points and the roughness of the cracks [default: the scene's own]
    #[arg(long, value_name = "N", value_parser = parse_seed, allow_negative_numbers = true)]
    pub(crate) seed: Option<u64>,

    /// Number of vibration modes [default: the scene's own]
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    pub(crate) modes: Option<i64>,

    /// Let pieces break again, up to N generations; 0 keeps the pieces of the first break whole [default: the scene's own]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(0..=20))]
    pub(crate) generations: Option<u32>,

    /// Fix a part of the body in place, before and after the break: below:z:0.01, above:x:0.3, box:x,y,z,x,y,z,
    /// sphere:x,y,z,r or group:NAME, in m in the coordinates of the shape (y is up in a mesh that was read); append @xy to fix x and y only. Repeat
    /// the option for several supports, for example --support below:x:0.01 --support group:frame@z
    #[arg(long = "support", value_name = "SPEC", allow_hyphen_values = true)]
    pub(crate) supports: Vec<String>,

    #[command(flatten)]
    pub(crate) mesh: MeshArgs,
}

#[derive(Args, Clone, Debug)]
pub(crate) struct BreakArgs {
    #[command(flatten)]
    pub(crate) scene: SceneArgs,

    /// Folder for the results, created if it does not exist
    #[arg(long, default_value = "out", value_name = "DIR")]
    pub(crate) out: PathBuf,

    /// Break with N consecutive seeds, starting at --seed, and draw the results on one sheet for comparison
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    pub(crate) contact_sheet: Option<i64>,

    /// Detail of the drawn pieces: crack faces as computed and cracks that end inside the body (full), or crack faces with fewer triangles, at most
    /// 0.5 % of the body's longest side away, and a GLB with vertices of 16 bits (light), or crack faces four times as fine as computed, with the
    /// roughness of the material (fine) [default: the scene's own, or full]
    #[arg(long, value_name = "full|light|fine", hide_possible_values = true)]
    pub(crate) drawing: Option<DrawingArg>,

    /// Print the report as JSON instead of a table
    #[arg(long)]
    pub(crate) json: bool,

    /// Write no pictures, only the GLB, the sound and the report
    #[arg(long)]
    pub(crate) no_pictures: bool,

    /// Write no sound (WAV)
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
}

/// Level of a sound file.
#[derive(Clone, Copy, Debug, clap::ValueEnum)]
pub(crate) enum LevelArg {
    Loudness,
    True,
}

impl From<LevelArg> for frangible_sound::Level {
    fn from(level: LevelArg) -> Self {
        match level {
            LevelArg::Loudness => Self::Loudness,
            LevelArg::True => Self::True,
        }
    }
}

/// Detail of drawn pieces.
#[derive(Clone, Copy, Debug, clap::ValueEnum)]
pub(crate) enum DrawingArg {
    Full,
    Light,
    Fine,
}

impl From<DrawingArg> for frangible_scenes::Drawing {
    fn from(drawing: DrawingArg) -> Self {
        match drawing {
            DrawingArg::Full => Self::Full,
            DrawingArg::Light => Self::Light,
            DrawingArg::Fine => Self::Fine,
        }
    }
}
