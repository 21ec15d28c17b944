//! THE step: bodies break inside it.
//!
//! Theory §6. A step that may see an impact (see `approach.rs`) begins with a copy of the world. After it, each
//! impact is put to the fracture. If a body broke: back to the copy, fragments in its place with the velocities
//! from before the impact, and the step is taken again, so that the striker meets fragments instead of a body
//! that is gone. Several bodies may break in a step; a body that is only hit in the repeated step is asked then,
//! up to [`MAX_REPEATS`] times. Fragments are not asked: they do not break again yet.

use std::collections::BTreeMap;
use std::sync::Arc;

use frangible::{Fracture, Outcome};
use rapier3d::dynamics::{RigidBody, RigidBodyHandle, RigidBodySet};
use rapier3d::math::Vector;

use crate::approach::candidates;
use crate::contacts::{Impact, Surfaces, impact_on};
use crate::error::WorldError;
use crate::event::{BreakEvent, HeldEvent};
use crate::guard::{Centres, centres, put_back};
use crate::motion::kinetic_energy;
use crate::replace::{Parts, is_debris};
use crate::rolling::resist_rolling;
use crate::snapshot::Snapshot;
use crate::surface::{EDGE_RADIUS, SurfaceProperties};
use crate::toll::take_energy;
use crate::world::{BreakableWorld, Key, key};

/// A step is undone at most so often; a body that would break only after that breaks in a later step.
const MAX_REPEATS: usize = 4;

/// Solver iterations of a step with newborn fragments, in units of an ordinary step's. Measured with 100 fragments:
/// 1, 2, 4 cost 5.0, 7.0, 8.2 ms for the whole breaking step; below 4, pieces left wedged gain energy afterwards.
const BREAK_ITERATIONS: usize = 4;

/// A body that breaks in this step.
struct Broken {
    parent: RigidBodyHandle,
    fracture: Arc<Fracture>,
    parts: Parts,
    impact: Impact,
    fragments: Vec<RigidBodyHandle>,
}

/// What was asked of the fracture in this step.
#[derive(Default)]
struct Asked {
    broken: Vec<Broken>,
    held: BTreeMap<Key, (Impact, HeldEvent)>,
    error: Option<WorldError>,
}

impl BreakableWorld {
    /// Advances by one time step; returns the breaks in it.
    ///
    /// # Errors
    /// The fracture refused an asset or a contact. The step is complete and the body whole: go on, or remove it.
    pub fn step(&mut self) -> Result<&[BreakEvent], WorldError> {
        self.events.clear();
        self.held.clear();
        self.forget_removed();
        self.siblings.step = self.steps;
        self.siblings.relaxation =
            self.config.overlap_relaxation * self.physics.integration_parameters.dt;
        let near = candidates(&self.physics, self.breakables(), self.config.impact_speed);
        let mut asked = if near.is_empty() {
            let centres = self.guarded_centres();
            self.advance();
            put_back(&mut self.physics, &centres);
            Asked::default()
        } else {
            self.step_with_breaks(near)
        };
        // A break's impulses are a blow, not a weight that rolls; its energy is settled already.
        if self.events.is_empty() {
            resist_rolling(&mut self.physics, self.config.rolling_arm);
        }
        if self.config.rest_drift > 0.0 {
            self.places.rest(&mut self.physics, self.config.rest_drift);
        }
        self.limit_debris(self.config.max_debris);
        for (body, (_, event)) in &asked.held {
            if let (Some(body), Some(state)) = (self.breakables.get_mut(body), &event.state)
                && let Err(error) = body.set_state(state.clone())
            {
                asked.error.get_or_insert(error.into());
            }
        }
        if self.config.record_held {
            self.held
                .extend(asked.held.into_values().map(|(_, event)| event));
        }
        self.steps += 1;
        asked.error.map_or(Ok(&self.events), Err)
    }

    fn advance(&mut self) {
        self.physics.step_with_events(&self.siblings, &());
    }

