//! The sound of breaking bodies, from the same vibration modes and forces that break them: plain data in, samples out.
//!
//! The input of a [`Synth`] are [bodies](SoundBody), their positions and their events: [strikes](Strike) with the force histories of the fracture
//! model, cracks with their energy, and breaks. Its output is the sound pressure at the ears, Pa. It needs no audio device and no threads, and
//! the same calls give the same samples.
//!
//! - **Modes** are resonators driven by the force history, integrated exactly for linear interpolation.
//! - **Radiation** and direction come in closed form from an [equivalent sphere](EquivalentSphere): the motion of the surface on spherical
//!   harmonics, times outgoing spherical waves.
//! - **The rigid motion** of a struck body is included; small pieces, whose modes are above the range of hearing, sound by it alone.
//! - **Damping** is [separate](AudibleDamping) from that of the fracture model, with losses by radiation and supports.
//! - **Pieces** without modes ring as a [free plate](Plate) of their size.
//! - **Dice** of tempered glass do not ring: each is heard when it comes loose and when it lands.
//! - **The floor** reflects sound and sounds itself when struck; the [listener](Listener) has two ears with travel times.
//! - **A limit** on the number of resonators keeps the loudest and drops masked ones, without clicks.
//! - **A scene**, or the world of a game, is converted to sound by a [`Hearing`], which only needs the events.
//! - **The level** for loudspeakers: [`by_loudness`] brings a file to a loudness by EBU R 128 at which crash and landings are both heard, and a
//!   [`Leveller`] does the same live. [`wav()`] and a soft [`Limiter`] keep the true levels.
//!
//! ```
//! use std::sync::Arc;
//! use frangible_sound::glam::{DQuat, DVec3, Vec3};
//! use frangible_sound::{AudibleDamping, Listener, Plate, PlateMaterial, SoundPulse, Strike, Synth, SynthConfig, wav};
//!
//! # fn main() -> Result<(), frangible_sound::SoundError> {
//! let glass = PlateMaterial {
//!     youngs_modulus: 71e9,
//!     poisson_ratio: 0.23,
//!     density: 2500.0,
//!     damping: AudibleDamping::published("glass").unwrap_or_default().0,
//! };
//! let (plate, body) = Plate::new("tile", [0.15, 0.1, 0.005], DQuat::IDENTITY, &glass)?;
//! let listener = Listener::at(DVec3::new(0.0, 0.3, 1.0), DVec3::ZERO);
//! let mut synth = Synth::new(SynthConfig::new(listener))?;
//! let tile = synth.add(Arc::new(body), DVec3::ZERO, DQuat::IDENTITY)?;
//! let strike = Strike {
//!     pulse: Arc::new(SoundPulse::half_sine(0.01, 2e-4)),
//!     push: plate.push(Vec3::new(0.07, 0.04, 0.0), Vec3::Z),
//!     direction: Vec3::Z,
//! };
//! synth.strike(0.0, tile, strike)?;
//! let samples = synth.render_all(5.0)?;
//! let peak = synth.report().peak; // Pa
//! let bytes = wav(&samples, 2, 48_000.0, peak)?;
//! assert!(bytes.len() > 48_000 && peak > 0.0);
//! # Ok(())
//! # }
//! ```
//!
//! Not modelled: diffraction around other bodies, and room acoustics. All quantities are in SI units, and y is up.

mod air;
mod bank;
mod block;
mod body;
mod config;
mod damping;
mod ellipsoid;
mod error;
mod level;
mod limiter;
mod listener;
mod of_asset;
mod outlet;
mod plate;
mod pulse;
mod scene;
mod select;
mod sphere;
mod strike;
mod synth;
mod thump;
mod voice;
mod wav;
mod waves;

pub use air::{AIR_DENSITY, SPEED_OF_SOUND};
pub use bank::BLOCK;
pub use body::{Mode, SoundBody};
pub use config::{SynthConfig, SynthReport};
pub use damping::{AudibleDamping, Hold};
pub use ellipsoid::moved_air;
pub use error::SoundError;
pub use frangible_recording::{Pose, RecordedBlow, RecordedSlide, RecordedTouch};
pub use glam;
pub use level::{Level, Levelled, Leveller, LevellerReport, Loudness, TARGET, by_loudness};
pub use limiter::{Limiter, LimiterReport};
pub use listener::{Listener, SoundFloor};
pub use of_asset::{AssetSound, HIGHEST};
pub use outlet::Outlet;
pub use plate::{Plate, PlateMaterial};
pub use pulse::SoundPulse;
pub use scene::{Cast, EngineMotion, EngineStep, Hearing, Push, Sounding, Touching, recorded_blow};
pub use sphere::{EquivalentSphere, SurfaceElement};
pub use strike::{CRACK_SHARE, CRACK_SPEED, Strike, first_push};
pub use synth::Synth;
pub use wav::wav;
pub use waves::{HARMONICS, MOST_DEGREE, efficiencies, harmonic, harmonics};
