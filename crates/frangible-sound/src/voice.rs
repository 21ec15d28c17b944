//! One body that sounds: its resonators, what strikes it, and its ways to the ears.

use std::sync::Arc;

use glam::{DQuat, DVec3};

use crate::air::{AIR_DENSITY, SPEED_OF_SOUND};
use crate::bank::{BLOCK, LANES, Lanes, Sums, ring_block, total};
use crate::body::Body;
use crate::complex::Complex;
use crate::listener::Ways;
use crate::pulse::Drive;
use crate::strike::{Strike, pole};
use crate::waves::{MOST_DEGREE, degree, harmonics};

/// Quieter resonators are taken for silent, Pa: 6 dB below what a young ear hears at its best. It also keeps numbers from becoming denormal.
pub(crate) const SILENCE: f32 = 1e-5;

/// Highest frequency that is synthesised, as a share of the sampling rate.
const NYQUIST: f64 = 0.45;

/// A strike that has begun.
#[derive(Clone, Debug)]
struct Hit {
    /// When it began, in samples.
    start: f64,
    strike: Strike,
    /// What of the force is heard at once: Σ Im G_i φ_i / ω_i, Pa/N. It is the acceleration under the force, and a resonator, which holds a
    /// velocity, lacks it. Known once the resonators are chosen.
    direct: Option<f64>,
    /// The motion as a whole: pressure per newton, Pa/N, times 1/s; and its state.
    shaken: Complex,
    state: Complex,
}

/// A resonator of a voice.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Slot {
    /// The mode of the body.
    pub(crate) mode: u32,
    /// How loud it will be by what is striking it, Pa.
    pub(crate) expected: f32,
    /// Whether it is to fade out in this block, and then go.
    pub(crate) goes: bool,
}

/// A body that sounds.
#[derive(Clone, Debug)]
pub(crate) struct Voice {
    pub(crate) body: Arc<Body>,
    place: DVec3,
    rotation: DQuat,
    /// Pressure per velocity of each degree, of each mode; and the distance they are for.
    waves: Vec<[Complex; MOST_DEGREE + 1]>,
    waves_distance: f64,
    /// G of each mode, Pa√kg·s/m.
    gains: Vec<Complex>,
    lanes: Vec<Lanes>,
    pub(crate) slots: Vec<Slot>,
    hits: Vec<Hit>,
    ways: Ways,
    /// The ways before the last change of place, while they fade.
    before: Option<Ways>,
}

/// What all voices share.
pub(crate) struct Room<'a> {
    pub(crate) listener: &'a crate::listener::Listener,
    pub(crate) floor: Option<&'a crate::listener::SoundFloor>,
    pub(crate) rate: f64,
}

impl Voice {
    pub(crate) fn new(body: Arc<Body>, place: DVec3, rotation: DQuat, room: &Room<'_>) -> Self {
        let ways = Ways::new(
            room.listener,
            room.floor,
            room.rate,
            place,
            body.sphere.radius,
        );
        Self {
            body,
            place,
            rotation,
            waves: Vec::new(),
            waves_distance: 0.0,
            gains: Vec::new(),
            lanes: Vec::new(),
            slots: Vec::new(),
            hits: Vec::new(),
            ways,
            before: None,
        }
    }

    /// Whether nothing of it is to be heard.
    pub(crate) fn is_silent(&self) -> bool {
        self.slots.is_empty() && self.hits.is_empty()
    }

    /// Moves the body; what rings goes over to the new place within a block.
    pub(crate) fn put(&mut self, place: DVec3, rotation: DQuat, room: &Room<'_>) {
        (self.place, self.rotation) = (place, rotation);
        let ways = Ways::new(
            room.listener,
            room.floor,
            room.rate,
            place,
            self.body.sphere.radius,
        );
        if self.is_silent() {
            (self.ways, self.before) = (ways, None);
            self.gains.clear();
            return;
        }
        // Within a block the ways may change twice; what sounded then is still the first.
        self.before.get_or_insert(self.ways);
        self.ways = ways;
        self.find_gains(room);
        for (i, slot) in self.slots.iter().enumerate() {
            let gain = self.gains[slot.mode as usize];
            let (lanes, k) = (&mut self.lanes[i / LANES], i % LANES);
            lanes.ramp_re[k] = (gain.re as f32 - lanes.gain_re[k]) / BLOCK as f32;
            lanes.ramp_im[k] = (gain.im as f32 - lanes.gain_im[k]) / BLOCK as f32;
        }
    }

