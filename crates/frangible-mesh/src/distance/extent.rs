//! Boxes along the axes.

use glam::{DMat3, DVec3};

/// A box along the axes by its lowest and highest corner, m; infinite for a body without bounds.
#[derive(Clone, Copy, Debug)]
pub(super) struct Extent {
    pub(super) low: DVec3,
    pub(super) high: DVec3,
}

impl Extent {
    pub(super) const EVERYWHERE: Self = Self {
        low: DVec3::NEG_INFINITY,
        high: DVec3::INFINITY,
    };

    pub(super) fn around(half: DVec3) -> Self {
        Self {
            low: -half,
            high: half,
        }
    }

    /// Distance of `p` to the box, 0 inside.
    pub(super) fn beyond(&self, p: DVec3) -> f64 {
        (self.low - p).max(p - self.high).max(DVec3::ZERO).length()
    }

    pub(super) fn grown(&self, by: f64) -> Self {
        Self {
            low: self.low - by,
            high: self.high + by,
        }
    }

    pub(super) fn union(&self, other: &Self) -> Self {
        Self {
            low: self.low.min(other.low),
            high: self.high.max(other.high),
        }
    }

    pub(super) fn intersection(&self, other: &Self) -> Self {
        Self {
            low: self.low.max(other.low),
            high: self.high.min(other.high),
        }
    }

    pub(super) fn smaller(&self, other: &Self) -> Self {
        if (other.high - other.low).length_squared() < (self.high - self.low).length_squared() {
            *other
        } else {
            *self
        }
    }

    pub(super) fn moved(&self, rotation: DMat3, origin: DVec3, scale: f64) -> Self {
        if !(self.low.is_finite() && self.high.is_finite()) {
            return Self::EVERYWHERE;
        }
        let reach = DMat3::from_cols(
            rotation.x_axis.abs(),
            rotation.y_axis.abs(),
            rotation.z_axis.abs(),
        ) * (0.5 * scale * (self.high - self.low));
        let centre = origin + rotation * (0.5 * scale * (self.high + self.low));
        Self {
            low: centre - reach,
            high: centre + reach,
        }
    }

    pub(super) fn mirrored_x(&self) -> Self {
        let reach = self.high.x.max(0.0);
        Self {
            low: self.low.with_x(-reach),
            high: self.high.with_x(reach),
        }
    }
}
