//! Switches and numbers of the world.

use frangible::FractureConfig;
use rapier3d::math::Vector;

use crate::error::{WorldError, finite, not_negative, positive};

/// Moment at which a body that breaks gives way to its fragments.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Breaking {
    /// Inside the step: it is undone and taken again with fragments, so that a ball goes on through the pane it broke.
    /// Costs a copy of the world in every step that may see an impact, and one more step of Rapier in every step that
    /// sees a break.
    #[default]
    InsideStep,
    /// After the step, which stands: the whole body takes the blow, then its fragments go on with its motion. A body judged in
    /// the step of the blow gives its striker back the excess that the engine took, and the striker meets the pieces in the
    /// next step; to a body judged later a ball loses as much as if it had held. No copy, no second step; for scenes of
    /// hundreds of bodies.
    AfterStep {
        /// Work per step, in tetrahedra of the fracture meshes of the bodies that a quick bound does not clear; one body
        /// at least. The others wait in the order of their blows, and stay whole until then: they collide as whole bodies
        /// do, and of several blows while one waits the hardest counts. `usize::MAX`: none waits.
        budget: usize,
        /// Steps for which other threads may compute a break while the world goes on; then the world waits for unfinished breaks,
        /// so that a body breaks in the same step however fast the machine is. 0: at once, inside
        /// [`step`](crate::BreakableWorld::step).
        delay: usize,
    },
}

/// Level of detail of a collider.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ColliderDetail {
    /// Convex parts at most, 1 or more: neighbouring cells are merged until no more are left. 1 is the convex hull.
    pub parts: usize,
    /// Points of each part at most, 4 or more.
    pub hull_points: usize,
}

/// Settings for fragments that break again.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct PieceConfig {
    /// Generations of fragments that break again: with 1, the pieces of baked bodies are the last that break. Default 3; 0 for none.
    pub generations: u32,
    /// Mass of the lightest fragments that break again, kg. Default 2e-3, a shard of glass 20 mm wide.
    pub least_mass: f32,
    /// Fewest uncut tetrahedra of a fragment that breaks again. Default 60.
    pub least_tets: usize,
    /// Time from a fragment's birth until it can break, s. Default 0.02: the blow that made it is over by then.
    pub delay: f32,
    /// Time from its birth until it has the modes that take longer to find, s. Default 0.15.
    pub later: f32,
    /// Finds new modes for bodies that are cracked but whole, too. Default on.
    pub cracked: bool,
    /// Work of other threads, s, that goes into pieces in a second of the world, for each of the two times above. Work beyond it,
    /// by what the [model](frangible::internals::PieceModel::expected_times) expects, is due later than they say, heavy fragments first.
    /// Default infinity: everything is due when they say, and the world waits for what is not ready. A game takes 0.5 or so: a body that
    /// bursts into a hundred pieces then costs no frame.
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

/// Treatment of pieces that rest.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum AtRest {
    /// They sleep until something touches them.
    #[default]
    Sleep,
    /// They become fixed: nothing moves them any more, and nothing has to be solved for them. They break again as others do.
    Freeze,
    /// Pieces of one body become one fixed body, its rubble, with one compound collider: see [`merged`](crate::BreakableWorld::merged). A copy of
    /// the world, its broad phase and its contacts have that collider in the place of all of theirs, and they do not count for
    /// [`WorldConfig::max_bodies`]. A piece that can break and may be hit at [`WorldConfig::impact_speed`] or more comes loose before the step that
    /// hits it, with those that lie on it; the others stay where they are, as the floor does. A rubble has the surface, the collision groups and the
    /// user data of its first piece. Pieces that lie on a body that can move, or on a held body that can break, go on sleeping.
    Merge,
    /// They are removed.
    Go,
}

