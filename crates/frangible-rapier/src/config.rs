//! Settings of the world.

use frangible::FractureConfig;
use rapier3d::math::Vector;

use crate::error::{WorldError, finite, not_negative, positive};

/// Time at which a breaking body is replaced by its fragments.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Breaking {
    /// Inside the step: the step is undone and repeated with fragments, so that a ball continues through the pane that it broke.
    /// Costs a copy of the world in every step with a possible impact, and a second Rapier step in every step with a break.
    #[default]
    InsideStep,
    /// After the step, which is kept: the whole body takes the blow, and its fragments continue with its motion. If the break is
    /// computed in the step of the blow, the striker gets back the excess impulse that the engine took and meets the pieces in the
    /// next step; if it is computed later, a ball loses as much speed as if the body had held. Needs no copy and no second step; for
    /// scenes with hundreds of bodies.
    AfterStep {
        /// Work per step, in tetrahedra of the fracture meshes of bodies that a quick bound does not clear; at least one body. The
        /// others wait in the order of their blows and stay whole until then; if a waiting body is hit several times, the hardest
        /// blow counts. `usize::MAX`: no waiting. With a delay, no more than `budget` × `delay` is under way at once, or one body: other threads
        /// that compute so much in that time are never waited for.
        budget: usize,
        /// Number of steps that other threads have to compute a break while the world continues; the world then waits for unfinished
        /// breaks, so that a body breaks in the same step on any machine. 0: compute the break inside
        /// [`step`](crate::BreakableWorld::step).
        delay: usize,
    },
}

/// Level of detail of a collider.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ColliderDetail {
    /// Largest number of convex parts, 1 or more: neighbouring cells are merged down to this number. 1 gives the convex hull.
    pub parts: usize,
    /// Largest number of points of each part, 4 or more. A part of a fragment has fewer where fewer suffice: its hull follows what is drawn to
    /// 0.3 % of the fragment's longest side, or of [`WorldConfig::length_unit`] if that is longer. A fragment that is a single hull may have as many as
    /// all parts together.
    pub hull_points: usize,
}

/// Fragments whose collider is a single hull of few points, however hollow they are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SmallPieces {
    /// Mass below which a fragment is small, kg; zero for none.
    pub mass: f32,
    /// Largest number of points of its hull, 4 or more.
    pub hull_points: usize,
}

/// Settings of fragments that can break again.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct PieceConfig {
    /// Number of generations of fragments that can break again: 1 means only pieces of baked bodies. Default 3; 0 for none.
    pub generations: u32,
    /// Smallest mass of a fragment that can break again, kg. Default 2e-3, a shard of glass 20 mm wide.
    pub least_mass: f32,
    /// Smallest number of uncut tetrahedra of a fragment that can break again. Default 60.
    pub least_tets: usize,
    /// Time from a fragment's birth until it can break, s. Default 0.02: the blow that made it is over by then.
    pub delay: f32,
    /// Time from a fragment's birth until its modes that take longer to compute are used, s. Default 0.15.
    pub later: f32,
    /// Also computes new modes for bodies that are cracked but not broken. Default on.
    pub cracked: bool,
    /// Thread time, s, spent on pieces per simulated second, for each of `delay` and `later`. Work beyond it, by the
    /// [times that the model expects](frangible::internals::PieceModel::expected_times), is postponed, heavy fragments first. Default
    /// infinity: nothing is postponed, and the world waits for unfinished work. About 0.5 suits games: a body that breaks into a hundred
    /// pieces then costs no frame.
    pub pace: f32,
}

impl PieceConfig {
    /// Steps that a fragment is plain at least: it and its siblings part first.
    pub(crate) const SOONEST: u64 = 3;
}

impl Default for PieceConfig {
    fn default() -> Self {
        Self {
            generations: 3,
            least_mass: 2e-3,
            least_tets: 60,
            delay: 0.02,
            later: 0.15,
            cracked: true,
            pace: f32::INFINITY,
        }
    }
}

/// Treatment of pieces at rest.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum AtRest {
    /// Pieces sleep until something touches them.
    #[default]
    Sleep,
    /// Pieces become fixed, so nothing moves them and they cost no solver time. They can still break again.
    Freeze,
    /// Pieces of one body become one fixed body, its rubble, with one compound collider: see [`merged`](crate::BreakableWorld::merged). A copy of
    /// the world, its broad phase and its contacts have that collider in the place of all of theirs, and they do not count for
    /// [`WorldConfig::max_bodies`]. A piece that can break and may be hit at [`WorldConfig::impact_speed`] or more comes loose before the step that
    /// hits it, with those that lie on it; the others stay where they are, as the floor does. A rubble has the surface, the collision groups and the
    /// user data of its first piece. Pieces that lie on a body that can move, or on a held body that can break, go on sleeping.
    Merge,
    /// Pieces are removed.
    Go,
}

