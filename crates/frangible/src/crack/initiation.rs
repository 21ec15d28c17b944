//! Cracks start `[G12 §4.4]`: at a weak tetrahedron whose largest principal tension passes R_c (Rankine), across the
//! direction of that tension, through its centre. Where it has a flaw on the free surface (beyond the paper, `stress/skin.rs`)
//! tension and crack are that flaw's: the crack stands upright on the surface, and goes through the flaw.
//!
//! Order within a time step: when the stress passes the strength (instant cracks start together), then falling stress,
//! then element number.
//!
//! The remaining stress after the release by other cracks is costly to find. So it is found last, at the moment when the crack is about to start,
//! and not while the energy ledger cannot pay for it.

use glam::Vec3;

use super::arrival::{Entered, Source};
use super::field::StressField;
use super::single::ElementCut;
use super::surface::CrackFrame;
use super::suspects::{Suspect, Suspects};
use super::system::CrackSystem;
use super::{advance, propagation::gradient, retry};
use crate::rng::{Purpose, stream, uniform};
use crate::stress::{Symmetric3, lane, largest_eigenvalue, perpendicular_axes, principal_axes};

/// Below this relative gap of the two largest tensions the direction between them is rounding noise.
const ISOTROPIC: f64 = 1e-3;

/// The most stressed weak point so far.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Peak {
    /// The largest principal tension, Pa.
    pub(crate) tension: f32,
    /// Tetrahedron of the point that has it, where there is any tension.
    pub(crate) tet: u32,
    /// Largest ratio of stress to strength so far, times the lowest strength, Pa.
    pub(crate) as_weakest: f32,
}

impl Peak {
    /// A peak that no stress exceeds.
    pub(crate) const UNPASSABLE: Self = Self {
        tension: f32::INFINITY,
        tet: 0,
        as_weakest: f32::INFINITY,
    };
}

/// A weak point whose stress passes its strength at a step.
struct Candidate<'a> {
    /// Time at which it does so, s.
    time: f64,
    tension: f32,
    suspect: &'a Suspect,
}

/// Runs and starts all cracks of the field's step, which lasts from one time, s, to another; returns the largest tension met at a weak point so far.
///
/// Instant cracks start at the step, the most stressed first. Others start when their stress, interpolated linearly between steps, exceeds the
/// strength, taking into account the growth and release of earlier cracks; the number of starts does not depend on the step length.
pub(crate) fn crack(
    system: &mut CrackSystem,
    field: &mut StressField,
    suspects: &Suspects,
    [since, now]: [f64; 2],
    peak: Peak,
) -> Peak {
    retry(system, since);
    let instant = system.config.is_paper();
    if instant {
        advance(system, field, now);
    }
    let (mut candidates, peak) = candidates(system, field, suspects, [since, now], peak);
    for candidate in &mut candidates {
        if instant {
            candidate.time = now;
        }
    }
    candidates.sort_unstable_by(|a, b| {
        a.time
            .total_cmp(&b.time)
            .then(b.tension.total_cmp(&a.tension))
            .then(a.suspect.tet.cmp(&b.suspect.tet))
    });
    for Candidate { time, suspect, .. } in candidates {
        if !instant {
            advance(system, field, time);
        }
        if system.gone.is_some() {
            break;
        }
        // The energy stored in a wall that dices pays for all of its cracks.
        let pays = || system.dices || system.may_pay(suspect.place);
        if !system.is_over(suspect.tet, time) && pays() {
            try_start(system, field, suspect, time);
        }
    }
    if !instant {
        advance(system, field, now);
    }
    peak
}

