//! A force over time, and the exact response of an oscillator to it.

use num_complex::Complex64;

use crate::error::{SoundError, finite, within};

/// A force over time, with linear interpolation between values.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SoundPulse {
    /// Time between two values, s.
    pub time_step: f64,
    /// Force at the end of each time step, N. It is zero at the start of the first step and drops to zero after the last value.
    pub force: Vec<f32>,
}

/// Steps of a half-sine; its spectrum is within 1 % of the true one up to its third lobe.
const HALF_SINE_STEPS: usize = 24;

/// Longest pulse that is heard as one, s.
const LONGEST: f64 = 10.0;

impl SoundPulse {
    /// Creates a half-sine pulse with this impulse, N·s, and duration, s, a good approximation of an elastic collision.
    #[must_use]
    pub fn half_sine(impulse: f64, duration: f64) -> Self {
        let time_step = duration / HALF_SINE_STEPS as f64;
        let shape = |k: usize| (std::f64::consts::PI * k as f64 / HALF_SINE_STEPS as f64).sin();
        let area: f64 = time_step * (1..HALF_SINE_STEPS).map(shape).sum::<f64>();
        let force = (1..=HALF_SINE_STEPS)
            .map(|k| match k {
                HALF_SINE_STEPS => 0.0,
                _ => (impulse * shape(k) / area) as f32,
            })
            .collect();
        Self { time_step, force }
    }

    /// Returns the duration, s.
    #[must_use]
    pub fn duration(&self) -> f64 {
        self.time_step * self.force.len() as f64
    }

    /// Returns the impulse, N·s.
    #[must_use]
    pub fn impulse(&self) -> f64 {
        let last = f64::from(self.force.last().copied().unwrap_or(0.0));
        let sum: f64 = self.force.iter().map(|&f| f64::from(f)).sum();
        self.time_step * (sum - 0.5 * last)
    }

    /// Checks every number.
    ///
    /// # Errors
    /// A force is not finite, the time step is not positive, or the duration exceeds 10 s.
    pub fn validate(&self) -> Result<(), SoundError> {
        let step = self.time_step;
        within(
            || "the time step of a pulse".into(),
            step,
            step > 0.0,
            "above zero, in s",
        )?;
        for (i, &force) in self.force.iter().enumerate() {
            finite(|| format!("force {i} of a pulse"), f64::from(force))?;
        }
        let long = self.duration();
        let range = "at most 10, in s; longer contacts are not strikes";
        within(
            || "the duration of a pulse".into(),
            long,
            long <= LONGEST,
            range,
        )
        .map(|_| ())
    }

    /// The force at the k-th value, N; the 0th begins the pulse.
    fn value(&self, k: usize) -> f64 {
        match k {
            0 => 0.0,
            _ => self.force.get(k - 1).map_or(0.0, |&f| f64::from(f)),
        }
    }

    /// Growth of the force from the k-th value to the next, N/s.
    fn slope(&self, k: usize) -> f64 {
        if k >= self.force.len() {
            return 0.0;
        }
        (self.value(k + 1) - self.value(k)) / self.time_step
    }

    /// Returns the force, N, and its rate of change, N/s, at a time after the start, s.
    #[must_use]
    pub fn at(&self, time: f64) -> (f64, f64) {
        if time < 0.0 {
            return (0.0, 0.0);
        }
        let k = (time / self.time_step) as usize;
        if k >= self.force.len() {
            return (0.0, 0.0);
        }
        let slope = self.slope(k);
        (
            self.value(k) + slope * (time - k as f64 * self.time_step),
            slope,
        )
    }

    /// ∫ F e^{−λt} dt: what the whole pulse gives an oscillator of this pole, seen from the pulse's beginning.
    pub(crate) fn spectrum(&self, pole: Complex64) -> Complex64 {
        let long = self.duration();
        // One step over all of it, from before the beginning to the end, and back.
        let all = Drive::new(self, pole, 2.0 * long, long).step();
        all * pole.scale(-long).exp()
    }
}

/// Response of an oscillator of an angular frequency, rad/s, to a half-sine of a duration, s, as a share of that to a blow of no duration:
/// |cos(ωτ/2) / (1 − (ωτ/π)²)|.
pub(crate) fn half_sine_share(frequency: f64, duration: f64) -> f64 {
    let x = frequency * duration / std::f64::consts::PI;
    let near = 1.0 - x * x;
    if near.abs() < 1e-6 {
        return std::f64::consts::FRAC_PI_4;
    }
    ((0.5 * std::f64::consts::PI * x).cos() / near).abs()
}

/// Sum that a pulse adds to z, ż = λ z + F, sample after sample: the integral of F e^{λ(t−τ)} over the time since the sample before, without
/// any approximation. A corner of the force, where its slope jumps by S and itself by J, leaves a free oscillation S/λ² + J/λ from there; with
/// the forced motion −F/λ − F'/λ² that is all of z.
pub(crate) struct Drive<'a> {
    pulse: &'a SoundPulse,
    pole: Complex64,
    inverse: Complex64,
    inverse_square: Complex64,
    /// e^{λT} and T, s.
    decay: Complex64,
    tick: f64,
    /// Time of the sample to come since the beginning of the pulse, s.
    time: f64,
    /// The next corner.
    corner: usize,
    /// e^{−λΔ} from one corner to the next.
    between: Complex64,
    forced: Complex64,
}

impl<'a> Drive<'a> {
    /// Begins with the sample that comes `first` seconds after the beginning of the pulse, zero or later; the one before came `tick` seconds
    /// earlier, when the pulse may have begun already.
    pub(crate) fn new(pulse: &'a SoundPulse, pole: Complex64, tick: f64, first: f64) -> Self {
        let inverse = pole.inv();
        let mut drive = Self {
            pulse,
            pole,
            inverse,
            inverse_square: inverse * inverse,
            decay: pole.scale(tick).exp(),
            tick,
            time: first,
            corner: 0,
            between: pole.scale(-pulse.time_step).exp(),
            forced: Complex64::default(),
        };
        let before = first - tick;
        if before >= 0.0 {
            drive.corner = drive.corners_until(before);
            drive.forced = drive.forced_at(before);
        }
        drive
    }

    /// Number of corners up to a time, s.
    fn corners_until(&self, time: f64) -> usize {
        ((time / self.pulse.time_step) as usize + 1).min(self.pulse.force.len() + 1)
    }

    fn forced_at(&self, time: f64) -> Complex64 {
        let (force, slope) = self.pulse.at(time);
        self.inverse.scale(-force) + self.inverse_square.scale(-slope)
    }

    /// Returns the sum for the next sample.
    pub(crate) fn step(&mut self) -> Complex64 {
        let (pulse, until) = (self.pulse, self.corners_until(self.time));
        let mut sum = Complex64::default();
        if self.corner < until {
            let begun = self.corner as f64 * pulse.time_step;
            let mut since = self.pole.scale(self.time - begun).exp();
            for k in self.corner..until {
                let last = k == pulse.force.len();
                let before = if k == 0 { 0.0 } else { pulse.slope(k - 1) };
                let mut corner = self.inverse_square.scale(pulse.slope(k) - before);
                if last {
                    corner += self.inverse.scale(-pulse.value(k));
                }
                sum += since * corner;
                since *= self.between;
            }
            self.corner = until;
        }
        let forced = self.forced_at(self.time);
        let step = forced - self.decay * self.forced + sum;
        (self.forced, self.time) = (forced, self.time + self.tick);
        step
    }
}
