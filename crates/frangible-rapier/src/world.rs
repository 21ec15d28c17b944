//! The world: Rapier's sets, and the breakable bodies in them.

use std::collections::{BTreeMap, VecDeque};

use frangible::glam::Vec3;
use frangible::internals::Force;
use frangible::internals::piece::PieceModel;
use frangible::{Asset, Body, Contact, FractureConfig, InputError, Outcome};
use rapier3d::dynamics::RigidBodyHandle;
use rapier3d::geometry::SharedShape;
use rapier3d::pipeline::PhysicsWorld;
use std::sync::Arc;

use crate::bodies::dispatch::PieceContacts;
use crate::calm::motions::Motions;
use crate::calm::rest::Places;
use crate::config::WorldConfig;
use crate::contact::surface::SurfaceProperties;
use crate::counts::LoadCounts;
use crate::error::WorldError;
use crate::event::{BreakEvent, HeldEvent};
use crate::fragments::clumps::WorldClump;
use crate::fragments::pieces::Expected;
use crate::fragments::rubble::Rubbles;
use crate::fragments::siblings::Siblings;
use crate::loads::pushes::Push;
use crate::loads::resting::Burden;
use crate::stepping::after::line::Waiting;
use crate::stepping::judge::Case;
use crate::threads;
use crate::timings::StepTimings;
use crate::workshop::Workshop;

/// Angular frequency of contacts × substep, against fixed bodies. Rapier lets a share c/(1+c) of the approach speed
/// through in a substep, c = x² / ((1+x) 4ζ²), x = 2ζ / this: its 0.4 is 11 %, so a ball of 200 m/s goes 23 mm into
/// a wall before it is stopped; 10 is 0.3 %, 0.7 mm.
const STATIC_STIFFNESS: f32 = 10.0;

/// Angular frequency of contacts × substep between bodies that move. Measured on 27 blocks dropped in a heap: 0.4 sleeps after 390 to 1700
/// steps,
/// 2 after 160 to 400, 10 never.
const STIFFNESS: f32 = 2.0;

/// Function that computes the outcome of an impact; [`frangible::impact()`] unless replaced with
/// [`BreakableWorld::set_break_function`].
pub type BreakFn =
    dyn Fn(&Body, &[Contact], &FractureConfig) -> Result<Outcome, InputError> + Send + Sync;

/// Function that computes the outcome of a sustained load, with gravity in the body frame; [`frangible::internals::rest()`] unless replaced
/// with [`BreakableWorld::set_rest_function`].
pub type RestFn =
    dyn Fn(&Body, &[Force], Vec3, &FractureConfig) -> Result<Outcome, InputError> + Send + Sync;

/// Sort key of a body's handle: maps are ordered, so that no result hangs on a hash.
pub(crate) type Key = (u32, u32);

pub(crate) fn key(handle: RigidBodyHandle) -> Key {
    handle.into_raw_parts()
}

/// A Rapier world with breakable bodies. See the crate's documentation.
pub struct BreakableWorld {
    /// Rapier's bodies, colliders, joints and pipelines, which may be added and removed freely between steps. Gravity and time step are
    /// Rapier's own (`gravity`, `integration_parameters.dt`).
    pub physics: PhysicsWorld,
    pub(crate) config: WorldConfig,
    pub(crate) break_function: Arc<BreakFn>,
    pub(crate) rest_function: Box<RestFn>,
    pub(crate) shapes: Vec<(Arc<Asset>, SharedShape)>,
    pub(crate) siblings: Siblings,
    pub(crate) state: State,
    pub(crate) events: Vec<BreakEvent>,
    pub(crate) held: Vec<HeldEvent>,
    pub(crate) timings: StepTimings,
    /// Mean time of the last steps, s.
    pub(crate) mean_step: f64,
    /// Blows that other threads judge, in the order in which they are due.
    pub(crate) cases: VecDeque<Case>,
    pub(crate) piece_model: Option<Arc<dyn PieceModel>>,
    pub(crate) workshop: Workshop,
    /// True if blows are judged by the fracture itself, whose quick bound then clears most of them.
    pub(crate) clears_quickly: bool,
    /// True if loads are judged by the fracture's quick bound in the same way.
    pub(crate) weighs_quickly: bool,
}

/// Data of a world about its bodies beside Rapier's, between two steps: a clone of it and of Rapier's sets is a world put aside.
#[derive(Clone, Default)]
pub(crate) struct State {
    pub(crate) breakables: BTreeMap<Key, Body>,
    pub(crate) surfaces: BTreeMap<Key, SurfaceProperties>,
    pub(crate) places: Places,
    pub(crate) burdens: BTreeMap<Key, Burden>,
    pub(crate) pushes: Vec<Push>,
    pub(crate) debris: VecDeque<RigidBodyHandle>,
    /// Dust, with the time of its birth, s.
    pub(crate) dust: VecDeque<(RigidBodyHandle, f64)>,
    /// Pieces that fade, with the time at which they began to, s.
    pub(crate) fading: VecDeque<(RigidBodyHandle, f64)>,
    /// Time since when each piece sleeps, s.
    pub(crate) asleep: BTreeMap<Key, f64>,
    pub(crate) rubble: Rubbles,
    /// Clumps of dice.
    pub(crate) clumps: BTreeMap<Key, WorldClump>,
    /// Those of them that were hit, in this order.
    pub(crate) parting: VecDeque<RigidBodyHandle>,
    pub(crate) waiting: VecDeque<Waiting>,
    /// Bodies being made, in the order in which they are due.
    pub(crate) expected: VecDeque<Expected>,
    /// Step at which all pieces asked for are expected to be ready at the [pace](crate::PieceConfig::pace), for either kind.
    pub(crate) pieces_ready: [f64; 2],
    pub(crate) motions: Motions,
    pub(crate) steps: u64,
    pub(crate) refused_breaks: u64,
    pub(crate) undone_steps: u64,
    pub(crate) snapshots: u64,
    pub(crate) impact_counts: LoadCounts,
    pub(crate) rest_counts: LoadCounts,
}

