//! Impact of a striker on bodies that absorb it: Zener's infinite plate and St Venant's rod, both behind Hertz' spring.

/// A striker on Hertz' spring, F = K δ^1.5.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Striker {
    /// Mass, kg.
    pub(crate) mass: f64,
    /// K, N/m^1.5.
    pub(crate) stiffness: f64,
    /// Speed of approach, m/s.
    pub(crate) speed: f64,
}

/// Force over time, N, at even steps from the first on, and the striker's speed in the end over that before.
#[derive(Clone, Debug)]
pub(crate) struct Strike {
    pub(crate) step: f64,
    pub(crate) force: Vec<f64>,
    pub(crate) restitution: f64,
}

impl Strike {
    /// Linear between the steps.
    pub(crate) fn at(&self, t: f64) -> f64 {
        let x = (t / self.step - 1.0).max(0.0);
        let i = x as usize;
        let of = |i: usize| self.force.get(i).copied().unwrap_or(0.0);
        of(i) + (of(i + 1) - of(i)) * (x - i as f64)
    }

    pub(crate) fn peak(&self) -> f64 {
        self.force.iter().copied().fold(0.0, f64::max)
    }

    /// Time until the force is zero for good, s.
    pub(crate) fn duration(&self) -> f64 {
        let last = self.force.iter().rposition(|&f| f > 0.0);
        last.map_or(0.0, |i| (i + 1) as f64 * self.step)
    }
}

impl Striker {
    /// T = (m/(K √v))^(2/5), s: the time that a blow on a rigid wall takes, over 3.218.
    pub(crate) fn time(&self) -> f64 {
        (self.mass / (self.stiffness * self.speed.sqrt())).powf(0.4)
    }

    /// Against a body whose surface moves at (F(t) + 2 F(t − τ) + 2 F(t − 2τ) + …)/Z: an infinite plate where τ is infinite
    /// (Zener 1941), a free rod τ = 2L/c long with Z = ρ c A (St Venant 1883). Runge and Kutta's fourth order with `steps` steps of T.
    pub(crate) fn against(&self, impedance: f64, echo: f64, steps: f64) -> Strike {
        let mut dt = self.time() / steps;
        // Echoes fall on steps.
        let late = if echo.is_finite() {
            let late = (echo / dt).ceil();
            dt = echo / late;
            late as usize
        } else {
            usize::MAX
        };
        let force = |dent: f64| self.stiffness * dent.max(0.0).powf(1.5);
        let mut forces: Vec<f64> = vec![0.0];
        let (mut dent, mut speed) = (0.0, self.speed);
        let (mut opened, mut peak) = (0, 0.0_f64);
        // Long enough for any blow; ended below.
        for i in 0..4_000_000_usize {
            let echoes = |at: usize| -> f64 {
                (1..)
                    .map_while(|n| at.checked_sub(late.checked_mul(n)?))
                    .map(|k| 2.0 * forces.get(k).copied().unwrap_or(0.0))
                    .sum()
            };
            let (before, after) = (echoes(i), echoes(i + 1));
            let rate = |dent: f64, speed: f64, share: f64| {
                let f = force(dent);
                let heard = before + (after - before) * share;
                [speed - (f + heard) / impedance, -f / self.mass]
            };
            let a = rate(dent, speed, 0.0);
            let b = rate(dent + 0.5 * dt * a[0], speed + 0.5 * dt * a[1], 0.5);
            let c = rate(dent + 0.5 * dt * b[0], speed + 0.5 * dt * b[1], 0.5);
            let d = rate(dent + dt * c[0], speed + dt * c[1], 1.0);
            dent += dt / 6.0 * (a[0] + 2.0 * (b[0] + c[0]) + d[0]);
            speed += dt / 6.0 * (a[1] + 2.0 * (b[1] + c[1]) + d[1]);
            forces.push(force(dent));
            // Open, and no echo on its way that would close it: a rod throws the striker off for good.
            opened = if dent <= 0.0 { opened + 1 } else { 0 };
            let waited = if late == usize::MAX { 1 } else { 2 * late };
            peak = peak.max(force(dent));
            let spent = force(dent) < 1e-4 * peak && late == usize::MAX;
            if i > 10 && (opened >= waited || spent) {
                break;
            }
        }
        forces.remove(0);
        Strike {
            step: dt,
            force: forces,
            restitution: -speed / self.speed,
        }
    }
}
