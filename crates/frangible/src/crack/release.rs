//! Release waves (Mott 1947; beyond the paper): a new free surface unloads the material around it at wave speed.
//!
//! At a point x and time t every crack that has a fractured tetrahedron e' with
//! `|x − x_e'| < min(c_R (t − t_e'), κ a)` takes away the stress across it: σ ← P σ P, P = I − n nᵀ, n the crack's
//! normal at the nearest such tetrahedron, a the crack's present length. In crack order: projections do not commute.

use glam::Vec3;

use super::system::CrackSystem;
use crate::config::CrackTiming;
use crate::stress::Symmetric3;

/// What is left of `stress` at `point` at time `now`, s.
pub(crate) fn released(
    system: &CrackSystem,
    stress: Symmetric3,
    point: Vec3,
    now: f64,
) -> Symmetric3 {
    let CrackTiming::TimeResolved { release_reach, .. } = system.config.timing else {
        return stress;
    };
    let wave = system.asset.material.rayleigh_speed() as f32;
    let mut left = stress;
    for crack in &system.cracks {
        let reach = release_reach as f32 * (2.0 * crack.extent).max(system.edge);
        if point.distance(crack.frame.origin) > crack.extent + reach {
            continue;
        }
        let mut nearest = (f32::INFINITY, Vec3::ZERO);
        for cut in &crack.elements {
            let distance = system
                .asset
                .fracture
                .centroid(cut.tet as usize)
                .distance(point);
            if distance < reach.min(wave * (now - cut.time) as f32) && distance < nearest.0 {
                nearest = (distance, cut.direction);
            }
        }
        if nearest.0.is_finite() {
            left = left.released(nearest.1);
        }
    }
    left
}
