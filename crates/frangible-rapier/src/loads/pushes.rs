//! Loads that are no contact: blasts and scripted blows. They act at the beginning of the next step, before it moves
//! anything: a body that breaks is replaced at once, and a body that was pushed goes on from there.
//!
//! A blast pushes every dynamic body too. Of a breakable body, and of its fragments, the outer triangles that face the
//! origin are lit, each with the impulse per area of [`frangible::internals::Blast`]; hidden crack faces are not. Of any other body
//! only colliders are known: a ball is lit over its near half, 2/3 of its cross-section's worth; any other shape is taken
//! for its local bounding box. Nothing casts a shadow on anything else. Merged pieces that are pushed to the impact speed come loose.

use std::sync::Arc;

use frangible::glam::Vec3;
use frangible::internals::Blast;
use frangible::{Fracture, Outcome, TriMesh};
use rapier3d::dynamics::{RigidBody, RigidBodyHandle};
use rapier3d::geometry::ColliderSet;
use rapier3d::math::Vector;

use crate::contact::contacts::Impact;
use crate::error::{WorldError, finite, positive};
use crate::event::{BreakCause, HeldEvent};
use crate::fragments::replace::{Parts, Replacement};
use crate::impulses::motion::kinetic_energy;
use crate::impulses::plain::take_energy;
use crate::impulses::settle::Broken;
use crate::world::{BreakableWorld, key};

/// Nearest that a part of the surface counts as, m: as [`frangible::internals::blast`] has it.
const NEAREST: f32 = 0.01;

/// A load that waits for the next step; world coordinates.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Push {
    Blast {
        origin: Vector,
        impulse: f32,
        duration: f32,
    },
    Blow {
        body: RigidBodyHandle,
        point: Vector,
        impulse: Vector,
    },
}

/// An impulse, N·s, and its moment, N·m·s.
#[derive(Clone, Copy, Debug, Default)]
struct Kick {
    linear: Vec3,
    angular: Vec3,
}

impl BreakableWorld {
    /// Applies a pressure pulse that spreads from `origin` (m): impulse per area at 1 m in Pa·s, duration in s; see
    /// [`frangible::internals::Blast`]. It acts at the start of the next step on all dynamic bodies and on supported breakable bodies.
    ///
    /// # Errors
    /// An origin that is not finite, an impulse or duration not above zero.
    pub fn blast(
        &mut self,
        origin: Vector,
        impulse_at_1m: f32,
        duration: f32,
    ) -> Result<(), WorldError> {
        finite("a blast's origin", origin)?;
        positive("a blast's impulse per area at 1 m (Pa·s)", impulse_at_1m)?;
        positive("a blast's duration (s)", duration)?;
        self.state.pushes.push(Push::Blast {
            origin,
            impulse: impulse_at_1m,
            duration,
        });
        Ok(())
    }

    /// Applies a scripted blow: an impulse (N·s) at a point (m), both in world axes, as from a rigid striker of 1 cm radius; see
    /// [`frangible::internals::fracture_at`]. It acts at the start of the next step. The impulse goes to the nearest fragment, or to the body
    /// if it holds; a supported body passes it to its supports.
    ///
    /// # Errors
    /// A body that is not breakable or no longer in the world, a point that is not finite, an impulse of zero.
    pub fn fracture_at(
        &mut self,
        body: RigidBodyHandle,
        point: Vector,
        impulse: Vector,
    ) -> Result<(), WorldError> {
        finite("point of the blow", point)?;
        finite("impulse of the blow", impulse)?;
        positive("size of the blow's impulse (N·s)", impulse.length())?;
        if self.breakable(body).is_none() {
            let (index, generation) = body.into_raw_parts();
            return Err(WorldError::NoBody { index, generation });
        }
        self.state.pushes.push(Push::Blow {
            body,
            point,
            impulse,
        });
        Ok(())
    }

    /// Applies the waiting loads.
    pub(crate) fn apply_pushes(&mut self) -> Result<(), WorldError> {
        let mut error = Ok(());
        for push in std::mem::take(&mut self.state.pushes) {
            let done = match push {
                Push::Blast {
                    origin,
                    impulse,
                    duration,
                } => self.apply_blast(origin, impulse, duration),
                Push::Blow {
                    body,
                    point,
                    impulse,
                } => self.apply_blow(body, point, impulse),
            };
            error = error.and(done);
        }
        error
    }

