//! Constraints of a supported body, and its remaining rigid-body modes.

use frangible::glam::DVec3;

/// Unit and independence of constraints: a direction of motion that every constraint sees by less than this, as a share
/// of the motion, is free. Far above the rounding of positions, far below any part of a body that can hold it.
const INDEPENDENT: f64 = 1e-6;

/// Constraints of a system. The default has none.
#[derive(Clone, Debug, Default)]
pub struct Constraints {
    /// Fixed unknowns, in ascending order; they are eliminated.
    unknowns: Vec<usize>,
    /// Points, and the axes along which they are fixed.
    places: Vec<(DVec3, [bool; 3])>,
}

impl Constraints {
    /// Creates constraints of nodes along axes. `held` has one entry per node of the system, or is empty.
    #[must_use]
    pub fn of_nodes(positions: &[DVec3], held: &[[bool; 3]]) -> Self {
        let unknowns = held.iter().flatten().enumerate();
        Self {
            unknowns: unknowns.filter(|u| *u.1).map(|u| u.0).collect(),
            ..Self::of_places(positions, held)
        }
    }

    /// Creates constraints of points that are fixed by springs in the stiffness matrix; rigid motions that move none of them have zero
    /// strain energy.
    #[must_use]
    pub fn of_places(positions: &[DVec3], held: &[[bool; 3]]) -> Self {
        let places = positions.iter().copied().zip(held.iter().copied());
        Self {
            unknowns: Vec::new(),
            places: places.filter(|p| p.1 != [false; 3]).collect(),
        }
    }

    /// Returns the fixed unknowns, in ascending order.
    #[must_use]
    pub fn unknowns(&self) -> &[usize] {
        &self.unknowns
    }

    /// Rigid motions that move no held place along a held axis: coefficients of the six of
    /// [`rigid_motions`](super::rigid_motions) about `centre`; `None` for a body that nothing holds. `reach`: how far the
    /// body extends from there, m.
    ///
    /// Rows of the constraints are made orthonormal, the one with the largest remainder first (QR with pivoting); motions
    /// orthogonal to all of them are free.
    pub(crate) fn free_motions(&self, centre: DVec3, reach: f64) -> Option<Vec<[f64; 6]>> {
        if self.places.is_empty() {
            return None;
        }
        let row = |p: DVec3, axis: usize| -> [f64; 6] {
            let arm = (p - centre) / reach;
            let turn = DVec3::AXES.map(|rotation| rotation.cross(arm)[axis]);
            let mut row = [0.0; 6];
            row[axis] = 1.0;
            row[3..].copy_from_slice(&turn);
            row
        };
        let held = self.places.iter().flat_map(|&(p, axes)| {
            (0..3)
                .filter(move |&axis| axes[axis])
                .map(move |axis| row(p, axis))
        });
        let bound = span(held.collect());
        let units = (0..6).map(|i| {
            let mut unit = [0.0; 6];
            unit[i] = 1.0;
            unit
        });
        let mut rest: Vec<[f64; 6]> = units.collect();
        for unit in &mut rest {
            // Twice, as the first pass leaves rounding of the size of the part that it takes away.
            for _ in 0..2 {
                bound.iter().for_each(|b| take_out(unit, b));
            }
        }
        let mut free = span(rest);
        free.truncate(6 - bound.len());
        for motion in &mut free {
            motion[3..].iter_mut().for_each(|turn| *turn /= reach);
        }
        Some(free)
    }
}

/// Orthonormal basis of what the rows span.
fn span(mut rows: Vec<[f64; 6]>) -> Vec<[f64; 6]> {
    let mut basis: Vec<[f64; 6]> = Vec::new();
    while basis.len() < 6 {
        let largest = rows
            .iter()
            .copied()
            .max_by(|a, b| dot(a, a).total_cmp(&dot(b, b)));
        let Some(mut next) = largest.filter(|row| dot(row, row).sqrt() > INDEPENDENT) else {
            break;
        };
        basis.iter().for_each(|b| take_out(&mut next, b));
        let length = dot(&next, &next).sqrt();
        next.iter_mut().for_each(|x| *x /= length);
        rows.iter_mut().for_each(|row| take_out(row, &next));
        basis.push(next);
    }
    basis
}

fn dot(a: &[f64; 6], b: &[f64; 6]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

fn take_out(from: &mut [f64; 6], unit: &[f64; 6]) {
    let c = dot(from, unit);
    from.iter_mut().zip(unit).for_each(|(x, u)| *x -= c * u);
}

#[cfg(test)]
mod tests {
    use super::Constraints;
    use frangible::glam::DVec3;

    fn left(places: &[(DVec3, [bool; 3])]) -> usize {
        let (positions, held): (Vec<DVec3>, Vec<[bool; 3]>) = places.iter().copied().unzip();
        let motions = Constraints::of_places(&positions, &held).free_motions(DVec3::ZERO, 1.0);
        let motions = motions.unwrap();
        for m in &motions {
            let (shift, turn) = (DVec3::from_slice(&m[..3]), DVec3::from_slice(&m[3..]));
            assert!((shift.length_squared() + turn.length_squared() - 1.0).abs() < 1e-12);
            for (p, axes) in places {
                let moved = shift + turn.cross(*p);
                assert!((0..3).all(|k| !axes[k] || moved[k].abs() < 1e-12));
            }
        }
        motions.len()
    }

    #[test]
    fn each_way_of_holding_leaves_the_motions_it_should() {
        let (all, z) = ([true; 3], [false, false, true]);
        let (a, b, c) = (
            DVec3::new(0.3, 0.4, 0.1),
            DVec3::new(-0.5, 0.2, 0.3),
            DVec3::new(0.1, -0.7, -0.2),
        );
        assert_eq!(left(&[(a, z)]), 5);
        assert_eq!(left(&[(a, z), (b, z), (c, z)]), 3);
        assert_eq!(left(&[(a, all)]), 3);
        // A hinge.
        assert_eq!(left(&[(a, all), (b, all)]), 1);
        assert_eq!(left(&[(a, all), (b, all), (a.lerp(b, 0.3), all)]), 1);
        assert_eq!(left(&[(a, all), (b, all), (c, z)]), 0);
        assert_eq!(left(&[(a, all), (b, all), (c, all)]), 0);
    }

    #[test]
    fn what_nothing_holds_has_no_constraints() {
        let free = Constraints::of_nodes(&[DVec3::X], &[[false; 3]]);
        assert!(free.free_motions(DVec3::ZERO, 1.0).is_none() && free.unknowns().is_empty());
    }
}
