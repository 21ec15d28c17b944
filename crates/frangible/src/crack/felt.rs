//! Stress at the front of a growing crack.

use glam::Vec3;

use crate::stress::{StressState, Symmetric3, Wall, largest_eigenvalue};

/// Cosine from which on the normals of a wall at two tetrahedra that touch belong to one face.
pub(super) const SAME_FACE: f32 = 0.3;

/// Stress and strain energy that act on a crack in a tetrahedron.
pub(crate) struct Felt {
    /// Stress and strain energy; in a wall the stress of its middle and the mean of the energy.
    pub(crate) state: StressState,
    /// The wall, and the stress on its two faces.
    pub(crate) wall: Option<(Wall, [Symmetric3; 2])>,
}

impl Felt {
    /// Stress that steers a crack, and the outward normal of the face of the wall that it is taken from, zero in a solid. A crack through a
    /// wall opens from one of its faces and follows the tension there: behind, a bent wall is stretched another way. `opens`: the normal
    /// of that face where the crack comes from; where it comes from no wall, it opens from the face with the larger tension.
    pub(crate) fn steering(&self, opens: Vec3) -> (Symmetric3, Vec3) {
        let Some((wall, [front, back])) = &self.wall else {
            return (self.state.stress, Vec3::ZERO);
        };
        if self.opens_in_front(opens) {
            (*front, wall.normal)
        } else {
            (*back, -wall.normal)
        }
    }

    /// Stress that steers a crack, and in a wall that of the face behind the one it is taken from. `opens`: as for [`Self::steering`].
    pub(crate) fn on_face(&self, opens: Vec3) -> (Symmetric3, Option<Symmetric3>) {
        match self.wall {
            None => (self.state.stress, None),
            Some((_, [front, back])) if self.opens_in_front(opens) => (front, Some(back)),
            Some((_, [front, back])) => (back, Some(front)),
        }
    }

    /// Returns true if a crack through a wall opens from the face that the wall's normal points out of.
    fn opens_in_front(&self, opens: Vec3) -> bool {
        let Some((wall, [front, back])) = &self.wall else {
            return true;
        };
        let side = opens.dot(wall.normal);
        if side.abs() > SAME_FACE {
            side > 0.0
        } else {
            largest_eigenvalue(front) >= largest_eigenvalue(back)
        }
    }

    /// The largest principal tension, Pa; in a wall that of its two faces.
    pub(crate) fn largest_tension(&self) -> f32 {
        let largest = match &self.wall {
            None => largest_eigenvalue(&self.state.stress),
            Some((_, [front, back])) => largest_eigenvalue(front).max(largest_eigenvalue(back)),
        };
        largest.max(0.0)
    }

    /// Strain energy of the tension across a crack of this unit normal, J/m³: in a wall its mean, of what stretches the wall and what bends
    /// it, at most that of the larger tension of its faces. `plane_modulus`: E/(1−ν²), Pa.
    pub(crate) fn energy_across(&self, normal: Vec3, plane_modulus: f64) -> f64 {
        let (middle, bending) = self.across(normal);
        0.5 * (middle.powi(2) + bending.powi(2) / 3.0) / plane_modulus
    }

    /// Tension across a crack of this unit normal in the middle of the wall, and what the larger one of its faces has beyond it, Pa; in a solid all
    /// of it and none.
    fn across(&self, normal: Vec3) -> (f64, f64) {
        let across = |stress: &Symmetric3| f64::from(normal.dot(stress.to_mat3() * normal));
        let Some((_, faces)) = &self.wall else {
            return (across(&self.state.stress).max(0.0), 0.0);
        };
        let [front, back] = faces.each_ref().map(across);
        let largest = front.max(back).max(0.0);
        let middle = (0.5 * (front + back)).clamp(0.0, largest);
        (middle, largest - middle)
    }

    /// Tension across a crack of this unit normal that opens its front, Pa: of a wall that of its middle and the part of its bending that
    /// counts (`tips.rs`), at most the larger one of its faces.
    pub(crate) fn opening(&self, normal: Vec3, poisson_ratio: f64) -> f64 {
        let (middle, bending) = self.across(normal);
        let share = (1.0 + poisson_ratio) / (3.0 * (3.0 + poisson_ratio));
        (middle.powi(2) + share * bending.powi(2)).sqrt()
    }
}