    /// G of all modes towards the listener.
    fn find_gains(&mut self, room: &Room<'_>) {
        let (body, distance) = (&self.body, room.listener.distance(self.place));
        let ratio = self.waves_distance / distance;
        if self.waves.is_empty() || !(0.8..1.25).contains(&ratio) {
            let wave = |frequency: f64| {
                let waves = body
                    .sphere
                    .waves(std::f64::consts::TAU * frequency, distance);
                std::array::from_fn(|l| waves[l])
            };
            self.waves = body.modes.iter().map(|m| wave(m.frequency)).collect();
            self.waves_distance = distance;
        }
        let scale = self.waves_distance / distance;
        let y = harmonics(body.sphere.axes.inverse() * self.towards(room));
        self.gains.clear();
        for (mode, waves) in body.modes.iter().zip(&self.waves) {
            let mut sums = [0.0; MOST_DEGREE + 1];
            for (place, (&c, y)) in mode.motion.iter().zip(y).enumerate() {
                sums[degree(place)] += f64::from(c) * y;
            }
            let each = waves
                .iter()
                .zip(sums)
                .map(|(wave, sum)| wave.scaled(scale * sum));
            self.gains.push(each.fold(Complex::default(), |a, b| a + b));
        }
    }

    /// The direction of the listener in the body's frame.
    fn towards(&self, room: &Room<'_>) -> DVec3 {
        self.rotation.inverse() * (room.listener.place - self.place)
    }

    /// Begins a strike at a time in samples; the modes it would make heard get a resonator.
    pub(crate) fn hit(&mut self, start: f64, strike: Strike, room: &Room<'_>) {
        if self.gains.len() != self.body.modes.len() {
            self.find_gains(room);
        }
        let shaken = self.shaken(&strike, room);
        let mut slot_of = vec![u32::MAX; self.body.modes.len()];
        for (i, slot) in self.slots.iter().enumerate() {
            slot_of[slot.mode as usize] = i as u32;
        }
        let body = Arc::clone(&self.body);
        for (i, (mode, &push)) in body.modes.iter().zip(&strike.push).enumerate() {
            let heard = mode.frequency <= NYQUIST * room.rate;
            let Some(pole) = pole(mode.frequency, mode.loss).filter(|_| heard) else {
                continue;
            };
            let gain = self.gains[i];
            let given =
                f64::from(push.abs()) * strike.pulse.spectrum(Complex::new(0.0, pole.im)).norm();
            let expected = (gain.norm() * given) as f32;
            if slot_of[i] != u32::MAX {
                let slot = &mut self.slots[slot_of[i] as usize];
                slot.expected = slot.expected.max(expected);
            } else if expected > SILENCE {
                self.add_slot(i, pole.scaled(1.0 / room.rate).exp(), gain, expected);
            }
        }
        self.hits.push(Hit {
            start,
            strike,
            direct: None,
            shaken,
            state: Complex::default(),
        });
    }

    fn add_slot(&mut self, mode: usize, turn: Complex, gain: Complex, expected: f32) {
        let (i, k) = (self.slots.len() / LANES, self.slots.len() % LANES);
        if k == 0 {
            self.lanes.push(Lanes::default());
        }
        let lanes = &mut self.lanes[i];
        (lanes.re[k], lanes.im[k]) = (0.0, 0.0);
        (lanes.turn_re[k], lanes.turn_im[k]) = (turn.re as f32, turn.im as f32);
        (lanes.gain_re[k], lanes.gain_im[k]) = (gain.re as f32, gain.im as f32);
        (lanes.ramp_re[k], lanes.ramp_im[k]) = (0.0, 0.0);
        self.slots.push(Slot {
            mode: mode as u32,
            expected,
            goes: false,
        });
    }

    /// Pressure per newton of a body that is shaken as a whole: its residue at the sphere's pole, Pa/(N·s), doubled.
    ///
    /// A sphere of radius a that is accelerated sends p = ρ/(2π) D·a⃗ (1/r² + s/(cr)) / (2 + 2σ + σ²), σ = sa/c, D its moved air: a resonator
    /// at s = (c/a)(−1 ± i). Chadwick, Zheng and James (ACM TOG 31(6), 2012) call it acceleration noise. Turning is silent, as a sphere's is.
    fn shaken(&self, strike: &Strike, room: &Room<'_>) -> Complex {
        let sphere = &self.body.sphere;
        if self.body.mass.is_infinite() {
            return Complex::default();
        }
        let r = room.listener.distance(self.place).max(sphere.radius);
        let towards = sphere.axes.inverse() * self.towards(room).normalize_or_zero();
        let force = sphere.axes.inverse() * strike.direction.as_dvec3();
        let dipole: f64 = (0..3)
            .map(|i| sphere.moved_air[i] * force[i] * towards[i])
            .sum();
        let own = SPEED_OF_SOUND / sphere.radius;
        let pole = shaken_pole(sphere.radius);
        let near = Complex::new(1.0 / (r * r), 0.0) + pole.scaled(1.0 / (SPEED_OF_SOUND * r));
        let size = AIR_DENSITY * dipole / (2.0 * std::f64::consts::PI * self.body.mass);
        // (c/a)² / (λ − λ̄), λ − λ̄ = 2i c/a.
        (near * Complex::new(0.0, -0.5 * own)).scaled(2.0 * size)
    }

