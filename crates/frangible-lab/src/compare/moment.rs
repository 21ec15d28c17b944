//! The body's stress at one moment of the vibration that ours follows.

use frangible::internals::asset::EmbeddedPoint;
use frangible::internals::modal::Motion;
use frangible::internals::stress::{
    DisplacementBatch, Elasticity, Law, Skin, StressState, largest_eigenvalue,
};
use frangible::internals::{Stage, Vibration};

use super::error::CompareError;
use super::hit::Hit;

/// Moments at which the largest tension is looked for.
const LOOKS: usize = 100;

/// The motion of an impact.
pub(crate) struct Wave<'a> {
    hit: Hit<'a>,
    motion: Motion,
    /// Surface triangles under the contacts.
    pressed: Vec<u32>,
    skin: Skin,
}

/// One time step of it.
pub(crate) struct Moment<'w> {
    wave: &'w Wave<'w>,
    batch: DisplacementBatch,
    elasticity: Elasticity,
}

impl<'a> Wave<'a> {
    /// The modes' answer to the contacts, as [`frangible::impact()`] has it.
    pub(crate) fn new(hit: Hit<'a>) -> Result<Self, CompareError> {
        // Also of a contact that a bound would refuse.
        let mut unculled = hit.config.clone();
        unculled.culling = false;
        let Stage::Vibrates(vibration) = Vibration::begin(hit.body, hit.contacts, &unculled)?
        else {
            return Err(CompareError::NoImpulse);
        };
        Ok(Self {
            motion: vibration.motion(hit.body),
            pressed: vibration.pressed,
            skin: Skin::of(hit.body.asset()),
            hit,
        })
    }

    /// Largest strain energy at a step, J.
    pub(crate) fn strain_energy(&self) -> f64 {
        self.motion.peak_strain_energy
    }

    /// The step at which the strain energy Σ ½ λ q² is largest; the first of several.
    pub(crate) fn most_strained(&self) -> usize {
        let eigenvalues = &self.hit.body.asset().modes().eigenvalues;
        let energy = |step: usize| -> f64 {
            let modes = self.motion.at(step).iter().zip(eigenvalues);
            modes.map(|(&q, l)| l * f64::from(q) * f64::from(q)).sum()
        };
        first_largest((0..self.motion.steps()).map(energy))
    }

    /// The step, of [`LOOKS`] or somewhat more that are spread over the motion, at which the tension of a weak point is the largest
    /// multiple of its strength; the first of several.
    pub(crate) fn most_stressed(&self) -> usize {
        let Hit { body, config, .. } = self.hit;
        let asset = body.asset();
        let mut batch = DisplacementBatch::new(asset);
        let elasticity = elasticity(self.hit);
        let places: Vec<_> = (body.weak_tets().iter())
            .map(|&e| (body.weak_place(e, config, &self.pressed), body.strength(e)))
            .collect();
        let every = (self.motion.steps() / LOOKS).max(1);
        // These steps alone: displacements are worked out for several that follow one another.
        let looks = (0..self.motion.steps()).step_by(every);
        let rows = looks.flat_map(|step| self.motion.at(step));
        let motion = Motion::new(rows.copied().collect(), self.motion.modes, 0.0, 0.0);
        every
            * first_largest((0..motion.steps()).map(|step| {
                batch.seek(&motion, step);
                let tension = |&((point, law), strength): &((_, _), f32)| {
                    let gradient = batch.gradient(asset, &point, step);
                    let state = elasticity.state_by(gradient, law);
                    f64::from(largest_eigenvalue(&state.stress) / strength)
                };
                places.iter().map(tension).fold(0.0, f64::max)
            }))
    }

    /// The body at a step.
    pub(crate) fn at(&self, step: usize) -> Moment<'_> {
        let row = self.motion.at(step).to_vec();
        let motion = Motion::new(row, self.motion.modes, 0.0, 0.0);
        let mut batch = DisplacementBatch::new(self.hit.body.asset());
        batch.seek(&motion, 0);
        Moment {
            wave: self,
            batch,
            elasticity: elasticity(self.hit),
        }
    }
}

impl Moment<'_> {
    /// Stress at the middle of a tetrahedron.
    pub(crate) fn inside(&mut self, tet: u32) -> StressState {
        let Hit { body, config, .. } = self.wave.hit;
        let asset = body.asset();
        let wall = (!config.is_paper()).then(|| self.wave.skin.wall(asset, tet as usize));
        let law = wall
            .flatten()
            .map_or(Law::Solid, |wall| Law::Free(wall.normal));
        self.state(*asset.embedded_tet(tet as usize), law)
    }

    /// Stress at the place in a tetrahedron where a crack may start.
    pub(crate) fn at_weak_point(&mut self, tet: u32) -> StressState {
        let Hit { body, config, .. } = self.wave.hit;
        let (point, law) = body.weak_place(tet, config, &self.wave.pressed);
        self.state(point, law)
    }

    fn state(&mut self, point: EmbeddedPoint, law: Law) -> StressState {
        let asset = self.wave.hit.body.asset();
        let gradient = self.batch.gradient(asset, &point, 0);
        self.elasticity.state_by(gradient, law)
    }
}

fn elasticity(hit: Hit<'_>) -> Elasticity {
    Elasticity::new(hit.body.asset().material()).with_green_lagrange(hit.config.is_paper())
}

/// Place of the largest number, the first of equals.
fn first_largest(numbers: impl Iterator<Item = f64>) -> usize {
    let best = numbers
        .enumerate()
        .fold((0, f64::NEG_INFINITY), |best, new| {
            if new.1 > best.1 { new } else { best }
        });
    best.0
}
