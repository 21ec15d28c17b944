//! The sound of a scene: converts its objects, blows and contacts to the input of a synthesiser.
//!
//! The program that runs a scene or a game numbers its objects ([`Cast`]) and reports events as plain data: blows with the forces of the
//! fracture model ([`recorded_blow`]), touches and slides, which [`Touching`] detects in the contacts of a physics engine. A
//! [`Hearing`] converts the objects to bodies of a [`Synth`], and the events to strikes.

mod blows;
mod cast;
mod dice;
mod nodes;
mod released;
mod slides;
mod touches;
mod touching;

use frangible::Material;
use frangible_recording::{RecordedBlow, RecordedSlide, RecordedTouch};
use glam::{DVec3, Vec3};

use crate::bank::BLOCK;
use crate::config::SynthConfig;
use crate::error::SoundError;
use crate::synth::Synth;

pub use blows::recorded_blow;
pub use cast::{Cast, Sounding};
pub use touching::{EngineMotion, EngineStep, Push, Touching};

use nodes::Nodes;

/// Time for which blows are remembered while a scene runs, s: touches within it are part of them.
const REMEMBERED: f64 = 0.02;

/// A synthesiser for the sound of a scene. The same calls give the same samples.
pub struct Hearing {
    synth: Synth,
    nodes: Nodes,
    /// Material of the floor.
    floor: Option<Material>,
    /// Struck objects, and the times of the blows, s.
    blows: Vec<(usize, f64)>,
    /// Dice that came loose and dice that landed.
    dice: [u64; 2],
}

impl Hearing {
    /// Creates a synthesiser for a scene with a floor of this material.
    ///
    /// # Errors
    /// A value of the configuration is invalid.
    pub fn new(config: SynthConfig, floor: Option<Material>) -> Result<Self, SoundError> {
        Ok(Self {
            synth: Synth::new(config)?,
            nodes: Nodes::default(),
            floor,
            blows: Vec::new(),
            dice: [0; 2],
        })
    }

    /// Returns the synthesiser.
    #[must_use]
    pub fn synth(&self) -> &Synth {
        &self.synth
    }

    /// Returns the synthesiser mutably, for example to move the listener.
    pub fn synth_mut(&mut self) -> &mut Synth {
        &mut self.synth
    }

    /// Prepares an object for sound in advance, so that its first blow causes no delay.
    ///
    /// # Errors
    /// A value of the object is invalid.
    pub fn ready(&mut self, cast: &dyn Cast, node: usize, time: f64) -> Result<(), SoundError> {
        let ready = self.nodes.ready(&mut self.synth, cast, node, time);
        ready.map(drop)
    }

    /// Prepares the data shared by all bodies of an object's asset, so that the first blow on one of them causes no delay. This is cheaper
    /// than [`Hearing::ready`] if many objects may never sound.
    ///
    /// # Errors
    /// A value of the object is invalid.
    pub fn prepare(&mut self, cast: &dyn Cast, node: usize) -> Result<(), SoundError> {
        self.nodes.prepare(cast, node)
    }

    /// Silences a removed object.
    ///
    /// # Errors
    /// The time is not finite.
    pub fn hush(&mut self, node: usize, time: f64) -> Result<(), SoundError> {
        self.nodes
            .id(node)
            .map_or(Ok(()), |id| self.synth.hush(time, id))
    }

    /// Removes an object immediately, including its ringing.
    pub fn forget(&mut self, node: usize) {
        if let Some(id) = self.nodes.forget(node) {
            // The synthesiser has it, as the list had.
            let _ = self.synth.remove(id);
        }
    }

    /// Registers a blow, so that touches of the same object at the same time count as part of it. Call it before adding these touches.
    pub fn note(&mut self, blow: &RecordedBlow) {
        self.blows.push((blow.node, blow.time));
    }

    /// Adds the sound of the forces of a blow.
    ///
    /// # Errors
    /// A value of the blow or of an object is invalid.
    pub fn blow(&mut self, cast: &dyn Cast, blow: &RecordedBlow) -> Result<(), SoundError> {
        self.dice[0] += blows::blows(&mut self.synth, &mut self.nodes, cast, blow)?;
        Ok(())
    }

    /// Adds the sound of the cracks of a blow.
    ///
    /// # Errors
    /// A value of the blow or of an object is invalid.
    pub fn cracks(&mut self, cast: &dyn Cast, blow: &RecordedBlow) -> Result<(), SoundError> {
        blows::cracks(&mut self.synth, &mut self.nodes, cast, blow)
    }

    /// Adds the sound of a touch.
    ///
    /// # Errors
    /// A value of the touch or of an object is invalid.
    pub fn touch(&mut self, cast: &dyn Cast, touch: &RecordedTouch) -> Result<(), SoundError> {
        let known = (self.floor.as_ref(), &self.blows[..]);
        self.dice[1] += touches::touches(&mut self.synth, &mut self.nodes, cast, known, touch)?;
        Ok(())
    }

    /// Returns the numbers of dice of tempered glass that were heard so far: when they came loose, and when they met something.
    #[must_use]
    pub fn dice(&self) -> [u64; 2] {
        self.dice
    }

    /// Adds the sound of a slide.
    ///
    /// # Errors
    /// A value of the slide or of an object is invalid.
    pub fn slide(&mut self, cast: &dyn Cast, slide: &RecordedSlide) -> Result<(), SoundError> {
        slides::slides(&mut self.synth, &mut self.nodes, cast, slide)
    }

    /// Adds the sound of the events of a step.
    ///
    /// # Errors
    /// A value of an event is invalid; the events before it have been added.
    pub fn happened(
        &mut self,
        cast: &dyn Cast,
        blows: &[RecordedBlow],
        (touches, slides): (&[RecordedTouch], &[RecordedSlide]),
    ) -> Result<(), SoundError> {
        blows.iter().for_each(|blow| self.note(blow));
        for blow in blows {
            self.blow(cast, blow)?;
            self.cracks(cast, blow)?;
        }
        for touch in touches {
            self.touch(cast, touch)?;
        }
        for slide in slides {
            self.slide(cast, slide)?;
        }
        Ok(())
    }

    /// Adds the sound up to a time, s, to `out`: pressures, Pa, left and right interleaved. The last [`BLOCK`] samples come with the next step,
    /// so that events of that step begin on their samples.
    pub fn until(&mut self, time: f64, out: &mut Vec<f32>) {
        let config = self.synth.config();
        let (rate, channels) = (config.rate, config.listener.channels);
        let behind = (time - self.synth.time()) * rate;
        let count = (behind - BLOCK as f64).max(0.0) as usize;
        let from = out.len();
        out.resize(from + count * channels, 0.0);
        self.synth.render(&mut out[from..]);
        self.blows.retain(|(_, then)| time - then < REMEMBERED);
    }

    /// Renders all samples, Pa, until silence, but at most `most` seconds.
    ///
    /// # Errors
    /// The time is not finite or not positive.
    pub fn until_silence(&mut self, most: f64) -> Result<Vec<f32>, SoundError> {
        self.synth.render_all(most)
    }
}

/// A point, m, in the precision of the synthesiser.
fn place(point: Vec3) -> DVec3 {
    point.as_dvec3()
}
