//! Supports of a body: parts that are fixed in some or all directions.

use frangible::glam::DVec3;
use frangible_mesh::did_you_mean;

use crate::error::BakeError;
use crate::groups::{Group, Reach};

/// A point nearer to a region than this, in diagonals of the body, lies in it: a face given as `z ≤ 0` holds the nodes
/// on it whatever their rounding.
const TOLERANCE: f64 = 1e-6;

/// Most names of groups in a message.
const MOST_SHOWN: usize = 20;

/// A fixed part of a body.
#[derive(Clone, Debug, PartialEq)]
pub struct Support {
    /// Region whose intersection with the body is fixed.
    pub region: Region,
    /// For each axis of the frame of the shape, true if the part is fixed along it. All three clamp it; z alone lets it slide in the xy plane.
    pub axes: [bool; 3],
}

impl Support {
    /// Makes a support that is fixed along all axes.
    #[must_use]
    pub const fn clamped(region: Region) -> Self {
        Self {
            region,
            axes: [true; 3],
        }
    }
}

/// A region of space, m, in the frame of the shape, or a named part of the body.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Region {
    /// The half-space behind the plane through `point` with the outward `normal`, of any length.
    HalfSpace {
        /// A point of the plane, m.
        point: DVec3,
        /// Direction out of the region.
        normal: DVec3,
    },
    /// An axis-aligned box; corners may be infinite.
    Box {
        /// Lowest corner, m.
        low: DVec3,
        /// Highest corner, m.
        high: DVec3,
    },
    /// A ball.
    Sphere {
        /// Centre of the ball, m.
        centre: DVec3,
        /// Radius of the ball, m.
        radius: f64,
    },
    /// The nodes of a [`Group`] of [`BakeSpec::groups`](crate::BakeSpec::groups): outer nodes within a fifth of their shortest edge of it.
    Group(String),
}

impl Region {
    /// Makes the half-space where the coordinate along `axis` (0: x, 1: y, 2 and above: z) is at most `at`, m.
    #[must_use]
    pub fn below(axis: usize, at: f64) -> Self {
        let normal = DVec3::AXES[axis.min(2)];
        Self::HalfSpace {
            point: normal * at,
            normal,
        }
    }

    /// Makes the half-space where the coordinate along `axis` (0: x, 1: y, 2 and above: z) is at least `at`, m.
    #[must_use]
    pub fn above(axis: usize, at: f64) -> Self {
        let normal = DVec3::AXES[axis.min(2)];
        Self::HalfSpace {
            point: normal * at,
            normal: -normal,
        }
    }

    /// Distance of a point outside the region, m; zero or less within. Infinite for a group, whose nodes are not known here.
    fn gap(&self, p: DVec3) -> f64 {
        match *self {
            Self::HalfSpace { point, normal } => (p - point).dot(normal.normalize_or_zero()),
            Self::Box { low, high } => (low - p).max(p - high).max_element(),
            Self::Sphere { centre, radius } => p.distance(centre) - radius,
            Self::Group(_) => f64::INFINITY,
        }
    }

    /// Returns the fault of its numbers, if there is one, as the rest of a sentence.
    fn problem(&self) -> Option<&'static str> {
        match *self {
            Self::HalfSpace { point, normal } => {
                if !(point.is_finite() && normal.is_finite()) {
                    Some(
                        "has a coordinate or radius that is not finite; give finite numbers in metres",
                    )
                } else if normal.try_normalize().is_none() {
                    Some("has a normal of length zero; give a direction")
                } else {
                    None
                }
            }
            Self::Box { low, high } => {
                if low.is_nan() || high.is_nan() {
                    Some("has a NaN coordinate; give numbers in metres")
                } else if low.cmpgt(high).any() {
                    Some("has a low corner above its high corner; swap them")
                } else {
                    None
                }
            }
            Self::Sphere { centre, radius } => {
                if !(centre.is_finite() && radius.is_finite()) {
                    Some(
                        "has a coordinate or radius that is not finite; give finite numbers in metres",
                    )
                } else if radius <= 0.0 {
                    Some("has a radius that is not above zero; give a positive radius in metres")
                } else {
                    None
                }
            }
            Self::Group(_) => None,
        }
    }
}

