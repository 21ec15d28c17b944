//! Exact step (tick) of an oscillator under a linearly varying force, for any damping.

use super::step::Step;

/// Effect of a tick on ω q and q̇ under a force that varies linearly over the tick.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Tick {
    /// (ω q, q̇) after the tick per (ω q, q̇) before it.
    pub own: [[f64; 2]; 2],
    /// (ω q, q̇) after the tick per newton of constant force.
    pub held: [f64; 2],
    /// (ω q, q̇) after the tick per newton of linear increase of the force over the tick.
    pub ramp: [f64; 2],
}

/// Below this angle ω Δt the closed form loses digits; the series of the matrix exponential is short there.
const SMALL_ANGLE: f64 = 0.02;

impl Tick {
    /// Creates the tick of an oscillator q̈ + d q̇ + ω² q = f, with ω in rad/s, d in 1/s and the length of the tick in s.
    #[must_use]
    pub fn new(frequency: f64, damping: f64, tick: f64) -> Self {
        let half = 0.5 * damping;
        let swings = frequency * frequency - half * half;
        if frequency * tick < SMALL_ANGLE || swings < 0.01 * frequency * frequency {
            return Self::by_series(frequency, damping, tick);
        }
        let (w, lambda) = (swings.sqrt(), frequency * frequency);
        let (sin, cos) = libm::sincos(w * tick);
        let decay = libm::exp(-half * tick);
        // q and q̇ of a free motion from q = 1, q̇ = 0, and from q = 0, q̇ = 1.
        let a = [decay * (cos + half / w * sin), -decay * lambda / w * sin];
        let b = [decay * sin / w, decay * (cos - half / w * sin)];
        // Under f = 1 the motion swings about 1/λ; under f = t/Δt about t/(λ Δt) − d/(λ² Δt).
        let held = [(1.0 - a[0]) / lambda, -a[1] / lambda];
        let rate = 1.0 / (lambda * tick);
        let late = damping * rate / lambda;
        let ramp = [
            1.0 / lambda - late * (1.0 - a[0]) - rate * b[0],
            rate + late * a[1] - rate * b[1],
        ];
        Self {
            own: [[a[0], frequency * b[0]], [a[1] / frequency, b[1]]],
            held: [frequency * held[0], held[1]],
            ramp: [frequency * ramp[0], ramp[1]],
        }
    }

    fn by_series(frequency: f64, damping: f64, tick: f64) -> Self {
        let (w, d) = (frequency * tick, damping * tick);
        // (ω q)' = ω q̇, q̈ = −ω (ω q) − d q̇ + f, f' = Δf / tick, Δf' = 0; all times the tick.
        let Step { own, force, .. } = Step {
            own: [[0.0, w], [-w, -d]],
            force: [[0.0, 0.0], [tick, 0.0]],
            turn: [[0.0, 1.0], [0.0, 0.0]],
        }
        .exponential();
        Self {
            own,
            held: [force[0][0], force[1][0]],
            ramp: [force[0][1], force[1][1]],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_closed_form_is_the_matrix_exponential() {
        let tick = 1e-6;
        for frequency in [1e4, 2.1e4, 3e5, 2e6, 4e7] {
            for damping in [0.0, 0.01, 0.5, 1.9] {
                let d = damping * frequency;
                let (fast, slow) = (
                    Tick::new(frequency, d, tick),
                    Tick::by_series(frequency, d, tick),
                );
                let pairs = fast
                    .own
                    .as_flattened()
                    .iter()
                    .chain(&fast.held)
                    .chain(&fast.ramp)
                    .zip(
                        slow.own
                            .as_flattened()
                            .iter()
                            .chain(&slow.held)
                            .chain(&slow.ramp),
                    );
                for (a, b) in pairs {
                    let size = b.abs().max(1e-3 * tick);
                    assert!(
                        (a - b).abs() < 1e-9 * size,
                        "{frequency} {damping}: {a} {b}"
                    );
                }
            }
        }
    }
}
