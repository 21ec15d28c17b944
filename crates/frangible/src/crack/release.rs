//! Release waves (Mott 1947; beyond the paper): a new free surface unloads the material beside it at wave speed.
//!
//! At a point x and time t every crack with a fractured tetrahedron e' whose wave is there, `|x − x_e'| < c_R (t − t_e')`, takes away part
//! of the stress across it. How much follows from the crack's present length and where beside it the nearest such tetrahedron lies
//! (`stress/shadow.rs`); no constant sets how far. Crack after crack in their order, since what two of them leave depends on it.
//!
//! The nearest tetrahedron may lie less straight beside a point than one before it, where a crack bends. A point therefore keeps, of each crack,
//! the smallest share that it has met when it asked: what is released stays released.
//!
//! A crack's tetrahedra are thinned to *sites* about one mean edge apart, the first of each place: some ten tetrahedra
//! lie in one such place, and the difference in distance is below what the mesh resolves. A site stands for the crack as far as half an
//! edge around it, so that a point close to the crack does not pass between two of them.
//!
//! A point asks once or twice in an impact, so each time it looks at all sites of all cracks near by, side by side in vectors. Lists of waves
//! on their way, which would spare it the second look, cost more than they save (`docs/speed.md`). The few cracks that are close come first:
//! where they leave less than the strength, the others need no look.

mod memory;

use glam::Vec3;
use memory::{Memory, Sources};

use super::extents::Ring;
use super::field::StressField;
use super::suspects::Suspect;
use super::system::CrackSystem;
use crate::stress::{
    BATCH, MARGIN, Released, STRIDE, Steps, StressLanes, Symmetric3, bent, lane, largest_eigenvalue,
};

/// Rounding of what is left, relative to the whole stress.
const ROUNDING: f32 = 1e-5;

/// Number of cracks after which it is asked again whether the remaining stress is low enough.
const BETWEEN_LOOKS: usize = 4;

/// A weak point that has asked for its release.
#[derive(Clone, Debug)]
struct Point {
    memory: Memory,
    /// Batch of steps that `held` is about.
    held_in: Option<usize>,
    /// Bit k: at step k of the batch what is left stays below the strength.
    held: Steps,
    /// True if shares fell since `held` was found.
    changed: bool,
    /// Batch of steps in which the stress behind the wall's middle was last asked for, and its place among those.
    opposite: Option<(usize, usize)>,
}

/// Memory of the points that have asked, by their place among the weak points.
#[derive(Default)]
pub(crate) struct Releases {
    points: Vec<Option<Point>>,
    /// Stress behind the middle of walls in the present batch, by the order in which it was asked for.
    opposites: Vec<StressLanes>,
    /// The present batch.
    batch: usize,
}

impl Releases {
    /// Forgets what is known of the present batch: the motion goes on in another way.
    pub(crate) fn forget_batch(&mut self) {
        self.opposites.clear();
        for point in self.points.iter_mut().flatten() {
            (point.held_in, point.opposite) = (None, None);
        }
    }

    /// Returns true if the remaining stress of a suspect at the field's step may pass its strength, Pa; false is certain.
    ///
    /// It is found for the rest of the batch at once, and a false stands until the batch ends, whatever cracks do in the meantime: they
    /// only release more.
    pub(crate) fn may_crack(
        &mut self,
        system: &CrackSystem,
        field: &mut StressField,
        suspect: &Suspect,
        strength: f32,
        now: f64,
    ) -> bool {
        let batch = field.step / STRIDE;
        let place = suspect.place as usize;
        // What it remembers may do already: since then cracks have only released more.
        if let Some(Some(point)) = self.points.get(place) {
            if point.memory.is_dark() && point.held_in != Some(batch) {
                self.look(field, suspect, strength);
            }
            if self.holds(suspect.place, field.step) {
                return false;
            }
        }
        for ring in Ring::ALL {
            let Some(point) = self.reached(system, field, suspect, ring, now) else {
                continue;
            };
            if point.held_in != Some(batch) || point.changed {
                self.look(field, suspect, strength);
            }
            if self.holds(suspect.place, field.step) {
                return false;
            }
        }
        true
    }

    /// Returns true if a step is known to leave a weak point, by its place among them, below its strength.
    pub(crate) fn holds(&self, place: u32, step: usize) -> bool {
        let point = self.points.get(place as usize).and_then(Option::as_ref);
        point.is_some_and(|p| p.held_in == Some(step / STRIDE) && p.held >> lane(step) & 1 == 1)
    }

    /// Finds the steps from the field's on at which what is left of a suspect's stress stays below the strength, Pa, by what its point
    /// remembers.
    fn look(&mut self, field: &mut StressField, suspect: &Suspect, strength: f32) {
        let (batch, step) = (field.step / STRIDE, lane(field.step));
        let limit = strength * (1.0 - MARGIN);
        let needed = Steps::MAX << step;
        let left = self.left(field, suspect, Some((limit, needed)));
        let mut held = holding(&left, suspect, limit);
        // The bound is too high by up to a third where two tensions are equal.
        for k in step..BATCH {
            if held >> k & 1 == 0 {
                held |= Steps::from(largest_eigenvalue(&left.stress(k)) <= limit) << k;
            }
        }
        if let Some(point) = &mut self.points[suspect.place as usize] {
            if point.held_in != Some(batch) {
                (point.held_in, point.held) = (Some(batch), 0);
            }
            point.held |= held;
            point.changed = false;
        }
    }

