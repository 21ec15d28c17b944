//! Output of the scene's sound.

use frangible_scenes::LiveSound;
use frangible_sound::{Leveller, Outlet, SoundError};

use super::Session;
use crate::error::ViewError;
use crate::tape::Tape;

/// Somebody listens.
pub(super) struct Heard {
    outlet: Outlet,
    /// None without a scene.
    ear: Option<Ear>,
    tape: Tape,
    volume: f64,
    muted: bool,
    /// Pressures of the last step in simulated time, Pa, their levelled samples, and those at the loudspeaker.
    pressures: Vec<f32>,
    levelled: Vec<f32>,
    samples: Vec<f32>,
}

/// Hears a scene, and levels what it hears.
struct Ear {
    live: LiveSound,
    leveller: Leveller,
}

impl Ear {
    fn new(live: LiveSound) -> Result<Self, SoundError> {
        let config = live.config();
        let leveller = Leveller::new(config.rate, config.listener.channels, Leveller::LIVE)?;
        Ok(Self { live, leveller })
    }
}

impl Session {
    /// Starts sound output: each step adds its sound to the outlet, at the speed of the session's clock.
    pub fn listen(&mut self, outlet: Outlet) {
        self.heard = Some(Heard {
            outlet,
            ear: None,
            tape: Tape::default(),
            volume: 1.0,
            muted: false,
            pressures: Vec::new(),
            levelled: Vec::new(),
            samples: Vec::new(),
        });
        self.listen_anew();
    }

    /// Forgets ringing bodies, for another scene or one put back.
    pub(super) fn listen_anew(&mut self) {
        let (Some(heard), Some(live)) = (&mut self.heard, &self.live) else {
            return;
        };
        heard.outlet.clear();
        heard.tape = Tape::default();
        heard.ear = None;
        let Some(scene) = &self.scene else { return };
        match LiveSound::new(live, scene, &self.home).and_then(Ear::new) {
            Ok(ear) => heard.ear = Some(ear),
            Err(error) => self.complain(&error.into()),
        }
    }

    /// Hears the step that was just taken.
    pub(super) fn listen_to_step(&mut self) {
        let (Some(heard), Some(live)) = (&mut self.heard, &self.live) else {
            return;
        };
        let Some(ear) = &mut heard.ear else { return };
        heard.pressures.clear();
        heard.levelled.clear();
        heard.samples.clear();
        let result = ear.live.step(live, &mut heard.pressures);
        let levelled = ear.leveller.level(&heard.pressures, &mut heard.levelled);
        let step = self.slow_motion * ear.live.config().rate / heard.outlet.rate();
        let volume = if heard.muted {
            0.0
        } else {
            heard.volume as f32
        };
        heard
            .levelled
            .iter_mut()
            .for_each(|sample| *sample *= volume);
        heard.tape.read(&heard.levelled, step, &mut heard.samples);
        heard.outlet.put(&heard.samples);
        if let Err(error) = result.and(levelled) {
            heard.ear = None;
            self.complain(&error.into());
        }
    }

    /// Forgets sound that waits to be played.
    pub(super) fn hush(&mut self) {
        if let Some(heard) = &mut self.heard {
            heard.outlet.clear();
            heard.tape = Tape::default();
        }
    }

    pub(super) fn set_volume(&mut self, volume: f64) -> Result<(), ViewError> {
        self.ears()?.volume = volume.clamp(0.0, 1.0);
        Ok(())
    }

    /// Mutes the sound, from the next sample on, or turns it on again.
    pub(super) fn set_muted(&mut self, muted: bool) -> Result<(), ViewError> {
        self.ears()?.muted = muted;
        if muted {
            self.hush();
        }
        Ok(())
    }

    fn ears(&mut self) -> Result<&mut Heard, ViewError> {
        self.heard
            .as_mut()
            .ok_or_else(|| ViewError::NotNow("sound is not available in this session".into()))
    }

    /// Volume, and true if it is muted; none if nobody listens.
    pub(super) fn volume(&self) -> Option<(f64, bool)> {
        self.heard.as_ref().map(|heard| (heard.volume, heard.muted))
    }
}
