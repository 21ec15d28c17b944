//! One body that sounds: its resonators, the strikes on it, and its ways to the ears.

mod hit;
mod ring;

use std::sync::Arc;

use glam::{DQuat, DVec3};
use num_complex::Complex64;

use crate::bank::{BLOCK, LANES, Lanes};
use crate::body::SoundBody;
use crate::listener::Ways;
use crate::strike::{Strike, pole};
use crate::waves::{MOST_DEGREE, degree, harmonics};

use hit::Hit;

/// Quieter resonators are taken for silent, Pa: 6 dB below what a young ear hears at its best. It also keeps numbers from becoming denormal.
pub(crate) const SILENCE: f32 = 1e-5;

/// Highest frequency that is synthesised, as a share of the sampling rate.
const NYQUIST: f64 = 0.45;

/// A resonator of a voice.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Slot {
    /// The mode of the body.
    pub(crate) mode: u32,
    /// Loudness expected from the strikes on the body, Pa.
    pub(crate) expected: f32,
    /// If true, it fades out in this block and is then removed.
    pub(crate) goes: bool,
}

/// A body that sounds.
#[derive(Clone, Debug)]
pub(crate) struct Voice {
    pub(crate) body: Arc<SoundBody>,
    place: DVec3,
    rotation: DQuat,
    /// Pressure per velocity of each degree, of each mode; and the distance they are for.
    waves: Vec<[Complex64; MOST_DEGREE + 1]>,
    waves_distance: f64,
    /// G of each mode, Pa√kg·s/m.
    gains: Vec<Complex64>,
    lanes: Vec<Lanes>,
    pub(crate) slots: Vec<Slot>,
    hits: Vec<Hit>,
    ways: Ways,
    /// The ways before the last change of place, while they fade.
    before: Option<Ways>,
    /// Time at which it ends, in samples: the body broke.
    ends: Option<f64>,
}

/// Surroundings that all voices share.
pub(crate) struct Room<'a> {
    pub(crate) listener: &'a crate::listener::Listener,
    pub(crate) floor: Option<&'a crate::listener::SoundFloor>,
    pub(crate) rate: f64,
}

impl Voice {
    pub(crate) fn new(
        body: Arc<SoundBody>,
        place: DVec3,
        rotation: DQuat,
        room: &Room<'_>,
    ) -> Self {
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
            ends: None,
        }
    }

    /// Returns true if no resonator rings and nothing strikes it.
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

    /// Takes in that the listener has moved.
    pub(crate) fn heard_from(&mut self, room: &Room<'_>) {
        self.put(self.place, self.rotation, room);
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
                .map(|(wave, sum)| wave.scale(scale * sum));
            self.gains
                .push(each.fold(Complex64::default(), |a, b| a + b));
        }
    }

    /// The direction of the listener in the body's frame.
    fn towards(&self, room: &Room<'_>) -> DVec3 {
        self.rotation.inverse() * (room.listener.place - self.place)
    }

    /// The directions in the body's frame in which sound leaves to the listener: straight, and towards its image below the floor.
    fn ways_out(&self, room: &Room<'_>) -> [DVec3; 2] {
        let mut image = room.listener.place;
        if let Some(floor) = room.floor {
            image.y = 2.0 * floor.height - image.y;
        }
        let down = self.rotation.inverse() * (image - self.place);
        [self.towards(room), down]
    }

    /// Begins a strike at a time in samples; the modes it would make heard get a resonator.
    pub(crate) fn hit(&mut self, start: f64, strike: Strike, room: &Room<'_>) {
        if self.gains.len() != self.body.modes.len() {
            self.find_gains(room);
        }
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
                f64::from(push.abs()) * strike.pulse.spectrum(Complex64::new(0.0, pole.im)).norm();
            let expected = (gain.norm() * given) as f32;
            if slot_of[i] != u32::MAX {
                let slot = &mut self.slots[slot_of[i] as usize];
                slot.expected = slot.expected.max(expected);
            } else if expected > SILENCE {
                self.add_slot(i, pole.scale(1.0 / room.rate).exp(), gain, expected);
            }
        }
        let (ways, distance) = (self.ways_out(room), room.listener.distance(self.place));
        self.hits
            .push(Hit::new(start, strike, &body, ways, distance));
    }

    fn add_slot(&mut self, mode: usize, turn: Complex64, gain: Complex64, expected: f32) {
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

    /// Loudness of a resonator, Pa.
    pub(crate) fn level(&self, i: usize) -> f32 {
        let (lanes, k) = (&self.lanes[i / LANES], i % LANES);
        let square = |re: f32, im: f32| f64::from(re).powi(2) + f64::from(im).powi(2);
        // One root for both sizes, and in f64, where no square overflows.
        let heard = square(lanes.re[k], lanes.im[k]) * square(lanes.gain_re[k], lanes.gain_im[k]);
        (heard.sqrt() as f32).max(self.slots[i].expected)
    }

    /// Fades a resonator out within this block.
    pub(crate) fn fade(&mut self, i: usize) {
        let (lanes, k) = (&mut self.lanes[i / LANES], i % LANES);
        lanes.ramp_re[k] = -lanes.gain_re[k] / BLOCK as f32;
        lanes.ramp_im[k] = -lanes.gain_im[k] / BLOCK as f32;
        self.slots[i].goes = true;
    }

    /// Fades the voice out from a time in samples on: the body is no more.
    pub(crate) fn hush(&mut self, from: f64) {
        self.ends = Some(self.ends.map_or(from, |ends| ends.min(from)));
    }

    /// The ways of this block, and those that fade in it.
    pub(crate) fn take_ways(&mut self) -> (Ways, Option<Ways>) {
        (self.ways, self.before.take())
    }
}
