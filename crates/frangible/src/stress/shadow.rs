//! Stress that a crack leaves beside it (beyond the paper).
//!
//! Beside the middle of a crack of half-length a in an infinite wall or solid, at distance y, the share
//! `w = y (y² + (1 + β) a²) / (y² + a²)^1.5` of the tension across it is left:
//! - β = −1 where the wall or solid is stretched, `y³ / (y² + a²)^1.5`: Westergaard's field (J. Appl. Mech. 6, A49, 1939);
//! - β = (1 − ν) / (3 + ν) where a wall is bent: a crack through it, its edges free in the sense of Kirchhoff's theory of plates.
//!
//! The front of another crack in a solid is released less far, since a crack there ends on all sides. Over the middle of a penny of radius a
//! `w = 1 − (2/π) (atan(a/y) − ay/(y² + a²) + 2a³y/(y² + a²)²)` is left (I. N. Sneddon, Proc. R. Soc. A 187 (1946) 229). A crack that is longer than wide
//! lies between a penny and an endless crack of its half-width.
//!
//! w is below 1 and falls as the crack grows. Ahead of the tips nothing is taken: with d the vector to the nearest place of the crack and n its
//! normal there the share is `w' = 1 − (1 − w) (n·d / |d|)²`.
//!
//! A stress σ is released to Q σ Q, `Q = I − (1 − √w') n nᵀ`: across the crack w' of it is left, √w' of the shear along the crack, and all
//! the rest. A closed crack carries pressure: where n·σn is not above zero nothing is taken. Q is a symmetric contraction, so
//! x·QσQx = (Qx)·σ(Qx) ≤ λ_max(σ) |Qx|², and no release raises the largest tension: λ_max(QσQ) ≤ max(λ_max(σ), 0).
//!
//! **A wall that is stretched and bent** has on its two faces the stresses σ_s + σ_b and σ_s − σ_b, and each part is left its own share, w_s and
//! w_b. To release each part by its own Q and to add what is left would break that bound: where the parts have opposite signs
//! across the crack, or opposite shear along it, they hold each other back, and taking more of one sets the other free. So the tension
//! across the crack alone is added up, `w_s n·σ_s n + w_b n·σ_b n`, and its share of n·σn, from 0 to 1, releases the
//! whole: one Q, for which the bound holds. Where one part is zero, or the two shares are equal, this is exactly the release of
//! each part for itself. The same Q goes over both parts, so that they still add up to the whole when the next crack comes.

use std::f32::consts::FRAC_2_PI;

use glam::{Mat3, Vec3};

use super::lanes::StressLanes;
use super::tensor::{Real, Symmetric3, times};
use super::wide::{Wide, narrow, wide};

/// β where a wall or a solid is stretched.
pub const STRETCHED: f32 = -1.0;

/// β where a wall is bent.
#[must_use]
pub fn bent(poisson_ratio: f64) -> f32 {
    ((1.0 - poisson_ratio) / (3.0 + poisson_ratio)) as f32
}

/// Share w of the tension across a crack of this half-length, m, that is left at a distance, m, beside its middle.
#[must_use]
pub fn share_beside(distance: f32, half_length: f32, beta: f32) -> f32 {
    let (y, a) = (distance, half_length);
    let squared = y * y + a * a;
    if squared <= f32::MIN_POSITIVE {
        return 0.0;
    }
    let share = y * (y * y + (1.0 + beta) * a * a) / (squared * squared.sqrt());
    share.min(1.0)
}

/// Share w of the tension across a crack in a solid of this half-width and half-length, m, that is left at a distance, m, beside its middle.
#[must_use]
pub fn share_in_solid(distance: f32, half_width: f32, half_length: f32) -> f32 {
    let (y, a) = (distance, half_width.min(half_length));
    let squared = y * y + a * a;
    if squared <= f32::MIN_POSITIVE {
        return 0.0;
    }
    let (layer, volume) = (a * y / squared, 2.0 * a * a * a * y / (squared * squared));
    let penny = 1.0 - FRAC_2_PI * (libm::atan2f(a, y) - layer + volume);
    let endless = share_beside(y, a, STRETCHED);
    (penny + (endless - penny) * (1.0 - a / half_length)).clamp(0.0, 1.0)
}

/// Share w' that is left at a point: `to_crack` from it to the nearest place of the crack, m, `normal` the crack's unit normal there, and `share` the
/// share w beside its middle at this distance, m.
#[must_use]
pub fn share_left(to_crack: Vec3, normal: Vec3, share: impl Fn(f32) -> f32) -> f32 {
    let squared = to_crack.length_squared();
    if squared <= f32::MIN_POSITIVE {
        return 0.0;
    }
    let beside = (normal.dot(to_crack).powi(2) / squared).min(1.0);
    1.0 - (1.0 - share(squared.sqrt())) * beside
}

/// Shares of the stress that one crack leaves at a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Shadow {
    /// The crack's unit normal.
    pub(crate) normal: Vec3,
    /// Share w_s that is left of the stress that stretches.
    pub(crate) stretched: f32,
    /// Share w_b that is left of the stress that bends.
    pub(crate) bent: f32,
}

