//! Background work on other threads; without threads, deferred until its progress has been displayed once.

use std::cell::Cell;
use std::sync::mpsc::{Receiver, RecvTimeoutError, TryRecvError, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

use frangible_scenes::{BakedBody, CancelToken, SceneError};

use crate::error::ViewError;
use crate::host::Delivery;

/// If true, work is done by whoever asks for its result.
const WITHOUT_THREADS: bool = cfg!(target_family = "wasm");

/// Current stage of a job, and the share of it that is done.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct JobProgress {
    pub(crate) what: String,
    pub(crate) share: f64,
}

/// Link from the job to its owner: reports the progress, and tells if the job was cancelled.
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
    put_off: Cell<Option<PutOff>>,
}

/// Work to be done by whoever asks for its result.
struct PutOff {
    work: Box<dyn FnOnce()>,
    /// True after the first request for the result, which is answered with “in progress”, so that the progress can be displayed.
    asked: bool,
}

/// State of a job.
pub(crate) enum Polled<T> {
    Running,
    Done(T),
    /// Its thread panicked.
    Died,
}

impl Job<Result<Vec<BakedBody>, SceneError>> {
    /// Bodies that somebody else brings.
    pub(crate) fn delivered(order: impl FnOnce(Delivery)) -> Self {
        let teller = Teller::default();
        let (sender, result) = channel();
        order(Delivery {
            teller: teller.clone(),
            sender,
        });
        Self {
            teller,
            result,
            put_off: Cell::default(),
        }
    }
}

impl<T: Send + 'static> Job<T> {
    /// Begins it.
    pub(crate) fn start(work: impl FnOnce(&Teller) -> T + Send + 'static) -> Self {
        if WITHOUT_THREADS {
            return Self::put_off(work);
        }
        let teller = Teller::default();
        let (sender, result) = channel();
        let own = teller.clone();
        std::thread::spawn(move || {
            // Nobody waits for a job that was dropped.
            let _ = sender.send(work(&own));
        });
        Self {
            teller,
            result,
            put_off: Cell::default(),
        }
    }

    /// Does it when its result is asked for the second time.
    fn put_off(work: impl FnOnce(&Teller) -> T + 'static) -> Self {
        let teller = Teller::default();
        let (sender, result) = channel();
        let own = teller.clone();
        let work = Box::new(move || {
            // The receiver is there: it is in the job that has this work done.
            let _ = sender.send(work(&own));
        });
        Self {
            teller,
            result,
            put_off: Cell::new(Some(PutOff { work, asked: false })),
        }
    }

    /// Asks it to end; it may take a while to notice that.
    pub(crate) fn cancel(&self) {
        self.teller.cancel.cancel();
    }

    /// Returns true if it was asked to end.
    pub(crate) fn is_cancelled(&self) -> bool {
        self.teller.cancel.is_cancelled()
    }

    pub(crate) fn progress(&self) -> JobProgress {
        let progress = self.teller.progress.lock();
        progress.unwrap_or_else(PoisonError::into_inner).clone()
    }

    fn poll(&self) -> Polled<T> {
        match self.put_off.take() {
            Some(PutOff { work, asked: true }) => work(),
            Some(PutOff { work, asked: false }) => {
                self.put_off.set(Some(PutOff { work, asked: true }));
                return Polled::Running;
            }
            None => {}
        }
        match self.result.try_recv() {
            Ok(result) => Polled::Done(result),
            Err(TryRecvError::Empty) => Polled::Running,
            Err(TryRecvError::Disconnected) => Polled::Died,
        }
    }

    /// Waits for a while, or until it is done.
    pub(crate) fn wait(&self, longest: Duration) -> Polled<T> {
        if let Some(PutOff { work, .. }) = self.put_off.take() {
            work();
        }
        match self.result.recv_timeout(longest) {
            Ok(result) => Polled::Done(result),
            Err(RecvTimeoutError::Timeout) => Polled::Running,
            Err(RecvTimeoutError::Disconnected) => Polled::Died,
        }
    }
}

impl<T, E> Job<Result<T, E>>
where
    T: Send + 'static,
    E: Send + 'static + Into<ViewError>,
{
    /// Takes a job out of its place once it is done, and returns its result; waits for a while if told to.
    pub(crate) fn collect(
        place: &mut Option<Self>,
        wait: Option<Duration>,
    ) -> Option<Result<T, ViewError>> {
        let result = place.as_ref()?.result(wait)?;
        *place = None;
        Some(result)
    }

    /// Returns its result, once there is one; waits for a while if told to.
    pub(crate) fn result(&self, wait: Option<Duration>) -> Option<Result<T, ViewError>> {
        match wait.map_or_else(|| self.poll(), |wait| self.wait(wait)) {
            Polled::Running => None,
            Polled::Died => Some(Err(ViewError::Worker)),
            Polled::Done(result) => Some(result.map_err(Into::into)),
        }
    }
}

impl<T> Drop for Job<T> {
    fn drop(&mut self) {
        self.teller.cancel.cancel();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn work_put_off_is_done_when_asked_for_twice() {
        let job = Job::put_off(|teller| {
            teller.tell("adding".into(), 1.0);
            1 + 1
        });
        assert!(matches!(job.poll(), Polled::Running));
        assert_eq!(job.progress(), JobProgress::default());
        assert!(matches!(job.poll(), Polled::Done(2)));
        assert_eq!(job.progress().what, "adding");
        assert!(matches!(
            Job::put_off(|_| 3).wait(Duration::ZERO),
            Polled::Done(3)
        ));
    }
}
