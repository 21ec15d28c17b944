//! The time for which a load has lasted, for static fatigue.

use crate::body::Body;

/// Change of the force by which a load counts as another one. Flaws grow with the 16th power of the stress in glass, so the time under a load
/// that was smaller by a fifth counts a 35th.
const CHANGE: f32 = 0.2;

/// Growth of the duration from one test of a load to the next: the strength of glass falls by 1.4 % meanwhile.
const GROWTH: f64 = 1.25;

/// Time for which the load on a body has lasted, and the time of its last test. An engine has one for each body, and adds
/// [`duration`](Self::duration) to [`FractureConfig::load_duration`](crate::FractureConfig::load_duration).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LoadClock {
    total: f32,
    lasted: f64,
    tested: f64,
}

impl LoadClock {
    /// Adds the time since the last call, s. `total` is the sum of the forces on the body, N; if it has changed by more than a fifth, the time
    /// starts again from zero.
    pub fn advance(&mut self, seconds: f64, total: f32) {
        if (total - self.total).abs() > CHANGE * total.max(self.total) {
            *self = Self {
                total,
                ..Self::default()
            };
        } else {
            self.lasted += seconds;
        }
    }

    /// Adds the time since the last call, s, of a body that sleeps, whose load does not change.
    pub const fn sleep(&mut self, seconds: f64) {
        self.lasted += seconds;
    }

    /// Time for which the load has lasted, s.
    #[must_use]
    pub const fn duration(&self) -> f64 {
        self.lasted
    }

    /// Returns true once the strength of a body may have fallen noticeably since the last test. `assumed`: the duration that is assumed for all
    /// loads, s.
    #[must_use]
    pub fn is_due(&self, body: &Body, assumed: f64) -> bool {
        body.resistance.tires() && assumed + self.lasted > GROWTH * (assumed + self.tested)
    }

    /// Returns the margin of a body that had this margin at the last test.
    #[must_use]
    pub fn margin(&self, body: &Body, assumed: f64, tested: f64) -> f64 {
        let left = |lasted| {
            body.resistance
                .left_after(assumed + lasted, body.resistance.weakest)
        };
        tested * (left(self.lasted) / left(self.tested))
    }

    /// Stores that the load was tested with its present duration.
    pub const fn test(&mut self) {
        self.tested = self.lasted;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_a_lasting_load_counts() {
        let mut clock = LoadClock::default();
        clock.advance(1.0, 10.0);
        assert_eq!(clock.duration(), 0.0);
        for total in [11.0, 9.5, 10.0] {
            clock.advance(1.0, total);
        }
        clock.sleep(2.0);
        assert_eq!(clock.duration(), 5.0);
        // Put down harder, the body is under another load; without one it recovers nothing, and starts again.
        clock.advance(1.0, 30.0);
        clock.advance(1.0, 30.0);
        assert_eq!(clock.duration(), 1.0);
        clock.advance(1.0, 0.0);
        assert_eq!(clock.duration(), 0.0);
    }
}