impl Symmetric3 {
    /// Stress that a crack of unit normal `n` leaves of this one, with this share of it across the crack: Q σ Q,
    /// Q = I − (1 − √share) n nᵀ. Of pressure it leaves all.
    #[must_use]
    pub fn released(self, n: Vec3, share: f32) -> Self {
        if n.dot(self.times(n)) <= 0.0 {
            return self;
        }
        let q = Mat3::IDENTITY - Mat3::from_cols(n * n.x, n * n.y, n * n.z) * (1.0 - share.sqrt());
        Self::from_mat3(q * self.to_mat3() * q)
    }
}

/// A stress that cracks release, one after the other: at one step, or at all steps of a batch.
pub(crate) struct Released<T> {
    whole: [T; 6],
    /// Bending part of it, in a wall.
    bending: Option<[T; 6]>,
}

impl Released<Wide> {
    /// The stress before any release. `opposite`: the stress behind the middle of the wall, where there is one.
    #[inline(always)]
    pub(crate) fn of_batch(stress: &StressLanes, opposite: Option<&StressLanes>) -> Self {
        let mut released = Self::of_whole(wide(&stress.components));
        if let Some(opposite) = opposite {
            released.bend(&wide(&opposite.components));
        }
        released
    }

    /// Stress that is left, without the energy.
    #[inline(always)]
    pub(crate) fn left_of_batch(&self) -> StressLanes {
        StressLanes {
            components: narrow(self.whole),
            ..StressLanes::default()
        }
    }
}

impl Released<f32> {
    /// The stress before any release. `opposite`: the stress behind the middle of the wall, where there is one.
    pub(crate) fn of_step(stress: Symmetric3, opposite: Option<Symmetric3>) -> Self {
        let mut released = Self::of_whole(stress.components());
        if let Some(opposite) = opposite {
            released.bend(&opposite.components());
        }
        released
    }

    /// Stress that is left.
    pub(crate) fn left(&self) -> Symmetric3 {
        Symmetric3::from_components(self.whole)
    }
}

impl<T: Real> Released<T> {
    #[inline(always)]
    fn of_whole(whole: [T; 6]) -> Self {
        Self {
            whole,
            bending: None,
        }
    }

    /// Takes in the stress behind the middle of the wall.
    #[inline(always)]
    fn bend(&mut self, opposite: &[T; 6]) {
        let mut bending = self.whole;
        for i in 0..6 {
            bending[i] = (self.whole[i] - opposite[i]) * 0.5;
        }
        self.bending = Some(bending);
    }

    /// Takes away what one crack releases.
    #[inline(always)]
    pub(crate) fn release(&mut self, by: &Shadow) {
        let n = by.normal;
        let (traction, across_it) = across(&self.whole, n);
        let Some(bending) = &mut self.bending else {
            let taken = across_it.with(across_it, |nn, _| taken(nn, || by.stretched));
            contract(&mut self.whole, n, traction, across_it, taken);
            return;
        };
        let (bending_traction, of_bending) = across(bending, n);
        let more = by.bent - by.stretched;
        let taken = across_it.with(of_bending, |nn, b| {
            taken(nn, || ((by.stretched * nn + more * b) / nn).clamp(0.0, 1.0))
        });
        contract(&mut self.whole, n, traction, across_it, taken);
        contract(bending, n, bending_traction, of_bending, taken);
    }
}

/// σn and n·σn.
#[inline(always)]
fn across<T: Real>(stress: &[T; 6], n: Vec3) -> ([T; 3], T) {
    let traction = times(stress, n);
    let [x, y, z] = traction;
    (traction, x * n.x + y * n.y + z * n.z)
}

/// 1 − √share of tension, 0 of pressure.
#[inline(always)]
fn taken(across: f32, share: impl Fn() -> f32) -> f32 {
    let taken = 1.0 - share().sqrt();
    if across > 0.0 { taken } else { 0.0 }
}

/// Q σ Q with Q = I − k n nᵀ: σ − k (n tᵀ + t nᵀ) + k² (n·t) n nᵀ, t = σn.
#[inline(always)]
fn contract<T: Real>(stress: &mut [T; 6], n: Vec3, t: [T; 3], across: T, k: T) {
    let (x, y, z) = (t[0] * k, t[1] * k, t[2] * k);
    let back = across * k * k;
    let [xx, yy, zz, xy, yz, zx] = stress;
    *xx = *xx - (x * 2.0 - back * n.x) * n.x;
    *yy = *yy - (y * 2.0 - back * n.y) * n.y;
    *zz = *zz - (z * 2.0 - back * n.z) * n.z;
    *xy = *xy - y * n.x - x * n.y + back * (n.x * n.y);
    *yz = *yz - z * n.y - y * n.z + back * (n.y * n.z);
    *zx = *zx - x * n.z - z * n.x + back * (n.z * n.x);
}

#[cfg(test)]
mod tests;