impl BreakableWorld {
    /// Makes an empty world.
    ///
    /// # Errors
    /// An invalid number in the configuration.
    pub fn new(mut config: WorldConfig) -> Result<Self, WorldError> {
        config.validate()?;
        if !config.fracture.threads.are_lent() {
            config.fracture.threads = threads::lent();
        }
        let mut physics = PhysicsWorld {
            gravity: config.gravity,
            ..PhysicsWorld::default()
        };
        physics.narrow_phase.set_query_dispatcher(PieceContacts);
        let parameters = &mut physics.integration_parameters;
        parameters.dt = config.dt;
        parameters.min_ccd_dt = config.dt / 100.0;
        parameters.length_unit = config.length_unit;
        parameters.num_solver_iterations = config.solver_iterations;
        parameters.normalized_max_linear_velocity = config.max_speed / config.length_unit;
        let substep = config.dt / config.solver_iterations as f32;
        let frequency = |stiffness: f32| stiffness / (std::f32::consts::TAU * substep);
        parameters.contact_softness.natural_frequency = frequency(STIFFNESS);
        parameters.static_contact_softness.natural_frequency = frequency(STATIC_STIFFNESS);
        Ok(Self {
            physics,
            siblings: Siblings::default(),
            break_function: Arc::new(frangible::impact),
            rest_function: Box::new(frangible::internals::rest),
            shapes: Vec::new(),
            state: State::default(),
            events: Vec::new(),
            held: Vec::new(),
            timings: StepTimings::default(),
            mean_step: 0.0,
            cases: VecDeque::new(),
            workshop: Workshop::default(),
            piece_model: None,
            clears_quickly: true,
            weighs_quickly: true,
            config,
        })
    }

    /// Replaces [`frangible::impact()`] with another function, such as another model or a test double.
    pub fn set_break_function(
        &mut self,
        function: impl Fn(&Body, &[Contact], &FractureConfig) -> Result<Outcome, InputError>
        + Send
        + Sync
        + 'static,
    ) {
        self.clears_quickly = false;
        self.break_function = Arc::new(function);
    }

    /// Replaces [`frangible::internals::rest()`] with another function for sustained loads.
    pub fn set_rest_function(
        &mut self,
        function: impl Fn(&Body, &[Force], Vec3, &FractureConfig) -> Result<Outcome, InputError>
        + Send
        + Sync
        + 'static,
    ) {
        self.weighs_quickly = false;
        self.rest_function = Box::new(function);
        self.weigh_anew();
    }

    /// The configuration of the world.
    #[must_use]
    pub fn config(&self) -> &WorldConfig {
        &self.config
    }

    /// Settings of the fracture model, which may be changed between steps.
    pub fn fracture_config_mut(&mut self) -> &mut FractureConfig {
        self.weigh_anew();
        &mut self.config.fracture
    }

    /// Steps taken so far.
    #[must_use]
    pub fn steps(&self) -> u64 {
        self.state.steps
    }

    /// Simulated time, s.
    #[must_use]
    pub fn time(&self) -> f64 {
        self.state.steps as f64 * f64::from(self.physics.integration_parameters.dt)
    }

    /// Breaks of the last step.
    #[must_use]
    pub fn breaks(&self) -> &[BreakEvent] {
        &self.events
    }

    /// Impacts and pushes of the last step that did not break a body; empty unless [`WorldConfig::record_held`] is set.
    #[must_use]
    pub fn held(&self) -> &[HeldEvent] {
        &self.held
    }

    /// The breakable body behind a handle; `None` for fragments, strikers and floors.
    #[must_use]
    pub fn breakable(&self, handle: RigidBodyHandle) -> Option<&Body> {
        self.state.breakables.get(&key(handle))
    }

    /// Handles of all breakable bodies.
    pub fn breakables(&self) -> impl Iterator<Item = RigidBodyHandle> {
        self.state
            .breakables
            .keys()
            .map(|&(index, generation)| RigidBodyHandle::from_raw_parts(index, generation))
    }

    /// Debris in the world, oldest first.
    pub fn debris(&self) -> impl Iterator<Item = RigidBodyHandle> {
        self.state.debris.iter().copied()
    }

    /// Number of breaks that were suppressed because the fragments would exceed [`WorldConfig::max_bodies`].
    #[must_use]
    pub fn refused_breaks(&self) -> u64 {
        self.state.refused_breaks
    }

    /// Counts of all impacts so far, by outcome.
    #[must_use]
    pub fn impact_counts(&self) -> LoadCounts {
        self.state.impact_counts
    }

    /// Counts of all sustained loads so far, by outcome.
    #[must_use]
    pub fn rest_counts(&self) -> LoadCounts {
        self.state.rest_counts
    }

    /// Times of the parts of the last step.
    #[must_use]
    pub fn timings(&self) -> &StepTimings {
        &self.timings
    }

    /// Number of steps that began with a copy of the world, because a breakable body might be hit.
    #[must_use]
    pub fn snapshots(&self) -> u64 {
        self.state.snapshots
    }

    /// Number of steps that were undone and repeated with fragments.
    #[must_use]
    pub fn undone_steps(&self) -> u64 {
        self.state.undone_steps
    }
}