    fn guarded_centres(&self) -> Centres {
        centres(
            &self.physics,
            self.siblings.fragments().chain(self.breakables()),
        )
    }

    /// A step with fragments just born: a blow runs through a chain of them, one link per solver iteration. With
    /// too few a piece between floor and chain is squeezed through a thin floor.
    fn advance_finely(&mut self) {
        let iterations = self.physics.integration_parameters.num_solver_iterations;
        self.physics.integration_parameters.num_solver_iterations = BREAK_ITERATIONS * iterations;
        self.advance();
        self.physics.integration_parameters.num_solver_iterations = iterations;
    }

    fn step_with_breaks(&mut self, mut near: Vec<RigidBodyHandle>) -> Asked {
        let base = Snapshot::take(&self.physics, &self.siblings);
        self.snapshots += 1;
        let mut asked = Asked::default();
        let mut before: Option<RigidBodySet> = None;
        let mut centres = self.guarded_centres();
        self.advance();
        for _ in 0..MAX_REPEATS {
            if !self.ask(&near, before.as_ref().unwrap_or(&base.bodies), &mut asked) {
                break;
            }
            near.retain(|&handle| asked.broken.iter().all(|b| b.parent != handle));
            self.undone_steps += 1;
            base.restore(&mut self.physics, &mut self.siblings);
            for broken in &mut asked.broken {
                broken.fragments = self.replace(broken.parent, &broken.parts);
            }
            before = Some(self.physics.bodies.clone());
            centres = self.guarded_centres();
            self.advance_finely();
        }
        put_back(&mut self.physics, &centres);
        for broken in std::mem::take(&mut asked.broken) {
            self.settle(broken, &base.bodies);
        }
        asked
    }

    /// Puts the impacts of the step just taken to the fracture; true when a body broke.
    fn ask(&mut self, near: &[RigidBodyHandle], before: &RigidBodySet, asked: &mut Asked) -> bool {
        let mut news = false;
        for &handle in near {
            let surfaces = Surfaces {
                bodies: &self.surfaces,
                colliders: &self.collider_surfaces,
                breakables: &self.breakables,
            };
            let Some(body) = self.breakables.get(&key(handle)) else {
                continue;
            };
            let impact = impact_on(handle, &self.physics, before, &surfaces, &self.config);
            let unchanged = asked
                .held
                .get(&key(handle))
                .is_some_and(|(known, _)| *known == impact);
            if impact.contacts.is_empty() || unchanged {
                continue;
            }
            let outcome = (self.break_function)(body, &impact.contacts, &self.config.fracture);
            let fracture = match outcome {
                Ok(Outcome::Broke(fracture)) if fracture.fragments.len() > 1 => *fracture,
                Ok(outcome) => {
                    self.remember_held(handle, impact, outcome, asked);
                    continue;
                }
                Err(error) => {
                    asked.error.get_or_insert(error.into());
                    continue;
                }
            };
            let fragments: usize = asked
                .broken
                .iter()
                .map(|b| b.fracture.fragments.len())
                .sum();
            let room = self
                .config
                .max_bodies
                .saturating_sub(self.physics.bodies.len())
                + self.debris.len();
            if fracture.fragments.len() + fragments > room {
                self.refused_breaks += 1;
                log::warn!(
                    "{} fragments of `{}` exceed `max_bodies`; it stays whole",
                    fracture.fragments.len(),
                    body.asset().name
                );
                continue;
            }
            match Parts::new(&fracture, &self.config) {
                Ok(parts) => {
                    let fracture = Arc::new(fracture);
                    asked.broken.push(Broken {
                        parent: handle,
                        fracture,
                        parts,
                        impact,
                        fragments: Vec::new(),
                    });
                    asked.held.remove(&key(handle));
                    news = true;
                }
                Err(error) => {
                    asked.error.get_or_insert(error);
                }
            }
        }
        news
    }