    fn apply_blast(
        &mut self,
        origin: Vector,
        impulse: f32,
        duration: f32,
    ) -> Result<(), WorldError> {
        let mut error = Ok(());
        let fast = self.config.impact_speed;
        self.loosen_where(|rigid, colliders| {
            let blast = Blast {
                origin: rigid.position().inverse_transform_point(origin),
                impulse,
                duration,
            };
            let push = kick_on_colliders(rigid, colliders, &blast).linear;
            push.length() >= fast * rigid.mass()
        });
        let handles: Vec<RigidBodyHandle> = self.physics.bodies.iter().map(|(h, _)| h).collect();
        for handle in handles {
            let Some(rigid) = self.physics.bodies.get(handle).filter(|b| b.is_enabled()) else {
                continue;
            };
            let local = rigid.position().inverse_transform_point(origin);
            let at = |place: Vec3| Blast {
                origin: local - place,
                impulse,
                duration,
            };
            let Some(body) = self.state.breakables.get(&key(handle)) else {
                let kick = kick_on_colliders(rigid, &self.physics.colliders, &at(Vec3::ZERO));
                self.kick(handle, kick);
                continue;
            };
            if !(rigid.is_dynamic() || body.asset().is_supported()) {
                continue;
            }
            let (surface, positions) = (body.asset().surface(), body.asset().surface_positions());
            let whole = kick_on(positions, &surface.triangles, &at(Vec3::ZERO));
            let outcome = frangible::internals::blast(body, &at(Vec3::ZERO), &self.config.fracture);
            let done = outcome.map_err(WorldError::from).and_then(|outcome| {
                let kick_piece = |fracture: &Fracture, i: usize| {
                    let TriMesh {
                        positions,
                        triangles,
                        outer_triangles,
                        ..
                    } = &fracture.fragments[i].mesh;
                    let place = fracture.fragments[i].mass.centre.as_vec3();
                    kick_on(positions, &triangles[..*outer_triangles], &at(place))
                };
                self.suffer(handle, BreakCause::Blast, outcome, whole, kick_piece)
            });
            error = error.and(done);
        }
        error
    }

    fn apply_blow(
        &mut self,
        handle: RigidBodyHandle,
        point: Vector,
        impulse: Vector,
    ) -> Result<(), WorldError> {
        self.loosen(handle);
        let (Some(body), Some(rigid)) = (
            self.state.breakables.get(&key(handle)),
            self.physics.bodies.get(handle),
        ) else {
            return Ok(());
        };
        let local = rigid.position().inverse_transform_point(point);
        let push = rigid.rotation().inverse() * impulse;
        let outcome = frangible::internals::fracture_at(body, local, push, &self.config.fracture)?;
        let about = |centre: Vec3| Kick {
            linear: push,
            angular: (local - centre).cross(push),
        };
        let kick_piece = |fracture: &Fracture, i: usize| {
            let gap = |f: &frangible::Fragment| {
                let place = local - f.mass.centre.as_vec3();
                let corners = f.mesh.positions.iter();
                corners.fold(f32::INFINITY, |gap, p| gap.min(p.distance_squared(place)))
            };
            let gaps = fracture.fragments.iter().map(gap).enumerate();
            let nearest = gaps.min_by(|(_, a), (_, b)| a.total_cmp(b));
            if nearest.is_some_and(|(nearest, _)| nearest == i) {
                about(fracture.fragments[i].mass.centre.as_vec3())
            } else {
                Kick::default()
            }
        };
        self.suffer(
            handle,
            BreakCause::Script,
            outcome,
            about(Vec3::ZERO),
            kick_piece,
        )
    }

