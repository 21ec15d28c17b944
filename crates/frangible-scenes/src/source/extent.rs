//! The box that a shape fills.

use frangible::glam::DVec3;
use frangible_bake::Shape;

/// Lowest and highest corner of a box that holds the shape, m, in its own frame; `None` where its kind is not known here.
pub(crate) fn bounds(shape: &Shape) -> Option<[DVec3; 2]> {
    Some(match shape {
        Shape::Box { size } => [DVec3::ZERO, DVec3::from_array(*size)],
        Shape::Pane(pane) => {
            let [width, depth, thickness] = pane.size;
            let high = DVec3::new(width, depth, thickness + pane.bow);
            [DVec3::ZERO, high]
        }
        Shape::Revolution { profile } => {
            let points = profile.iter().flat_map(|s| [s.outer, s.inner]);
            around(points.flat_map(|[r, z]| [DVec3::new(-r, -r, z), DVec3::new(r, r, z)]))
        }
        Shape::Solid(shape) => shape.solid.bounds(),
        Shape::Wall(shape) => shape.wall.bounds(),
        Shape::Tets(shape) => around(shape.body.positions.iter().copied()),
        _ => return None,
    })
}

fn around(points: impl Iterator<Item = DVec3>) -> [DVec3; 2] {
    let nothing = [DVec3::INFINITY, DVec3::NEG_INFINITY];
    points.fold(nothing, |[low, high], p| [low.min(p), high.max(p)])
}