    fn remember_held(
        &self,
        body: RigidBodyHandle,
        impact: Impact,
        outcome: Outcome,
        asked: &mut Asked,
    ) {
        let Outcome::Held {
            margin,
            report,
            state,
        } = outcome
        else {
            return;
        };
        let event = HeldEvent {
            step: self.steps,
            body,
            contacts: impact.contacts.clone(),
            margin,
            report,
            state: state.map(|s| *s),
        };
        asked.held.insert(key(body), (impact, event));
    }

    /// Takes the cracks' energy from the motion and records the break.
    fn settle(&mut self, broken: Broken, before: &RigidBodySet) {
        let Broken {
            parent,
            fracture,
            impact,
            fragments,
            ..
        } = broken;
        let Some(body) = self.breakables.remove(&key(parent)) else {
            return;
        };
        self.surfaces.remove(&key(parent));
        let surface = SurfaceProperties::of(&body.asset().material, EDGE_RADIUS);
        for (&handle, fragment) in fragments.iter().zip(&fracture.fragments) {
            self.surfaces.insert(key(handle), surface);
            if is_debris(fragment, &self.config) {
                self.debris.push_back(handle);
            }
        }
        let mut strikers = impact.strikers;
        strikers.retain(|&s| self.physics.bodies.contains(s));
        let gain = self.energy_gain(parent, &fragments, &strikers, before);
        let toll = fracture.report.fracture_energy.max(gain);
        let energy_paid = take_energy(&mut self.physics.bodies, &fragments, &strikers, toll);
        let (pose, linvel, angvel) = before.get(parent).map_or_else(Default::default, |b| {
            (*b.position(), b.linvel(), b.angvel())
        });
        self.events.push(BreakEvent {
            step: self.steps,
            parent,
            asset: Arc::clone(body.asset()),
            fragments,
            fracture,
            contacts: impact.contacts,
            strikers,
            pose,
            linvel,
            angvel,
            energy_paid: energy_paid.min(toll),
        });
    }

    /// Kinetic energy the group has more after the step than before it, beyond the work of gravity, J. Rapier's
    /// restitution at many contacts at once can gain some; a break never does.
    fn energy_gain(
        &self,
        parent: RigidBodyHandle,
        fragments: &[RigidBodyHandle],
        strikers: &[RigidBodyHandle],
        before: &RigidBodySet,
    ) -> f64 {
        let energy = |bodies: &RigidBodySet, handle: RigidBodyHandle| {
            bodies.get(handle).map_or(0.0, kinetic_energy)
        };
        let start: f64 = std::iter::once(&parent)
            .chain(strikers)
            .map(|&h| energy(before, h))
            .sum();
        let end: f64 = fragments
            .iter()
            .chain(strikers)
            .map(|&h| energy(&self.physics.bodies, h))
            .sum();
        let dt = self.physics.integration_parameters.dt;
        let gravity = self.physics.gravity;
        let fall = |body: &RigidBody, start: Vector| {
            let pull = gravity * body.gravity_scale();
            f64::from(body.mass() * (pull * dt).dot(start + 0.5 * dt * pull))
        };
        let dynamic = |bodies: &RigidBodySet, handle: RigidBodyHandle, start: Option<Vector>| {
            let body = bodies.get(handle).filter(|b| b.is_dynamic());
            body.map_or(0.0, |b| fall(b, start.unwrap_or(b.linvel())))
        };
        let movers = std::iter::once(&parent).chain(strikers);
        let mut work: f64 = movers.map(|&h| dynamic(before, h, None)).sum();
        // Fragments of what was held begin their fall with the step.
        if before.get(parent).is_some_and(|b| !b.is_dynamic()) {
            let bodies = &self.physics.bodies;
            let falls = fragments
                .iter()
                .map(|&h| dynamic(bodies, h, Some(Vector::ZERO)));
            work += falls.sum::<f64>();
        }
        end - start - work.max(0.0)
    }
}
