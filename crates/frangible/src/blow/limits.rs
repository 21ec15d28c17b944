//! Upper bounds of the impulse and the force of a contact before the blow is integrated, which allow harmless contacts to be rejected early.
//!
//! With B the inverse masses of the rigid bodies at the contacts and v the approach there, the motion of approach holds the energy `T = ½ vᵀ B⁻¹ v`,
//! and nothing adds to it: springs, modes and wall oscillators, also those of a striker that vibrates, are at rest before the blow and only store,
//! pass on and lose energy. Scripted forces do add to it, so there is no bound if they act together with strikers. Friction does not affect the normal
//! forces. The bounds therefore need no modes, and hold with and without those of a striker:
//! - the Hertz spring of a contact never stores more than T, which limits its force;
//! - the impulses J of the contacts so far have left the approach v − B J, which holds at most T as well. So `½ Jᵀ B J ≤ 4 T`, and so
//!   `J_k ≤ √(8 T (B⁻¹)_kk)`. If no contact's push helps another (all of B ≥ 0), `J_k ≤ √(8 T / B_kk)`, which is less; for a single contact this
//!   is `2 v / B`.

use super::Spring;
use crate::asset::Asset;
use crate::contact::{self, Contact};
use crate::mesh::SurfacePoint;

/// Most contacts for which limits are computed.
const MOST: usize = 16;

/// Limits of one contact of a blow.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Limits {
    /// Largest impulse, N·s.
    pub(crate) impulse: f64,
    /// Largest force, N.
    pub(crate) force: f64,
}

impl Limits {
    /// Computes the limits of all contacts at their places on the surface, into `limits`. Returns false if none are known.
    pub(crate) fn of(
        asset: &Asset,
        contacts: &[Option<(&Contact, SurfacePoint)>],
        limits: &mut [Self],
    ) -> bool {
        let count = contacts.len();
        if count > MOST || limits.len() < count {
            return false;
        }
        let contacts = || contacts.iter().flatten().enumerate();
        let scripts = contacts().filter(|(_, (contact, _))| contact.is_script());
        let scripts = scripts.count();
        if scripts > 0 && scripts < count {
            return false;
        }
        let mut inverse_mass = [0.0; MOST * MOST];
        let mut speeds = [0.0; MOST];
        let mut helps = false;
        for (k, (a, at)) in contacts() {
            speeds[k] = f64::from(a.approach_speed);
            for (l, (b, there)) in contacts().take(k + 1) {
                let [a, b] = [(a, at), (b, there)]
                    .map(|(c, at)| (&c.striker, at.position, c.normal.normalize()));
                let entry = contact::inverse_mass(asset, a, b, k == l);
                helps |= entry < 0.0;
                inverse_mass[k * MOST + l] = entry;
            }
        }
        let factor = factor(&inverse_mass, count);
        let energy = 0.5 * square(&factor, &speeds[..count]);
        for (k, (contact, at)) in contacts() {
            if contact.is_script() {
                // Its pulse is known.
                let (impulse, duration) = (f64::from(contact.impulse), f64::from(contact.duration));
                limits[k] = Self {
                    impulse,
                    force: 0.5 * std::f64::consts::PI * impulse / duration,
                };
                continue;
            }
            let radius = f64::from(asset.surface.curvature_radius[at.triangle as usize]);
            let mass = if helps {
                let mut unit = [0.0; MOST];
                unit[k] = 1.0;
                square(&factor, &unit[..count])
            } else {
                1.0 / inverse_mass[k * MOST + k]
            };
            limits[k] = Self {
                impulse: (8.0 * energy * mass).sqrt(),
                force: Spring::at(asset, contact, radius).force_of_energy(energy),
            };
        }
        energy.is_finite()
    }
}

/// Cholesky's factor of B, whose lower half is given; if B is singular, a little is added to it.
fn factor(inverse_mass: &[f64; MOST * MOST], count: usize) -> [f64; MOST * MOST] {
    let mut factor = *inverse_mass;
    for k in 0..count {
        let smallest = 1e-9 * inverse_mass[k * MOST + k];
        for l in 0..=k {
            let mut sum = factor[k * MOST + l];
            for j in 0..l {
                sum -= factor[k * MOST + j] * factor[l * MOST + j];
            }
            factor[k * MOST + l] = if k == l {
                sum.max(smallest).sqrt()
            } else {
                sum / factor[l * MOST + l]
            };
        }
    }
    factor
}

/// vᵀ B⁻¹ v, from Cholesky's factor of B.
fn square(factor: &[f64; MOST * MOST], v: &[f64]) -> f64 {
    let mut solved = [0.0; MOST];
    let mut square = 0.0;
    for k in 0..v.len() {
        let mut rest = v[k];
        for j in 0..k {
            rest -= factor[k * MOST + j] * solved[j];
        }
        solved[k] = rest / factor[k * MOST + k];
        square += solved[k] * solved[k];
    }
    square
}
