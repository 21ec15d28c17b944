//! Finds the first thing that a ray meets.

use frangible::glam::Vec3;
use frangible_scenes::LiveScene;

use crate::camera::Ray;
use crate::mesher::apart;

/// Something a ray met.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Met {
    /// Number of the thing; none for the floor.
    pub(crate) thing: Option<usize>,
    /// Distance along the ray, m.
    pub(crate) distance: f32,
}

/// The first thing a ray meets, as things are drawn, or the floor.
pub(crate) fn pick(live: &LiveScene, explode: f32, ray: Ray) -> Option<Met> {
    let mut best: Option<Met> = None;
    let mut offer = |met: Met| {
        if best.is_none_or(|b| met.distance < b.distance) {
            best = Some(met);
        }
    };
    if live.floor().is_some() && ray.direction.y < 0.0 && ray.origin.y > 0.0 {
        offer(Met {
            thing: None,
            distance: -ray.origin.y / ray.direction.y,
        });
    }
    for (number, thing) in live.things().iter().enumerate() {
        let Some(pose) = live.pose(thing) else {
            continue;
        };
        let pose = apart(thing, pose, explode);
        // The ray in the thing's own frame.
        let back = pose.rotation.normalize().inverse();
        let origin = back * (ray.origin - pose.translation);
        let direction = back * ray.direction;
        let positions = &thing.mesh.positions;
        let reach = positions.iter().map(|p| p.length()).fold(0.0, f32::max);
        let nearest = origin - direction * origin.dot(direction);
        if nearest.length() > reach {
            continue;
        }
        for part in &thing.mesh.parts {
            for face in part.indices.chunks_exact(3) {
                let corners = [face[0], face[1], face[2]].map(|v| positions[v as usize]);
                if let Some(distance) = meets(origin, direction, corners) {
                    offer(Met {
                        thing: Some(number),
                        distance,
                    });
                }
            }
        }
    }
    best
}

/// Distance at which a ray meets a triangle, from either side (Möller and Trumbore 1997).
fn meets(origin: Vec3, direction: Vec3, [a, b, c]: [Vec3; 3]) -> Option<f32> {
    let (e, f) = (b - a, c - a);
    let p = direction.cross(f);
    let determinant = e.dot(p);
    if determinant == 0.0 {
        return None;
    }
    let t = origin - a;
    let u = t.dot(p) / determinant;
    let q = t.cross(e);
    let v = direction.dot(q) / determinant;
    let distance = f.dot(q) / determinant;
    (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && distance > 0.0).then_some(distance)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ray_meets_a_triangle_inside_only_and_ahead_only() {
        let triangle = [Vec3::ZERO, Vec3::X, Vec3::Y];
        let from = |x: f32, y: f32| meets(Vec3::new(x, y, 2.0), Vec3::NEG_Z, triangle);
        assert_eq!(from(0.25, 0.25), Some(2.0));
        assert_eq!(from(0.75, 0.75), None);
        assert_eq!(meets(Vec3::new(0.2, 0.2, 2.0), Vec3::Z, triangle), None);
        assert_eq!(meets(Vec3::new(0.2, 0.2, 2.0), Vec3::X, triangle), None);
    }
}
