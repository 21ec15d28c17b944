//! The synthesiser, which converts bodies and events to sound pressure.

use std::collections::VecDeque;
use std::sync::Arc;

use glam::{DQuat, DVec3};

use crate::bank::BLOCK;
use crate::body::SoundBody;
use crate::config::{SynthConfig, SynthReport};
use crate::error::{SoundError, finite, within};
use crate::listener::{Listener, longest_delay};
use crate::pulse::SoundPulse;
use crate::strike::Strike;
use crate::thump::Thump;
use crate::voice::{Room, Voice};

/// Something that happens at a time.
#[derive(Clone, Debug)]
pub(crate) enum Event {
    Put(usize, DVec3, DQuat),
    Strike(usize, Strike),
    Hush(usize),
    Thump(DVec3, Arc<SoundPulse>),
    Piston(DVec3, Arc<SoundPulse>),
    Listen(Listener),
}

/// Synthesiser for the sound of bodies and strikes. The same calls give the same samples, regardless of how many are rendered at a time.
#[derive(Clone, Debug)]
pub struct Synth {
    pub(crate) config: SynthConfig,
    pub(crate) voices: Vec<Option<Voice>>,
    /// Events to come, by time, s, and by the order of the calls.
    pub(crate) events: VecDeque<(f64, Event)>,
    pub(crate) sorted: bool,
    pub(crate) thumps: Vec<Thump>,
    /// Pressure to come, Pa: a ring for each channel.
    pub(crate) coming: Vec<Vec<f32>>,
    /// Pressures that are finished and not handed out, Pa, interleaved.
    pub(crate) ready: VecDeque<f32>,
    /// Samples that were computed.
    pub(crate) now: u64,
    pub(crate) report: SynthReport,
    pub(crate) levels: Vec<f32>,
    /// Blocks since anything was heard.
    pub(crate) silent: usize,
}

impl Synth {
    /// Creates a synthesiser at time zero, without bodies.
    ///
    /// # Errors
    /// A value of the configuration is not finite or out of range.
    pub fn new(config: SynthConfig) -> Result<Self, SoundError> {
        config.validate()?;
        let long = (longest_delay(config.rate) + 2 * BLOCK).next_power_of_two();
        Ok(Self {
            config,
            voices: Vec::new(),
            events: VecDeque::new(),
            sorted: true,
            thumps: Vec::new(),
            coming: vec![vec![0.0; long]; config.listener.channels],
            ready: VecDeque::new(),
            now: 0,
            report: SynthReport::default(),
            levels: Vec::new(),
            silent: 0,
        })
    }

    /// Returns its settings.
    #[must_use]
    pub fn config(&self) -> &SynthConfig {
        &self.config
    }

    /// Returns the time of the next rendered sample, s.
    #[must_use]
    pub fn time(&self) -> f64 {
        let waiting = self.ready.len() / self.config.listener.channels;
        (self.now - waiting as u64) as f64 / self.config.rate
    }

    /// Returns its statistics so far.
    #[must_use]
    pub fn report(&self) -> SynthReport {
        self.report
    }

    /// Returns the number of active resonators.
    #[must_use]
    pub fn resonators(&self) -> usize {
        self.voices.iter().flatten().map(|v| v.slots.len()).sum()
    }

    /// Adds a body with this position, m, and rotation, and returns its number.
    ///
    /// # Errors
    /// An invalid number of the body or its position.
    pub fn add(
        &mut self,
        body: Arc<SoundBody>,
        place: DVec3,
        rotation: DQuat,
    ) -> Result<usize, SoundError> {
        body.validate()?;
        placed(place, rotation)?;
        let room = room(&self.config);
        let voice = Voice::new(body, place, rotation.normalize(), &room);
        let free = self.voices.iter().position(Option::is_none);
        let index = free.unwrap_or(self.voices.len());
        if free.is_none() {
            self.voices.push(None);
        }
        self.voices[index] = Some(voice);
        Ok(index)
    }

    /// Removes a body immediately. Its number may be reused.
    ///
    /// # Errors
    /// An unknown body.
    pub fn remove(&mut self, body: usize) -> Result<(), SoundError> {
        self.body(body)?;
        self.voices[body] = None;
        let at = |event: &Event| match event {
            Event::Put(i, ..) | Event::Strike(i, _) | Event::Hush(i) => *i == body,
            Event::Thump(..) | Event::Piston(..) | Event::Listen(_) => false,
        };
        self.events.retain(|(_, event)| !at(event));
        Ok(())
    }

    /// Moves a body at a time, s. The change takes effect within 128 samples.
    ///
    /// # Errors
    /// An unknown body, or a number that is not finite.
    pub fn put(
        &mut self,
        time: f64,
        body: usize,
        place: DVec3,
        rotation: DQuat,
    ) -> Result<(), SoundError> {
        self.body(body)?;
        placed(place, rotation)?;
        self.event(time, Event::Put(body, place, rotation.normalize()))
    }

    /// Strikes a body at a time, s; a time in the past means now.
    ///
    /// # Errors
    /// An unknown body, or an invalid number of the strike.
    pub fn strike(&mut self, time: f64, body: usize, strike: Strike) -> Result<(), SoundError> {
        strike.validate(self.body(body)?)?;
        self.event(time, Event::Strike(body, strike))
    }

