//! Frangible's scenes: procedural bodies, materials and set-ups, defined once for tests, benches, pictures and the
//! command line.
//!
//! ```no_run
//! let scene = frangible_scenes::scene("glass")?;
//! let (asset, _) = frangible_scenes::bake(&scene, &mut |_| {})?;
//! let run = frangible_scenes::play(&scene, &asset, &mut |_| {})?;
//! println!("{} pieces", run.breaks.first().map_or(1, |b| b.masses.len()));
//! # Ok::<(), frangible_scenes::SceneError>(())
//! ```

mod appearance;
mod builtin;
mod error;
mod meshes;
mod recorder;
mod run;
mod scene;

pub use builtin::{SCENE_NAMES, scene};
pub use error::SceneError;
pub use run::{BreakRecord, HeldRecord, Run, bake, play};
pub use scene::{Action, BallThrow, Scene};
