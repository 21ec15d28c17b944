//! The distance with its gradient, in one walk down the tree: seven evaluations for the price of little more than one.

use glam::{DVec2, DVec3};

use super::{DistanceSolid, Node, fold, nearer_first, padded, primitives, smooth_max, smooth_min};

/// Step of differences, in sizes of a primitive.
const STEP: f64 = 1e-6;

type Sloped = (f64, DVec3);

impl DistanceSolid {
    /// [`DistanceSolid::value`] and its gradient, where it is below `cutoff`; on a crease, that of one side.
    pub(super) fn sloped(&self, p: DVec3, cutoff: f64) -> Sloped {
        match &self.node {
            Node::Ellipsoid(radii) => primitives::sloped_ellipsoid(p, *radii),
            Node::RoundCone {
                ends: [a, b],
                radii,
            } => primitives::sloped_round_cone(p, *a, radii[0], *b, radii[1]),
            &Node::HalfSpace { normal, offset } => {
                (primitives::half_space(p, normal, offset), normal)
            }
            Node::Box { .. }
            | Node::Cylinder { .. }
            | Node::Torus { .. }
            | Node::Revolved(_)
            | Node::Prism { .. } => self.differences(p),
            Node::Union { parts, blend } => union(parts, *blend, p, cutoff),
            Node::Intersection { parts, blend } => {
                let first = parts[0].sloped(p, cutoff);
                if first.0 >= cutoff {
                    first
                } else {
                    max(first, parts[1].sloped(p, cutoff), *blend)
                }
            }
            Node::Difference { parts, blend } => {
                let first = parts[0].sloped(p, cutoff);
                let needed = padded(blend - first.0);
                let beyond = parts[1].reach.beyond(p);
                if first.0 >= cutoff || (beyond > 0.0 && beyond >= needed) {
                    first
                } else {
                    let (value, gradient) = parts[1].sloped(p, needed);
                    max(first, (-value, -gradient), *blend)
                }
            }
            Node::Moved {
                part,
                to_part,
                origin,
                scale,
            } => {
                let place = *to_part * (p - origin) / scale;
                let (value, gradient) = part.sloped(place, padded(cutoff / scale));
                (scale * value, to_part.transpose() * gradient)
            }
            Node::Mirrored(part) => {
                let (value, gradient) = part.sloped(DVec3::new(p.x.abs(), p.y, p.z), cutoff);
                (value, gradient.with_x(gradient.x * p.x.signum()))
            }
            Node::Ring { part, sector } => {
                let (value, gradient) = part.sloped(fold(p, *sector), cutoff);
                // Back through the mirror, then back round.
                let angle = p.truncate().to_angle();
                let turn = 2.0 * sector * (0.5 * angle / sector).round();
                let side = (angle - turn).signum();
                let across = DVec2::new(gradient.x, side * gradient.y);
                let across = DVec2::from_angle(turn).rotate(across);
                (value, across.extend(gradient.z))
            }
            Node::Grown(part, by) => {
                let (value, gradient) = part.sloped(p, padded(cutoff + by));
                (value - by, gradient)
            }
            Node::Shell(part, wall) => {
                let (value, gradient) = part.sloped(p, cutoff);
                if value >= -value - wall {
                    (value, gradient)
                } else {
                    (-value - wall, -gradient)
                }
            }
        }
    }

    /// Distance and gradient by central differences, of one primitive alone.
    fn differences(&self, p: DVec3) -> Sloped {
        let h = STEP * (self.bounds.high - self.bounds.low).max_element();
        let value = |p: DVec3| self.value(p, f64::INFINITY);
        let along = |e: DVec3| (value(p + h * e) - value(p - h * e)) / (2.0 * h);
        let gradient = DVec3::new(along(DVec3::X), along(DVec3::Y), along(DVec3::Z));
        (value(p), gradient)
    }
}

/// The union of two parts, blended over a length, m, with its gradient: passes over a part where the union of values does.
fn union(parts: &[DistanceSolid; 2], blend: f64, p: DVec3, cutoff: f64) -> Sloped {
    let (near, far, at_far) = nearer_first(parts, p);
    let cutoff = padded(cutoff + 1.25 * blend);
    let first = near.sloped(p, cutoff);
    let needed = padded(first.0 + blend).min(cutoff);
    if at_far > 0.0 && at_far >= needed {
        first
    } else {
        let second = far.sloped(p, needed);
        let value = smooth_min(first.0, second.0, blend);
        (value, mixed(first.1, second.1, second.0 - first.0, blend))
    }
}

fn max(first: Sloped, second: Sloped, blend: f64) -> Sloped {
    let value = smooth_max(first.0, second.0, blend);
    (value, mixed(first.1, second.1, first.0 - second.0, blend))
}

/// Gradient of a smooth minimum or maximum whose first operand is ahead by `lead`, m.
fn mixed(first: DVec3, second: DVec3, lead: f64, blend: f64) -> DVec3 {
    let (ahead, behind) = if lead >= 0.0 {
        (first, second)
    } else {
        (second, first)
    };
    if blend <= 0.0 || lead.abs() >= blend {
        return ahead;
    }
    ahead.lerp(behind, 0.5 * (1.0 - lead.abs() / blend))
}
