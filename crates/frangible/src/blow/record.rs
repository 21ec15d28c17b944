//! Record of the integration of a blow beside the motion, and the contact reports and complement made from it.

use std::sync::Arc;

use super::integrate::Progress;
use super::plan::Plan;
use crate::contact::ContactReport;
use crate::motion::{Complement, Residual};
use crate::near_field::NearField;
use crate::stress::Shape;

/// Results of an integration so far, beside the motion.
#[derive(Clone, Debug, Default)]
pub(super) struct Record {
    /// Forces after each substep, N.
    pub(super) forces: Vec<f64>,
    /// ω p of all wall oscillators at each time step until the near field has gone, m·√kg/s.
    pub(super) swing: Vec<f32>,
    /// Energy of the body's vibration and pieces, and the strain energy in it, at the end of each time step, J.
    pub(super) energies: Vec<[f64; 2]>,
    /// Workspace for q'.
    pub(super) elastic: Vec<f64>,
}

impl Record {
    /// Forgets the results after an earlier state.
    pub(super) fn forget_after(&mut self, progress: &Progress, plan: &Plan) {
        self.forces.truncate(progress.substep * plan.sites.len());
        let waves = plan.own - plan.modes;
        self.swing.truncate(progress.near_steps() * waves);
        self.energies.truncate(progress.step);
    }

    /// Forces of a contact after each substep, N.
    pub(super) fn forces_of(&self, plan: &Plan, contact: usize) -> impl Iterator<Item = f64> {
        let own = self.forces.iter().skip(contact);
        own.step_by(plan.sites.len()).copied()
    }

    /// Forces of a contact at the end of each time step, N.
    fn sampled(&self, plan: &Plan, contact: usize) -> impl Iterator<Item = f32> {
        let ends = self.forces_of(plan, contact).skip(plan.substeps - 1);
        ends.step_by(plan.substeps).map(|force| force as f32)
    }

    /// Report of a contact whose striker leaves at this speed, m/s.
    pub(super) fn report(
        &self,
        plan: &Plan,
        contact: usize,
        departure_speed: f64,
    ) -> ContactReport {
        let site = &plan.sites[contact];
        let dt = plan.time_step / plan.substeps as f64;
        let (mut impulse, mut peak, mut last) = (0.0, 0.0_f64, 0);
        for (i, force) in (1..).zip(self.forces_of(plan, contact)) {
            impulse += force;
            peak = peak.max(force);
            last = if force > 0.0 { i } else { last };
        }
        let crushing_energy = match site.script {
            Some(_) => 0.0,
            None => site.spring.crushing_energy(peak),
        };
        ContactReport {
            point: site.touch.contact.point,
            normal: site.touch.contact.normal,
            striker_radius: match site.script {
                Some(_) => 0.0,
                None => f64::from(site.touch.contact.striker.curvature_radius),
            },
            approach_speed: f64::from(site.touch.contact.approach_speed),
            impulse: impulse * dt,
            peak_force: peak,
            duration: f64::from(last) * dt,
            contact_radius: (site.near.as_ref())
                .map_or(site.spring.contact_radius(peak), |near| near.contact_radius),
            departure_speed,
            crushing_energy,
            crushed_volume: crushing_energy / site.spring.crushing_pressure,
            force: self.sampled(plan, contact).collect(),
        }
    }

    /// Parts of the motion so far that the modes leave out. `shapes`: those that follow each contact's force; `near_steps`: number of time steps of
    /// the near field so far.
    pub(super) fn complement(
        &self,
        plan: &Plan,
        shapes: &[Option<Arc<Shape>>],
        near_steps: usize,
    ) -> Complement {
        let mut complement = Complement::default();
        let mut first = 0;
        for (k, (site, shape)) in plan.sites.iter().zip(shapes).enumerate() {
            let force: Vec<f32> = self.sampled(plan, k).collect();
            if let Some(near) = &site.near {
                let oscillators = near.oscillators.len();
                let rows = self.swing.chunks_exact((plan.own - plan.modes).max(1));
                let frequencies = &plan.oscillators[near.oscillators.clone()];
                // From ω p of the oscillator of unit mass to ω² q of the one that the force itself drives, N.
                let scale: Vec<f32> = (near.bands.oscillators.iter().zip(frequencies))
                    .map(|(band, (w, _))| (w / band.give.sqrt()) as f32)
                    .collect();
                let mut swing = Vec::with_capacity(rows.len() * oscillators);
                for row in rows {
                    let own = &row[first..first + oscillators];
                    swing.extend(own.iter().zip(&scale).map(|(x, s)| x * s));
                }
                first += oscillators;
                let mut across: Vec<f32> = force.iter().map(|f| f * near.across as f32).collect();
                across.resize(near_steps, 0.0);
                let field = NearField::new(near.place, &near.shapes, &swing, &across);
                complement.near.push(field);
            }
            let shape = shape.as_ref().map(Arc::clone);
            complement
                .residuals
                .extend(shape.map(|shape| Residual { shape, force }));
        }
        complement
    }
}
