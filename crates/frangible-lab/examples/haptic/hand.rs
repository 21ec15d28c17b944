//! A hand that taps: a hammer's head on a spring, led along strokes of a rising speed.

use frangible::glam::Vec3;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

use crate::touch::TICK;

/// Height at which a stroke begins and ends, m above the surface.
const HEIGHT: f32 = 0.02;
/// Ticks of a stroke: flight and press, then back.
const PRESS: u32 = 150;
/// Ticks of a whole stroke.
pub(crate) const STROKE: u32 = 250;
/// Depth to which the hand presses, m, and speed at which it slides meanwhile, m/s.
const DEPTH: f32 = 1e-3;
const SLIDE: f32 = 0.05;
/// Spring and damper of the hand, N/m and N·s/m.
const STIFFNESS: f32 = 1500.0;
const DAMPING: f32 = 12.0;
/// A stroke lands within this of the middle, m, to each side.
const REACH: f32 = 0.03;

/// A hammer's head in a hand, above a level surface.
#[derive(Clone, Debug)]
pub(crate) struct Hand {
    /// Centre of the head, m.
    pub(crate) position: Vec3,
    /// Its velocity, m/s.
    pub(crate) velocity: Vec3,
    mass: f32,
    /// Height of the head's centre when it touches, m.
    surface: f32,
    /// Point where the stroke lands.
    aim: Vec3,
    in_stroke: u32,
    landed: bool,
    rng: ChaCha8Rng,
}

impl Hand {
    /// A hand whose head has this mass, kg, and radius, m, above a surface at height `surface`, m.
    pub(crate) fn new(mass: f32, radius: f32, surface: f32, seed: u64) -> Self {
        Self {
            position: Vec3::ZERO,
            velocity: Vec3::ZERO,
            mass,
            surface: surface + radius,
            aim: Vec3::ZERO,
            in_stroke: STROKE,
            landed: false,
            rng: ChaCha8Rng::seed_from_u64(seed),
        }
    }

    /// Returns true if the stroke is over.
    pub(crate) fn is_done(&self) -> bool {
        self.in_stroke >= STROKE
    }

    /// Begins a stroke at this speed, m/s, somewhere around the middle.
    pub(crate) fn strike(&mut self, speed: f32) {
        let mut aside = || REACH * (2.0 * (self.rng.next_u32() as f32 / u32::MAX as f32) - 1.0);
        self.aim = Vec3::new(aside(), aside(), self.surface);
        self.position = self.aim + Vec3::Z * HEIGHT;
        self.velocity = Vec3::NEG_Z * speed;
        self.in_stroke = 0;
        self.landed = false;
    }

    /// A tick further under a force on the head, N. It flies until it lands; then the hand presses and slides, and lifts.
    pub(crate) fn step(&mut self, force: Vec3) {
        let dt = TICK as f32;
        self.landed |= force != Vec3::ZERO;
        if self.landed {
            let time = self.in_stroke as f32 * dt;
            let lift = self.in_stroke.saturating_sub(PRESS) as f32 / (STROKE - PRESS) as f32;
            let to = self.aim + Vec3::new(SLIDE * time, 0.0, (HEIGHT + DEPTH) * lift - DEPTH);
            let pull = STIFFNESS * (to - self.position) - DAMPING * self.velocity;
            self.velocity += (force + pull) * (dt / self.mass);
        }
        // The new velocity moves it: the scheme that keeps a spring's energy.
        self.position += self.velocity * dt;
        self.in_stroke += 1;
    }
}
