//! The front door: bodies and what happens to them in, samples out.

use std::collections::VecDeque;
use std::sync::Arc;

use glam::{DQuat, DVec3};

use crate::air::{AIR_DENSITY, SPEED_OF_SOUND};
use crate::bank::BLOCK;
use crate::body::Body;
use crate::error::{SoundError, finite, within};
use crate::limiter::{Limiter, LimiterReport};
use crate::listener::{Listener, SoundFloor, Ways, longest_delay};
use crate::pulse::Pulse;
use crate::select::select;
use crate::strike::Strike;
use crate::voice::{Room, Voice};

/// How sound is made.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SynthConfig {
    /// Samples per second, 8000 to 192 000, default 48 000.
    pub rate: f64,
    /// Who listens.
    pub listener: Listener,
    /// The floor, if there is one.
    pub floor: Option<SoundFloor>,
    /// Pressure that fills the samples' range, Pa, default 20 (117 dB). What is louder than 0.7 of it is bent by a limiter, which tells so.
    pub full_scale: f64,
    /// Resonators that ring at once, default 16 384. Fewer cost less time, and the quietest are left out.
    pub budget: usize,
    /// Strikes that begin in one block of 128 samples, default 4096. Of more, those of the least impulse are left out.
    pub strikes: usize,
}

impl SynthConfig {
    /// 48 kHz without a floor.
    #[must_use]
    pub fn new(listener: Listener) -> Self {
        Self {
            rate: 48_000.0,
            listener,
            floor: None,
            full_scale: 20.0,
            budget: 16_384,
            strikes: 4096,
        }
    }

    /// For a game: a budget of 1000 resonators and 64 strikes per block.
    #[must_use]
    pub fn live(self) -> Self {
        Self {
            budget: 1000,
            strikes: 64,
            ..self
        }
    }

    /// Checks every number.
    ///
    /// # Errors
    /// The first number at fault.
    pub fn validate(&self) -> Result<(), SoundError> {
        let fits = (8_000.0..=192_000.0).contains(&self.rate);
        within(
            || "the sampling rate".into(),
            self.rate,
            fits,
            "from 8000 to 192000, in 1/s",
        )?;
        let (name, pressure) = (|| "the pressure of full scale".into(), self.full_scale);
        within(name, pressure, pressure > 0.0, "above zero, in Pa")?;
        self.listener.validate()?;
        self.floor.as_ref().map_or(Ok(()), SoundFloor::validate)
    }
}

/// What a synthesiser did so far.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SynthReport {
    /// What the limiter did.
    pub limiter: LimiterReport,
    /// Most resonators that rang at once.
    pub most_resonators: usize,
    /// Most bodies that rang at once.
    pub most_bodies: usize,
    /// Resonators that were let go because louder ones of the same pitch mask them.
    pub masked: u64,
    /// Resonators that were let go because there were more than the budget.
    pub over_budget: u64,
    /// Strikes that were left out because too many began at once.
    pub strikes_left_out: u64,
}

/// Something that happens at a time.
#[derive(Clone, Debug)]
enum Event {
    Put(usize, DVec3, DQuat),
    Strike(usize, Strike),
    Hush(usize),
    Thump(DVec3, Arc<Pulse>),
}

/// A force on the floor.
#[derive(Clone, Debug)]
struct Thump {
    start: f64,
    pulse: Arc<Pulse>,
    /// Pressure per growth of the force, Pa·s/N.
    size: f64,
    ways: Ways,
}

/// Makes sound of bodies and strikes, block by block. The same calls give the same samples, however many are asked for at a time.
#[derive(Clone, Debug)]
pub struct Synth {
    config: SynthConfig,
    arch: pulp::Arch,
    voices: Vec<Option<Voice>>,
    /// What is to come, by time, s, and by the order of the calls.
    events: VecDeque<(f64, Event)>,
    sorted: bool,
    thumps: Vec<Thump>,
    /// Pressure to come, Pa: a ring for each channel.
    coming: Vec<Vec<f32>>,
    /// Samples that are finished and not handed out, interleaved.
    ready: VecDeque<f32>,
    /// Samples that were computed.
    now: u64,
    limiter: Limiter,
    report: SynthReport,
    levels: Vec<f32>,
    /// Blocks since anything was heard.
    silent: usize,
}

