//! Batches of impacts.

use frangible::internals::{Stage, Vibration};
use frangible::{Body, Contact, FractureConfig, Outcome};
use rayon::prelude::*;

use super::clock::{Clock, PassTime};
use super::device::Gpu;
use super::error::GpuError;
use super::initiation::Initiation;
use super::loaded::{Buffers, Loaded, quadratic_modulus};
use super::response::Response;
use super::wave::{Job, waves};

/// Steps whose bound is below the strength by this share need no look: the rounding of the bound itself, as on the CPU.
const BOUND_MARGIN: f64 = 1e-4;

/// One impact on one body: all contacts of a moment, as for [`frangible::impact()`].
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct Impact<'a> {
    /// The body's kind, loaded.
    pub kind: &'a Loaded,
    /// The body.
    pub body: &'a Body,
    /// The contacts, in its body frame.
    pub contacts: &'a [Contact],
}

impl<'a> Impact<'a> {
    /// An impact on a body whose kind is loaded.
    #[must_use]
    pub fn new(kind: &'a Loaded, body: &'a Body, contacts: &'a [Contact]) -> Self {
        Self {
            kind,
            body,
            contacts,
        }
    }
}

/// Verdict of the GPU on an impact.
#[derive(Clone, Debug)]
pub enum Verdict {
    /// The body clearly held. The second field is the crack initiation, unless the first bound already ruled out cracks.
    Held(Outcome, Option<Initiation>),
    /// The CPU has to continue from a time step: `vibration.end(body, config, first_step)`.
    Open {
        /// The vibration that was begun.
        vibration: Vibration,
        /// First step at which a crack can start.
        first_step: usize,
        /// Crack initiation. None for a body with cracks from earlier impacts.
        initiation: Option<Initiation>,
    },
}

