//! Threads of all worlds for the parts of a break.
//!
//! They are a pool of their own. In a pool that also computes the modes of pieces, a break that waits for its parts could be given such a job, which
//! takes much longer than the break.

use std::sync::{Arc, OnceLock};

use frangible::internals::{Pool, Threads};
use rayon::{ThreadPool, ThreadPoolBuilder};

/// Most threads: a break has few parts that are worth one.
const MOST: usize = 8;

/// The pool; none where no thread can be started, or where there is only one core.
fn pool() -> Option<Arc<Breaks>> {
    static POOL: OnceLock<Option<Arc<Breaks>>> = OnceLock::new();
    let make = || {
        let cores = std::thread::available_parallelism().map_or(1, usize::from);
        let builder = ThreadPoolBuilder::new().num_threads(cores.min(MOST));
        let named = builder.thread_name(|k| format!("break {k}"));
        (cores > 1).then(|| named.build().ok().map(|pool| Arc::new(Breaks(pool))))?
    };
    POOL.get_or_init(make).clone()
}

/// Threads for the breaks of a world.
pub(crate) fn lent() -> Threads {
    pool().map_or_else(Threads::default, |pool| Threads::of(pool))
}

struct Breaks(ThreadPool);

impl Pool for Breaks {
    fn threads(&self) -> usize {
        self.0.current_num_threads()
    }

    fn run(&self, workers: usize, work: &(dyn Fn(usize) + Sync)) {
        self.0.scope(|scope| {
            for worker in 1..workers {
                scope.spawn(move |_| work(worker));
            }
            work(0);
        });
    }
}
