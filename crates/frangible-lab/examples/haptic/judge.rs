//! Work that takes too long for a tick: it is done on a thread of its own, and its result is taken at a tick that is known beforehand.

use std::sync::Arc;
use std::thread::JoinHandle;

use frangible::glam::Vec3;
use frangible::internals::{Force, Vibration, rest};
use frangible::{Body, FractureConfig, InputError, Outcome};

/// Ticks from a question to its verdict: twice the time that a break of 8 000 tetrahedra takes one core.
pub(crate) const DELAY: u64 = 24;

/// A case to decide about a body.
pub(crate) enum Case {
    /// An impact that has begun.
    Impact(Box<Vibration>),
    /// A force that presses.
    Press(Force),
}

/// Cracks, pieces and surfaces on another thread, one case at a time.
pub(crate) struct Judge {
    config: FractureConfig,
    /// Given, not handed over yet.
    given: Option<(Arc<Body>, Case)>,
    work: Option<JoinHandle<Result<Outcome, InputError>>>,
    /// Tick at which the verdict on the case at hand is taken.
    due: Option<u64>,
}

impl Judge {
    pub(crate) fn new(config: FractureConfig) -> Self {
        Self {
            config,
            given: None,
            work: None,
            due: None,
        }
    }

    /// Returns true if a case is at hand: then no other is taken.
    pub(crate) fn is_busy(&self) -> bool {
        self.due.is_some()
    }

    /// Gives it a case at a tick; the work begins with [`Judge::hand_over`].
    pub(crate) fn ask(&mut self, tick: u64, body: &Arc<Body>, case: Case) {
        if self.due.is_none() {
            self.given = Some((Arc::clone(body), case));
            self.due = Some(tick + DELAY);
        }
    }

    /// Begins the work, where there is some. After the tick's answer is out: to start a thread takes longer than a tick should.
    pub(crate) fn hand_over(&mut self) {
        if let Some((body, case)) = self.given.take() {
            let config = self.config.clone();
            self.work = Some(std::thread::spawn(move || match case {
                Case::Impact(vibration) => Ok(vibration.end(&body, &config, 0)),
                Case::Press(force) => rest(&body, &[force], Vec3::ZERO, &config),
            }));
        }
    }

    /// Returns true if the verdict is due at this tick.
    pub(crate) fn is_due(&self, tick: u64) -> bool {
        self.due == Some(tick)
    }

    /// Returns true if the verdict has come.
    pub(crate) fn is_ready(&self) -> bool {
        self.work.as_ref().is_some_and(JoinHandle::is_finished)
    }

    /// The verdict that is due at this tick; waits for it if it is not ready.
    pub(crate) fn verdict(&mut self, tick: u64) -> Option<Result<Outcome, InputError>> {
        if !self.is_due(tick) {
            return None;
        }
        self.hand_over();
        self.due = None;
        self.work.take()?.join().ok()
    }
}
