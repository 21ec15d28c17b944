//! Progress of an experiment, told from several threads.

use std::sync::atomic::{AtomicUsize, Ordering};

use crate::Progress;

/// Counts the finished parts of something.
pub(crate) struct Counter<'a> {
    done: AtomicUsize,
    all: usize,
    hear: Progress<'a>,
}

impl<'a> Counter<'a> {
    pub(crate) fn new(all: usize, hear: Progress<'a>) -> Self {
        hear(0.0);
        Self {
            done: AtomicUsize::new(0),
            all: all.max(1),
            hear,
        }
    }

    /// One more is done.
    pub(crate) fn count(&self) {
        let done = self.done.fetch_add(1, Ordering::Relaxed) + 1;
        (self.hear)(done as f64 / self.all as f64);
    }
}
