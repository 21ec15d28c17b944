//! Threads that a caller lends to a break, which keeps none of its own.
//!
//! The stress at the weak points, the pieces and their drawn surfaces are computed part by part. The parts are independent of each other, and their
//! results are put together in a fixed order, so the bits are the same for any number of threads.

use std::fmt;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

/// A pool of threads.
pub trait Pool: Send + Sync {
    /// Number of threads that may work on a break at once, the caller's included.
    fn threads(&self) -> usize;

    /// Calls `work` once for each of 0 to `workers` − 1, on any threads, and returns when all calls have returned.
    fn run(&self, workers: usize, work: &(dyn Fn(usize) + Sync));
}

/// Threads for a break; by default only the caller's.
#[derive(Clone, Default)]
pub struct Threads(Option<Arc<dyn Pool>>);

impl Threads {
    /// The threads of a pool.
    #[must_use]
    pub fn of(pool: Arc<dyn Pool>) -> Self {
        Self(Some(pool))
    }

    /// Returns true if a pool lends threads.
    #[must_use]
    pub fn are_lent(&self) -> bool {
        self.0.is_some()
    }

    /// Number of threads.
    #[must_use]
    pub fn count(&self) -> usize {
        self.0.as_ref().map_or(1, |pool| pool.threads().max(1))
    }

    /// Computes `each` of a list's items; the results are in the order of the items. `state`: data that a thread keeps from item to item.
    pub fn map<T: Send, S, R: Send>(
        &self,
        items: Vec<T>,
        state: impl Fn() -> S + Sync,
        each: impl Fn(&mut S, T) -> R + Sync,
    ) -> Vec<R> {
        let workers = self.count().min(items.len());
        let Some(pool) = self.0.as_ref().filter(|_| workers > 1) else {
            let mut state = state();
            return items
                .into_iter()
                .map(|item| each(&mut state, item))
                .collect();
        };
        let count = items.len();
        let items: Vec<Mutex<Option<T>>> = items.into_iter().map(|t| Mutex::new(Some(t))).collect();
        let (next, results) = (AtomicUsize::new(0), Mutex::new(Vec::with_capacity(count)));
        pool.run(workers, &|_| {
            let mut state = state();
            while let Some((number, item)) = taken(&items, &next) {
                let result = each(&mut state, item);
                let mut results = results.lock().unwrap_or_else(PoisonError::into_inner);
                results.push((number, result));
            }
        });
        let mut results = results.into_inner().unwrap_or_else(PoisonError::into_inner);
        results.sort_unstable_by_key(|(number, _)| *number);
        results.into_iter().map(|(_, result)| result).collect()
    }
}

/// Takes the next item of a list, with its number.
fn taken<T>(items: &[Mutex<Option<T>>], next: &AtomicUsize) -> Option<(usize, T)> {
    let number = next.fetch_add(1, Ordering::Relaxed);
    let mut item = items
        .get(number)?
        .lock()
        .unwrap_or_else(PoisonError::into_inner);
    Some((number, item.take()?))
}

impl fmt::Debug for Threads {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Threads")
    }
}

// Threads make no difference to a result.
impl PartialEq for Threads {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}
