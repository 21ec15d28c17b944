//! Bodies by signed distance: primitives, put together by operators.
//!
//! Every value is a bound: its sign is right, its magnitude never larger than the true distance, and between two
//! points it differs by no more than they are apart. Boxes around the parts spare most evaluations and change no bit
//! of the result.

mod build;
mod extent;
mod march;
pub mod operators;
pub mod primitives;

pub use march::first_hit;

use crate::Solid;
use extent::Extent;
use glam::{DMat3, DVec2, DVec3};
use operators::{smooth_max, smooth_min};

/// A body by signed distance, a tree of primitives and operators.
#[derive(Clone, Debug)]
pub struct DistanceSolid {
    node: Node,
    /// Holds the body.
    bounds: Extent,
    /// No value outside this box is smaller than the distance to it: more than to hold the body, and what may be clipped off
    /// `bounds` may not be clipped here.
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
    Grown(Box<DistanceSolid>, f64),
    Shell(Box<DistanceSolid>, f64),
}

impl DistanceSolid {
    fn value(&self, p: DVec3) -> f64 {
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
            Node::Union { parts, blend } => {
                let [a, b] = parts.as_ref();
                let (at_a, at_b) = (a.reach.beyond(p), b.reach.beyond(p));
                let (near, far, at_far) = if at_a <= at_b {
                    (a, b, at_b)
                } else {
                    (b, a, at_a)
                };
                let value = near.value(p);
                if at_far > 0.0 && at_far >= value + blend {
                    value
                } else {
                    smooth_min(value, far.value(p), *blend)
                }
            }
            Node::Intersection { parts, blend } => {
                smooth_max(parts[0].value(p), parts[1].value(p), *blend)
            }
            Node::Difference { parts, blend } => {
                let value = parts[0].value(p);
                let beyond = parts[1].reach.beyond(p);
                if beyond > 0.0 && -beyond <= value - blend {
                    value
                } else {
                    smooth_max(value, -parts[1].value(p), *blend)
                }
            }
            Node::Moved {
                part,
                to_part,
                origin,
                scale,
            } => scale * part.value(*to_part * (p - origin) / scale),
            Node::Mirrored(part) => part.value(DVec3::new(p.x.abs(), p.y, p.z)),
            Node::Grown(part, by) => part.value(p) - by,
            Node::Shell(part, wall) => {
                let value = part.value(p);
                value.max(-value - wall)
            }
        }
    }
}

impl Solid for DistanceSolid {
    fn bounds(&self) -> [DVec3; 2] {
        // Past the box the value is positive; on it, it may be zero.
        let Extent { low, high } = self.bounds;
        let margin = DVec3::splat(1e-6 * (high - low).max_element());
        [low - margin, high + margin]
    }

    fn signed_distance(&self, p: DVec3) -> f64 {
        self.value(p)
    }
}
