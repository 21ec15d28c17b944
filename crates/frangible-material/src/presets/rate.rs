//! How strength rises with the rate at which stress rises.

use crate::error::{OutOfRange, positive};

/// Strength at a high rate of stress over the strength of a slow test, `min((σ̇/σ̇₀)^m, limit)`.
///
/// A slow test lets flaws grow while it lasts: water at the tip of a flaw in glass, crazes in acrylic. A blow that loads in microseconds does not,
/// and finds the material stronger. An option, because presets state the strength of slow tests.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct RateLaw {
    /// m.
    pub exponent: f64,
    /// σ̇₀, the rate of the slow test, Pa/s.
    pub reference: f64,
    /// Largest factor that was measured.
    pub limit: f64,
    /// Where the numbers come from.
    pub source: &'static str,
}

impl RateLaw {
    /// The strength, Pa, of a material that bears `strength`, Pa, in a slow test, where stress rises within `rise_time`, s.
    ///
    /// # Errors
    /// A strength or a rise time that is not a finite number above zero.
    pub fn strength(&self, strength: f64, rise_time: f64) -> Result<f64, OutOfRange> {
        positive("the strength of a slow test", strength, "Pa")?;
        positive("the time in which the stress rises", rise_time, "s")?;
        let rate = strength / rise_time;
        let factor = (rate / self.reference).powf(self.exponent);
        Ok(strength * factor.clamp(1.0, self.limit))
    }
}

pub(super) const GLASS: RateLaw = RateLaw {
    exponent: 1.0 / 17.0,
    reference: 2e6,
    limit: 1.52,
    source: "m = 1/(n+1), n = 16 for stress corrosion of soda-lime glass: Haldimann, IABSE Structural Engineering Documents 10 (2008), not re-checked \
             (14.5 and 21.6 in other tests); limit: 1.52 for handled surfaces (1.85 as received) between 2 and 5.6e6 MPa/s, ring on ring: Meyland et al., \
             Glass Structures & Engineering, 10.1007/s40940-018-0089-2 (abstract)",
};

pub(super) const CONCRETE: RateLaw = RateLaw {
    exponent: 0.018,
    reference: 0.03e6,
    limit: 1.34,
    source: "fib Model Code 2010, tension, up to 10 1/s (not re-checked); its cube-root branch above is mostly inertia, which is computed here",
};

pub(super) const PMMA: RateLaw = RateLaw {
    exponent: 0.02,
    reference: 3e6,
    limit: 1.3,
    source: "an estimate from one measurement: a sphere's impact needs about 30 % more load than a slow test to fracture a plate on a ring \
             (Flexure strength and fracture of polymethylmethacrylate plates; abstract); that strength in tension grows with rate: Wu, Ma, Xia, \
             Materials Letters 2004, 10.1016/j.matlet.2004.07.022 (abstract)",
};
