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
    /// Break a scene, a mesh or a baked body; write the animation (GLB), its sound (WAV) and a contact sheet (PNG)
    Break(Box<BreakCommand>),
    /// Bake a mesh, or the body of a scene, into a file that breaks without waiting
    Bake(BakeArgs),
    /// Show how a body vibrates: table of its modes, picture of their shapes coloured by stress (PNG), files for ParaView (VTU)
    Modes(ModesArgs),
    /// Film a break in slow motion, or the microseconds in which it happens (GIF, MP4, single pictures)
    Film(Box<FilmArgs>),
    /// Open a window: throw things, turn the model's knobs, look into the last contact; takes a build with `--features view`
    View(ViewArgs),
    /// List the built-in scenes and materials, or print one scene as a file to start from
    Scenes {
        /// Scene to print as TOML; saved, and given to `break`, it does the same
        name: Option<String>,
    },
}

#[derive(Args, Clone, Debug)]
pub(crate) struct ViewArgs {
    /// Built-in scene, or a file: scene (.toml), mesh or baked body [default: glass]
    #[arg(value_name = "SCENE|FILE")]
    pub(crate) what: Option<String>,

    /// Give the commands of this file, one per line, instead of a person's; the clock stands, and the window closes at the end
    #[arg(long, value_name = "FILE", conflicts_with = "what")]
    pub(crate) script: Option<PathBuf>,

    /// Folder for what is saved: files of keys and buttons, and relative names in scripts
    #[arg(long, value_name = "DIR", default_value = "out")]
    pub(crate) shots: PathBuf,

    /// Size of the window, pixels
    #[arg(long, value_name = "WIDTHxHEIGHT", default_value = "1280x800", value_parser = parse_size)]
    pub(crate) size: [u32; 2],
}

#[derive(Args, Clone, Debug)]
pub(crate) struct FilmArgs {
    /// File to break: a mesh, a baked body (.frangible) or a scene (.toml)
    #[arg(value_name = "FILE", conflicts_with = "scene")]
    pub(crate) file: Option<PathBuf>,

    /// The microseconds of the first break: tension as colour on the body, and the cracks that it drives, each when it runs; takes a build with
    /// `--features view`
    #[arg(long, conflicts_with = "slow")]
    pub(crate) microseconds: bool,

    /// Film to write: .gif, .mp4 (which takes the program ffmpeg), .webp (in a build with `--features view`), or a folder of pictures [default:
    /// out/NAME.gif]. An MP4 has its sound
    /// track, the others a WAV beside them; slowed down, the sound is as much deeper
    #[arg(short, long, value_name = "FILE")]
    pub(crate) output: Option<PathBuf>,

    /// Follow light for each picture, as stills do: seconds per picture. A build without `--features view` always does
    #[arg(long, conflicts_with = "microseconds")]
    pub(crate) traced: bool,

    /// Leave the sound out
    #[arg(long)]
    pub(crate) no_sound: bool,

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

    /// How many times slower than it is the break is shown
    #[arg(
        long,
        value_name = "TIMES",
        default_value_t = 8.0,
        allow_negative_numbers = true
    )]
    pub(crate) slow: f64,

    /// Size of the pictures, pixels
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

fn sides(text: &str, within: std::ops::RangeInclusive<u32>) -> Option<[u32; 2]> {
    let (width, height) = text.split_once('x')?;
    let sides = [width.parse::<u32>().ok()?, height.parse::<u32>().ok()?];
    sides
        .iter()
        .all(|side| within.contains(side))
        .then_some(sides)
}

/// Width and height.
fn parse_size(text: &str) -> Result<[u32; 2], String> {
    sides(text, 320..=8192)
        .ok_or_else(|| "give width and height in pixels, 320 to 8192, such as 1280x800".into())
}

fn parse_seed(text: &str) -> Result<u64, String> {
    text.parse()
        .map_err(|_| format!("a seed is a whole number, 0 to {}", u64::MAX))
}