impl Synth {
    /// A synthesiser at time zero, without bodies.
    ///
    /// # Errors
    /// A number of the configuration that is not finite or out of its range.
    pub fn new(config: SynthConfig) -> Result<Self, SoundError> {
        config.validate()?;
        let long = (longest_delay(config.rate) + 2 * BLOCK).next_power_of_two();
        Ok(Self {
            config,
            arch: pulp::Arch::new(),
            voices: Vec::new(),
            events: VecDeque::new(),
            sorted: true,
            thumps: Vec::new(),
            coming: vec![vec![0.0; long]; config.listener.channels],
            ready: VecDeque::new(),
            now: 0,
            limiter: Limiter::new(config.full_scale),
            report: SynthReport::default(),
            levels: Vec::new(),
            silent: 0,
        })
    }

    /// How it was set.
    #[must_use]
    pub fn config(&self) -> &SynthConfig {
        &self.config
    }

    /// Time of the next sample that is handed out, s.
    #[must_use]
    pub fn time(&self) -> f64 {
        let waiting = self.ready.len() / self.config.listener.channels;
        (self.now - waiting as u64) as f64 / self.config.rate
    }

    /// What it did so far.
    #[must_use]
    pub fn report(&self) -> SynthReport {
        SynthReport {
            limiter: self.limiter.report(),
            ..self.report
        }
    }

    /// Resonators that ring now.
    #[must_use]
    pub fn resonators(&self) -> usize {
        self.voices.iter().flatten().map(|v| v.slots.len()).sum()
    }

