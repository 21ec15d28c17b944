//! Making and combining bodies by signed distance.

use super::extent::Extent;
use super::{DistanceSolid, Node};
use glam::{DMat3, DQuat, DVec2, DVec3};
use std::f64::consts::PI;

/// Primitives. All lengths in m.
impl DistanceSolid {
    fn around(node: Node, half: DVec3) -> Self {
        Self::within(node, Extent::around(half))
    }

    fn within(node: Node, bounds: Extent) -> Self {
        Self {
            node,
            bounds,
            reach: bounds,
        }
    }

    /// A ball.
    pub fn sphere(centre: DVec3, radius: f64) -> Self {
        Self::round_cone(centre, radius, centre, radius)
    }

    /// An ellipsoid along the axes, by half its lengths.
    pub fn ellipsoid(centre: DVec3, radii: DVec3) -> Self {
        Self::around(Node::Ellipsoid(radii), radii).translated(centre)
    }

    /// All points within `radius` of a segment.
    pub fn capsule(a: DVec3, b: DVec3, radius: f64) -> Self {
        Self::round_cone(a, radius, b, radius)
    }

    /// The hull of two balls.
    pub fn round_cone(a: DVec3, radius_a: f64, b: DVec3, radius_b: f64) -> Self {
        let bounds = Extent {
            low: (a - radius_a).min(b - radius_b),
            high: (a + radius_a).max(b + radius_b),
        };
        let node = Node::RoundCone {
            ends: [a, b],
            radii: [radius_a, radius_b],
        };
        Self::within(node, bounds)
    }

    /// A box around the origin by half its edges; `rounding` is the radius of its edges, within those.
    pub fn rounded_box(half: DVec3, rounding: f64) -> Self {
        let rounding = rounding.min(half.min_element());
        Self::around(Node::Box { half, rounding }, half)
    }

    /// A cylinder around z and the origin; `rounding` is the radius of its rims, within its radius and height.
    pub fn cylinder(radius: f64, half_height: f64, rounding: f64) -> Self {
        let node = Node::Cylinder {
            radius,
            half_height,
            rounding: rounding.min(radius).min(half_height),
        };
        Self::around(node, DVec3::new(radius, radius, half_height))
    }

    /// A torus around z and the origin: radius of the centre line, radius of the section.
    pub fn torus(ring: f64, tube: f64) -> Self {
        let reach = ring + tube;
        Self::around(Node::Torus { ring, tube }, DVec3::new(reach, reach, tube))
    }

    /// A cone around z from `z = 0`, where its radius is `base`, to `z = height`, where it is `top` (0 for a point).
    pub fn cone(base: f64, top: f64, height: f64) -> Self {
        Self::revolved(vec![
            DVec2::ZERO,
            DVec2::new(base, 0.0),
            DVec2::new(top, height),
            DVec2::new(0.0, height),
        ])
    }

    /// All points p with p · `normal` ≤ `offset`; `normal` of any length but 0. Without bounds: to be intersected.
    pub fn half_space(normal: DVec3, offset: f64) -> Self {
        let normal = normal.normalize_or(DVec3::Z);
        let along = normal.abs().cmpge(DVec3::ONE);
        let plane = normal * offset;
        let bounds = Extent {
            low: DVec3::select(
                along & normal.cmplt(DVec3::ZERO),
                plane,
                DVec3::NEG_INFINITY,
            ),
            high: DVec3::select(along & normal.cmpgt(DVec3::ZERO), plane, DVec3::INFINITY),
        };
        Self {
            node: Node::HalfSpace { normal, offset },
            bounds,
            reach: Extent::EVERYWHERE,
        }
    }

    /// Solid of revolution: a closed polygon of (radius, height) points turned around z.
    pub fn revolved(profile: Vec<DVec2>) -> Self {
        let radius = profile.iter().fold(0.0, |most: f64, q| most.max(q.x));
        let low = profile
            .iter()
            .fold(f64::INFINITY, |least, q| least.min(q.y));
        let high = profile
            .iter()
            .fold(f64::NEG_INFINITY, |most, q| most.max(q.y));
        let bounds = Extent {
            low: DVec3::new(-radius, -radius, low),
            high: DVec3::new(radius, radius, high),
        };
        Self::within(Node::Revolved(profile), bounds)
    }

    /// A closed polygon in x and y, extended by `half_height` to both sides along z.
    pub fn prism(outline: Vec<DVec2>, half_height: f64) -> Self {
        let low = outline
            .iter()
            .fold(DVec2::INFINITY, |least, &q| least.min(q));
        let high = outline
            .iter()
            .fold(DVec2::NEG_INFINITY, |most, &q| most.max(q));
        let bounds = Extent {
            low: low.extend(-half_height),
            high: high.extend(half_height),
        };
        Self::within(
            Node::Prism {
                outline,
                half_height,
            },
            bounds,
        )
    }

    /// A tube along points, straight between them, by centre and radius. Nothing for less than two points.
    pub fn tube(line: &[(DVec3, f64)]) -> Option<Self> {
        let parts = line
            .windows(2)
            .map(|ends| Self::round_cone(ends[0].0, ends[0].1, ends[1].0, ends[1].1))
            .collect();
        Self::union_of(parts)
    }
}