/// Weak points that pass their strength in a step, `times` its beginning and end, s, and are not known to be released.
fn candidates<'a>(
    system: &CrackSystem,
    field: &StressField,
    suspects: &'a Suspects,
    times: [f64; 2],
    peak_so_far: Peak,
) -> (Vec<Candidate<'a>>, Peak) {
    let resistance = system.resistance;
    let k = lane(field.step);
    let mut candidates = Vec::new();
    let mut peak = peak_so_far;
    for suspect in suspects.at(k) {
        let e = suspect.tet;
        if system.is_over(e, times[0]) {
            continue;
        }
        let strength = resistance.strength(e);
        // Neither a crack nor a new peak: most points at most times, and the bound needs no trigonometry.
        let felt = resistance.as_weakest(suspect.bounds[k], strength);
        let may_start =
            suspect.bounds[k] > strength && !system.releases.holds(suspect.place, field.step);
        if !may_start && suspect.bounds[k] <= peak.tension && felt <= peak.as_weakest {
            continue;
        }
        let tension = largest_eigenvalue(&suspect.state.stress(k));
        if tension > peak.tension {
            (peak.tension, peak.tet) = (tension, e);
        }
        let felt = resistance.as_weakest(tension, strength);
        peak.as_weakest = peak.as_weakest.max(felt);
        if may_start && tension > strength {
            let before = largest_eigenvalue(&suspect.state.stress(k - 1));
            let share = ((strength - before) / (tension - before)).clamp(0.0, 1.0);
            // Above it all along, or falling: from the step's beginning on.
            let share = if before >= strength { 0.0 } else { share };
            candidates.push(Candidate {
                time: times[0] + f64::from(share) * (times[1] - times[0]),
                tension,
                suspect,
            });
        }
    }
    (candidates, peak)
}

fn try_start(system: &mut CrackSystem, field: &mut StressField, suspect: &Suspect, now: f64) {
    let asset = system.asset;
    let material = &asset.material;
    let e = suspect.tet;
    let k = lane(field.step);
    let centre = field.weak_position(e as usize);
    let strength = system.resistance.strength(e);
    if system.dices && system.resistance.is_open(e) {
        return system.let_go(e, centre, now);
    }
    let mut releases = std::mem::take(&mut system.releases);
    let left = (releases.may_crack(system, field, suspect, strength, now))
        .then(|| releases.released(system, field, suspect, now));
    system.releases = releases;
    let Some(stress) = left.filter(|left| largest_eigenvalue(left) > strength) else {
        return;
    };
    // The net stress of a face rises with the depth below it, faster than bending falls: the crack does not stop in the compressed layer.
    if system.dices {
        return system.let_go(e, centre, now);
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
    let area = system.area(&x, &values, normal);
    let cost = system.cost(e, area);
    if !system.ledger.has(cost) {
        return system.unpaid.note(suspect.place, cost);
    }
    if area <= 0.0 {
        return;
    }
    let tension = f64::from(normal.dot(suspect.state.stress(k).times(normal)))
        - system.resistance.pressed_at(e);
    let at_surface = field.is_on_surface(e as usize);
    let in_wall = field.wall(e as usize).is_some();
    let flaw = system.flaw_feed(e, at_surface || in_wall);
    let planar = system.config.is_paper();
    let gain = match planar {
        true => material.energy_depth * f64::from(suspect.state.energy_density[k]),
        false => flaw * 0.5 * tension * tension / material.contact_modulus(),
    };
    if !planar && gain <= system.resistance.toughness.of(e) {
        return;
    }
    let id = system.cracks.len() as u32;
    system.add(frame, e);
    (
        system.cracks[id as usize].flaw,
        system.cracks[id as usize].at_surface,
    ) = (flaw, at_surface);
    let direction = match planar {
        true => gradient(&x, &values).unwrap_or(normal),
        false => normal,
    };
    system.fracture(
        id,
        ElementCut {
            tet: e,
            values,
            direction,
            opens: field.opens(e as usize),
            mirror: f32::INFINITY,
            time: now,
        },
        &Entered::at_start(Source {
            place: centre,
            since: now,
        }),
        area,
        f64::from(area) * gain,
    );
    if planar {
        advance(system, field, f64::INFINITY);
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
    let (sin, cos) = libm::sincos(angle);
    a * cos as f32 + b * sin as f32
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
