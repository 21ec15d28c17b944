//! A star of cracks under a contact, and the compliance that it adds to the wall.
//!
//! n arms of length L leave n cantilevers that are clamped at the distance L and pushed at their tips. A tip of angle 2π/n bends to a constant
//! curvature, as its width grows with the distance like the moment. Together they have the compliance `L² / 4 n D tan(π/n)`. The whole wall within L
//! had `L² / 16 π D` (a clamped disc), which the modes and wall oscillators have already: the star adds the difference. Two arms are one crack, along
//! which the wall still bends as one.

use std::f32::consts::TAU;
use std::f64::consts::PI;

use crate::crack::CrackSystem;
use crate::near_field::NearPlace;
use crate::stress::perpendicular_axes;

/// Fewest arms of a star.
const FEWEST: usize = 3;

/// Least distance of arms from the contact, in thicknesses of the wall: nearer, every crack lies in all directions.
const FROM: f64 = 2.0;

/// Least angle between the directions of different arms, rad.
const APART: f32 = 0.4;

/// Cantilevers between the arms of a star of cracks under a contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Star {
    /// Length that at least three arms reach, m.
    length: f64,
    /// Number of arms longer than 0.8 of it.
    arms: usize,
}

impl Star {
    /// Finds the star that cracks have cut about a contact; none with fewer than three arms.
    pub(super) fn of(system: &CrackSystem, place: &NearPlace, thickness: f64) -> Option<Self> {
        let (u, v) = perpendicular_axes(place.inwards);
        let nearest = (FROM * thickness) as f32;
        // Direction and distance of places where a crack runs out from the contact, or in to it.
        let mut places: Vec<(f32, f32)> = Vec::new();
        for site in system.cracks.iter().flat_map(|crack| crack.sites.list()) {
            let away = site.position - place.point;
            let away = away - away.dot(place.inwards) * place.inwards;
            let distance = away.length();
            if !site.time.is_finite() || distance <= nearest || distance >= place.reach as f32 {
                continue;
            }
            let angle = libm::atan2f(away.dot(v), away.dot(u));
            if site.direction.dot(away).abs() < 0.5 * distance {
                places.push((angle, distance));
            }
        }
        places.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
        let mut lengths: Vec<f32> = Vec::new();
        let mut previous = f32::NEG_INFINITY;
        for &(angle, distance) in &places {
            match lengths.last_mut() {
                Some(length) if angle - previous < APART => *length = length.max(distance),
                _ => lengths.push(distance),
            }
            previous = angle;
        }
        // The last arm may be the first one, across the angle ±π.
        if lengths.len() > 1
            && let (Some(first), Some(last)) = (places.first(), places.last())
            && first.0 + TAU - last.0 < APART
            && let Some(length) = lengths.pop()
        {
            lengths[0] = lengths[0].max(length);
        }
        lengths.sort_unstable_by(|a, b| b.total_cmp(a));
        let length = *lengths.get(FEWEST - 1)?;
        Some(Self {
            length: f64::from(length),
            arms: lengths.iter().filter(|l| **l > 0.8 * length).count(),
        })
    }

    /// Compliance that the star adds to the wall, m/N, for this bending stiffness, N·m.
    pub(super) fn compliance(&self, bending_stiffness: f64) -> f64 {
        let Self { length, arms } = *self;
        let n = arms as f64;
        let tips = 1.0 / (4.0 * n * libm::tan(PI / n));
        let whole = 1.0 / (16.0 * PI);
        length * length * (tips - whole) / bending_stiffness
    }
}

#[cfg(test)]
mod tests {
    use super::Star;

    #[test]
    fn more_and_longer_arms_give_way_more() {
        let star = |length, arms| Star { length, arms }.compliance(2.0);
        assert!(star(0.02, 3) > 0.0);
        assert!((star(0.02, 3) / star(0.01, 3) - 4.0).abs() < 1e-12);
        for arms in 3..12 {
            assert!(star(0.01, arms + 1) > star(0.01, arms));
        }
        // Very many arms: tips of no width, L²/4πD in all.
        let many = star(1.0, 100_000) * 2.0 + 1.0 / (16.0 * std::f64::consts::PI);
        assert!((many * 4.0 * std::f64::consts::PI - 1.0).abs() < 1e-6);
    }
}
