//! Progress of the mode stage, its time by phase, and its cancellation.

use std::ops::ControlFlow;
use web_time::Instant;

use crate::error::BakeError;
use crate::phase::Phase;

/// Progress to the caller, and seconds by phase.
pub(crate) struct Watch<'a> {
    progress: &'a mut dyn FnMut(f64) -> ControlFlow<()>,
    told: f64,
    seconds: [f64; Phase::ALL.len()],
}

impl<'a> Watch<'a> {
    pub(crate) fn new(progress: &'a mut dyn FnMut(f64) -> ControlFlow<()>) -> Self {
        Self {
            progress,
            told: 0.0,
            seconds: [0.0; Phase::ALL.len()],
        }
    }

    /// Tells the caller that `share` of the work is done, never less than before.
    ///
    /// # Errors
    /// [`BakeError::Cancelled`] when the caller has had enough.
    pub(crate) fn tell(&mut self, share: f64) -> Result<(), BakeError> {
        self.told = self.told.max(share.clamp(0.0, 1.0));
        match (self.progress)(self.told) {
            ControlFlow::Continue(()) => Ok(()),
            ControlFlow::Break(()) => Err(BakeError::Cancelled),
        }
    }

    /// Adds what `work` takes to a phase.
    pub(crate) fn time<R>(&mut self, phase: Phase, work: impl FnOnce() -> R) -> R {
        let started = Instant::now();
        let result = work();
        self.seconds[phase as usize] += started.elapsed().as_secs_f64();
        result
    }

    /// Wall-clock seconds of each phase.
    pub(crate) fn seconds(&self) -> Vec<(Phase, f64)> {
        Phase::ALL.into_iter().zip(self.seconds).collect()
    }
}