    /// Silences a body within 32 samples from a time on, s, for example when it breaks and its pieces replace it.
    ///
    /// # Errors
    /// An unknown body, or a time that is not finite.
    pub fn hush(&mut self, time: f64, body: usize) -> Result<(), SoundError> {
        self.body(body)?;
        self.event(time, Event::Hush(body))
    }

    /// Pushes the floor straight down at a time, s, and a position, m. No effect without a floor.
    ///
    /// The ground under a force F gives way by (1−ν) F/(2πGR) at a distance R (Boussinesq). Sound in air is slower than all waves in a solid, so
    /// that towards the angle θ from the vertical the ground follows the force at once, and its Rayleigh integral is closed:
    /// p = ρ c (1−ν) F′(t − r/c) / (2π r G sin θ). Right above, within some degrees, this grows beyond what is true, and sin θ is held at ¼.
    ///
    /// # Errors
    /// A number that is not finite or out of range.
    pub fn thump(
        &mut self,
        time: f64,
        place: DVec3,
        pulse: Arc<SoundPulse>,
    ) -> Result<(), SoundError> {
        pulse.validate()?;
        placed(place, DQuat::IDENTITY)?;
        self.event(time, Event::Thump(place, pulse))
    }

    /// Pushes air away in front of a wall at a time, s, and a position, m: `pulse` is the acceleration of the volume, m³/s², of a part of the wall that
    /// moves by itself, is small against the waves, and is surrounded by the rest: p = ρ V̈(t − r/c) / (2π r), Rayleigh's integral.
    ///
    /// # Errors
    /// A number that is not finite or out of range.
    pub fn piston(
        &mut self,
        time: f64,
        place: DVec3,
        pulse: Arc<SoundPulse>,
    ) -> Result<(), SoundError> {
        pulse.validate()?;
        placed(place, DQuat::IDENTITY)?;
        self.event(time, Event::Piston(place, pulse))
    }

    /// Moves the listener at a time, s. The change takes effect within 128 samples.
    ///
    /// # Errors
    /// An invalid position or direction, or a different number of channels.
    pub fn listen(&mut self, time: f64, listener: Listener) -> Result<(), SoundError> {
        listener.validate()?;
        let channels = self.config.listener.channels;
        if listener.channels != channels {
            return Err(SoundError::BadCount {
                what: "the listener's list of channels".into(),
                count: listener.channels,
                expected: format!("{channels}, as the synthesiser was made with, are"),
            });
        }
        self.event(time, Event::Listen(listener))
    }

    fn body(&self, index: usize) -> Result<&SoundBody, SoundError> {
        let voice = self.voices.get(index).and_then(Option::as_ref);
        voice.map(|v| &*v.body).ok_or(SoundError::NoBody {
            index,
            count: self.voices.len(),
        })
    }

    fn event(&mut self, time: f64, event: Event) -> Result<(), SoundError> {
        finite(|| "the time of an event".into(), time)?;
        self.sorted &= self.events.back().is_none_or(|(last, _)| *last <= time);
        self.events.push_back((time, event));
        Ok(())
    }

    /// Returns true if nothing sounds and no events are pending.
    #[must_use]
    pub fn is_silent(&self) -> bool {
        let delays = self.coming.first().map_or(0, Vec::len) / BLOCK;
        self.events.is_empty() && self.silent > delays && self.ready.iter().all(|&s| s == 0.0)
    }

    /// Fills `out` with the pressures of the next samples, Pa, interleaved for two channels. A [`Leveller`](crate::Leveller) or a
    /// [`Limiter`](crate::Limiter) converts them to samples for playback.
    pub fn render(&mut self, out: &mut [f32]) {
        for sample in out {
            if self.ready.is_empty() {
                self.block();
            }
            *sample = self.ready.pop_front().unwrap_or(0.0);
        }
    }

    /// Renders all samples, Pa, until silence, but at most `most` seconds.
    ///
    /// # Errors
    /// A time that is not finite or not above zero.
    pub fn render_all(&mut self, most: f64) -> Result<Vec<f32>, SoundError> {
        within(
            || "the longest time of a sound".into(),
            most,
            most > 0.0,
            "above zero, in s",
        )?;
        let channels = self.config.listener.channels;
        let most = (most * self.config.rate) as usize * channels;
        let mut out = Vec::new();
        while out.len() < most && !(self.is_silent()) {
            let from = out.len();
            out.resize((from + BLOCK * channels).min(most), 0.0);
            self.render(&mut out[from..]);
        }
        // The delays were waited for in silence.
        let end = out
            .iter()
            .rposition(|&s| s != 0.0)
            .map_or(0, |last| last + 1);
        out.truncate(end.next_multiple_of(channels).min(out.len()));
        Ok(out)
    }
}

pub(crate) fn room(config: &SynthConfig) -> Room<'_> {
    Room {
        listener: &config.listener,
        floor: config.floor.as_ref(),
        rate: config.rate,
    }
}

/// Refuses a place or a rotation that is none.
fn placed(place: DVec3, rotation: DQuat) -> Result<(), SoundError> {
    for part in place.to_array() {
        finite(|| "a place".into(), part)?;
    }
    let long = rotation.length();
    let name = || "the length of a rotation".into();
    within(name, long, (0.5..2.0).contains(&long), "close to 1").map(|_| ())
}
