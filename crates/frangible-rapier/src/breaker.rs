//! Breaking bodies in a game's own Rapier world.
//!
//! A game already has Rapier's sets and pipeline, with its own bodies, joints, hooks and events. A [`Breaker`] stores only the additional
//! data: the breakable bodies, their assets and their cracks. During a call it borrows the game's sets ([`Sets`]) and works on them as a
//! [`BreakableWorld`] works on its own.
//!
//! The borrowed sets are swapped in and out, some hundred bytes each. They go back even if a hook or an event handler of the game
//! panics.

use frangible::internals::PieceModel;
use rapier3d::dynamics::{
    CCDSolver, ImpulseJointSet, IntegrationParameters, IslandManager, MultibodyJointSet,
    RigidBodySet, SoftBodySet,
};
use rapier3d::geometry::{BroadPhaseBvh, ColliderSet, NarrowPhase};
use rapier3d::math::Vector;
use rapier3d::pipeline::{EventHandler, PhysicsHooks, PhysicsPipeline, PhysicsWorld};

use crate::config::WorldConfig;
use crate::error::WorldError;
use crate::event::BreakEvent;
use crate::world::BreakableWorld;

/// Data on which Rapier's pipeline works, borrowed from a game for one call: the arguments of [`PhysicsPipeline::step`].
pub struct Sets<'a> {
    /// Acceleration of gravity, m/s².
    pub gravity: Vector,
    /// Time step and numbers of the solver.
    pub parameters: &'a IntegrationParameters,
    /// The pipeline that takes the steps.
    pub pipeline: &'a mut PhysicsPipeline,
    /// Islands of bodies that are awake.
    pub islands: &'a mut IslandManager,
    /// The broad phase.
    pub broad_phase: &'a mut BroadPhaseBvh,
    /// The narrow phase.
    pub narrow_phase: &'a mut NarrowPhase,
    /// All bodies.
    pub bodies: &'a mut RigidBodySet,
    /// All colliders.
    pub colliders: &'a mut ColliderSet,
    /// Joints that are solved by impulses.
    pub impulse_joints: &'a mut ImpulseJointSet,
    /// Joints in reduced coordinates.
    pub multibody_joints: &'a mut MultibodyJointSet,
    /// Bodies that deform.
    pub soft_bodies: &'a mut SoftBodySet,
    /// The solver of continuous collisions.
    pub ccd_solver: &'a mut CCDSolver,
}

impl<'a> From<&'a mut PhysicsWorld> for Sets<'a> {
    fn from(world: &'a mut PhysicsWorld) -> Self {
        Self {
            gravity: world.gravity,
            parameters: &world.integration_parameters,
            pipeline: &mut world.physics_pipeline,
            islands: &mut world.islands,
            broad_phase: &mut world.broad_phase,
            narrow_phase: &mut world.narrow_phase,
            bodies: &mut world.bodies,
            colliders: &mut world.colliders,
            impulse_joints: &mut world.impulse_joints,
            multibody_joints: &mut world.multibody_joints,
            soft_bodies: &mut world.soft_bodies,
            ccd_solver: &mut world.ccd_solver,
        }
    }
}

/// The breakable bodies of a game that has a Rapier world of its own.
///
/// ```
/// use frangible_rapier::rapier3d::pipeline::PhysicsWorld;
/// use frangible_rapier::{Breaker, Sets};
///
/// let mut game = PhysicsWorld::default();
/// let mut breaker = Breaker::new();
/// // In place of `game.step_with_events(&hooks, &events)`:
/// let breaks = breaker.step(Sets::from(&mut game), &(), &())?;
/// assert!(breaks.is_empty());
/// # Ok::<(), frangible_rapier::WorldError>(())
/// ```
pub struct Breaker {
    /// Its own sets are empty between calls.
    world: BreakableWorld,
}

impl Default for Breaker {
    fn default() -> Self {
        Self::new()
    }
}