/// Checks the numbers of supports, but not the names of groups.
///
/// # Errors
/// The first support without axes or with invalid numbers.
pub fn check_supports(supports: &[Support]) -> Result<(), BakeError> {
    for (support, Support { region, axes }) in supports.iter().enumerate() {
        let axisless = "fixes no axis; set at least one of its axes";
        let none = (*axes == [false; 3]).then_some(axisless);
        if let Some(problem) = region.problem().or(none) {
            return Err(BakeError::Support { support, problem });
        }
    }
    Ok(())
}

/// Checks that every group named by a support exists.
///
/// # Errors
/// The first unknown name, with the most similar known one.
pub fn check_groups(supports: &[Support], groups: &[Group]) -> Result<(), BakeError> {
    supports
        .iter()
        .try_for_each(|support| group_of(&support.region, groups).map(|_| ()))
}

fn group_of<'a>(region: &Region, groups: &'a [Group]) -> Result<Option<&'a Group>, BakeError> {
    let Region::Group(name) = region else {
        return Ok(None);
    };
    if let Some(found) = groups.iter().find(|group| group.name == *name) {
        return Ok(Some(found));
    }
    let names = || groups.iter().map(|group| group.name.as_str());
    let known: Vec<String> = names().take(MOST_SHOWN).map(|n| format!("`{n}`")).collect();
    let hint = did_you_mean(name, names());
    Err(BakeError::UnknownGroup {
        name: name.clone(),
        known: match groups.len() {
            0 => "; this body has no groups (in an OBJ they are named by g, o and usemtl, in a glTF by nodes, meshes and materials)".into(),
            n if n > MOST_SHOWN => format!("{hint}; groups: {} and {} more", known.join(", "), n - MOST_SHOWN),
            _ => format!("{hint}; groups: {}", known.join(", ")),
        },
    })
}

/// The supports of one body.
pub(crate) struct Holder<'a> {
    /// The supports, each with the group that it names, if any.
    supports: Vec<(&'a Support, Option<&'a Group>)>,
    /// Offset from coordinates of the body frame to those of the shape, m.
    origin: DVec3,
    tolerance: f64,
}

impl<'a> Holder<'a> {
    /// `positions`: nodes of the body, in the frame of the shape.
    ///
    /// # Errors
    /// A support without axes, with numbers that cannot be used, or of a group that is not there.
    pub(crate) fn new(
        supports: &'a [Support],
        groups: &'a [Group],
        positions: &[DVec3],
    ) -> Result<Self, BakeError> {
        check_supports(supports)?;
        let low = positions.iter().copied().fold(DVec3::INFINITY, DVec3::min);
        let high = positions
            .iter()
            .copied()
            .fold(DVec3::NEG_INFINITY, DVec3::max);
        Ok(Self {
            supports: supports
                .iter()
                .map(|support| Ok((support, group_of(&support.region, groups)?)))
                .collect::<Result<_, BakeError>>()?,
            origin: DVec3::ZERO,
            tolerance: TOLERANCE * low.distance(high),
        })
    }

    /// The support for positions in a frame whose origin is at `origin` of the frame of the shape.
    pub(crate) fn with_origin(self, origin: DVec3) -> Self {
        Self { origin, ..self }
    }

    /// For each of the points, the axes along which it is held; nothing when there are no supports at all. `elements` are those of
    /// the mesh whose nodes the points are.
    ///
    /// # Errors
    /// A support that holds none of the points (`problem` ends the message), or supports that hold all of them.
    pub(crate) fn axes<const N: usize>(
        &self,
        points: &[DVec3],
        elements: &[[u32; N]],
        problem: &'static str,
    ) -> Result<Vec<[bool; 3]>, BakeError> {
        if self.supports.is_empty() {
            return Ok(Vec::new());
        }
        let by_name = self.supports.iter().any(|(_, group)| group.is_some());
        let mut reach = by_name.then(|| Reach::new(points, elements, self.origin));
        let mut held = vec![[false; 3]; points.len()];
        for (support, (Support { region, axes }, group)) in self.supports.iter().enumerate() {
            let mut holds = false;
            let mut hold = |held: &mut [bool; 3]| {
                holds = true;
                *held = [0, 1, 2].map(|k| held[k] || axes[k]);
            };
            match (group, &mut reach) {
                (Some(group), Some(reach)) => {
                    for v in reach.nodes_on(group) {
                        hold(&mut held[v as usize]);
                    }
                }
                _ => {
                    for (held, &p) in held.iter_mut().zip(points) {
                        if region.gap(p + self.origin) <= self.tolerance {
                            hold(held);
                        }
                    }
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