impl Gpu {
    /// Computes the outcome of each impact, like successive calls of [`frangible::impact()`]. Impacts that clearly held are decided on the GPU; the
    /// others are finished on all threads of the CPU.
    ///
    /// # Errors
    /// An invalid contact, a body of another kind than given, a failure of the GPU.
    pub fn impacts(
        &self,
        impacts: &[Impact<'_>],
        config: &FractureConfig,
    ) -> Result<Vec<Outcome>, GpuError> {
        let verdicts = self.verdicts(impacts, config)?;
        Ok(verdicts
            .into_par_iter()
            .zip(impacts)
            .map(|(verdict, impact)| match verdict {
                Verdict::Held(outcome, _) => outcome,
                Verdict::Open {
                    vibration,
                    first_step,
                    ..
                } => vibration.end(impact.body, config, first_step),
            })
            .collect())
    }

    /// Crack initiation of each impact; `None` if the first bound rules out cracks, and for bodies with cracks.
    ///
    /// # Errors
    /// The errors of [`Self::impacts`].
    pub fn initiation(
        &self,
        impacts: &[Impact<'_>],
        config: &FractureConfig,
    ) -> Result<Vec<Option<Initiation>>, GpuError> {
        let verdicts = self.verdicts(impacts, config)?;
        let initiation = |verdict| match verdict {
            Verdict::Held(_, initiation) | Verdict::Open { initiation, .. } => initiation,
        };
        Ok(verdicts.into_iter().map(initiation).collect())
    }

    /// Time of each kind of pass for these impacts, by the GPU's own clock; empty if it has none. For measurements: no more than the first 2 048
    /// dispatches of a submission are timed.
    ///
    /// # Errors
    /// The same as [`Self::impacts`].
    pub fn pass_times(
        &self,
        impacts: &[Impact<'_>],
        config: &FractureConfig,
    ) -> Result<Vec<PassTime>, GpuError> {
        if !self
            .device
            .features()
            .contains(wgpu::Features::TIMESTAMP_QUERY)
        {
            return Ok(Vec::new());
        }
        self.scratch().clock = Some(Clock::new(&self.device, &self.queue));
        let ran = self.verdicts(impacts, config);
        let clock = self.scratch().clock.take();
        ran?;
        Ok(clock.map_or_else(Vec::new, Clock::into_times))
    }

    /// Verdict on each impact: the body clearly held, or the CPU has to continue from a time step.
    ///
    /// # Errors
    /// The same as [`Self::impacts`].
    pub fn verdicts(
        &self,
        impacts: &[Impact<'_>],
        config: &FractureConfig,
    ) -> Result<Vec<Verdict>, GpuError> {
        let begun = begin(impacts, config)?;
        for (number, impact) in impacts.iter().enumerate() {
            self.buffers_of(number, impact)?;
        }
        let mut found: Vec<Option<Initiation>> = vec![None; impacts.len()];
        for group in groups(impacts, &begun, config) {
            self.group(impacts, &begun, &group, config, &mut found)?;
        }
        Ok(begun
            .into_iter()
            .zip(found)
            .zip(impacts)
            .map(|((stage, found), impact)| verdict(impact.body, stage, found))
            .collect())
    }

    /// Computes the impacts of these numbers, all of one kind.
    fn group(
        &self,
        impacts: &[Impact<'_>],
        begun: &[Stage],
        group: &[usize],
        config: &FractureConfig,
        found: &mut [Option<Initiation>],
    ) -> Result<(), GpuError> {
        let Some(&first) = group.first() else {
            return Ok(());
        };
        let buffers = self.buffers_of(first, &impacts[first])?;
        let kind = impacts[first].kind;
        let asset = kind.asset();
        let jobs: Vec<Job<'_>> = group
            .par_iter()
            .filter_map(|&i| {
                let Stage::Vibrates(vibration) = &begun[i] else {
                    return None;
                };
                let (modal_impulse, pulse) = vibration.pulse()?;
                Some(Job {
                    body: impacts[i].body,
                    response: Response::new(asset.modes(), asset.material(), modal_impulse, pulse),
                    vibration,
                    pulse,
                })
            })
            .collect();
        let limit = |body: &Body| {
            if config.culling {
                (body.weakest() * (1.0 - BOUND_MARGIN)) as f32
            } else {
                -1.0
            }
        };
        let mut numbers = group.iter();
        let mut rest = jobs.iter();
        for mut wave in waves(&kind.kind, &jobs, limit)? {
            let here: Vec<&Job<'_>> = rest.by_ref().take(wave.spans.len()).collect();
            let of_wave = self.run(kind, buffers, &mut wave, &here, config)?;
            for (initiation, &i) in of_wave.into_iter().zip(&mut numbers) {
                found[i] = Some(initiation);
            }
        }
        Ok(())
    }

    fn buffers_of<'a>(&self, number: usize, impact: &Impact<'a>) -> Result<&'a Buffers, GpuError> {
        if !std::ptr::eq(impact.kind.asset(), &**impact.body.asset()) {
            return Err(GpuError::WrongBody(number));
        }
        let buffers = &*impact.kind.buffers;
        let own = buffers.device == self.device;
        own.then_some(buffers).ok_or(GpuError::NotLoaded(number))
    }
}

/// The first stage of each impact, on all threads.
fn begin(impacts: &[Impact<'_>], config: &FractureConfig) -> Result<Vec<Stage>, GpuError> {
    let begun: Vec<_> = impacts
        .par_iter()
        .map(|i| Vibration::begin(i.body, i.contacts, config))
        .collect();
    begun
        .into_iter()
        .enumerate()
        .map(|(impact, stage)| stage.map_err(|error| GpuError::Input { impact, error }))
        .collect()
}

/// Numbers of the impacts that the GPU computes, by kind.
fn groups(impacts: &[Impact<'_>], begun: &[Stage], config: &FractureConfig) -> Vec<Vec<usize>> {
    let mut groups: Vec<Vec<usize>> = Vec::new();
    for (i, impact) in impacts.iter().enumerate() {
        // Old cracks move at stresses below the strength.
        let Stage::Vibrates(vibration) = &begun[i] else {
            continue;
        };
        if !impact.body.state().is_intact() || !within_range(impact.kind, vibration, config) {
            continue;
        }
        let same =
            |g: &&mut Vec<usize>| std::ptr::eq(impacts[g[0]].kind.asset(), impact.kind.asset());
        match groups.iter_mut().find(same) {
            Some(group) => group.push(i),
            None => groups.push(vec![i]),
        }
    }
    groups
}

/// Returns true if the GPU covers all effects of the impact, and no stress can be so large that its cube overflows. No real blow comes near that
/// limit.
fn within_range(kind: &Loaded, vibration: &Vibration, config: &FractureConfig) -> bool {
    const MOST: f64 = 1e12;
    // Integrated contact forces, the near field of walls and the mean stress over a flaw are known to the CPU only; and all modes that the GPU has
    // must be followed.
    let Some((modal_impulse, _)) = vibration.pulse() else {
        return false;
    };
    if config.sized_flaws || kind.asset().modes().residual_modes > 0 {
        return false;
    }
    let asset = kind.asset();
    let modes = asset.modes();
    let (mut stress, mut gradient) = (0.0, 0.0);
    for (i, impulse) in modal_impulse.iter().enumerate() {
        let amplitude = impulse.abs() / modes.eigenvalues[i].sqrt();
        stress += amplitude * f64::from(kind.root[i][0]);
        gradient += amplitude * f64::from(kind.root[i][1]);
    }
    let modulus = quadratic_modulus(asset.material(), config);
    // A NaN is not within.
    stress + 0.5 * modulus * gradient * gradient < MOST
}

fn verdict(body: &Body, stage: Stage, found: Option<Initiation>) -> Verdict {
    let vibration = match stage {
        Stage::Vibrates(vibration) => vibration,
        Stage::Held(outcome) => return Verdict::Held(outcome, None),
    };
    let open = found.as_ref().map_or(Some(0), |f| f.first_open(body));
    match (open, found) {
        (None, Some(found)) => {
            let mut report = vibration.report;
            report.looked_at = found.looked_at;
            report.peak_stress = f64::from(found.peak_stress);
            report.stress_bound = f64::from(found.peak_stress.max(found.passed_over));
            let held = Outcome::Held {
                margin: found.margin,
                report,
                state: None,
            };
            Verdict::Held(held, Some(found))
        }
        (open, found) => Verdict::Open {
            vibration,
            first_step: open.unwrap_or(0),
            initiation: found,
        },
    }
}
