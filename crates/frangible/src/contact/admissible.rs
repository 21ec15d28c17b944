//! Energy-admissible duration (beyond the paper).
//!
//! The impulse is given, so too short a contact would put more elastic energy into the body than the impact had.
//! The modal energy ½ Σ (q̇² + λ q²) bounds all later strain energy and costs O(modes) per step; the duration grows
//! until its peak over the contact is at most the kinetic energy of approach Σ_k ½ φ_k v_k / (1 + e_k).

use super::{Contact, Load};
use crate::asset::Asset;
use crate::modal::ContactEnergy;

/// Growth of the duration per try.
const GROWTH: f64 = 1.05;

/// 1.05^200 ≈ 17 000: no real contact needs more.
const TRIES: usize = 200;

/// Kinetic energy of approach that the contacts absorb, J: Σ_k ½ φ_k v_k / (1 + e_k).
#[must_use]
pub fn approach_energy(contacts: &[Contact]) -> f64 {
    contacts
        .iter()
        .map(|c| {
            0.5 * f64::from(c.impulse) * f64::from(c.approach_speed)
                / (1.0 + f64::from(c.striker.restitution))
        })
        .sum()
}

/// The duration, s, lengthened until the body's vibration holds no more energy than `budget`, J, what the impact brought.
#[must_use]
pub fn admissible_duration(asset: &Asset, load: &Load, budget: f64, duration: f64) -> f64 {
    let energy = ContactEnergy::new(&asset.modes, &asset.material, &load.modal_impulse);
    let mut t = duration;
    for _ in 0..TRIES {
        if energy.is_within(t, budget) {
            break;
        }
        t *= GROWTH;
    }
    t
}
