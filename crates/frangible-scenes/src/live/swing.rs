//! Swinging a hammer into a scene that runs: its head is led on an arc to the point that it strikes, flies freely from the first touch
//! on, as long as a blow takes, and is lifted away.

use std::sync::Arc;

use frangible::Material;
use frangible::glam::{Mat3, Quat, Vec3};
use frangible_rapier::SurfaceProperties;
use frangible_rapier::rapier3d::dynamics::RigidBodyHandle;
use frangible_rapier::rapier3d::math::{Pose, Rotation};

use super::{LiveScene, TICKS_PER_SECOND, Thing, ThingKind};
use frangible_sound::Sounding;

use crate::appearance::projectile_surface;
use crate::error::SceneError;
use crate::hammer::{Head, add_handle};
use crate::launch::{hull, vector};

/// Radius of curvature of the striking face, m, as of the scenes' hammers.
const CROWN: f64 = 0.06;

/// Length of the head in radii of its face: a club hammer's.
const SLENDERNESS: f64 = 3.0;

/// Distance from the hand to the head, m.
const ARM: f32 = 0.35;

/// Angle by which the head is drawn back at the start, radians of its arc.
const DRAWN_BACK: f32 = 1.2;

/// Angle by which it goes on where there is nothing to strike, radians.
const FOLLOW_THROUGH: f32 = 0.5;

/// Change of the velocity that the head is led with, as a share of it, that is a strike.
const STRUCK: f32 = 0.01;

/// Time for which the head is left alone from the first touch on, s.
const LOOSE: f64 = 0.08;

/// Speed with which it is lifted away, m/s, and the time for that at most, s.
const LIFT: f32 = 2.5;
const LIFTED: f64 = 0.6;

/// A hammer about to be swung.
#[derive(Clone, Debug, PartialEq)]
pub struct Swing {
    /// Mass of the head, kg.
    pub mass: f64,
    /// Speed of the head, m/s.
    pub speed: f64,
    /// Material preset.
    pub material: String,
    /// Point from which it strikes, m: only the direction to `at` matters.
    pub from: Vec3,
    /// Point that the middle of its face strikes, m.
    pub at: Vec3,
}

/// Phase of a swung hammer on its way.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Phase {
    /// On its arc: the angle still to go, radians, falling, and the velocity it is led with, m/s.
    Coming { angle: f32, led: Vec3 },
    /// Left alone until this tick.
    Loose(u64),
    /// Lifted away until this tick.
    Leaving(u64),
}

/// A hammer that was swung.
#[derive(Clone, Copy, Debug)]
pub(super) struct Swung {
    handle: RigidBodyHandle,
    pivot: Vec3,
    /// Vector from the pivot to the head where it strikes, m.
    arm: Vec3,
    /// Axis about which the head turns, unit.
    axis: Vec3,
    /// Radians per second.
    rate: f32,
    phase: Phase,
}

impl Swung {
    /// Position of the head's centre with this angle to go, m.
    fn centre(&self, angle: f32) -> Vec3 {
        self.pivot + Quat::from_axis_angle(self.axis, -angle) * self.arm
    }
}

fn ticks(seconds: f64) -> u64 {
    (seconds * TICKS_PER_SECOND as f64) as u64
}

impl Swing {
    fn check(&self) -> Result<Vec3, SceneError> {
        for (what, value, must) in [
            ("the hammer's mass", self.mass, "above zero, in kg"),
            ("the hammer's speed", self.speed, "above zero, in m/s"),
        ] {
            if !(value.is_finite() && value > 0.0) {
                let value = value.to_string();
                return Err(SceneError::Quantity { what, value, must });
            }
        }
        let way = self.at - self.from;
        way.try_normalize().ok_or_else(|| SceneError::Quantity {
            what: "the direction of the hammer's blow",
            value: way.to_string(),
            must: "a vector of non-zero length, in m",
        })
    }
}

/// Direction from the head to the hand, across the blow and as far upwards as may be: so the head comes from above, and never out of
/// the floor.
fn toward_hand(blow: Vec3) -> Vec3 {
    let up = Vec3::Y.reject_from_normalized(blow);
    up.try_normalize().unwrap_or(Vec3::X)
}

