//! The next block of a synthesiser: its events, its ringing resonators, and their ways to the ears.

use crate::bank::BLOCK;
use crate::listener::Ways;
use crate::select::select;
use crate::synth::{Event, Synth, room};
use crate::thump::Thump;

/// A pressure beyond this is held at it, Pa: a thousand atmospheres, which no sound has.
const LOUDEST: f32 = 1e8;

impl Synth {
    /// Computes the next block.
    pub(crate) fn block(&mut self) {
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
            let heard = voice.ring(rate, now);
            let (ways, before) = voice.take_ways();
            match before {
                None => mix(&mut self.coming, self.now, &ways, &heard),
                Some(before) => {
                    let rising = |n: usize| (n as f32 + 1.0) / BLOCK as f32;
                    let new = heard.map(|h| std::array::from_fn(|n| h[n] * rising(n)));
                    let old = heard.map(|h| std::array::from_fn(|n| h[n] * (1.0 - rising(n))));
                    mix(&mut self.coming, self.now, &ways, &new);
                    mix(&mut self.coming, self.now, &before, &old);
                }
            }
        }
        self.report.most_bodies = self.report.most_bodies.max(bodies);
        for thump in &self.thumps {
            let heard = [thump.heard(rate, now); 2];
            mix(&mut self.coming, self.now, &thump.ways, &heard);
        }
        let end = now + BLOCK as f64;
        self.thumps.retain(|thump| thump.lasts(rate, end));
        self.silent = if bodies == 0 && self.thumps.is_empty() {
            self.silent.saturating_add(1)
        } else {
            0
        };
        self.hand_out();
    }

    /// Takes the events of the coming block out of the queue, and leaves out those beyond the limit.
    fn due(&mut self) -> Vec<(f64, Event)> {
        if !self.sorted {
            // Stable: of events at one time, that called first happens first.
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
        if let Event::Listen(listener) = event {
            self.config.listener = listener;
        }
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
                    voice.hush(start);
                }
            }
            Event::Strike(i, strike) => {
                if let Some(voice) = &mut self.voices[i] {
                    voice.hit(start, strike, &room);
                }
            }
            Event::Thump(place, pulse) => {
                let thump = Thump::new(&self.config, start, place, pulse);
                self.thumps.extend(thump);
            }
            Event::Piston(place, pulse) => {
                let piston = Thump::piston(&self.config, start, place, pulse);
                self.thumps.push(piston);
            }
            Event::Listen(_) => {
                for voice in self.voices.iter_mut().flatten() {
                    voice.heard_from(&room);
                }
            }
        }
    }

    /// Hands out the samples of the block that has just been computed.
    fn hand_out(&mut self) {
        let mask = self.coming[0].len() - 1;
        for n in 0..BLOCK {
            let at = (self.now as usize + n) & mask;
            for channel in &mut self.coming {
                let pressure = std::mem::take(&mut channel[at]);
                // A pressure that is no number can only come of an overflow.
                let finite = if pressure.is_nan() { LOUDEST } else { pressure };
                let pressure = finite.clamp(-LOUDEST, LOUDEST);
                self.report.peak = self.report.peak.max(f64::from(pressure.abs()));
                self.ready.push_back(pressure);
            }
        }
        self.now += BLOCK as u64;
    }
}

/// Adds a block that leaves now, straight and towards the floor, to the pressures to come by each way.
fn mix(coming: &mut [Vec<f32>], now: u64, ways: &Ways, heard: &[[f32; BLOCK]; 2]) {
    for way in ways.iter() {
        let heard = &heard[usize::from(way.by_floor)];
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
