//! Work on other threads.

use std::sync::mpsc::{Receiver, RecvTimeoutError, TryRecvError, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

use frangible_scenes::CancelToken;

/// What a job is at, and the share of it that is done.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct JobProgress {
    pub(crate) what: String,
    pub(crate) share: f64,
}

/// For the job itself: tells how far it is, and asks whether it is still wanted.
#[derive(Clone, Default)]
pub(crate) struct Teller {
    progress: Arc<Mutex<JobProgress>>,
    pub(crate) cancel: CancelToken,
}

impl Teller {
    pub(crate) fn tell(&self, what: String, share: f64) {
        *self.progress.lock().unwrap_or_else(PoisonError::into_inner) = JobProgress { what, share };
    }
}

/// Work that goes on elsewhere; dropped, it is cancelled.
pub(crate) struct Job<T> {
    teller: Teller,
    result: Receiver<T>,
}

/// What there is of a job.
pub(crate) enum Polled<T> {
    Running,
    Done(T),
    /// Its thread panicked.
    Died,
}

impl<T: Send + 'static> Job<T> {
    /// Begins it.
    pub(crate) fn start(work: impl FnOnce(&Teller) -> T + Send + 'static) -> Self {
        let teller = Teller::default();
        let (sender, result) = channel();
        let own = teller.clone();
        std::thread::spawn(move || {
            // Nobody waits for a job that was dropped.
            let _ = sender.send(work(&own));
        });
        Self { teller, result }
    }

    /// Asks it to end; it may take a while to hear that.
    pub(crate) fn cancel(&self) {
        self.teller.cancel.cancel();
    }

    /// Whether it was asked to end.
    pub(crate) fn is_cancelled(&self) -> bool {
        self.teller.cancel.is_cancelled()
    }

    pub(crate) fn progress(&self) -> JobProgress {
        let progress = self.teller.progress.lock();
        progress.unwrap_or_else(PoisonError::into_inner).clone()
    }

    pub(crate) fn poll(&self) -> Polled<T> {
        match self.result.try_recv() {
            Ok(result) => Polled::Done(result),
            Err(TryRecvError::Empty) => Polled::Running,
            Err(TryRecvError::Disconnected) => Polled::Died,
        }
    }

    /// Waits for a while, or until it is done.
    pub(crate) fn wait(&self, longest: Duration) -> Polled<T> {
        match self.result.recv_timeout(longest) {
            Ok(result) => Polled::Done(result),
            Err(RecvTimeoutError::Timeout) => Polled::Running,
            Err(RecvTimeoutError::Disconnected) => Polled::Died,
        }
    }
}

impl<T> Drop for Job<T> {
    fn drop(&mut self) {
        self.teller.cancel.cancel();
    }
}