    /// Adds a body at a place, m, turned so, and returns its number.
    ///
    /// # Errors
    /// A number of the body or of its place at fault.
    pub fn add(
        &mut self,
        body: Arc<Body>,
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

    /// Takes a body out at once. Its number may be given to another one.
    ///
    /// # Errors
    /// There is no such body.
    pub fn remove(&mut self, body: usize) -> Result<(), SoundError> {
        self.body(body)?;
        self.voices[body] = None;
        let at = |event: &Event| match event {
            Event::Put(i, ..) | Event::Strike(i, _) | Event::Hush(i) => *i == body,
            Event::Thump(..) => false,
        };
        self.events.retain(|(_, event)| !at(event));
        Ok(())
    }

    /// Moves a body at a time, s. What rings of it comes from there within 128 samples.
    ///
    /// # Errors
    /// There is no such body, or a number is not finite.
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

    /// Strikes a body at a time, s; a time that has passed is now.
    ///
    /// # Errors
    /// There is no such body, or a number of the strike is at fault.
    pub fn strike(&mut self, time: f64, body: usize, strike: Strike) -> Result<(), SoundError> {
        strike.validate(self.body(body)?)?;
        self.event(time, Event::Strike(body, strike))
    }

    /// Silences a body within 128 samples from a time on, s: it is no more, its pieces ring instead.
    ///
    /// # Errors
    /// There is no such body, or the time is not finite.
    pub fn hush(&mut self, time: f64, body: usize) -> Result<(), SoundError> {
        self.body(body)?;
        self.event(time, Event::Hush(body))
    }

    /// Pushes the floor at a time, s, and a place, m, straight down. Without a floor nothing is heard.
    ///
    /// The ground under a force F gives way by (1−ν) F/(2πGR) at a distance R (Boussinesq). Sound in air is slower than all waves in a solid, so
    /// that towards the angle θ from the vertical the ground follows the force at once, and its Rayleigh integral is closed:
    /// p = ρ c (1−ν) F′(t − r/c) / (2π r G sin θ). Right above, within some degrees, this grows beyond what is true, and sin θ is held at ¼.
    ///
    /// # Errors
    /// A number that is not finite or out of its range.
    pub fn thump(&mut self, time: f64, place: DVec3, pulse: Arc<Pulse>) -> Result<(), SoundError> {
        pulse.validate()?;
        placed(place, DQuat::IDENTITY)?;
        self.event(time, Event::Thump(place, pulse))
    }

    fn body(&self, index: usize) -> Result<&Body, SoundError> {
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

    /// Whether nothing is heard any more and nothing is to come.
    #[must_use]
    pub fn is_silent(&self) -> bool {
        let delays = self.coming.first().map_or(0, Vec::len) / BLOCK;
        self.events.is_empty() && self.silent > delays && self.ready.iter().all(|&s| s == 0.0)
    }

    /// Fills `out` with the next samples, −1 to 1, left and right in turn where there are two channels.
    pub fn render(&mut self, out: &mut [f32]) {
        for sample in out {
            if self.ready.is_empty() {
                self.block();
            }
            *sample = self.ready.pop_front().unwrap_or(0.0);
        }
    }

    /// All samples until nothing is heard any more, for at most `most` seconds.
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

    /// Computes the next block.
    fn block(&mut self) {
        let due = self.due();
        for (time, event) in due {
            self.happen(time, event);
        }
        let taken = select(&mut self.voices, self.config.budget, &mut self.levels);
        self.report.masked += taken.masked;
        self.report.over_budget += taken.over_budget;
        let ringing = self.resonators();
        self.report.most_resonators = self.report.most_resonators.max(ringing);
        let (rate, now) = (self.config.rate, self.now as f64);
        let mut bodies = 0;
        for voice in self.voices.iter_mut().flatten() {
            if voice.is_silent() {
                continue;
            }
            bodies += 1;
            let mut heard = [0.0; BLOCK];
            voice.ring(self.arch, rate, now, &mut heard);
            let (ways, before) = voice.take_ways();
            match before {
                None => mix(&mut self.coming, self.now, &ways, &heard),
                Some(before) => {
                    let rising = |n: usize| (n as f32 + 1.0) / BLOCK as f32;
                    let new = std::array::from_fn(|n| heard[n] * rising(n));
                    let old = std::array::from_fn(|n| heard[n] * (1.0 - rising(n)));
                    mix(&mut self.coming, self.now, &ways, &new);
                    mix(&mut self.coming, self.now, &before, &old);
                }
            }
        }
        self.report.most_bodies = self.report.most_bodies.max(bodies);
        for thump in &self.thumps {
            let heard = thump.heard(rate, now);
            mix(&mut self.coming, self.now, &thump.ways, &heard);
        }
        let end = now + BLOCK as f64;
        self.thumps
            .retain(|t| t.start + t.pulse.duration() * rate + 1.0 >= end);
        self.silent = if bodies == 0 && self.thumps.is_empty() {
            self.silent.saturating_add(1)
        } else {
            0
        };
        self.hand_out();
    }

    /// Takes the events of the coming block out of the queue, and leaves out what is too much.
    fn due(&mut self) -> Vec<(f64, Event)> {
        if !self.sorted {
            // Stable: what was called first happens first.
            self.events
                .make_contiguous()
                .sort_by(|a, b| a.0.total_cmp(&b.0));
            self.sorted = true;
        }
        let end = (self.now + BLOCK as u64) as f64 / self.config.rate;
        let count = self.events.partition_point(|(time, _)| *time < end);
        let mut due: Vec<(f64, Event)> = self.events.drain(..count).collect();
        let weight = |event: &Event| match event {
            Event::Strike(_, strike) => Some(strike.pulse.impulse().abs()),
            Event::Thump(_, pulse) => Some(pulse.impulse().abs()),
            _ => None,
        };
        let mut weights: Vec<f64> = due.iter().filter_map(|(_, e)| weight(e)).collect();
        if weights.len() > self.config.strikes {
            let over = weights.len() - self.config.strikes;
            self.report.strikes_left_out += over as u64;
            let (_, &mut bar, _) = weights.select_nth_unstable_by(over - 1, f64::total_cmp);
            let below = weights.iter().filter(|&&w| w < bar).count();
            let mut ties = over - below;
            due.retain(|(_, event)| match weight(event) {
                Some(weight) if weight < bar => false,
                Some(weight) if weight == bar && ties > 0 => {
                    ties -= 1;
                    false
                }
                _ => true,
            });
        }
        due
    }

    fn happen(&mut self, time: f64, event: Event) {
        let room = room(&self.config);
        let start = (time * self.config.rate).max(self.now as f64);
        match event {
            Event::Put(i, place, rotation) => {
                if let Some(voice) = &mut self.voices[i] {
                    voice.put(place, rotation, &room);
                }
            }
            Event::Hush(i) => {
                if let Some(voice) = &mut self.voices[i] {
                    voice.hush();
                }
            }
            Event::Strike(i, strike) => {
                if let Some(voice) = &mut self.voices[i] {
                    voice.hit(start, strike, &room);
                }
            }
            Event::Thump(place, pulse) => self.begin_thump(start, place, pulse),
        }
    }

    fn begin_thump(&mut self, start: f64, place: DVec3, pulse: Arc<Pulse>) {
        let Some(floor) = &self.config.floor else {
            return;
        };
        let listener = &self.config.listener;
        let way = listener.place - place;
        let sine = DVec3::new(way.x, 0.0, way.z).length() / way.length().max(1e-9);
        let stiffness = floor.shear_modulus * sine.max(0.25) / (1.0 - floor.poisson_ratio);
        let spread = 2.0 * std::f64::consts::PI * listener.distance(place);
        self.thumps.push(Thump {
            start,
            pulse,
            size: AIR_DENSITY * SPEED_OF_SOUND / (spread * stiffness),
            ways: Ways::from_floor(listener, self.config.rate, place),
        });
    }

    /// Hands out the samples of the block that has just been computed.
    fn hand_out(&mut self) {
        let mask = self.coming[0].len() - 1;
        for n in 0..BLOCK {
            let at = (self.now as usize + n) & mask;
            for channel in &mut self.coming {
                let pressure = std::mem::take(&mut channel[at]);
                self.ready.push_back(self.limiter.sample(pressure));
            }
        }
        self.now += BLOCK as u64;
    }
}

impl Thump {
    /// The block's pressure: the growth of the force over each sample.
    fn heard(&self, rate: f64, now: f64) -> [f32; BLOCK] {
        std::array::from_fn(|n| {
            let time = (now + n as f64 - self.start) / rate;
            let growth = (self.pulse.at(time).0 - self.pulse.at(time - 1.0 / rate).0) * rate;
            (self.size * growth) as f32
        })
    }
}

fn room(config: &SynthConfig) -> Room<'_> {
    Room {
        listener: &config.listener,
        floor: config.floor.as_ref(),
        rate: config.rate,
    }
}

/// Adds a block that leaves now to what comes by each way.
fn mix(coming: &mut [Vec<f32>], now: u64, ways: &Ways, heard: &[f32; BLOCK]) {
    for way in ways.iter() {
        let channel = &mut coming[way.channel];
        let mask = channel.len() - 1;
        let from = (now as usize + way.delay) & mask;
        let first = (channel.len() - from).min(BLOCK);
        let (before, after) = heard.split_at(first);
        let parts = [(from, before), (0, after)];
        for (at, part) in parts {
            for (sum, heard) in channel[at..at + part.len()].iter_mut().zip(part) {
                *sum += way.gain * heard;
            }
        }
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
