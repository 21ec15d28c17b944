//! Release waves (Mott 1947; beyond the paper): a new free surface unloads the material around it at wave speed.
//!
//! At a point x and time t every crack that has a fractured tetrahedron e' with
//! `|x − x_e'| < min(c_R (t − t_e'), κ a)` takes away the stress across it: σ ← P σ P, P = I − n nᵀ, n the crack's
//! normal at the nearest such tetrahedron, a the crack's present length. In crack order: projections do not commute.
//!
//! Both limits only grow with time, so what has released a point once releases it for good. A point therefore looks at
//! each fractured tetrahedron once: it keeps the nearest one that has released it and, of those still to come, only
//! the ones that no nearer one will precede.

use std::collections::HashMap;

use glam::Vec3;

use super::system::{Crack, CrackSystem};
use crate::config::CrackTiming;
use crate::stress::{Symmetric3, largest_eigenvalue};

/// What a point knows of one crack.
#[derive(Clone, Debug)]
struct Seen {
    /// How many of the crack's tetrahedra it has looked at.
    scanned: usize,
    /// Nearest one that has released it: distance, m, and the crack's normal there.
    nearest: (f32, Vec3),
    /// Those to come: nearer means later. Distance, m; arrival of the wave, s; index in the crack.
    pending: Vec<(f32, f64, u32)>,
}

/// Memory of the points that have asked. Looked up only, never iterated.
#[derive(Default)]
pub(crate) struct Releases {
    points: HashMap<u32, Vec<Seen>>,
}

/// What is left of `stress` at the centre of tetrahedron `e` at time `now`, s; stops early once it is below `enough`, Pa.
pub(crate) fn released(
    system: &CrackSystem,
    releases: &mut Releases,
    stress: Symmetric3,
    e: u32,
    now: f64,
    enough: f32,
) -> Symmetric3 {
    let CrackTiming::TimeResolved { release_reach, .. } = system.config.timing else {
        return stress;
    };
    let point = system.asset.fracture.centroid(e as usize);
    let wave = system.asset.material.rayleigh_speed();
    let known = releases.points.entry(e).or_default();
    let mut left = stress;
    for (i, crack) in system.cracks.iter().enumerate() {
        let reach = release_reach as f32 * (2.0 * crack.extent).max(system.edge);
        if i == known.len() {
            known.push(Seen {
                scanned: 0,
                nearest: (f32::INFINITY, Vec3::ZERO),
                pending: Vec::new(),
            });
        }
        let seen = &mut known[i];
        if point.distance(crack.frame.origin) > crack.extent + reach {
            continue;
        }
        look(seen, crack, system, point, wave);
        arrive(seen, crack, now, reach);
        if seen.nearest.0.is_finite() {
            left = left.released(seen.nearest.1);
            // A projection never raises the largest tension.
            if largest_eigenvalue(&left) <= enough {
                return left;
            }
        }
    }
    left
}

/// Looks at the tetrahedra that have joined since the last time.
fn look(seen: &mut Seen, crack: &Crack, system: &CrackSystem, point: Vec3, wave: f64) {
    for (k, cut) in crack.elements.iter().enumerate().skip(seen.scanned) {
        let distance = system
            .asset
            .fracture
            .centroid(cut.tet as usize)
            .distance(point);
        let arrival = cut.time + f64::from(distance) / wave;
        let beaten = seen.nearest.0 <= distance
            || seen
                .pending
                .iter()
                .any(|p| p.0 <= distance && p.1 <= arrival);
        if !beaten {
            seen.pending.retain(|p| p.0 < distance || p.1 < arrival);
            seen.pending.push((distance, arrival, k as u32));
        }
    }
    seen.scanned = crack.elements.len();
}

/// Lets those arrive whose wave is here and that lie within reach.
fn arrive(seen: &mut Seen, crack: &Crack, now: f64, reach: f32) {
    for &(distance, arrival, k) in &seen.pending {
        if arrival < now && distance < reach && distance < seen.nearest.0 {
            seen.nearest = (distance, crack.elements[k as usize].direction);
        }
    }
    let nearest = seen.nearest.0;
    seen.pending.retain(|p| p.0 < nearest);
}