/// Settings for stepping, impacts and fragments.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct WorldConfig {
    /// Acceleration of gravity, m/s². Default (0, −9.81, 0).
    pub gravity: Vector,
    /// Time step, s. Default 1/240: at 1/60 a piece that falls for half a second moves 8 cm per step.
    pub dt: f32,
    /// Size of typical bodies, m: Rapier's tolerances (slop, prediction, push-out speed, sleep speed) scale with it.
    /// Default 0.1. Rapier's own 1 m leaves gaps of 5 mm, more than a pane is thick.
    pub length_unit: f32,
    /// Solver iterations per step, 1 or more. Default 4.
    pub solver_iterations: usize,
    /// Largest speed of bodies, m/s. Default 400.
    pub max_speed: f32,
    /// Approach speed from which a contact is an impact, m/s. Default 0.5; raising it asks the fracture less often.
    pub impact_speed: f32,
    /// Distance below which contact points of one pair are one contact, m. Default 5e-4.
    pub merge_distance: f32,
    /// Hull volume over piece volume up to which a fragment gets one convex hull. Default 1.15.
    pub hull_volume_ratio: f32,
    /// Detail of the collider of a whole body; that of a box is a box. Default: all the convex cells of the bake, 128 points each.
    pub whole_collider: ColliderDetail,
    /// Detail of the colliders of fragments that one hull does not fit. Default: 12 parts of at most 48 points. It is most of what a heap of pieces
    /// costs. Measured in `frangible-lab bench shop`, Rapier's time per frame: every share of a cell with 128 points
    /// 97 ms, this 45 ms, 4 parts of 24 points with [`WorldConfig::hull_volume_ratio`] 3 13 ms.
    pub fragment_collider: ColliderDetail,
    /// Speed at which fragments of one parent part when they overlap, m/s; zero leaves overlaps alone.
    /// Default 0.002: along a chain of pieces the speeds add up, and must stay below what counts as rest.
    pub overlap_relaxation: f32,
    /// Distance ahead of a contact's normal at which the pressure of a rolling body acts, m: the torque of rolling resistance is
    /// this × normal force. Default 5e-4: rough stone, dust. Zero: things roll for ever.
    pub rolling_arm: f32,
    /// Drift at most of a body at rest, m: none of its points moves farther than this for 0.4 s while it touches something.
    /// Default 3e-3 (7.5 mm/s; Rapier alone asks for 40 mm/s, but in every step). Zero leaves sleep to Rapier alone.
    pub rest_drift: f32,
    /// A joint of a broken body moves to the nearest fragment within this distance of its anchor, m; else it is
    /// released. Default 5e-3.
    pub joint_reach: f32,
    /// Mass below which fragments are debris, kg: a box for a collider, removed when there are too many. Default 1e-4, a
    /// chip of glass 3 mm wide.
    pub debris_mass: f32,
    /// Mass below which fragments are dust, kg: debris without a collider, so that it falls through everything, costs next to
    /// nothing, and is removed after a second. Default 0: none.
    pub dust_mass: f32,
    /// Largest number of pieces of debris; the oldest goes first. Default 200.
    pub max_debris: usize,
    /// Largest mean time of the last 32 steps, s: while they take longer, one in fifty pieces of debris goes in each, the oldest
    /// first. Default infinity. With it two runs are no longer alike, as they depend on the speed of the machine.
    pub step_time: f32,
    /// Treatment of pieces that have rested for [`WorldConfig::rest_time`]: slept, or stayed within [`WorldConfig::rest_drift`] of their
    /// place, whatever the others of their heap do. Those that touch a body that can move and is no piece sleep on. Default
    /// [`AtRest::Sleep`].
    pub at_rest: AtRest,
    /// Time that a piece has to rest before [`WorldConfig::at_rest`] applies, s. Default 2.
    pub rest_time: f32,
    /// Time in which a piece that is removed [fades](crate::BreakableWorld::fading) without its collider, s. Default zero: it is gone at once.
    pub fade_time: f32,
    /// Largest number of bodies; a body whose fragments would not fit stays whole. Default 4000.
    pub max_bodies: usize,
    /// Checks resting loads after every step, and breaks bodies that carry too much. Default on.
    pub resting_loads: bool,
    /// Moment at which a body gives way to its fragments. Default inside the step.
    pub breaking: Breaking,
    /// Settings for fragments that break again, if the world has a [model of how they vibrate](crate::BreakableWorld::set_piece_model).
    pub pieces: PieceConfig,
    /// Also records the impacts that broke nothing, see [`crate::BreakableWorld::held`]. Default off.
    pub record_held: bool,
    /// Switches and numbers of the fracture.
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
                hull_points: 48,
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
            resting_loads: true,
            breaking: Breaking::default(),
            pieces: PieceConfig::default(),
            record_held: false,
            fracture: FractureConfig::default(),
        }
    }
}

impl WorldConfig {
    /// The default without everything that changes the motion of unbreakable bodies: no rolling resistance, and sleep left to Rapier. So steps
    /// without breakable bodies are Rapier's own, bit for bit.
    #[must_use]
    pub fn plain() -> Self {
        Self {
            rolling_arm: 0.0,
            rest_drift: 0.0,
            ..Self::default()
        }
    }

    /// Settings for hundreds of bodies at a game's rate: steps of 1/60 s; breaks after the step, about one body a step, which
    /// other threads have three steps for; colliders of few parts, a single hull where a piece fills a third of it.
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
                hull_points: 24,
            },
            breaking: Breaking::AfterStep {
                budget: 2_000,
                delay: 3,
            },
            ..Self::default()
        }
    }

    /// Checks every number.
    ///
    /// # Errors
    /// The first field that is not finite or out of its range, of the fracture's too.
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
