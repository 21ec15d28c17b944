//! Kinks of cracks where toughness varies: a crack turns to where it costs least for the energy that it releases.

use glam::Vec3;

use super::resistance::Toughness;
use crate::mesh::{NO_NEIGHBOUR, TetMesh};

/// Kinks that are compared with going straight on, degrees, to either side.
const ANGLES: [f32; 6] = [15.0, 30.0, 45.0, 60.0, 75.0, 90.0];

/// Largest number of tetrahedra between a front and the place it looks at.
const MOST_STEPS: usize = 32;

/// A front of a crack at the tetrahedron it is about to enter.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Tip {
    pub(crate) tet: u32,
    /// Its normal if toughness were the same everywhere.
    pub(crate) normal: Vec3,
    /// Place that it comes from, m.
    pub(crate) from: Vec3,
    /// Distance that it looks ahead, m.
    pub(crate) reach: f32,
}

impl Toughness {
    /// The tip's normal, kinked by the angle θ to which the energy release rate over the toughness is largest:
    /// G(θ)/G_c(θ), G(θ) = G(0) cos⁴(θ/2) for a kink out of pure tension (Cotterell & Rice 1980, first order), G_c(θ) that
    /// of the place a reach ahead. At a right angle G is a quarter: a weak band less than a quarter as tough as what is behind it
    /// catches cracks that meet it squarely (He & Hutchinson 1989 for interfaces).
    ///
    /// If toughness does not vary it is the tip's own normal, bit for bit. An angle at which even the least toughness near
    /// would cost as much as the best so far is not looked at.
    pub(crate) fn kinked(&self, mesh: &TetMesh, tip: Tip) -> Vec3 {
        let centre = mesh.centroid(tip.tet as usize);
        let along = (centre - tip.from).reject_from(tip.normal).try_normalize();
        let (Some(along), Some(least)) = (along, self.least_about(tip.tet)) else {
            return tip.normal;
        };
        let released = |radians: f32| f64::from(libm::cosf(0.5 * radians).powi(4));
        let cost = |radians: f32| {
            let (sin, cos) = libm::sincosf(radians);
            let to = along * cos + tip.normal * sin;
            let place = tet_towards(mesh, tip.tet, centre + to * tip.reach);
            self.of(place) / released(radians)
        };
        let mut best = (cost(0.0), 0.0);
        for degrees in ANGLES {
            let radians = degrees.to_radians();
            if least / released(radians) >= best.0 {
                break;
            }
            for radians in [radians, -radians] {
                let cost = cost(radians);
                if cost < best.0 {
                    best = (cost, radians);
                }
            }
        }
        if best.1 == 0.0 {
            return tip.normal;
        }
        let (sin, cos) = libm::sincosf(best.1);
        tip.normal * cos - along * sin
    }
}

/// The tetrahedron that holds `p`, or the last one before the way there leaves the body.
fn tet_towards(mesh: &TetMesh, from: u32, p: Vec3) -> u32 {
    let mut tet = from;
    for _ in 0..MOST_STEPS {
        let [origin, corners @ ..] = mesh.corners(tet as usize);
        let [a, b, c] = corners.map(|corner| corner - origin);
        let faces = [b.cross(c), c.cross(a), a.cross(b)];
        let volume = a.dot(faces[0]);
        let [a, b, c] = faces.map(|face| (p - origin).dot(face) / volume);
        // Through the face that p lies farthest behind, in shares of the height over it: its barycentric coordinates.
        let shares = [1.0 - a - b - c, a, b, c];
        let mut k = 0;
        for other in 1..4 {
            if shares[other] < shares[k] {
                k = other;
            }
        }
        let next = mesh.neighbours[tet as usize][k];
        if shares[k] >= 0.0 || next == NO_NEIGHBOUR {
            return tet;
        }
        tet = next;
    }
    tet
}
