//! The corners with which a jagged body stands on a plane.
//!
//! Engines set a polyhedron on a plane with the face that is most nearly parallel to it, wherever on the body that is. On a jagged piece that face is a
//! small one somewhere, not the one at the bottom: the tip sinks until the face arrives (measured: 12 mm on a piece of a brick), then the piece rocks from
//! face to face for ever. Here a body stands on its lowest corner and those that span the widest base with it.

use glam::Vec3;

/// A corner higher than the lowest one by h counts as nearer by this × h: a base is spanned by corners that touch, not by ones that hover.
const HEIGHT_COST: f32 = 20.0;

/// Depth below the plane from which on corners are alike, m: all of them touch, so that a sunken body is lifted by its widest base. Lifted by its
/// lowest corner alone it turns about that, and goes on turning where it is. Engines leave resting bodies 0.1 mm deep.
const SUNK: f32 = 3e-4;

/// A corner that touched in the last step counts as farther by this, m, so that the base does not flicker between corners that are as good.
const LOYALTY: f32 = 5e-4;

/// A corner of a body near a plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Corner {
    /// Number of the corner, of its own in the body.
    pub number: u32,
    /// Position in the body's frame, m.
    pub point: Vec3,
    /// Height above the plane, m.
    pub height: f32,
    /// It touched in the last step.
    pub known: bool,
}

/// The up to four of these corners on which a body stands; `up` is the plane's normal in the body's frame. The lowest one is among them.
#[must_use]
pub fn footing(near: &[Corner], up: Vec3) -> Vec<Corner> {
    let lowest = near.iter().map(|c| c.height).fold(f32::INFINITY, f32::min);
    let worth = |corner: &Corner| {
        let loyalty = if corner.known { LOYALTY } else { 0.0 };
        loyalty - HEIGHT_COST * (corner.height.max(-SUNK) - lowest.max(-SUNK))
    };
    let best = |score: &dyn Fn(&Corner) -> f32| {
        near.iter()
            .copied()
            .max_by(|a, b| score(a).total_cmp(&score(b)).then(b.number.cmp(&a.number)))
    };
    let mut base: Vec<Corner> = Vec::with_capacity(4);
    let mut add = |corner: Option<Corner>| {
        if let Some(corner) = corner.filter(|c| base.iter().all(|b| b.number != c.number)) {
            base.push(corner);
        }
    };
    let Some(first) = best(&|c| -c.height) else {
        return base;
    };
    let flat = |v: Vec3| v - up * v.dot(up);
    let second = best(&|c| flat(c.point - first.point).length() + worth(c)).unwrap_or(first);
    let across = up
        .cross(flat(second.point - first.point))
        .normalize_or_zero();
    add(Some(first));
    add(Some(second));
    for side in [across, -across] {
        add(best(&|c| (c.point - first.point).dot(side) + worth(c))
            .filter(|c| (c.point - first.point).dot(side) > 0.0));
    }
    base
}

#[cfg(test)]
mod tests {
    use super::{Corner, footing};
    use glam::Vec3;

    fn corners(heights: &[(f32, f32, f32)]) -> Vec<Corner> {
        let corner = |(number, &(x, y, height)): (u32, &(f32, f32, f32))| Corner {
            number,
            point: Vec3::new(x, height, y),
            height,
            known: false,
        };
        (0..).zip(heights).map(corner).collect()
    }

    #[test]
    fn a_body_stands_on_its_lowest_corner_and_on_those_that_touch() {
        // Four corners of a square touch, one in the middle is lowest, and one far away hovers.
        let mut near = corners(&[
            (0.0, 0.0, -2e-4),
            (0.01, 0.01, 0.0),
            (-0.01, 0.01, 0.0),
            (0.01, -0.01, 0.0),
            (-0.01, -0.01, 0.0),
            (0.03, 0.0, 4e-3),
        ]);
        let numbers = |near: &[Corner]| {
            let mut numbers: Vec<u32> = footing(near, Vec3::Y).iter().map(|c| c.number).collect();
            numbers.sort_unstable();
            numbers
        };
        let base = numbers(&near);
        assert!(base.contains(&0) && !base.contains(&5), "{base:?}");
        assert!((3..=4).contains(&base.len()), "{base:?}");
        // Of two that are as good, the one that touched before stays.
        for known in [1, 4] {
            near.iter_mut().for_each(|c| c.known = c.number == known);
            assert!(numbers(&near).contains(&known));
        }
        assert!(footing(&[], Vec3::Y).is_empty());
    }
}
