//! Waiting fronts, and the upper bounds that refuse them without an evaluation of the stress.
//!
//! A refused front is tried again at each time step, and most tries fail. So an upper bound of the tension at its place is found for all steps of
//! a batch at once, side by side in vectors. The stress is evaluated only at steps where this bound may pay for the front.

use glam::Vec3;

use super::felt::Felt;
use super::field::StressField;
use super::single::Front;
use super::system::CrackSystem;
use crate::stress::{Lanes, STRIDE, lane};

/// Allowance for rounding: the bounds sum the modes in another order than the stress does.
const ROUNDING: f32 = 1.01;

/// A waiting front.
#[derive(Clone, Debug)]
pub(crate) struct Waiting {
    /// Middle of what the crack cuts of the tetrahedron ahead if it runs straight on, m.
    pub(super) place: Vec3,
    /// Area of that, m².
    pub(super) area: f32,
    /// Batch of the bounds.
    batch: Option<usize>,
    /// Upper bounds of the largest tension there at the steps of the batch, Pa.
    bounds: Lanes,
}

impl CrackSystem<'_> {
    /// Puts a front on the list of waiting fronts. `ahead`: the area, m², that it would cut if it ran straight on, and the middle of it, m.
    pub(super) fn wait(&mut self, mut front: Front, ahead: (f32, Vec3)) {
        let (area, place) = ahead;
        front.waiting.get_or_insert_with(|| {
            self.waiting.push(Waiting {
                place,
                area,
                batch: None,
                bounds: Lanes::default(),
            });
            self.waiting.len() as u32 - 1
        });
        self.stalled.push(front);
    }

    /// Discards everything found for the present batch, after a change of the motion.
    pub(crate) fn forget_batch(&mut self) {
        self.releases.forget_batch();
        self.waiting.iter_mut().for_each(|front| front.batch = None);
    }

    /// Returns true if the upper bound of the tension shows that a refused front stays refused at the present step.
    pub(super) fn waits_on(&mut self, front: &Front, field: &mut StressField) -> bool {
        let (Some(waiting), true) = (front.waiting, front.refused > 0.0) else {
            return false;
        };
        let waiting = &mut self.waiting[waiting as usize];
        let batch = field.step / STRIDE;
        if waiting.batch != Some(batch) {
            let bounds = field.tension_bounds(front.tet as usize, waiting.place);
            (waiting.batch, waiting.bounds) = (Some(batch), bounds);
        }
        let (place, most) = (waiting.place, waiting.bounds[lane(field.step)].max(0.0));
        !self.may_pay_at(front, ROUNDING * most, place, field)
    }

    /// Returns true if the stress does not pay for a refused front in any direction that the crack may turn to. The area is that of the refusal.
    pub(super) fn stays_refused(
        &mut self,
        front: &Front,
        felt: &Felt,
        at: Vec3,
        field: &StressField,
    ) -> bool {
        if front.refused <= 0.0 || self.config.is_paper() {
            return false;
        }
        !self.may_pay_at(front, felt.largest_tension(), at, field)
    }

    /// Returns true if this tension, Pa, or the section of the crack pays for a refused front at a place, m.
    fn may_pay_at(&mut self, front: &Front, tension: f32, at: Vec3, field: &StressField) -> bool {
        let in_wall = field.wall(front.tet as usize).is_some();
        let crack = &self.cracks[front.crack as usize];
        let normal = crack.elements[front.from as usize].direction;
        let needs = crack.spent + self.cost(front.tet, front.refused) - crack.available;
        let depth = self.tip_depth(front);
        let depth = depth.unwrap_or_else(|| self.depth(crack, front.tet, in_wall));
        let tension = f64::from(tension);
        let gain = depth * 0.5 * tension * tension / self.asset.material.contact_modulus();
        let area = f64::from(front.refused);
        needs < area * gain || needs < area * self.section_feed(front, at, normal, field)
    }
}
