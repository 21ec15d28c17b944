//! Bodies welded into one across the gaps between them.

use glam::DVec3;

use super::mesh_solid::MeshSolid;
use super::nearest::Nearest;
use crate::solid::{Solid, SurfacePoint, newton};

/// Angle between the ways to two bodies at which a point lies between them, rad: seen from the rim of a gap it soon falls below.
const BETWEEN: f64 = 5.0 / 6.0 * std::f64::consts::PI;

/// Several bodies and what lies between them: points from which two of them are seen in opposite directions, across a gap of at most a given
/// width. Two parallel faces are joined over their common area.
pub struct WeldedSolid {
    bodies: Vec<MeshSolid>,
    gap: f64,
    bounds: [DVec3; 2],
}

impl WeldedSolid {
    /// Welds bodies across gaps of at most this width, m.
    #[must_use]
    pub fn new(bodies: Vec<MeshSolid>, gap: f64) -> Self {
        let nothing = [DVec3::INFINITY, DVec3::NEG_INFINITY];
        let bounds = bodies.iter().fold(nothing, |[low, high], body| {
            let [l, h] = body.bounds();
            [low.min(l), high.max(h)]
        });
        Self {
            bodies,
            // Gaps of exactly this width are filled, whatever their rounding.
            gap: gap * (1.0 + 1e-6),
            bounds,
        }
    }

    /// Depth in the bodies at a point, if it is in any, m.
    fn depth(&self, p: DVec3) -> Option<f64> {
        let holders = self.bodies.iter().filter(|body| body.inside(p));
        let depths = holders.filter_map(|body| body.nearest(p, f64::INFINITY));
        depths.map(|n| n.distance).reduce(f64::max)
    }

    /// The closest places of the bodies: of the nearest body, and of all that a gap may reach.
    fn near(&self, p: DVec3) -> (f64, Vec<Nearest>) {
        let mut least = f64::INFINITY;
        let mut near = Vec::new();
        for body in &self.bodies {
            let [low, high] = body.bounds();
            let beyond = (low - p).max(p - high).max(DVec3::ZERO).length();
            let within = least.max(self.gap);
            if beyond > within {
                continue;
            }
            if let Some(found) = body.nearest(p, within) {
                least = least.min(found.distance);
                near.push(found);
            }
        }
        near.retain(|found| found.distance <= self.gap);
        (least, near)
    }

    /// Signed distance to the filling between two bodies, m, or less.
    fn filling(&self, p: DVec3, one: &Nearest, two: &Nearest) -> f64 {
        let (a, b) = (one.distance, two.distance);
        let too_wide = 0.5 * (a + b - self.gap);
        if a == 0.0 || b == 0.0 {
            return too_wide;
        }
        let angle = (one.position - p).angle_between(two.position - p);
        // A step turns the way to a place by no more than itself over the distance.
        too_wide.max((BETWEEN - angle) / (1.0 / a + 1.0 / b))
    }
}

impl Solid for WeldedSolid {
    fn bounds(&self) -> [DVec3; 2] {
        self.bounds
    }

    fn signed_distance(&self, p: DVec3) -> f64 {
        if let Some(depth) = self.depth(p) {
            return -depth;
        }
        let (least, near) = self.near(p);
        let pairs = near
            .iter()
            .enumerate()
            .flat_map(|(i, one)| near[i + 1..].iter().map(move |two| (one, two)));
        let fillings = pairs.map(|(one, two)| self.filling(p, one, two));
        fillings.fold(least, f64::min)
    }

    /// The closest place of the bodies if it is on the outside, else one of a filling.
    fn closest(&self, p: DVec3) -> SurfacePoint {
        let all = self.bodies.iter();
        let nearest = all
            .filter_map(|body| body.nearest(p, f64::INFINITY))
            .min_by(|a, b| a.distance.total_cmp(&b.distance));
        let [low, high] = self.bounds;
        let step = 1e-6 * (high - low).max_element();
        match nearest {
            Some(n) if !self.inside(n.position + step * n.normal) => SurfacePoint {
                position: n.position,
                normal: n.normal,
            },
            _ => {
                let slope = |x| self.gradient(x);
                let (position, _, normal) = newton(p, f64::INFINITY, self.bounds, slope);
                SurfacePoint { position, normal }
            }
        }
    }
}
