//! Output of the scene's sound.

use frangible_scenes::LiveSound;
use frangible_sound::{Limiter, Outlet};

use super::Session;
use crate::error::ViewError;
use crate::tape::Tape;

/// Somebody listens.
pub(super) struct Heard {
    outlet: Outlet,
    /// None without a scene.
    ear: Option<LiveSound>,
    limiter: Limiter,
    tape: Tape,
    volume: f64,
    muted: bool,
    /// Pressures of the last step in simulated time, Pa, and its samples at the loudspeaker.
    pressures: Vec<f32>,
    samples: Vec<f32>,
}

impl Session {
    /// Starts sound output: each step adds its sound to the outlet, at the speed of the session's clock.
    pub fn listen(&mut self, outlet: Outlet) {
        self.heard = Some(Heard {
            outlet,
            ear: None,
            limiter: Limiter::default(),
            tape: Tape::default(),
            volume: 1.0,
            muted: false,
            pressures: Vec::new(),
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
        match LiveSound::new(live, scene, &self.home) {
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
        heard.samples.clear();
        let result = ear.step(live, &mut heard.pressures);
        let step = self.slow_motion * ear.config().rate / heard.outlet.rate();
        let volume = if heard.muted {
            0.0
        } else {
            heard.volume as f32
        };
        for pressure in &mut heard.pressures {
            *pressure = volume * heard.limiter.sample(*pressure);
        }
        heard.tape.read(&heard.pressures, step, &mut heard.samples);
        heard.outlet.put(&heard.samples);
        if let Err(error) = result {
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