/// Settings for stepping, impacts and fragments.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct WorldConfig {
    /// Gravitational acceleration, m/s². Default (0, −9.81, 0).
    pub gravity: Vector,
    /// Time step, s. Default 1/240: at 1/60 a piece that falls for half a second moves 8 cm per step.
    pub dt: f32,
    /// Typical body size, m: Rapier's tolerances (slop, prediction, push-out speed, sleep speed) scale with it.
    /// Default 0.1. Rapier's own 1 m leaves gaps of 5 mm, more than a pane is thick.
    pub length_unit: f32,
    /// Solver iterations per step, 1 or more. Default 4.
    pub solver_iterations: usize,
    /// Largest speed of bodies, m/s. Default 400.
    pub max_speed: f32,
    /// Smallest approach speed at which a contact is tested for fracture, m/s. Default 0.5; a higher value means fewer tests.
    pub impact_speed: f32,
    /// Distance below which contact points of a pair are merged, m. Default 5e-4.
    pub merge_distance: f32,
    /// Largest ratio of hull volume to piece volume at which a fragment gets a single convex hull. Default 1.15.
    pub hull_volume_ratio: f32,
    /// Detail of the collider of a whole body; that of a box is a box. Default: all the convex cells of the bake, 128 points each.
    pub whole_collider: ColliderDetail,
    /// Detail of the colliders of fragments; those that a single hull fits have one part. Default: 12 parts of at most 128 points. It dominates
    /// the cost of a heap of pieces. Measured in the china shop of `frangible-lab`, Rapier's time per frame, when every hull had all the points that it
    /// may have: every share of a cell with 128 points 97 ms, 12 parts of 48 points 45 ms, 4 parts of 24 points with
    /// [`WorldConfig::hull_volume_ratio`] 3 13 ms.
    pub fragment_collider: ColliderDetail,
    /// Fragments with the cheapest collider. Default none. They are most of a heap of crockery, and the colliders of the others matter less.
    pub small_pieces: SmallPieces,
    /// Separation speed of fragments of the same parent whose colliders overlap when they are born, m/s; zero leaves these overlaps unchanged.
    /// Fragments that are pressed into each other later come out as other bodies do.
    /// Default 0.002: in a chain of pieces the speeds add up, and the sum must stay below the threshold of rest.
    pub overlap_relaxation: f32,
    /// Rolling resistance arm, m: the torque of rolling resistance is this length times the normal force. Default 5e-4, for rough stone or
    /// dust. Zero: no rolling resistance.
    pub rolling_arm: f32,
    /// Largest drift of a body at rest, m: while it touches something, none of its points moves farther than this within 0.4 s.
    /// Default 3e-3 (7.5 mm/s; Rapier's own threshold is 40 mm/s, but in every step). Zero: Rapier alone decides on sleep.
    /// One that has not been faster than 0.1 m/s for seconds may drift up to six times as far: in a heap some piece always creeps.
    pub rest_drift: f32,
    /// Distance within which a joint of a broken body moves to the fragment nearest to its anchor, m; otherwise it is released.
    /// Default 5e-3.
    pub joint_reach: f32,
    /// Mass below which fragments are debris, kg: their collider is a single hull, and they are removed if there are too many. Default 1e-4, a
    /// chip of glass 3 mm wide.
    pub debris_mass: f32,
    /// Mass below which fragments are dust, kg: debris without a collider, which falls through everything, costs almost nothing, and is
    /// removed after a second. Default 0: no dust.
    pub dust_mass: f32,
    /// Largest number of pieces of debris; the oldest are removed first. Default 200.
    pub max_debris: usize,
    /// Largest mean time of the last 32 steps, s: while it is exceeded, each step removes one in fifty pieces of debris, the oldest
    /// first. Default infinity. A finite value makes runs depend on the speed of the machine and so not reproducible.
    pub step_time: f32,
    /// Treatment of pieces that have rested for [`WorldConfig::rest_time`]: that slept, or stayed within [`WorldConfig::rest_drift`] of their
    /// position, regardless of the rest of their heap. Pieces that touch a movable body other than a piece only sleep. Default
    /// [`AtRest::Sleep`].
    pub at_rest: AtRest,
    /// Time at rest after which [`WorldConfig::at_rest`] applies to a piece, s. Default 2.
    pub rest_time: f32,
    /// Time in which a removed piece [fades](crate::BreakableWorld::fading) without its collider, s. Default zero: it is removed at once.
    pub fade_time: f32,
    /// Largest number of bodies; a body whose fragments would not fit stays whole. Default 4000.
    pub max_bodies: usize,
    /// Largest number of clumps of dice of tempered walls, until which they part where they are hit. Walls that break begin with
    /// [`FractureConfig::clumps`] each, however many there are. Default 600.
    pub max_clumps: usize,
    /// Checks sustained loads after every step and breaks overloaded bodies. Default on.
    pub resting_loads: bool,
    /// Time at which a breaking body is replaced by its fragments. Default: inside the step.
    pub breaking: Breaking,
    /// Settings for fragments that break again, if the world has a [model of how they vibrate](crate::BreakableWorld::with_piece_model).
    pub pieces: PieceConfig,
    /// Also records the impacts that broke nothing, see [`crate::BreakableWorld::held`]. Default off.
    pub record_held: bool,
    /// Settings of the fracture model.
    pub fracture: FractureConfig,
}

