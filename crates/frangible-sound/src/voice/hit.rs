//! A strike that has begun, and the motion of the body as a whole.

use glam::DVec3;
use num_complex::Complex64;

use crate::air::{AIR_DENSITY, SPEED_OF_SOUND};
use crate::bank::BLOCK;
use crate::body::SoundBody;
use crate::pulse::Drive;
use crate::strike::Strike;

/// A strike that has begun.
#[derive(Clone, Debug)]
pub(super) struct Hit {
    /// Time at which it began, in samples.
    pub(super) start: f64,
    pub(super) strike: Strike,
    /// Part of the force that is heard at once: Σ Im G_i φ_i / ω_i, Pa/N. It is the acceleration under the force, and a resonator, which holds a
    /// velocity, lacks it. Known once the resonators are chosen.
    pub(super) direct: Option<f64>,
    /// The motion as a whole: pressure per newton, Pa/N, times 1/s, straight to the listener and towards the floor; and its state.
    shaken: [Complex64; 2],
    state: Complex64,
}

/// The pole of a sphere that is shaken: (c/a)(−1 + i).
fn shaken_pole(radius: f64) -> Complex64 {
    let own = SPEED_OF_SOUND / radius;
    Complex64::new(-own, own)
}

impl Hit {
    /// A strike that begins at a time in samples, heard straight and by the floor in these directions of the body's frame, from a distance, m.
    pub(super) fn new(
        start: f64,
        strike: Strike,
        body: &SoundBody,
        ways: [DVec3; 2],
        distance: f64,
    ) -> Self {
        Self {
            start,
            direct: None,
            shaken: ways.map(|towards| Self::shaken(body, &strike, towards, distance)),
            state: Complex64::default(),
            strike,
        }
    }

    /// Pressure per newton of a body that is shaken as a whole: its residue at the sphere's pole, Pa/(N·s), doubled.
    ///
    /// A sphere of radius a that is accelerated sends p = ρ/(2π) D·a⃗ (1/r² + s/(cr)) / (2 + 2σ + σ²), σ = sa/c, D its moved air: a resonator
    /// at s = (c/a)(−1 ± i). Chadwick, Zheng and James (ACM TOG 31(6), 2012) call it acceleration noise. Turning is silent, as a sphere's is.
    ///
    /// `towards` is the direction of the listener in the body's frame, `distance` its distance, m.
    fn shaken(body: &SoundBody, strike: &Strike, towards: DVec3, distance: f64) -> Complex64 {
        let sphere = &body.sphere;
        if body.mass.is_infinite() {
            return Complex64::default();
        }
        let r = distance.max(sphere.radius);
        let towards = sphere.axes.inverse() * towards.normalize_or_zero();
        let force = sphere.axes.inverse() * strike.direction.as_dvec3();
        let dipole: f64 = (0..3)
            .map(|i| sphere.moved_air[i] * force[i] * towards[i])
            .sum();
        let own = SPEED_OF_SOUND / sphere.radius;
        let pole = shaken_pole(sphere.radius);
        let near = Complex64::new(1.0 / (r * r), 0.0) + pole.scale(1.0 / (SPEED_OF_SOUND * r));
        let size = AIR_DENSITY * dipole / (2.0 * std::f64::consts::PI * body.mass);
        // (c/a)² / (λ − λ̄), λ − λ̄ = 2i c/a.
        (near * Complex64::new(0.0, -0.5 * own)).scale(2.0 * size)
    }

    /// Adds the force that is heard at once, and the motion as a whole, straight and towards the floor.
    pub(super) fn rings(&mut self, radius: f64, rate: f64, now: f64, out: &mut [[f32; BLOCK]; 2]) {
        let first = (self.start - now).ceil().max(0.0) as usize;
        if first >= BLOCK {
            return;
        }
        let past = (now + first as f64 - self.start) / rate;
        let pole = shaken_pole(radius);
        let turn = pole.scale(1.0 / rate).exp();
        let mut drive = Drive::new(&self.strike.pulse, pole, 1.0 / rate, past);
        let direct = self.direct.unwrap_or(0.0);
        for n in first..BLOCK {
            self.state = turn * self.state + drive.step();
            let force = self.strike.pulse.at(past + (n - first) as f64 / rate).0;
            for (out, shaken) in out.iter_mut().zip(self.shaken) {
                let whole = shaken * self.state;
                out[n] += (direct * force + whole.re) as f32;
            }
        }
    }
}
