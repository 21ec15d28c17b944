//! Threads beside the world's own, one less than there are cores: they judge blows and make pieces ready. What is due first comes first.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use rayon::{ThreadPool, ThreadPoolBuilder};

type Job = Box<dyn FnOnce() + Send>;

/// Jobs by the step in which they are due, and by the order in which they came.
type Jobs = BTreeMap<(u64, u64), Job>;

/// The threads, and what they have to do.
#[derive(Default)]
pub(crate) struct Workshop {
    /// None before the first job; inside, none where no thread can be had.
    pool: Option<Option<ThreadPool>>,
    jobs: Arc<Mutex<Jobs>>,
    count: u64,
}

impl Workshop {
    /// Has a job done before the step `due`, as far as the threads come to it; here and now where there are none.
    pub(crate) fn take(&mut self, due: u64, job: impl FnOnce() + Send + 'static) {
        let make = || {
            let cores = std::thread::available_parallelism().map_or(1, usize::from);
            let builder = ThreadPoolBuilder::new().num_threads(cores.saturating_sub(1).max(1));
            builder.build().ok()
        };
        let Some(pool) = self.pool.get_or_insert_with(make) else {
            job();
            return;
        };
        self.count += 1;
        let jobs = Arc::clone(&self.jobs);
        locked(&jobs).insert((due, self.count), Box::new(job));
        // One turn for each job, and each turn does the most urgent one.
        pool.spawn_fifo(move || {
            let next = locked(&jobs).pop_first();
            if let Some((_, job)) = next {
                job();
            }
        });
    }
}

fn locked(jobs: &Mutex<Jobs>) -> MutexGuard<'_, Jobs> {
    jobs.lock().unwrap_or_else(PoisonError::into_inner)
}