#[derive(Args, Clone, Debug)]
pub(crate) struct BreakCommand {
    /// File to break: a mesh (.obj .stl .ply .gltf .glb, or tetrahedra .msh .node .ele .vtk .vtu .mesh; dropped, of porcelain), a baked body (.frangible) or a scene (.toml)
    #[arg(value_name = "FILE", conflicts_with = "scene")]
    pub(crate) file: Option<PathBuf>,

    #[command(flatten)]
    pub(crate) args: BreakArgs,
}

/// Settings for making a body from a mesh file.
#[derive(Args, Clone, Debug, Default)]
pub(crate) struct MeshArgs {
    /// Longest side of a mesh's or a baked body in metres [default: the file's unit is the metre]
    #[arg(long, value_name = "METRES", allow_hyphen_values = true)]
    pub(crate) size: Option<f64>,

    /// Tetrahedra that carry cracks, about [default: the scene's own, or 42000]
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    pub(crate) resolution: Option<i64>,

    /// Make a wall of this thickness, in metres, along the mesh's surface, half on each side, instead of filling its inside
    #[arg(long, value_name = "METRES", allow_hyphen_values = true)]
    pub(crate) wall: Option<f64>,

    /// Which axis of the file is up: x, y or z [default: z in STL, PLY and tetrahedra, else y]
    #[arg(long, value_name = "AXIS")]
    pub(crate) up: Option<String>,
}

#[derive(Args, Clone, Debug)]
pub(crate) struct BakeArgs {
    /// Mesh (.obj .stl .ply .gltf .glb, or tetrahedra .msh .node .ele .vtk .vtu .mesh) or scene of one body (.toml)
    #[arg(
        value_name = "FILE",
        conflicts_with = "scene",
        required_unless_present = "scene"
    )]
    pub(crate) file: Option<PathBuf>,

    /// Built-in scene whose body to bake instead
    #[arg(long, value_name = "NAME")]
    pub(crate) scene: Option<String>,

    /// File to write, ending in .frangible
    #[arg(short, long, value_name = "FILE.frangible")]
    pub(crate) output: PathBuf,

    /// Material of the body [default: the scene's own, or porcelain]
    #[arg(long, value_name = "M")]
    pub(crate) material: Option<String>,

    /// Number of vibration modes to keep, 1 to 400 [default: the scene's own, or 200]
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    pub(crate) modes: Option<i64>,

    /// How many of them a blow follows through time; the rest answer it at once [default: found by trial on the body]
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    pub(crate) followed: Option<i64>,

    /// Mode shapes in half precision: a smaller file; the report tells what it changes
    #[arg(long)]
    pub(crate) compact: bool,

    /// Hold a part of the body, which stays where it is, also after the break: below:z:0.01, above:x:0.3 (m, in the
    /// frame of its shape; in a mesh that was read y is up), box:x,y,z,x,y,z, sphere:x,y,z,r or group:NAME; @xy holds it along x and y only. Repeat it for
    /// several, for example --support below:x:0.01 --support group:frame@z
    #[arg(long = "support", value_name = "SPEC", allow_hyphen_values = true)]
    pub(crate) supports: Vec<String>,

    #[command(flatten)]
    pub(crate) mesh: MeshArgs,
}