impl Default for WorldConfig {
    fn default() -> Self {
        Self {
            gravity: Vector::new(0.0, -9.81, 0.0),
            dt: 1.0 / 240.0,
            length_unit: 0.1,
            solver_iterations: 4,
            max_speed: 400.0,
            impact_speed: 0.5,
            merge_distance: 5e-4,
            hull_volume_ratio: 1.15,
            whole_collider: ColliderDetail {
                parts: usize::MAX,
                hull_points: 128,
            },
            fragment_collider: ColliderDetail {
                parts: 12,
                hull_points: 128,
            },
            small_pieces: SmallPieces {
                mass: 0.0,
                hull_points: 12,
            },
            overlap_relaxation: 0.002,
            rolling_arm: 5e-4,
            rest_drift: 3e-3,
            joint_reach: 5e-3,
            debris_mass: 1e-4,
            dust_mass: 0.0,
            max_debris: 200,
            step_time: f32::INFINITY,
            at_rest: AtRest::default(),
            rest_time: 2.0,
            fade_time: 0.0,
            max_bodies: 4000,
            max_clumps: 600,
            resting_loads: true,
            breaking: Breaking::default(),
            pieces: PieceConfig::default(),
            record_held: false,
            fracture: FractureConfig::default(),
        }
    }
}

impl WorldConfig {
    /// The default without anything that changes the motion of unbreakable bodies: no rolling resistance, and sleep decided by Rapier. Steps
    /// without breakable bodies are bit-identical to Rapier's.
    #[must_use]
    pub fn plain() -> Self {
        Self {
            rolling_arm: 0.0,
            rest_drift: 0.0,
            ..Self::default()
        }
    }

    /// Settings for real-time scenes with hundreds of bodies: steps of 1/60 s; breaks after the step, about one body per step, with three
    /// steps for other threads to compute it; colliders with few parts, and a single hull for pieces that fill a third of it.
    #[must_use]
    pub fn for_games() -> Self {
        Self {
            dt: 1.0 / 60.0,
            hull_volume_ratio: 3.0,
            whole_collider: ColliderDetail {
                parts: 16,
                hull_points: 64,
            },
            fragment_collider: ColliderDetail {
                parts: 4,
                hull_points: 64,
            },
            breaking: Breaking::AfterStep {
                budget: 2_000,
                delay: 3,
            },
            max_clumps: 200,
            ..Self::default()
        }
    }

    /// Checks every number.
    ///
    /// # Errors
    /// The first field that is not finite or out of range, including those of the fracture model.
    pub fn validate(&self) -> Result<(), WorldError> {
        finite("gravity", self.gravity)?;
        positive("time step (s)", self.dt)?;
        positive("length unit (m)", self.length_unit)?;
        positive("number of solver iterations", self.solver_iterations as f32)?;
        positive("largest speed (m/s)", self.max_speed)?;
        positive("impact speed (m/s)", self.impact_speed)?;
        not_negative("merge distance (m)", self.merge_distance)?;
        positive("hull volume ratio", self.hull_volume_ratio)?;
        not_negative("overlap relaxation (m/s)", self.overlap_relaxation)?;
        not_negative("rolling arm (m)", self.rolling_arm)?;
        not_negative("rest drift (m)", self.rest_drift)?;
        not_negative("joint reach (m)", self.joint_reach)?;
        for detail in [self.whole_collider, self.fragment_collider] {
            positive("number of parts of a collider", detail.parts as f32)?;
            positive("number of points of a hull", detail.hull_points as f32)?;
        }
        not_negative("mass of a small piece (kg)", self.small_pieces.mass)?;
        positive(
            "number of points of a small piece",
            self.small_pieces.hull_points as f32,
        )?;
        not_negative(
            "least mass of a piece that breaks again (kg)",
            self.pieces.least_mass,
        )?;
        not_negative("delay until a piece breaks again (s)", self.pieces.delay)?;
        not_negative("delay of a piece's own modes (s)", self.pieces.later)?;
        if self.pieces.pace != f32::INFINITY {
            positive("pace of the work on pieces (s/s)", self.pieces.pace)?;
        }
        if self.step_time != f32::INFINITY {
            not_negative("longest step (s)", self.step_time)?;
        }
        not_negative("time of rest (s)", self.rest_time)?;
        not_negative("time of fading (s)", self.fade_time)?;
        not_negative("dust mass (kg)", self.dust_mass)?;
        not_negative("debris mass (kg)", self.debris_mass)?;
        Ok(self.fracture.validate()?)
    }
}
