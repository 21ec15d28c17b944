//! Cracks start `[G12 §4.4]`: at a weak tetrahedron whose largest principal tension passes R_c (Rankine), across the
//! direction of that tension, through its centre. The tension is that of its flaw on the free surface, where it has one
//! (beyond the paper, `stress/skin.rs`): a crack from there stands upright on the surface.
//!
//! Order within a time step: falling stress, then element number.

use glam::Vec3;

use super::field::StressField;
use super::release::released;
use super::surface::{CrackFrame, crossing_area};
use super::system::{Crack, CrackSystem, ElementCut, UNCUT};
use super::{advance, propagation::gradient};
use crate::config::CrackTiming;
use crate::rng::{Purpose, stream, uniform};
use crate::stress::{
    Symmetric3, largest_eigenvalue, largest_eigenvalue_bound, perpendicular_axes, principal_axes,
};

/// Below this relative gap of the two largest tensions the direction between them is rounding noise.
const ISOTROPIC: f64 = 1e-3;

/// Largest principal tension met at a weak point so far, Pa.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Peak {
    /// The tension …
    pub(crate) tension: f32,
    /// … and that of the largest share of its point's strength, as the weakest point would feel it.
    pub(crate) as_weakest: f32,
}

/// Starts every crack of this step; returns the largest tension met at a weak point so far.
pub(crate) fn start_cracks(
    system: &mut CrackSystem,
    field: &StressField,
    weak_tets: impl Iterator<Item = u32>,
    now: f64,
    peak_so_far: Peak,
) -> Peak {
    let resistance = system.resistance;
    let mut candidates = Vec::new();
    let mut peak = peak_so_far;
    for e in weak_tets {
        if system.fractured_by[e as usize] != UNCUT {
            continue;
        }
        let stress = field.at_weak_point(e as usize).stress;
        let strength = resistance.strength(e);
        // Neither a crack nor a new peak: most points at most times, and the bound needs no trigonometry.
        let bound = largest_eigenvalue_bound(&stress);
        if bound <= peak.tension.min(strength)
            && resistance.as_weakest(bound, strength) <= peak.as_weakest
        {
            continue;
        }
        let tension = largest_eigenvalue(&stress);
        peak.tension = peak.tension.max(tension);
        let felt = resistance.as_weakest(tension, strength);
        peak.as_weakest = peak.as_weakest.max(felt);
        if tension > strength {
            candidates.push((tension, e));
        }
    }
    candidates.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
    for (_, e) in candidates {
        if system.fractured_by[e as usize] == UNCUT {
            try_start(system, field, e, now);
        }
    }
    peak
}

fn try_start(system: &mut CrackSystem, field: &StressField, e: u32, now: f64) {
    let asset = system.asset;
    let material = &asset.material;
    let centre = system.centroids[e as usize];
    let state = field.at_weak_point(e as usize);
    let strength = system.resistance.strength(e);
    let mut releases = std::mem::take(&mut system.releases);
    let stress = released(system, &mut releases, state.stress, e, now);
    system.releases = releases;
    if largest_eigenvalue(&stress) <= strength {
        return;
    }
    // e₀ must pay for its own area: A γ η > A G_c.
    if system.config.first_element_pays
        && material.energy_depth * f64::from(state.energy_density)
            <= system.resistance.toughness.of(e)
    {
        return;
    }
    let normal = opening_direction(&stress, system.seed, e);
    let frame = CrackFrame::new(
        centre,
        normal,
        material.roughness_amplitude,
        material.roughness_wavelength,
        system.seed,
        e,
    );
    let x = asset.fracture.corners(e as usize);
    let values = x.map(|p| frame.planar(p));
    let area = crossing_area(&x, &values);
    if area <= 0.0 || !system.affords(e, area) {
        return;
    }
    let id = system.cracks.len() as u32;
    system.cracks.push(Crack::new(frame));
    let direction = gradient(&x, &values).unwrap_or(normal);
    system.fracture(
        id,
        ElementCut {
            tet: e,
            values,
            direction,
            time: now,
        },
        area,
        state.energy_density,
    );
    if system.config.timing == CrackTiming::Instant {
        advance(system, field, now, f64::INFINITY);
        // An instant crack that ran out of energy is over.
        system.stalled.clear();
    }
}

/// Direction of the largest tension; where the two largest are equal, a seeded direction in their plane.
fn opening_direction(stress: &Symmetric3, seed: u64, e: u32) -> Vec3 {
    let (sigma, axes) = principal_axes(stress);
    if sigma[0] - sigma[1] >= ISOTROPIC * sigma[0] {
        return axes[0].as_vec3();
    }
    // Of the two axes only their plane is known: the angle counts from a fixed direction in it.
    let (a, b) = perpendicular_axes(axes[2].as_vec3());
    let angle = uniform(&mut stream(seed, Purpose::CrackDirection, e)) * std::f64::consts::PI;
    a * angle.cos() as f32 + b * angle.sin() as f32
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rounding_of_an_isotropic_stress_does_not_turn_the_crack() {
        let directions: Vec<Vec3> = [0.0, 3e-7, -3e-7]
            .into_iter()
            .flat_map(|a| [[a, 0.0], [0.0, a], [a, a], [-a, a]])
            .map(|[a, b]| {
                let stress = Symmetric3 {
                    diagonal: [4e7 * (1.0 + a), 4e7 * (1.0 - a), 1e6],
                    off: [4e7 * b, 0.0, 0.0],
                };
                opening_direction(&stress, 5, 17)
            })
            .collect();
        for d in &directions {
            assert!(d.distance(directions[0]) < 1e-5, "{directions:?}");
            assert!(d.z.abs() < 1e-5 && (d.length() - 1.0).abs() < 1e-5);
        }
    }
}