impl LiveScene {
    /// Swings a hammer onto a point; it is the last of [`LiveScene::things`] then. After the strike it is lifted away.
    ///
    /// # Errors
    /// An invalid number, or an unknown material.
    pub fn swing(&mut self, swing: &Swing) -> Result<(), SceneError> {
        let blow = swing.check()?;
        let material = Material::preset(&swing.material)?;
        let volume = swing.mass / material.density;
        let radius = libm::cbrt(volume / (SLENDERNESS * std::f64::consts::PI));
        let mut head = Head::new(radius, CROWN.max(radius), swing.mass, material.density);
        head.shift(-hull(&head, radius)?.mass_properties(1.0).local_com.z);
        let hand = toward_hand(blow);
        let turn = Quat::from_mat3(&Mat3::from_cols(hand.cross(blow), hand, blow));
        let mut strike = swing.at - head.front() * blow;
        if self.floor.is_some() {
            strike.y += depth(&head, turn, strike, blow);
        }
        let swung = Swung {
            handle: RigidBodyHandle::invalid(),
            pivot: strike + ARM * hand,
            arm: -ARM * hand,
            axis: blow.cross(hand),
            rate: swing.speed as f32 / ARM,
            phase: Phase::Coming {
                angle: DRAWN_BACK,
                led: Vec3::ZERO,
            },
        };
        let q = Quat::from_axis_angle(swung.axis, -DRAWN_BACK) * turn;
        let rotation = Rotation::from_xyzw(q.x, q.y, q.z, q.w);
        let pose = Pose::from_parts(vector(swung.centre(DRAWN_BACK)), rotation);
        let properties = SurfaceProperties::of(&material, CROWN.max(radius) as f32);
        let shape = hull(&head, radius)?;
        let mass = swing.mass as f32;
        let handle = self
            .world
            .insert_rigid(shape, mass, properties, pose, vector(Vec3::ZERO))?;
        if let Some(body) = self.world.physics.bodies.get_mut(handle) {
            body.set_gravity_scale(0.0, true);
        }
        self.swings.push(Swung { handle, ..swung });
        self.throws += 1;
        let surface = self.surface(projectile_surface("hammer", &swing.material));
        let mut mesh = head.mesh(surface);
        let wood = self.surface(projectile_surface("handle", "wood"));
        add_handle(&mut mesh, 0.45 * radius as f32, 0.85 * ARM, wood);
        self.things.push(Arc::new(Thing {
            name: format!("hammer swing {}", self.throws),
            kind: ThingKind::Projectile,
            mesh,
            mass: swing.mass,
            volume,
            handle,
            sounding: Sounding::Ball(material, radius, swing.mass),
            surfaces: None,
            plain: None,
        }));
        Ok(())
    }

    /// Leads hammers on, before a step of `dt` seconds.
    pub(super) fn drive_swings(&mut self, dt: f32) {
        for swung in &mut self.swings {
            let Some(body) = self.world.physics.bodies.get_mut(swung.handle) else {
                continue;
            };
            let at = Vec3::from(body.translation().to_array());
            match &mut swung.phase {
                Phase::Coming { angle, led } => {
                    *angle -= swung.rate * dt;
                    let to = swung.pivot + Quat::from_axis_angle(swung.axis, -*angle) * swung.arm;
                    // A sweep may have stopped the head at the body that it is about to strike; it does not make up for that.
                    *led = ((to - at) / dt).clamp_length_max(swung.rate * ARM);
                    body.set_linvel(vector(*led), true);
                    body.set_angvel(vector(swung.rate * swung.axis), true);
                }
                Phase::Loose(_) => {}
                Phase::Leaving(_) => {
                    let way = swung.centre(DRAWN_BACK) - at;
                    let velocity = (way / dt).clamp_length_max(LIFT);
                    body.set_linvel(vector(velocity), true);
                    body.set_angvel(vector(Vec3::ZERO), true);
                }
            }
        }
    }

    /// Sees what became of hammers in a step.
    pub(super) fn follow_swings(&mut self) {
        let now = self.ticks;
        let mut swings = std::mem::take(&mut self.swings);
        swings.retain_mut(|swung| self.follow(swung, now));
        self.swings = swings;
    }

    /// Moves a hammer on. Returns false once it is gone.
    fn follow(&mut self, swung: &mut Swung, now: u64) -> bool {
        let physics = &mut self.world.physics;
        let Some(body) = physics.bodies.get_mut(swung.handle) else {
            return false;
        };
        match swung.phase {
            Phase::Coming { angle, led } => {
                let velocity = Vec3::from(body.linvel().to_array());
                if velocity.distance(led) > STRUCK * led.length() {
                    body.set_gravity_scale(1.0, true);
                    swung.phase = Phase::Loose(now + ticks(LOOSE));
                } else if angle < -FOLLOW_THROUGH {
                    self.lift(swung, now);
                }
            }
            Phase::Loose(until) if now >= until => self.lift(swung, now),
            Phase::Loose(_) => {}
            Phase::Leaving(until) => {
                let there = Vec3::from(body.translation().to_array());
                if now >= until || there.distance(swung.centre(DRAWN_BACK)) < 1e-3 {
                    physics.remove_body(swung.handle);
                    return false;
                }
            }
        }
        true
    }

    /// Begins to lift a hammer away: it touches nothing any more.
    fn lift(&mut self, swung: &mut Swung, now: u64) {
        swung.phase = Phase::Leaving(now + ticks(LIFTED));
        let physics = &mut self.world.physics;
        let Some(body) = physics.bodies.get_mut(swung.handle) else {
            return;
        };
        body.set_gravity_scale(0.0, true);
        for &collider in body.colliders() {
            if let Some(collider) = physics.colliders.get_mut(collider) {
                collider.set_sensor(true);
            }
        }
    }
}

/// Height by which a blow must be moved up so that the head clears the floor, m; a blow downwards may strike it.
fn depth(head: &Head, turn: Quat, strike: Vec3, blow: Vec3) -> f32 {
    /// The head's edge sinks by less than this on the last of its arc, m.
    const MARGIN: f32 = 2e-3;
    if blow.y < -0.7 {
        return 0.0;
    }
    let lowest = head.points().into_iter().map(|p| (turn * p + strike).y);
    (MARGIN - lowest.fold(f32::INFINITY, f32::min)).max(0.0)
}
