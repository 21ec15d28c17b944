//! Work that takes too long for a tick: it is done on a thread of its own, and its result is taken at a tick that is known beforehand.

use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender, channel};
use std::thread::JoinHandle;

use frangible::glam::Vec3;
use frangible::internals::{Force, Vibration, rest};
use frangible::{Body, FractureConfig, InputError, Outcome};

/// A case to decide about a body.
pub(crate) enum Case {
    /// An impact that has begun.
    Impact(Box<Vibration>),
    /// A force that presses.
    Press(Force),
}

/// Cracks, pieces and surfaces on another thread.
pub(crate) struct Judge {
    cases: Option<Sender<(Arc<Body>, Case)>>,
    verdicts: Receiver<Result<Outcome, InputError>>,
    thread: Option<JoinHandle<()>>,
    /// Given, not handed over yet.
    given: Option<(Arc<Body>, Case)>,
    /// Verdict that has come already.
    ready: Option<Result<Outcome, InputError>>,
    /// Tick at which the verdict on the case at hand is taken.
    due: Option<u64>,
    delay: u64,
}

impl Judge {
    /// Begins a thread; every verdict is taken `delay` ticks after its case was given.
    pub(crate) fn new(config: FractureConfig, delay: u64) -> Self {
        let (cases, to_judge) = channel::<(Arc<Body>, Case)>();
        let (judged, verdicts) = channel();
        let thread = std::thread::spawn(move || {
            for (body, case) in to_judge {
                let verdict = match case {
                    Case::Impact(vibration) => Ok(vibration.end(&body, &config, 0)),
                    Case::Press(force) => rest(&body, &[force], Vec3::ZERO, &config),
                };
                // Whoever asked may be gone.
                if judged.send(verdict).is_err() {
                    return;
                }
            }
        });
        Self {
            cases: Some(cases),
            verdicts,
            thread: Some(thread),
            given: None,
            ready: None,
            due: None,
            delay,
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
            self.due = Some(tick + self.delay);
        }
    }

    /// Wakes the other thread, where there is something to do for it. After the tick's answer is out: on a machine whose cores
    /// are all taken the thread that wakes another may have to wait for it.
    pub(crate) fn hand_over(&mut self) {
        if let (Some(cases), Some(case)) = (&self.cases, self.given.take()) {
            // The thread ends only with this value.
            let _ = cases.send(case);
        }
    }

    /// Returns true if the verdict is due at this tick.
    pub(crate) fn is_due(&self, tick: u64) -> bool {
        self.due == Some(tick)
    }

    /// Returns true if the verdict has come.
    pub(crate) fn is_ready(&mut self) -> bool {
        if self.ready.is_none() {
            self.ready = self.verdicts.try_recv().ok();
        }
        self.ready.is_some()
    }

    /// Waits until the verdict has come: for loops that do not keep time with the clock.
    pub(crate) fn wait(&mut self) {
        self.hand_over();
        if self.is_busy() && self.ready.is_none() {
            self.ready = self.verdicts.recv().ok();
        }
    }

    /// The verdict that is due at this tick; waits for it if it is not ready.
    pub(crate) fn verdict(&mut self, tick: u64) -> Option<Result<Outcome, InputError>> {
        if !self.is_due(tick) {
            return None;
        }
        self.wait();
        self.due = None;
        self.ready.take()
    }
}

impl Drop for Judge {
    fn drop(&mut self) {
        self.cases = None;
        if let Some(thread) = self.thread.take() {
            let _ = thread.join();
        }
    }
}
