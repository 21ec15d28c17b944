//! The sound of a scene: its things, and the blows and touches that happen to them, on their way into a synthesiser.
//!
//! The program that runs a scene or a game numbers the things in it ([`Cast`]) and reports events as plain data: blows with the forces
//! that the fracture found ([`recorded_blow`]), touches and slides ([`Touching`] finds them in an engine's contacts). A
//! [`Hearing`] makes bodies of a [`Synth`] of the things, and strikes of the events.

mod blows;
mod cast;
mod nodes;
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
pub use touching::{EngineStep, Motion, Push, Touching};

use nodes::Nodes;

/// Time for which blows are remembered while a scene runs, s: touches within it are part of them.
const REMEMBERED: f64 = 0.02;

/// A synthesiser that hears a scene. The same calls give the same samples.
pub struct Hearing {
    synth: Synth,
    nodes: Nodes,
    /// Material of the floor.
    floor: Option<Material>,
    /// Things that were struck, and when, s.
    blows: Vec<(usize, f64)>,
}

impl Hearing {
    /// A synthesiser for a scene with a floor of this material.
    ///
    /// # Errors
    /// A number of the configuration that cannot be used.
    pub fn new(config: SynthConfig, floor: Option<Material>) -> Result<Self, SoundError> {
        Ok(Self {
            synth: Synth::new(config)?,
            nodes: Nodes::default(),
            floor,
            blows: Vec::new(),
        })
    }

    /// The synthesiser.
    #[must_use]
    pub fn synth(&self) -> &Synth {
        &self.synth
    }

    /// The synthesiser, to move the listener.
    pub fn synth_mut(&mut self) -> &mut Synth {
        &mut self.synth
    }

    /// Makes a thing ready to sound, lest its first blow waits.
    ///
    /// # Errors
    /// A number of the thing that cannot be used.
    pub fn ready(&mut self, cast: &dyn Cast, node: usize, time: f64) -> Result<(), SoundError> {
        let ready = self.nodes.ready(&mut self.synth, cast, node, time);
        ready.map(drop)
    }

    /// Makes what all bodies of a thing's asset share, lest the first blow on one of them waits. Costs less than [`Hearing::ready`] where
    /// there are many things that may never sound.
    ///
    /// # Errors
    /// A number of the thing that cannot be used.
    pub fn prepare(&mut self, cast: &dyn Cast, node: usize) -> Result<(), SoundError> {
        self.nodes.prepare(cast, node)
    }

    /// Silences a thing that is gone.
    ///
    /// # Errors
    /// A time that is not finite.
    pub fn hush(&mut self, node: usize, time: f64) -> Result<(), SoundError> {
        self.nodes
            .id(node)
            .map_or(Ok(()), |id| self.synth.hush(time, id))
    }

    /// Forgets a thing at once; its ringing is cut off.
    pub fn forget(&mut self, node: usize) {
        if let Some(id) = self.nodes.forget(node) {
            // The synthesiser has it, as the list had.
            let _ = self.synth.remove(id);
        }
    }

    /// Takes note of a blow: touches of the same thing at its time are part of it. Call it before the touches of that time.
    pub fn note(&mut self, blow: &RecordedBlow) {
        self.blows.push((blow.node, blow.time));
    }

    /// Lets the forces of a blow be heard.
    ///
    /// # Errors
    /// A number of the blow or of a thing that cannot be used.
    pub fn blow(&mut self, cast: &dyn Cast, blow: &RecordedBlow) -> Result<(), SoundError> {
        blows::blows(&mut self.synth, &mut self.nodes, cast, blow)
    }

    /// Lets the cracks of a blow be heard.
    ///
    /// # Errors
    /// A number of the blow or of a thing that cannot be used.
    pub fn cracks(&mut self, cast: &dyn Cast, blow: &RecordedBlow) -> Result<(), SoundError> {
        blows::cracks(&mut self.synth, &mut self.nodes, cast, blow)
    }

    /// Lets a touch be heard.
    ///
    /// # Errors
    /// A number of the touch or of a thing that cannot be used.
    pub fn touch(&mut self, cast: &dyn Cast, touch: &RecordedTouch) -> Result<(), SoundError> {
        let known = (self.floor.as_ref(), &self.blows[..]);
        touches::touches(&mut self.synth, &mut self.nodes, cast, known, touch)
    }

    /// Lets a slide be heard.
    ///
    /// # Errors
    /// A number of the slide or of a thing that cannot be used.
    pub fn slide(&mut self, cast: &dyn Cast, slide: &RecordedSlide) -> Result<(), SoundError> {
        slides::slides(&mut self.synth, &mut self.nodes, cast, slide)
    }

    /// Takes in the events of a step.
    ///
    /// # Errors
    /// A number of an event that cannot be used; the events before it are heard.
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

    /// Adds the sound up to a time, s, to `out`: pressures, Pa, left and right in turn. The last [`BLOCK`] samples come with the next step,
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

    /// All samples, Pa, until nothing is heard any more, for at most `most` seconds.
    ///
    /// # Errors
    /// A time that is not finite or not above zero.
    pub fn until_silence(&mut self, most: f64) -> Result<Vec<f32>, SoundError> {
        self.synth.render_all(most)
    }
}

/// A point, m, in the precision of the synthesiser.
fn place(point: Vec3) -> DVec3 {
    point.as_dvec3()
}
