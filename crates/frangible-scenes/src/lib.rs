//! Scenes of Frangible: bodies, materials and set-ups for tests, benchmarks, pictures and the command line, built in or from files.
//!
//! ```no_run
//! let scene = frangible_scenes::scene("glass")?;
//! let bodies = frangible_scenes::bake(&scene)?;
//! let run = frangible_scenes::play(&scene, &bodies, &mut |_| {})?;
//! println!("{} pieces", run.breaks.first().map_or(1, |b| b.masses.len()));
//! # Ok::<(), frangible_scenes::SceneError>(())
//! ```
//!
//! [`scene()`] returns a built-in scene, [`scene_of_file`] a scene from a scene file, a mesh or a baked body, and [`parse_scene`] a scene from
//! TOML text; [`scene_to_toml`] writes TOML.
//!
//! Without the feature `bake` the crate has no finite-element solver and no dependency on faer, and requires baked bodies.

mod adhesive;
mod again;
mod appearance;
mod assembly;
mod bake;
mod body;
mod bonds;
mod builtin;
mod cameras;
mod check;
mod cracks;
mod error;
mod files;
mod first_break;
mod game;
mod hammer;
mod laminated;
mod launch;
mod light;
mod live;
mod marks;
mod meshes;
mod output;
mod overlap;
mod projectile;
mod read;
mod recorder;
mod rescale;
mod result;
mod run;
mod scene;
mod sheets;
mod showpieces;
mod sound;
mod source;
mod stage;
mod tempered;
mod text;
mod touching;
mod wave;

pub use bake::{
    BakedBody, bake, bake_opened, bake_until, bake_with, open_scene, open_scene_from, open_sources,
    open_sources_from,
};
pub use body::{BodySpec, Place};
pub use builtin::{SCENE_NAMES, scene};
pub use check::tame;
pub use error::SceneError;
pub use files::{read_scene, scene_of, scene_of_file, scene_of_file_from};
pub use first_break::{FirstBreak, first_break};
pub use frangible_bake::{CancelToken, Region, Support};
pub use frangible_sound::Sounding;
pub use game::{GamePlan, GameRun, play_as_game};
pub use live::{LiveScene, Reel, SavedScene, Swing, Thing, ThingKind, Throw};
pub use output::{Drawing, FileWish, Output, Simplified, TOLERANCE};
pub use projectile::{Projectile, ProjectileKind};
pub use read::Files;
pub use rescale::{MaterialEdit, Rescale};
pub use result::{BlowRecord, BreakRecord, HeldRecord, Run};
pub use run::play;
pub use scene::{Adhesive, PieceSpec, Scene};
pub use sound::{
    LiveSound, Sounded, Sources, energy_lost, energy_radiated, sound, sound_config, sound_of,
};
pub use source::{
    Axis, BodySource, FileKind, Opened, axes_of, compacted, open_source, save_asset,
    save_compact_asset,
};
pub use stage::{breakable, intact_body};
pub use text::{parse_scene, scene_to_toml};
pub use wave::{SurfaceCut, Wave, WaveMoment, surface_cuts};
