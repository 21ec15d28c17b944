//! What holds a body: parts of it that do not move, in all directions or in some.

use frangible::glam::DVec3;

use crate::error::BakeError;

/// A point nearer to a region than this, in diagonals of the body, lies in it: a face given as `z ≤ 0` holds the nodes
/// on it whatever their rounding.
const TOLERANCE: f64 = 1e-6;

/// A part of a body that something outside holds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Support {
    /// Which part; what of it lies outside the body does not matter.
    pub region: Region,
    /// Along which axes of the frame of the shape it is held: all of them clamp it, z alone lets it slide in the
    /// plane across z.
    pub axes: [bool; 3],
}

impl Support {
    /// Held along all axes.
    #[must_use]
    pub const fn clamped(region: Region) -> Self {
        Self {
            region,
            axes: [true; 3],
        }
    }
}

/// A part of space, m, in the frame of the shape.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Region {
    /// Everything behind the plane through `point` with the outward `normal` (of any length).
    HalfSpace {
        /// A point of the plane, m.
        point: DVec3,
        /// Away from the region.
        normal: DVec3,
    },
    /// A box along the axes; a corner may be infinite.
    Box {
        /// Lowest corner, m.
        low: DVec3,
        /// Highest corner, m.
        high: DVec3,
    },
    /// A ball.
    Sphere {
        /// Its centre, m.
        centre: DVec3,
        /// Its radius, m.
        radius: f64,
    },
}

impl Region {
    /// Everything whose coordinate along `axis` (0 x, 1 y, 2 z and above) is `at` m or less.
    #[must_use]
    pub fn below(axis: usize, at: f64) -> Self {
        let normal = DVec3::AXES[axis.min(2)];
        Self::HalfSpace {
            point: normal * at,
            normal,
        }
    }

    /// Everything whose coordinate along `axis` (0 x, 1 y, 2 z and above) is `at` m or more.
    #[must_use]
    pub fn above(axis: usize, at: f64) -> Self {
        let normal = DVec3::AXES[axis.min(2)];
        Self::HalfSpace {
            point: normal * at,
            normal: -normal,
        }
    }

    /// How far a point lies outside, m; zero or less within.
    fn gap(&self, p: DVec3) -> f64 {
        match *self {
            Self::HalfSpace { point, normal } => (p - point).dot(normal.normalize_or_zero()),
            Self::Box { low, high } => (low - p).max(p - high).max_element(),
            Self::Sphere { centre, radius } => p.distance(centre) - radius,
        }
    }

    /// What is wrong with its numbers, as the rest of a sentence.
    fn problem(&self) -> Option<&'static str> {
        match *self {
            Self::HalfSpace { point, normal } => {
                if !(point.is_finite() && normal.is_finite()) {
                    Some("has a number that is not finite; give metres")
                } else if normal.try_normalize().is_none() {
                    Some("has a normal of no length; give a direction")
                } else {
                    None
                }
            }
            Self::Box { low, high } => {
                if low.is_nan() || high.is_nan() {
                    Some("has a number that is not a number; give metres")
                } else if low.cmpgt(high).any() {
                    Some("has a low corner above its high one; swap them")
                } else {
                    None
                }
            }
            Self::Sphere { centre, radius } => {
                if !(centre.is_finite() && radius.is_finite()) {
                    Some("has a number that is not finite; give metres")
                } else if radius <= 0.0 {
                    Some("has a radius that is not above zero; give metres")
                } else {
                    None
                }
            }
        }
    }
}

/// The supports of one body.
pub(crate) struct Holder<'a> {
    supports: &'a [Support],
    /// From the body's frame to that of the shape, m.
    origin: DVec3,
    tolerance: f64,
}

impl<'a> Holder<'a> {
    /// `positions`: nodes of the body, in the frame of the shape.
    ///
    /// # Errors
    /// A support without axes, or with numbers that cannot be used.
    pub(crate) fn new(supports: &'a [Support], positions: &[DVec3]) -> Result<Self, BakeError> {
        for (support, Support { region, axes }) in supports.iter().enumerate() {
            let axisless = "holds along no axis; set one of its axes";
            let none = (*axes == [false; 3]).then_some(axisless);
            if let Some(problem) = region.problem().or(none) {
                return Err(BakeError::Support { support, problem });
            }
        }
        let low = positions.iter().copied().fold(DVec3::INFINITY, DVec3::min);
        let high = positions
            .iter()
            .copied()
            .fold(DVec3::NEG_INFINITY, DVec3::max);
        Ok(Self {
            supports,
            origin: DVec3::ZERO,
            tolerance: TOLERANCE * low.distance(high),
        })
    }

    /// The same for positions in a frame whose origin is at `origin` of the frame of the shape.
    pub(crate) fn with_origin(self, origin: DVec3) -> Self {
        Self { origin, ..self }
    }

    /// Along which axes each of the points is held; nothing when there are no supports at all.
    ///
    /// # Errors
    /// A support that holds none of the points (`problem` says what it means), or supports that hold all of them.
    pub(crate) fn axes(
        &self,
        points: &[DVec3],
        problem: &'static str,
    ) -> Result<Vec<[bool; 3]>, BakeError> {
        if self.supports.is_empty() {
            return Ok(Vec::new());
        }
        let mut held = vec![[false; 3]; points.len()];
        for (support, Support { region, axes }) in self.supports.iter().enumerate() {
            let mut holds = false;
            for (held, &p) in held.iter_mut().zip(points) {
                if region.gap(p + self.origin) <= self.tolerance {
                    holds = true;
                    *held = [0, 1, 2].map(|k| held[k] || axes[k]);
                }
            }
            if !holds {
                return Err(BakeError::Support { support, problem });
            }
        }
        if held.iter().all(|h| *h == [true; 3]) {
            return Err(BakeError::AllHeld);
        }
        Ok(held)
    }
}
