//! Bevy's threads for the parts of a break.

use std::sync::Arc;

use bevy::tasks::{ComputeTaskPool, TaskPool};
use frangible::internals::{Pool, Threads};

/// The threads of the app's compute tasks.
pub(crate) fn lent() -> Threads {
    Threads::of(Arc::new(Compute))
}

struct Compute;

impl Pool for Compute {
    fn threads(&self) -> usize {
        let others = ComputeTaskPool::get_or_init(TaskPool::default).thread_num();
        // On a web page there is one thread, which the pool counts as its own.
        if cfg!(target_family = "wasm") {
            1
        } else {
            others + 1
        }
    }

    fn run(&self, workers: usize, work: &(dyn Fn(usize) + Sync)) {
        ComputeTaskPool::get_or_init(TaskPool::default).scope(|scope| {
            for worker in 0..workers {
                scope.spawn(async move { work(worker) });
            }
        });
    }
}
