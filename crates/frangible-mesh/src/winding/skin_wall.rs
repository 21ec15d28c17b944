//! A wall along a surface that has no thickness of its own: the skin of a pot, say, of which its author drew one side.

use glam::DVec3;

use super::mesh_solid::MeshSolid;
use crate::solid::Solid;

/// All points no farther from a surface than half the thickness of the wall. Where the surface ends, the wall ends
/// in a rounded rim.
pub struct SkinWall {
    middle: MeshSolid,
    half: f64,
}

impl SkinWall {
    /// A wall of this thickness, m, half of it on each side of the surface.
    #[must_use]
    pub fn new(middle: MeshSolid, thickness: f64) -> Self {
        let half = 0.5 * thickness;
        Self { middle, half }
    }
}

impl Solid for SkinWall {
    fn bounds(&self) -> [DVec3; 2] {
        let [low, high] = self.middle.bounds();
        [low - self.half, high + self.half]
    }

    fn signed_distance(&self, p: DVec3) -> f64 {
        let nearest = self.middle.nearest(p, f64::INFINITY);
        nearest.map_or(f64::INFINITY, |n| n.distance) - self.half
    }

    /// The way from the closest place of the surface; on the surface itself its normal.
    fn gradient(&self, p: DVec3) -> (f64, DVec3) {
        match self.middle.nearest(p, f64::INFINITY) {
            Some(n) => {
                let away = (p - n.position).try_normalize().unwrap_or(n.normal);
                (n.distance - self.half, away)
            }
            None => (f64::INFINITY, DVec3::Y),
        }
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::SkinWall;
    use crate::solid::Solid;
    use crate::surface::Surface;
    use crate::winding::MeshSolid;

    #[test]
    fn a_point_is_inside_within_half_the_thickness_of_the_skin() {
        // A box of 1 m without a lid.
        let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        let level = |z: f64| corners.map(|[x, y]| DVec3::new(x, y, z));
        let mut triangles = vec![[0, 2, 1], [0, 3, 2]];
        for [a, b] in [[0, 1], [1, 2], [2, 3], [3, 0]] {
            triangles.extend([[a, b, b + 4], [a, b + 4, a + 4]]);
        }
        let surface = Surface {
            positions: [level(0.0), level(1.0)].concat(),
            triangles,
        };
        let wall = SkinWall::new(MeshSolid::new(&surface).unwrap(), 0.02);
        let distance = |x, y, z| wall.signed_distance(DVec3::new(x, y, z));
        for side in [-1.0, 1.0] {
            assert!((distance(0.5, 0.4, side * 0.004) + 0.006).abs() < 1e-12);
            assert!((distance(0.5, 0.4, side * 0.05) - 0.04).abs() < 1e-12);
            let (_, away) = wall.gradient(DVec3::new(0.5, 0.4, side * 0.05));
            assert!(away.distance(DVec3::Z * side) < 1e-12);
        }
        // The rim is round.
        assert!((distance(1.03, 0.5, 1.04) - 0.04).abs() < 1e-12);
    }
}