    /// Remaining stress of a suspect at the field's step, at time `now`, s.
    pub(crate) fn released(
        &mut self,
        system: &CrackSystem,
        field: &mut StressField,
        suspect: &Suspect,
        now: f64,
    ) -> Symmetric3 {
        let k = lane(field.step);
        let mut reached = false;
        for ring in Ring::ALL {
            reached = self.reached(system, field, suspect, ring, now).is_some();
        }
        if reached {
            self.left(field, suspect, None).stress(k)
        } else {
            suspect.state.stress(k)
        }
    }

    /// Remaining stress of a suspect at all steps of the field's batch, without the energy. `enough`: a limit, Pa, and steps at which
    /// it matters only whether the rest stays below.
    fn left(
        &mut self,
        field: &mut StressField,
        suspect: &Suspect,
        enough: Option<(f32, Steps)>,
    ) -> StressLanes {
        left(self, field, suspect, enough)
    }

    /// A suspect's point as the cracks of a ring about it leave it by `now`, s, if any crack has released it.
    fn reached(
        &mut self,
        system: &CrackSystem,
        field: &StressField,
        suspect: &Suspect,
        ring: Ring,
        now: f64,
    ) -> Option<&mut Point> {
        if system.config.is_paper() || system.cracks.is_empty() {
            return None;
        }
        let place = suspect.place as usize;
        if place >= self.points.len() {
            self.points.resize(place + 1, None);
        }
        let point = self.points[place].get_or_insert_with(|| {
            let wall = field.wall(suspect.tet as usize);
            let beta = wall.map(|_| bent(system.asset.material.poisson_ratio));
            Point {
                memory: Memory::new(field.weak_position(suspect.tet as usize), beta),
                held_in: None,
                held: 0,
                changed: true,
                opposite: None,
            }
        });
        point.changed |= point.memory.update(Sources::of(system), ring, None, now);
        point.memory.is_dark().then_some(point)
    }
}

/// Remaining part of a stress at the front of a crack, at this place, m, when all other cracks have released it as of `now`, s. `opposite`: the
/// stress on the other face of a wall. None where the close ones leave no longer `enough`. Nothing is remembered.
pub(super) fn once(
    system: &CrackSystem,
    (crack, place): (u32, Vec3),
    stress: Symmetric3,
    opposite: Option<Symmetric3>,
    now: f64,
    enough: impl Fn(&Symmetric3) -> bool,
) -> Option<Symmetric3> {
    let beta = opposite.map(|_| bent(system.asset.material.poisson_ratio));
    let mut memory = Memory::of_front(place, beta);
    let mut left = stress;
    for ring in Ring::ALL {
        memory.update(Sources::of(system), ring, Some(crack), now);
        let mut rest = Released::of_step(stress, opposite);
        for shadow in memory.shadows() {
            rest.release(shadow);
        }
        left = rest.left();
        if !enough(&left) {
            return None;
        }
    }
    Some(left)
}

widest! {
    /// Computes the remaining stress of a suspect.
    fn left(
        releases: &mut Releases,
        field: &mut StressField<'_>,
        suspect: &Suspect,
        enough: Option<(f32, Steps)>,
    ) -> StressLanes {
        let Releases {
            points,
            opposites,
            batch,
        } = releases;
        let mut rest = Released::of_batch(&suspect.state, None);
        let Some(point) = &mut points[suspect.place as usize] else {
            return rest.left_of_batch();
        };
        let present = field.step / STRIDE;
        if *batch != present {
            *batch = present;
            opposites.clear();
        }
        // Only in a wall the two shares differ.
        if point.memory.bent.is_some()
            && point.opposite.is_none_or(|(of, _)| of != present)
            && let Some(opposite) =
                field.opposite_weak_point(suspect.place as usize, suspect.tet as usize)
        {
            point.opposite = Some((present, opposites.len()));
            opposites.push(opposite);
        }
        let opposite = point.opposite.filter(|&(of, _)| of == present);
        let opposite = opposite.and_then(|(_, i)| opposites.get(i));
        rest = Released::of_batch(&suspect.state, opposite);
        for (k, shadow) in point.memory.shadows().enumerate() {
            rest.release(shadow);
            // What is below stays below.
            if k % BETWEEN_LOOKS == BETWEEN_LOOKS - 1
                && let Some((limit, needed)) = enough
                && holding(&rest.left_of_batch(), suspect, limit) & needed == needed
            {
                break;
            }
        }
        rest.left_of_batch()
    }
}

/// Bit k: at step k of the batch what is left of a suspect's stress stays below a limit, Pa.
#[inline(always)]
fn holding(left: &StressLanes, suspect: &Suspect, limit: f32) -> Steps {
    let mut holding = 0;
    let bounds = left.tension_bounds();
    for (k, (left, whole)) in bounds.iter().zip(&suspect.bounds).enumerate() {
        holding |= Steps::from(left + ROUNDING * whole.abs() <= limit) << k;
    }
    holding
}
