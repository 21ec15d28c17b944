//! A block of a voice: its resonators, by themselves or under strikes on the body.

use num_complex::Complex64;

use crate::bank::{BLOCK, LANES, Sums, ring_block, total};
use crate::pulse::Drive;
use crate::strike::pole;

use super::{SILENCE, Voice};
use crate::air::SPEED_OF_SOUND;

/// Samples in which a body that broke falls silent: less than a millisecond, and no click.
const HUSH: f64 = 32.0;

impl Voice {
    /// Share of a sample that is left at a time, in samples, of a body that ends.
    fn left(&self, time: f64) -> f32 {
        let past = self.ends.map_or(0.0, |ends| (time - ends) / HUSH);
        (0.5 + 0.5 * (std::f64::consts::PI * past.clamp(0.0, 1.0)).cos()) as f32
    }

    /// Computes a block of the sound at the middle of the head: the part that leaves straight to it, and the part that leaves towards the floor.
    pub(crate) fn ring(&mut self, rate: f64, now: f64) -> [[f32; BLOCK]; 2] {
        let mut sums: Sums = [[0.0; LANES]; BLOCK];
        if self.hits.is_empty() {
            ring_block(&mut self.lanes, &mut sums);
        } else {
            self.find_direct();
            for i in 0..self.slots.len() {
                self.ring_struck(i, rate, now, &mut sums);
            }
        }
        let mut heard = [std::array::from_fn(|n| total(&sums[n])); 2];
        for hit in &mut self.hits {
            hit.rings(self.body.sphere.radius, rate, now, &mut heard);
        }
        if self.ends.is_some() {
            for n in 0..BLOCK {
                let left = self.left(now + n as f64);
                heard.iter_mut().for_each(|heard| heard[n] *= left);
            }
        }
        let end = now + BLOCK as f64;
        if self.ends.is_some_and(|ends| ends + HUSH <= end) {
            (self.slots, self.lanes, self.ends) = (Vec::new(), Vec::new(), None);
            self.hits.clear();
        }
        let tail = 12.0 * self.body.sphere.radius / SPEED_OF_SOUND;
        self.hits
            .retain(|hit| hit.start + (hit.strike.pulse.duration() + tail) * rate >= end);
        self.tidy();
        heard
    }

    fn find_direct(&mut self) {
        let (slots, modes, gains) = (&self.slots, &self.body.modes, &self.gains);
        for hit in self.hits.iter_mut().filter(|hit| hit.direct.is_none()) {
            let push = &hit.strike.push;
            let direct = slots
                .iter()
                .filter(|slot| !slot.goes && !push.is_empty())
                .map(|slot| {
                    let i = slot.mode as usize;
                    gains[i].im * f64::from(push[i]) / (std::f64::consts::TAU * modes[i].frequency)
                });
            hit.direct = Some(direct.sum());
        }
    }

    /// One resonator under what strikes the body, in f64 and sample by sample.
    fn ring_struck(&mut self, i: usize, rate: f64, now: f64, sums: &mut Sums) {
        let slot = self.slots[i];
        let mode = &self.body.modes[slot.mode as usize];
        let Some(pole) = pole(mode.frequency, mode.loss) else {
            return;
        };
        let mut given = [Complex64::default(); BLOCK];
        for hit in self.hits.iter().filter(|hit| !hit.strike.push.is_empty()) {
            let push = f64::from(hit.strike.push[slot.mode as usize]);
            let first = (hit.start - now).ceil().max(0.0);
            let past = (now + first - hit.start) / rate;
            if first as usize >= BLOCK || past > hit.strike.pulse.duration() + 1.0 / rate {
                continue;
            }
            let mut drive = Drive::new(&hit.strike.pulse, pole, 1.0 / rate, past);
            for given in &mut given[first as usize..] {
                *given += drive.step().scale(push);
            }
        }
        let (lanes, k) = (&mut self.lanes[i / LANES], i % LANES);
        let turn = pole.scale(1.0 / rate).exp();
        let mut z = Complex64::new(f64::from(lanes.re[k]), f64::from(lanes.im[k]));
        for (sum, given) in sums.iter_mut().zip(given) {
            z = turn * z + given;
            lanes.gain_re[k] += lanes.ramp_re[k];
            lanes.gain_im[k] += lanes.ramp_im[k];
            sum[k] += lanes.gain_re[k] * z.re as f32 - lanes.gain_im[k] * z.im as f32;
        }
        (lanes.re[k], lanes.im[k]) = (z.re as f32, z.im as f32);
    }

    /// Ends ramps, and takes out resonators that have faded or fallen silent.
    fn tidy(&mut self) {
        let struck = !self.hits.is_empty();
        let mut kept = 0;
        for i in 0..self.slots.len() {
            if !struck {
                self.slots[i].expected = 0.0;
            }
            let slot = self.slots[i];
            if slot.goes || (!struck && self.level(i) < SILENCE) {
                continue;
            }
            let (from, to) = ((i / LANES, i % LANES), (kept / LANES, kept % LANES));
            let source = self.lanes[from.0];
            let target = &mut self.lanes[to.0];
            for (target, source) in [
                (&mut target.re, source.re),
                (&mut target.im, source.im),
                (&mut target.turn_re, source.turn_re),
                (&mut target.turn_im, source.turn_im),
                (&mut target.gain_re, source.gain_re),
                (&mut target.gain_im, source.gain_im),
            ] {
                target[to.1] = source[from.1];
            }
            self.slots[kept] = slot;
            kept += 1;
        }
        self.slots.truncate(kept);
        self.lanes.truncate(kept.div_ceil(LANES));
        for lanes in &mut self.lanes {
            (lanes.ramp_re, lanes.ramp_im) = ([0.0; LANES], [0.0; LANES]);
        }
        for k in kept..self.lanes.len() * LANES {
            let lanes = &mut self.lanes[k / LANES];
            (lanes.re[k % LANES], lanes.im[k % LANES]) = (0.0, 0.0);
        }
        if self.slots.is_empty() {
            (self.slots, self.lanes) = (Vec::new(), Vec::new());
        }
    }
}
