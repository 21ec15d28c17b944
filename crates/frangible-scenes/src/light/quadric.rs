//! Quadric errors of places.

use frangible::glam::{DMat3, DVec3};

/// Weight that keeps the best place near the middle where planes leave it free, of the planes' weight.
const TIE: f64 = 1e-3;

/// Sum of the squared distances from planes, weighted by area [Garland & Heckbert 1997].
#[derive(Clone, Copy)]
pub(super) struct Quadric {
    squares: DMat3,
    linear: DVec3,
    constant: f64,
    weight: f64,
}

impl Quadric {
    pub(super) const ZERO: Self = Self {
        squares: DMat3::ZERO,
        linear: DVec3::ZERO,
        constant: 0.0,
        weight: 0.0,
    };

    pub(super) fn of_plane(point: DVec3, normal: DVec3, weight: f64) -> Self {
        let d = -normal.dot(point);
        let outer = DMat3::from_cols(normal.x * normal, normal.y * normal, normal.z * normal);
        Self {
            squares: weight * outer,
            linear: weight * d * normal,
            constant: weight * d * d,
            weight,
        }
    }

    pub(super) fn add(&mut self, other: &Self) {
        self.squares += other.squares;
        self.linear += other.linear;
        self.constant += other.constant;
        self.weight += other.weight;
    }

    /// Mean of the squared distances.
    pub(super) fn at(&self, p: DVec3) -> f64 {
        let sum = p.dot(self.squares * p) + 2.0 * self.linear.dot(p) + self.constant;
        if self.weight > 0.0 {
            (sum / self.weight).max(0.0)
        } else {
            0.0
        }
    }

    /// The place with the least sum, the one nearest to `middle` where there are several.
    pub(super) fn best(&self, middle: DVec3) -> DVec3 {
        let tie = TIE * self.weight;
        let sum = self.squares + DMat3::from_diagonal(DVec3::splat(tie));
        let place = sum.inverse() * (tie * middle - self.linear);
        if place.is_finite() { place } else { middle }
    }
}