#[derive(Args, Clone, Debug)]
pub(crate) struct ModesArgs {
    /// Baked body (.frangible), mesh (.obj .stl .ply .gltf .glb, or tetrahedra .msh .node .ele .vtk .vtu .mesh) or scene of one body (.toml)
    #[arg(
        value_name = "FILE",
        conflicts_with = "scene",
        required_unless_present = "scene"
    )]
    pub(crate) file: Option<PathBuf>,

    /// Built-in scene whose body to look at instead
    #[arg(long, value_name = "NAME")]
    pub(crate) scene: Option<String>,

    /// Picture to write, ending in .png [default: out/NAME-modes.png]
    #[arg(short, long, value_name = "FILE.png", conflicts_with = "no_pictures")]
    pub(crate) output: Option<PathBuf>,

    /// How many modes to draw and to list, 1 to 36
    #[arg(
        long,
        value_name = "N",
        default_value_t = 12,
        allow_negative_numbers = true
    )]
    pub(crate) modes: i64,

    /// Write the elements that carry the modes, with all shapes and stresses, ending in .vtu
    #[arg(long, value_name = "FILE.vtu")]
    pub(crate) vtu: Option<PathBuf>,

    /// Write the mesh that carries cracks, which is the body's own shape, with the same fields, ending in .vtu
    #[arg(long, value_name = "FILE.vtu")]
    pub(crate) fracture_vtu: Option<PathBuf>,

    /// Material of the body [default: the scene's own, or porcelain]
    #[arg(long, value_name = "M")]
    pub(crate) material: Option<String>,

    /// Print JSON instead of a table
    #[arg(long)]
    pub(crate) json: bool,

    /// No picture
    #[arg(long)]
    pub(crate) no_pictures: bool,

    #[command(flatten)]
    pub(crate) mesh: MeshArgs,
}

/// Scene to play: the body that breaks, and the blow that breaks it.
#[derive(Args, Clone, Debug)]
pub(crate) struct SceneArgs {
    /// Built-in scene; `frangible scenes` lists them [default: glass]
    #[arg(long, value_name = "NAME")]
    pub(crate) scene: Option<String>,

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

    /// Point the ball is aimed at, with --ball: x,y,z in m from the body's centre of mass, y up [default: 0,0,0]
    #[arg(
        long,
        value_name = "x,y,z",
        requires = "ball",
        allow_hyphen_values = true
    )]
    pub(crate) at: Option<String>,

    /// Direction of the ball's flight, with --ball: x,y,z, any length [default: 0,0,-1]
    #[arg(
        long,
        value_name = "x,y,z",
        requires = "ball",
        allow_hyphen_values = true
    )]
    pub(crate) toward: Option<String>,

    /// Seed of the weak points and of the cracks' roughness [default: the scene's own]
    #[arg(long, value_name = "N", value_parser = parse_seed, allow_negative_numbers = true)]
    pub(crate) seed: Option<u64>,

    /// Number of vibration modes [default: the scene's own]
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    pub(crate) modes: Option<i64>,

    /// Let pieces break again, and their pieces, up to N breaks; 0: pieces stay as they are [default: the scene's own]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(0..=20))]
    pub(crate) generations: Option<u32>,

    /// Hold a part of the body, which stays where it is, also after the break: below:z:0.01, above:x:0.3 (m, in the
    /// frame of its shape; in a mesh that was read y is up), box:x,y,z,x,y,z, sphere:x,y,z,r or group:NAME; @xy holds it along x and y only. Repeat it for
    /// several, for example --support below:x:0.01 --support group:frame@z
    #[arg(long = "support", value_name = "SPEC", allow_hyphen_values = true)]
    pub(crate) supports: Vec<String>,

    #[command(flatten)]
    pub(crate) mesh: MeshArgs,
}

#[derive(Args, Clone, Debug)]
pub(crate) struct BreakArgs {
    #[command(flatten)]
    pub(crate) scene: SceneArgs,

    /// Folder for the results, made when it is missing
    #[arg(long, default_value = "out", value_name = "DIR")]
    pub(crate) out: PathBuf,

    /// Break with N seeds, from --seed on, and show them in one sheet, to choose a good one
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    pub(crate) contact_sheet: Option<i64>,

    /// Print the report as JSON instead of a table
    #[arg(long)]
    pub(crate) json: bool,

    /// No pictures (GLB, sound and report only)
    #[arg(long)]
    pub(crate) no_pictures: bool,

    /// No sound (no WAV)
    #[arg(long)]
    pub(crate) no_sound: bool,
}
