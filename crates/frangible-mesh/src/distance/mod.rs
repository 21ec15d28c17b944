//! Bodies by signed distance: primitives, put together by operators.
//!
//! Every value is a bound: its sign is right, its magnitude never larger than the true distance, and between two
//! points it differs by no more than they are apart. Boxes around the parts spare most evaluations and change no bit
//! of the result.

mod build;
mod extent;
mod gradient;
mod march;
pub mod operators;
pub mod primitives;

pub use march::first_hit;

use crate::Solid;
use crate::solid::newton;
use extent::Extent;
use glam::{DMat3, DVec2, DVec3};
use operators::{smooth_max, smooth_min};

/// A body by signed distance, a tree of primitives and operators.
#[derive(Clone, Debug)]
pub struct DistanceSolid {
    node: Node,
    /// Box that holds the body.
    bounds: Extent,
    /// Box outside which no value is smaller than the distance to it. It may be larger than `bounds`, which can be clipped where this one may
    /// not be.
    reach: Extent,
}

#[derive(Clone, Debug)]
enum Node {
    Ellipsoid(DVec3),
    RoundCone {
        ends: [DVec3; 2],
        radii: [f64; 2],
    },
    Box {
        half: DVec3,
        rounding: f64,
    },
    Cylinder {
        radius: f64,
        half_height: f64,
        rounding: f64,
    },
    Torus {
        ring: f64,
        tube: f64,
    },
    HalfSpace {
        normal: DVec3,
        offset: f64,
    },
    Revolved(Vec<DVec2>),
    Prism {
        outline: Vec<DVec2>,
        half_height: f64,
    },
    Union {
        parts: Box<[DistanceSolid; 2]>,
        blend: f64,
    },
    Intersection {
        parts: Box<[DistanceSolid; 2]>,
        blend: f64,
    },
    /// The first without the second.
    Difference {
        parts: Box<[DistanceSolid; 2]>,
        blend: f64,
    },
    Moved {
        part: Box<DistanceSolid>,
        to_part: DMat3,
        origin: DVec3,
        scale: f64,
    },
    Mirrored(Box<DistanceSolid>),
    Ring {
        part: Box<DistanceSolid>,
        /// Half the angle from one to the next, rad.
        sector: f64,
    },
    Grown(Box<DistanceSolid>, f64),
    Shell(Box<DistanceSolid>, f64),
}

impl DistanceSolid {
    /// The distance where it is below `cutoff`, anything from `cutoff` up where it is not: what the caller needs no
    /// closer is not worked out.
    fn value(&self, p: DVec3, cutoff: f64) -> f64 {
        match &self.node {
            Node::Ellipsoid(radii) => primitives::ellipsoid(p, *radii),
            Node::RoundCone {
                ends: [a, b],
                radii,
            } => primitives::round_cone(p, *a, radii[0], *b, radii[1]),
            Node::Box { half, rounding } => primitives::rounded_box(p, *half, *rounding),
            &Node::Cylinder {
                radius,
                half_height,
                rounding,
            } => primitives::cylinder(p, radius, half_height, rounding),
            &Node::Torus { ring, tube } => primitives::torus(p, ring, tube),
            &Node::HalfSpace { normal, offset } => primitives::half_space(p, normal, offset),
            Node::Revolved(profile) => primitives::revolved(p, profile),
            Node::Prism {
                outline,
                half_height,
            } => primitives::prism(p, outline, *half_height),
            Node::Union { parts, blend } => union(parts, *blend, p, cutoff),
            Node::Intersection { parts, blend } => {
                let value = parts[0].value(p, cutoff);
                if value >= cutoff {
                    value
                } else {
                    smooth_max(value, parts[1].value(p, cutoff), *blend)
                }
            }
            Node::Difference { parts, blend } => {
                let value = parts[0].value(p, cutoff);
                let needed = padded(blend - value);
                let beyond = parts[1].reach.beyond(p);
                if value >= cutoff || (beyond > 0.0 && beyond >= needed) {
                    value
                } else {
                    smooth_max(value, -parts[1].value(p, needed), *blend)
                }
            }
            Node::Moved {
                part,
                to_part,
                origin,
                scale,
            } => scale * part.value(*to_part * (p - origin) / scale, padded(cutoff / scale)),
            Node::Mirrored(part) => part.value(DVec3::new(p.x.abs(), p.y, p.z), cutoff),
            Node::Ring { part, sector } => part.value(fold(p, *sector), cutoff),
            Node::Grown(part, by) => part.value(p, padded(cutoff + by)) - by,
            Node::Shell(part, wall) => {
                let value = part.value(p, cutoff);
                value.max(-value - wall)
            }
        }
    }
}

/// The part whose reach is nearer to a point, the other one, and how far that one's reach is away, m.
fn nearer_first([a, b]: &[DistanceSolid; 2], p: DVec3) -> (&DistanceSolid, &DistanceSolid, f64) {
    let (at_a, at_b) = (a.reach.beyond(p), b.reach.beyond(p));
    if at_a <= at_b {
        (a, b, at_b)
    } else {
        (b, a, at_a)
    }
}

fn union(parts: &[DistanceSolid; 2], blend: f64, p: DVec3, cutoff: f64) -> f64 {
    let (near, far, at_far) = nearer_first(parts, p);
    // Beyond this, a part changes no union that is below `cutoff`: the other is then less than blend/4 above that.
    let cutoff = padded(cutoff + 1.25 * blend);
    let value = near.value(p, cutoff);
    let needed = padded(value + blend).min(cutoff);
    if at_far > 0.0 && at_far >= needed {
        value
    } else {
        smooth_min(value, far.value(p, needed), blend)
    }
}

/// A little more, so that rounding on the way cuts nothing off.
fn padded(cutoff: f64) -> f64 {
    cutoff + 1e-12 * cutoff.abs()
}

/// The point of the sector, from the x axis to `half_angle`, that turns and mirror images bring to `p`.
fn fold(p: DVec3, half_angle: f64) -> DVec3 {
    let across = p.truncate();
    let angle = across.to_angle();
    let folded = (angle - 2.0 * half_angle * (0.5 * angle / half_angle).round()).abs();
    DVec2::from_angle(folded).extend(0.0) * across.length() + p.z * DVec3::Z
}

impl Solid for DistanceSolid {
    fn bounds(&self) -> [DVec3; 2] {
        // Past the box the value is positive; on it, it may be zero.
        let Extent { low, high } = self.bounds;
        let margin = DVec3::splat(1e-6 * (high - low).max_element());
        [low - margin, high + margin]
    }

    fn signed_distance(&self, p: DVec3) -> f64 {
        self.value(p, f64::INFINITY)
    }

    fn gradient(&self, p: DVec3) -> (f64, DVec3) {
        self.sloped(p, f64::INFINITY)
    }

    fn foot(&self, p: DVec3, within: f64) -> Option<DVec3> {
        let (foot, left, _) = newton(p, within, self.bounds(), |x| self.gradient(x));
        (foot.distance(p) <= within && left.abs() <= within).then_some(foot)
    }
}