/// Operators. All lengths in m.
impl DistanceSolid {
    /// Union of both.
    pub fn union(self, other: Self) -> Self {
        self.smooth_union(other, 0.0)
    }

    /// Union of both, the creases between them filled over about `blend`.
    pub fn smooth_union(self, other: Self, blend: f64) -> Self {
        let swell = 0.25 * blend.max(0.0);
        let reach = self.reach.union(&other.reach).grown(swell);
        Self {
            bounds: if swell > 0.0 {
                reach
            } else {
                self.bounds.union(&other.bounds)
            },
            reach,
            node: Node::Union {
                parts: Box::new([self, other]),
                blend: blend.max(0.0),
            },
        }
    }

    /// Union of all, halved again and again so that few are looked at for one point. Nothing for no parts.
    pub fn union_of(mut parts: Vec<Self>) -> Option<Self> {
        if parts.len() < 2 {
            return parts.pop();
        }
        let rest = parts.split_off(parts.len() / 2);
        Some(Self::union_of(parts)?.union(Self::union_of(rest)?))
    }

    /// Intersection of both.
    pub fn intersection(self, other: Self) -> Self {
        self.smooth_intersection(other, 0.0)
    }

    /// Intersection of both, the edges between them rounded over about `blend`.
    pub fn smooth_intersection(self, other: Self, blend: f64) -> Self {
        Self {
            bounds: self.bounds.intersection(&other.bounds),
            reach: self.reach.smaller(&other.reach),
            node: Node::Intersection {
                parts: Box::new([self, other]),
                blend: blend.max(0.0),
            },
        }
    }

    /// This without `tool`.
    pub fn subtract(self, tool: Self) -> Self {
        self.smooth_subtract(tool, 0.0)
    }

    /// Difference: this without `tool`, the edges of the cut rounded over about `blend`.
    pub fn smooth_subtract(self, tool: Self, blend: f64) -> Self {
        Self {
            bounds: self.bounds,
            reach: self.reach,
            node: Node::Difference {
                parts: Box::new([self, tool]),
                blend: blend.max(0.0),
            },
        }
    }

    fn moved(self, rotation: DMat3, origin: DVec3, scale: f64) -> Self {
        Self {
            bounds: self.bounds.moved(rotation, origin, scale),
            reach: self.reach.moved(rotation, origin, scale),
            node: Node::Moved {
                part: Box::new(self),
                to_part: rotation.transpose(),
                origin,
                scale,
            },
        }
    }

    /// Moved by `way`.
    pub fn translated(mut self, way: DVec3) -> Self {
        if let Node::Moved { origin, .. } = &mut self.node {
            *origin += way;
            self.bounds = self.bounds.moved(DMat3::IDENTITY, way, 1.0);
            self.reach = self.reach.moved(DMat3::IDENTITY, way, 1.0);
            return self;
        }
        self.moved(DMat3::IDENTITY, way, 1.0)
    }

    /// Turned around the origin; `rotation` of length 1.
    pub fn rotated(self, rotation: DQuat) -> Self {
        self.moved(DMat3::from_quat(rotation), DVec3::ZERO, 1.0)
    }

    /// `factor` (above 0) times as large, from the origin.
    pub fn scaled(self, factor: f64) -> Self {
        self.moved(DMat3::IDENTITY, DVec3::ZERO, factor)
    }

    /// The half with x ≥ 0, and its mirror image.
    pub fn mirrored_x(self) -> Self {
        Self {
            bounds: self.bounds.mirrored_x(),
            reach: self.reach.mirrored_x(),
            node: Node::Mirrored(Box::new(self)),
        }
    }

    /// `count` copies turned around z of the part about the positive x axis: of its half with y ≥ 0 and that half's
    /// mirror image, as far as it keeps to its sector.
    pub fn ring(self, count: u32) -> Self {
        let turned = |extent: &Extent| {
            let radius = extent
                .low
                .truncate()
                .abs()
                .max(extent.high.truncate().abs())
                .length();
            Extent {
                low: DVec3::new(-radius, -radius, extent.low.z),
                high: DVec3::new(radius, radius, extent.high.z),
            }
        };
        Self {
            bounds: turned(&self.bounds),
            reach: turned(&self.reach),
            node: Node::Ring {
                part: Box::new(self),
                sector: PI / f64::from(count.max(1)),
            },
        }
    }

    /// Grown by `by` all around, edges rounded; shrunk where it is negative.
    pub fn grown(self, by: f64) -> Self {
        let bounds = if by > 0.0 { self.reach } else { self.bounds };
        Self {
            bounds: bounds.grown(by),
            reach: self.reach.grown(by.max(0.0)),
            node: Node::Grown(Box::new(self), by),
        }
    }

    /// Hollow shell: the part of the body within `wall` of its surface.
    pub fn shell(self, wall: f64) -> Self {
        Self {
            bounds: self.bounds,
            reach: self.reach,
            node: Node::Shell(Box::new(self), wall),
        }
    }
}
