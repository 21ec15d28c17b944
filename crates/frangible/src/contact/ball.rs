//! First touch of a ball and a body.
//!
//! Engines find contacts on the convex parts of the collider, sometimes on parts beside the one that is hit, millimetres off and with
//! tilted normals. For a ball, the exact contact with the body's surface is simple to compute.

use glam::Vec3;

use crate::body::Body;

/// The ball is at the surface when it is this near, relative to its radius.
const TOUCHES: f32 = 1e-4;

/// Steps towards the surface, each as long as the gap: enough for a ball that comes at a slant of six degrees.
const MOST_STEPS: usize = 100;

/// Returns the point at which a moving ball first touches the body's surface, and the unit direction from its centre to that point.
///
/// The ball has this radius, m; its centre moves with `velocity`, m/s, relative to the body. All values are in the body frame. A ball that
/// already touches the body touches at the nearest point. Returns `None` if there is no contact within `time`, s, or the centre is on the surface.
#[must_use]
pub fn first_touch_of_ball(
    body: &Body,
    mut centre: Vec3,
    velocity: Vec3,
    radius: f32,
    time: f32,
) -> Option<(Vec3, Vec3)> {
    let speed = velocity.length();
    let mut left = speed * time;
    for _ in 0..MOST_STEPS {
        let place = body.nearest_on_surface(centre).position;
        let to_place = place - centre;
        let gap = to_place.length() - radius;
        if gap <= TOUCHES * radius {
            return to_place.try_normalize().map(|normal| (place, normal));
        }
        if gap > left || speed <= 0.0 {
            return None;
        }
        centre += velocity * (gap / speed);
        left -= gap;
    }
    None
}
