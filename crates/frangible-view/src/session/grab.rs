//! Taking hold of things and flinging them.

use frangible::glam::Vec3;
use frangible_rapier::rapier3d::math::Vector;

use super::Session;
use crate::camera::Ray;
use crate::error::ViewError;
use crate::picking::pick;

/// Time in which a held thing covers most of the way to the point that it is pulled to, s.
const LAG: f32 = 0.04;

/// No hand is faster, m/s.
const FASTEST: f32 = 15.0;

/// Thing that is held, and its target.
#[derive(Clone, Copy, Debug)]
pub(super) struct Grip {
    /// Number of the thing.
    thing: usize,
    /// Distance from the eye at which it was taken, m.
    distance: f32,
    /// Vector from the place that was taken to the thing's centre of mass, m.
    offset: Vec3,
    /// Target of the place that was taken, m.
    target: Vec3,
}

fn ray(from: Vec3, through: Vec3) -> Ray {
    Ray {
        origin: from,
        direction: (through - from).normalize_or_zero(),
    }
}

impl Session {
    pub(super) fn grab(&mut self, from: Vec3, through: Vec3) -> Result<(), ViewError> {
        let explode = self.explode as f32;
        let live = self.running()?;
        let ray = ray(from, through);
        let met = pick(live, explode, ray);
        let held = met.and_then(|met| Some((met.thing?, met.distance)));
        let grip = held.and_then(|(thing, distance)| {
            let known = &live.things()[thing];
            let body = live.world().physics.bodies.get(known.handle)?;
            let at = ray.origin + distance * ray.direction;
            let centre = live.pose(known)?.translation;
            body.is_dynamic().then_some(Grip {
                thing,
                distance,
                offset: centre - at,
                target: at,
            })
        });
        self.grip = grip;
        Ok(())
    }

    pub(super) fn pull(&mut self, from: Vec3, through: Vec3) {
        let ray = ray(from, through);
        if let Some(grip) = &mut self.grip {
            let target = ray.origin + grip.distance * ray.direction;
            // Nobody reaches through the floor.
            grip.target = target.max(Vec3::new(f32::MIN, 0.0, f32::MIN));
        }
    }

    /// Moves the held thing, before a step; one that broke in the hand is gone.
    pub(super) fn pull_along(&mut self) {
        let (Some(grip), Some(live)) = (self.grip, self.live.as_mut()) else {
            return;
        };
        let thing = std::sync::Arc::clone(&live.things()[grip.thing]);
        let Some(pose) = live.pose(&thing) else {
            self.grip = None;
            return;
        };
        let way = grip.target + grip.offset - pose.translation;
        let velocity = (way / LAG).clamp_length_max(FASTEST);
        if let Some(body) = live.world_mut().physics.bodies.get_mut(thing.handle) {
            body.set_linvel(Vector::new(velocity.x, velocity.y, velocity.z), true);
        }
    }
}