    /// Applies the outcome of a push to a breakable body: it or its fragments get the momentum.
    fn suffer(
        &mut self,
        handle: RigidBodyHandle,
        cause: BreakCause,
        outcome: Outcome,
        whole: Kick,
        piece: impl Fn(&Fracture, usize) -> Kick,
    ) -> Result<(), WorldError> {
        let fracture = match outcome {
            Outcome::Broke(fracture)
                if fracture.fragments.len() > 1 && self.has_room(&fracture, 0, handle) =>
            {
                Arc::new(*fracture)
            }
            Outcome::Held {
                margin,
                report,
                state,
            } => {
                let state = state.map(|s| *s);
                if let Some(state) = &state {
                    self.crack(handle, state)?;
                }
                if self.config.record_held {
                    self.held.push(HeldEvent {
                        step: self.state.steps,
                        body: handle,
                        contacts: Vec::new(),
                        margin,
                        report,
                        state,
                    });
                }
                self.kick(handle, whole);
                return Ok(());
            }
            _ => {
                self.kick(handle, whole);
                return Ok(());
            }
        };
        let parts = Parts::new(&fracture, &self.config)?;
        let before = self.physics.bodies.get(handle).cloned();
        let Replacement {
            fragments,
            released,
        } = self.replace(handle, &parts);
        self.bind_film(&fracture, &fragments);
        for (i, &fragment) in fragments.iter().enumerate() {
            self.kick(fragment, piece(&fracture, i));
        }
        let energy = |world: &Self| -> f64 {
            let bodies = fragments
                .iter()
                .filter_map(|&f| world.physics.bodies.get(f));
            bodies.map(kinetic_energy).sum()
        };
        let kinetic_before = before.as_ref().map_or(0.0, kinetic_energy);
        let pushed = energy(self);
        let toll = fracture.report.fracture_energy;
        let energy_paid = take_energy(&mut self.physics.bodies, &fragments, &[], toll);
        let kinetic_after = energy(self);
        let broken = Broken {
            parent: handle,
            cause,
            fracture,
            parts,
            impact: Impact::default(),
            fragments,
            released,
            blow: Vec::new(),
            lost: 0.0,
            alone: false,
        };
        if self.record(broken, before.as_ref(), energy_paid)
            && let Some(event) = self.events.last_mut()
        {
            (event.kinetic_before, event.kinetic_after) = (kinetic_before, kinetic_after);
            event.work = (pushed - kinetic_before).max(0.0);
        }
        Ok(())
    }

    /// Gives a dynamic body an impulse in its own frame.
    fn kick(&mut self, handle: RigidBodyHandle, kick: Kick) {
        let body = self.physics.bodies.get_mut(handle);
        let Some(body) = body.filter(|b| b.is_dynamic()) else {
            return;
        };
        if kick.linear == Vec3::ZERO && kick.angular == Vec3::ZERO {
            return;
        }
        let turn = *body.rotation();
        body.apply_impulse(turn * kick.linear, true);
        body.apply_torque_impulse(turn * kick.angular, true);
    }
}

/// Push on the lit ones of some triangles; moment about the origin of their frame.
fn kick_on(positions: &[Vec3], triangles: &[[u32; 3]], blast: &Blast) -> Kick {
    let mut kick = Kick::default();
    for triangle in triangles {
        let [a, b, c] = triangle.map(|v| positions[v as usize]);
        push_on(
            &mut kick,
            0.5 * (b - a).cross(c - a),
            (a + b + c) / 3.0,
            blast,
        );
    }
    kick
}

/// Push on a flat piece of surface: its area vector points outwards.
fn push_on(kick: &mut Kick, area: Vec3, at: Vec3, blast: &Blast) {
    let away = at - blast.origin;
    let distance = away.length().max(NEAREST);
    let facing = -area.dot(away) / distance;
    if facing > 0.0 {
        let push = -area.normalize_or_zero() * (facing * blast.impulse / distance);
        kick.linear += push;
        kick.angular += at.cross(push);
    }
}

/// Push on a body of which only colliders are known; moment about its centre of mass.
fn kick_on_colliders(body: &RigidBody, colliders: &ColliderSet, blast: &Blast) -> Kick {
    let mut kick = Kick::default();
    let centre = body.local_center_of_mass();
    for collider in body.colliders().iter().filter_map(|&c| colliders.get(c)) {
        if collider.is_sensor() {
            continue;
        }
        let pose = collider.position_wrt_parent().copied().unwrap_or_default();
        if let Some(ball) = collider.shape().as_ball() {
            // ∫ cos²θ over the near half, in a parallel front.
            let away = pose.translation - blast.origin;
            let distance = (away.length() - ball.radius).max(NEAREST);
            let area = 2.0 / 3.0 * std::f32::consts::PI * ball.radius * ball.radius;
            let push = away.normalize_or_zero() * (area * blast.impulse / distance);
            kick.linear += push;
            kick.angular += (pose.translation - centre).cross(push);
            continue;
        }
        let bounds = collider.shape().compute_local_aabb();
        let (middle, half) = (bounds.center(), bounds.half_extents());
        for axis in 0..3 {
            for side in [-1.0, 1.0] {
                let normal = Vec3::AXES[axis] * side;
                let area = 4.0 * half[(axis + 1) % 3] * half[(axis + 2) % 3];
                let place = pose * (middle + normal * half[axis]);
                let mut part = Kick::default();
                push_on(&mut part, pose.rotation * normal * area, place, blast);
                kick.linear += part.linear;
                kick.angular += (place - centre).cross(part.linear);
            }
        }
    }
    kick
}