    /// How loud a resonator is, Pa.
    pub(crate) fn level(&self, i: usize) -> f32 {
        let (lanes, k) = (&self.lanes[i / LANES], i % LANES);
        let square = |re: f32, im: f32| f64::from(re).powi(2) + f64::from(im).powi(2);
        // One root for both sizes, and in f64, where no square overflows.
        let heard = square(lanes.re[k], lanes.im[k]) * square(lanes.gain_re[k], lanes.gain_im[k]);
        (heard.sqrt() as f32).max(self.slots[i].expected)
    }

    /// Lets what goes fade out within this block.
    pub(crate) fn fade(&mut self, i: usize) {
        let (lanes, k) = (&mut self.lanes[i / LANES], i % LANES);
        lanes.ramp_re[k] = -lanes.gain_re[k] / BLOCK as f32;
        lanes.ramp_im[k] = -lanes.gain_im[k] / BLOCK as f32;
        self.slots[i].goes = true;
    }

    /// Lets all of it fade out within this block: the body is no more.
    pub(crate) fn hush(&mut self) {
        (0..self.slots.len()).for_each(|i| self.fade(i));
        self.hits.clear();
    }

    /// Adds a block of what is heard at the middle of the head to `out`.
    pub(crate) fn ring(&mut self, arch: pulp::Arch, rate: f64, now: f64, out: &mut [f32; BLOCK]) {
        let mut sums: Sums = [[0.0; LANES]; BLOCK];
        if self.hits.is_empty() {
            ring_block(arch, &mut self.lanes, &mut sums);
        } else {
            self.find_direct();
            for i in 0..self.slots.len() {
                self.ring_struck(i, rate, now, &mut sums);
            }
        }
        for (out, sum) in out.iter_mut().zip(&sums) {
            *out += total(sum);
        }
        for hit in &mut self.hits {
            hit.rings(self.body.sphere.radius, rate, now, out);
        }
        let end = now + BLOCK as f64;
        let tail = 12.0 * self.body.sphere.radius / SPEED_OF_SOUND;
        self.hits
            .retain(|hit| hit.start + (hit.strike.pulse.duration() + tail) * rate >= end);
        self.tidy();
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
        let mut given = [Complex::default(); BLOCK];
        for hit in self.hits.iter().filter(|hit| !hit.strike.push.is_empty()) {
            let push = f64::from(hit.strike.push[slot.mode as usize]);
            let first = (hit.start - now).ceil().max(0.0);
            let past = (now + first - hit.start) / rate;
            if first as usize >= BLOCK || past > hit.strike.pulse.duration() + 1.0 / rate {
                continue;
            }
            let mut drive = Drive::new(&hit.strike.pulse, pole, 1.0 / rate, past);
            for given in &mut given[first as usize..] {
                *given = *given + drive.step().scaled(push);
            }
        }
        let (lanes, k) = (&mut self.lanes[i / LANES], i % LANES);
        let turn = pole.scaled(1.0 / rate).exp();
        let mut z = Complex::new(f64::from(lanes.re[k]), f64::from(lanes.im[k]));
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

    /// The ways of this block, and those that fade in it.
    pub(crate) fn take_ways(&mut self) -> (Ways, Option<Ways>) {
        (self.ways, self.before.take())
    }
}

/// The pole of a sphere that is shaken: (c/a)(−1 + i).
fn shaken_pole(radius: f64) -> Complex {
    let own = SPEED_OF_SOUND / radius;
    Complex::new(-own, own)
}

impl Hit {
    /// Adds what is heard of the force at once, and of the motion as a whole.
    fn rings(&mut self, radius: f64, rate: f64, now: f64, out: &mut [f32; BLOCK]) {
        let first = (self.start - now).ceil().max(0.0) as usize;
        if first >= BLOCK {
            return;
        }
        let past = (now + first as f64 - self.start) / rate;
        let pole = shaken_pole(radius);
        let turn = pole.scaled(1.0 / rate).exp();
        let mut drive = Drive::new(&self.strike.pulse, pole, 1.0 / rate, past);
        let direct = self.direct.unwrap_or(0.0);
        for (n, out) in out.iter_mut().enumerate().skip(first) {
            self.state = turn * self.state + drive.step();
            let force = self.strike.pulse.at(past + (n - first) as f64 / rate).0;
            let whole = self.shaken * self.state;
            *out += (direct * force + whole.re) as f32;
        }
    }
}