impl Breaker {
    /// Makes a breaker that changes nothing except breaking bodies: [`WorldConfig::plain`].
    #[must_use]
    pub fn new() -> Self {
        match Self::with_config(WorldConfig::plain()) {
            Ok(breaker) => breaker,
            Err(_) => unreachable!("the plain configuration is valid"),
        }
    }

    /// Makes a breaker with a configuration. Gravity, time step, length unit, solver iterations and largest speed of the configuration are
    /// ignored; those of the game's sets apply.
    ///
    /// # Errors
    /// An invalid number in the configuration.
    pub fn with_config(config: WorldConfig) -> Result<Self, WorldError> {
        Ok(Self {
            world: BreakableWorld::new(config)?,
        })
    }

    /// This breaker with a model for the modes of fragments, see [`BreakableWorld::with_piece_model`].
    #[must_use]
    pub fn with_piece_model(self, model: impl PieceModel + 'static) -> Self {
        Self {
            world: self.world.with_piece_model(model),
        }
    }

    /// Steps the game's world in place of [`PhysicsPipeline::step`]; returns the breaks in the step.
    ///
    /// A step in which a body breaks is undone and repeated. Events of an undone step are dropped; hooks are called in every attempt. See
    /// [`BreakableWorld::step_with`].
    ///
    /// # Errors
    /// The fracture model rejected an asset or a contact. The step is complete and the body whole: continue, or remove the body.
    pub fn step<'a>(
        &'a mut self,
        sets: Sets<'_>,
        hooks: &dyn PhysicsHooks,
        events: &dyn EventHandler,
    ) -> Result<&'a [BreakEvent], WorldError> {
        let mut lent = Lent::new(&mut self.world, sets);
        let stepped = lent.world().step_with(hooks, events).map(|_| ());
        drop(lent);
        stepped.map(|()| self.world.breaks())
    }

    /// Calls `work` with a [`BreakableWorld`] on the game's sets, for everything else: inserting breakable bodies, testing blows, pushes,
    /// saving and restoring.
    pub fn with<T>(&mut self, sets: Sets<'_>, work: impl FnOnce(&mut BreakableWorld) -> T) -> T {
        let mut lent = Lent::new(&mut self.world, sets);
        work(lent.world())
    }

    /// State that does not need the game's sets: breaks of the last step, breakable bodies, counts, times.
    #[must_use]
    pub fn state(&self) -> &BreakableWorld {
        &self.world
    }
}

/// A world that has a game's sets until this is dropped.
struct Lent<'w, 's> {
    world: &'w mut BreakableWorld,
    sets: Sets<'s>,
}

impl<'w, 's> Lent<'w, 's> {
    fn new(world: &'w mut BreakableWorld, sets: Sets<'s>) -> Self {
        world.physics.gravity = sets.gravity;
        world.physics.integration_parameters = *sets.parameters;
        let mut lent = Self { world, sets };
        lent.swap();
        lent
    }

    fn world(&mut self) -> &mut BreakableWorld {
        self.world
    }

    fn swap(&mut self) {
        use std::mem::swap;
        let (own, sets) = (&mut self.world.physics, &mut self.sets);
        swap(&mut own.physics_pipeline, sets.pipeline);
        swap(&mut own.islands, sets.islands);
        swap(&mut own.broad_phase, sets.broad_phase);
        swap(&mut own.narrow_phase, sets.narrow_phase);
        swap(&mut own.bodies, sets.bodies);
        swap(&mut own.colliders, sets.colliders);
        swap(&mut own.impulse_joints, sets.impulse_joints);
        swap(&mut own.multibody_joints, sets.multibody_joints);
        swap(&mut own.soft_bodies, sets.soft_bodies);
        swap(&mut own.ccd_solver, sets.ccd_solver);
    }
}

impl Drop for Lent<'_, '_> {
    fn drop(&mut self) {
        self.swap();
    }
}
