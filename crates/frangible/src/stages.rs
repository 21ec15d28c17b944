//! An impact in two stages, for those who find elsewhere, on a GPU, when its stress first nears the strength; and its second
//! half alone, for motions that come from elsewhere.

use crate::blow::Blow;
use crate::body::Body;
use crate::config::FractureConfig;
use crate::contact::{Contact, Pulse};
use crate::error::{InputError, positive};
use crate::impact::{Begun, Cracked, Cracking, begin, pieces, report_on, vibrate};
use crate::modal::{self, Motion};
use crate::outcome::{ImpactReport, LookedAt, Outcome};

/// What the first stage of an impact leaves to do.
#[derive(Clone, Debug)]
pub enum Stage {
    /// Nothing: its impulses are too weak for any crack.
    Held(Outcome),
    /// Its modes have to be followed over time.
    Vibrates(Vibration),
}

/// An impact whose modes have to be followed over time.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Vibration {
    /// Modal impulse of every mode, N·s/√kg.
    pub modal_impulse: Vec<f64>,
    /// Surface triangles under its contacts: their flaws are pressed together, see [`Body::weak_place`].
    pub pressed: Vec<u32>,
    /// The pulse of unit impulse and its time steps.
    pub pulse: Pulse,
    /// What is known of the impact so far.
    pub report: ImpactReport,
    /// The blow, where it was followed with the body: then the modes are not all there is, and `pulse` only says how long it was.
    pub(crate) blow: Option<Box<Blow>>,
}

impl Vibration {
    /// Begins an impact: everything of [`impact()`](crate::impact()) before the motion of the modes.
    ///
    /// # Errors
    /// As [`impact()`](crate::impact()).
    pub fn begin(
        body: &Body,
        contacts: &[Contact],
        config: &FractureConfig,
    ) -> Result<Stage, InputError> {
        Ok(match begin(body, contacts, config, config.culling)? {
            Begun::Held(margin, report) => Stage::Held(Outcome::Held {
                margin,
                report,
                state: None,
            }),
            Begun::Vibrates(vibration) => Stage::Vibrates(vibration),
        })
    }

    /// Whether the pulse and the modes are all there is. Else the blow was followed with the body, or the modes left out count.
    #[must_use]
    pub fn is_pulse(&self) -> bool {
        self.blow.is_none()
    }

    /// Amplitudes of the modes over time.
    #[must_use]
    pub fn motion(&self, body: &Body) -> Motion {
        if let Some(blow) = &self.blow {
            return blow.motion.clone();
        }
        let asset = &*body.asset;
        modal::respond(
            &asset.modes,
            &asset.material,
            &self.modal_impulse,
            &self.pulse,
        )
    }

    /// Ends the impact. With `first_step` 0 this is [`impact()`](crate::impact()); time steps before it are passed over.
    ///
    /// Where none of those has a weak point's stress above its strength, and the body has no cracks yet, the cracks and
    /// the pieces are the same bit for bit; the report's stresses and the margin are those of the steps looked at.
    #[must_use]
    pub fn end(self, body: &Body, config: &FractureConfig, first_step: usize) -> Outcome {
        pieces(body, vibrate(body, config, self, first_step, &mut None))
    }

    /// Whether the impact would break the body into pieces: [`Self::end`] without making them.
    #[must_use]
    pub fn would_break(self, body: &Body, config: &FractureConfig, first_step: usize) -> bool {
        let cracked = vibrate(body, config, self, first_step, &mut None);
        matches!(cracked, Cracked::Parted(..))
    }
}

/// What cracks do under any motion of a body's modes, wherever it comes from: [`impact()`](crate::impact()) from its stress wave
/// on. `pressed`: surface triangles that something presses on; `time_step`: of the motion, s. With the energy ledger all
/// cracks together spend no more than the motion's [peak strain energy](Motion::peak_strain_energy).
///
/// A motion whose rows are all the same is a steady state: what methods without a vibration make of an impact.
///
/// # Errors
/// A motion, time step or energy that is not one of this body.
pub fn follow(
    body: &Body,
    motion: &Motion,
    pressed: &[u32],
    time_step: f64,
    config: &FractureConfig,
) -> Result<Outcome, InputError> {
    if motion.modes != body.asset.modes.followed() || motion.steps() == 0 {
        return Err(InputError::Motion(
            "it must have an amplitude for each of the body's modes and one time step or more",
        ));
    }
    if !motion.amplitudes.iter().all(|q| q.is_finite()) {
        return Err(InputError::Motion(
            "every amplitude must be a finite number",
        ));
    }
    positive("time step", time_step, "s")?;
    let energy = motion.peak_strain_energy;
    if !energy.is_finite() || energy < 0.0 {
        return Err(InputError::Motion(
            "its strain energy must be a finite number, zero or above",
        ));
    }
    let mut report = report_on(body);
    report.time_step = time_step;
    report.time_steps = motion.steps();
    report.looked_at = LookedAt::Amplitudes;
    let cracked = Cracking {
        body,
        config,
        motion: motion.clone(),
        pressed: pressed.to_vec(),
        time_step,
        budget: energy,
        blow: None,
    }
    .run(0, report, &mut None);
    Ok(pieces(body, cracked))
}
