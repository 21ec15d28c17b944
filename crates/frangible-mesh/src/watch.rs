//! Progress of the work, and its cancellation.

use std::ops::ControlFlow;

use crate::error::TetError;

/// The observer of the work, and the share that it was told last.
pub(crate) struct Watch<'a> {
    tell: &'a mut dyn FnMut(f64) -> ControlFlow<()>,
    told: f64,
    /// Share of the work at which the present attempt started: one that is repeated shares the rest.
    start: f64,
}

impl<'a> Watch<'a> {
    pub(crate) fn new(tell: &'a mut dyn FnMut(f64) -> ControlFlow<()>) -> Self {
        Self {
            tell,
            told: 0.0,
            start: 0.0,
        }
    }

    /// Tells that `share` of the present attempt is done; never less than before.
    ///
    /// # Errors
    /// [`TetError::Cancelled`] when told to stop.
    pub(crate) fn reach(&mut self, share: f64) -> Result<(), TetError> {
        let all = self.start + (1.0 - self.start) * share.clamp(0.0, 1.0);
        self.told = self.told.max(all);
        match (self.tell)(self.told) {
            ControlFlow::Continue(()) => Ok(()),
            ControlFlow::Break(()) => Err(TetError::Cancelled),
        }
    }

    /// The work starts over.
    pub(crate) fn start_over(&mut self) {
        self.start = self.told;
    }
}
