//! Threads beside the world's own: they judge blows and make pieces ready. What is due first comes first.
//!
//! A blow is judged within milliseconds and the world soon asks for the verdict, while the modes of a piece may take a second. So one
//! thread is kept free of such long jobs. There is one thread less than there are cores, but there are two at least.

use std::collections::BTreeMap;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use rayon::{ThreadPool, ThreadPoolBuilder};

type Job = Box<dyn FnOnce() + Send>;

/// Jobs by the step in which they are due, and by the order in which they came.
type Jobs = BTreeMap<(u64, u64), Job>;

/// Length of a job.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Length {
    /// Milliseconds.
    Short,
    /// Longer than the world would wait for it.
    Long,
}

/// Jobs that wait, and the number of threads at long ones.
#[derive(Default)]
struct Queue {
    short: Jobs,
    long: Jobs,
    /// Threads that are at a long job.
    at_long: usize,
}

impl Queue {
    /// The next job, and how long it takes. `most`: threads that may be at long jobs.
    fn next(&mut self, most: usize) -> Option<(Length, Job)> {
        if let Some((_, job)) = self.short.pop_first() {
            return Some((Length::Short, job));
        }
        if self.at_long >= most {
            return None;
        }
        let (_, job) = self.long.pop_first()?;
        self.at_long += 1;
        Some((Length::Long, job))
    }
}

/// Threads, and their jobs.
#[derive(Default)]
pub(crate) struct Workshop {
    /// None before the first job; inside, none if no thread can be started.
    pool: Option<Option<ThreadPool>>,
    queue: Arc<Mutex<Queue>>,
    count: u64,
}

impl Workshop {
    /// Has a job done before the step `due`, as far as the threads come to it; here and now if there are none.
    pub(crate) fn take(&mut self, length: Length, due: u64, job: impl FnOnce() + Send + 'static) {
        let make = || {
            let cores = std::thread::available_parallelism().map_or(1, usize::from);
            let builder = ThreadPoolBuilder::new().num_threads(cores.saturating_sub(1).max(2));
            builder.build().ok()
        };
        let Some(pool) = self.pool.get_or_insert_with(make) else {
            job();
            return;
        };
        self.count += 1;
        {
            let mut queue = locked(&self.queue);
            let jobs = match length {
                Length::Short => &mut queue.short,
                Length::Long => &mut queue.long,
            };
            jobs.insert((due, self.count), Box::new(job));
        }
        let (queue, most) = (Arc::clone(&self.queue), pool.current_num_threads() - 1);
        // A thread that ends a job looks for the next one, so that a long job that must wait here is found by those at long jobs.
        pool.spawn_fifo(move || work(&queue, most));
    }
}

/// Does jobs until there is none that this thread may do.
fn work(queue: &Mutex<Queue>, most: usize) {
    loop {
        let next = locked(queue).next(most);
        let Some((length, job)) = next else { return };
        // If a job panics, the thread that waits for it sees that its sender is gone; this one has other jobs to do.
        let _ = catch_unwind(AssertUnwindSafe(job));
        if length == Length::Long {
            locked(queue).at_long -= 1;
        }
    }
}

fn locked(queue: &Mutex<Queue>) -> MutexGuard<'_, Queue> {
    queue.lock().unwrap_or_else(PoisonError::into_inner)
}

#[cfg(test)]
mod tests {
    use std::sync::mpsc::channel;
    use std::sync::{Arc, Mutex};

    use super::{Job, Length, Queue, Workshop};

    #[test]
    fn a_short_job_never_waits_for_long_ones() {
        let mut workshop = Workshop::default();
        let (end, ended) = channel::<()>();
        let (say, said) = channel();
        // Long jobs that end when this thread lets them, more than there are threads.
        let ended = Arc::new(Mutex::new(ended));
        let cores = std::thread::available_parallelism().map_or(1, usize::from);
        for k in 0..cores + 2 {
            let (ended, say) = (Arc::clone(&ended), say.clone());
            workshop.take(Length::Long, 0, move || {
                let _ = ended.lock().map(|e| e.recv());
                let _ = say.send(k);
            });
        }
        let short = say.clone();
        workshop.take(Length::Short, 1000, move || {
            let _ = short.send(usize::MAX);
        });
        assert_eq!(said.recv().ok(), Some(usize::MAX));
        drop(end);
        let mut others: Vec<usize> = (0..cores + 2).filter_map(|_| said.recv().ok()).collect();
        others.sort_unstable();
        assert_eq!(others, (0..cores + 2).collect::<Vec<_>>());
    }

    #[test]
    fn a_job_that_panics_ends_neither_the_thread_nor_the_process() {
        let mut workshop = Workshop::default();
        let (say, said) = channel();
        let cores = std::thread::available_parallelism().map_or(1, usize::from);
        for k in 0..cores + 2 {
            let say = say.clone();
            workshop.take(Length::Long, 0, move || {
                let _keep = say;
                panic!("job {k} of a test panics, as it should");
            });
        }
        let after = say.clone();
        workshop.take(Length::Long, 1, move || {
            let _ = after.send(());
        });
        drop(say);
        assert_eq!(said.recv(), Ok(()));
        // All that could still speak are gone.
        assert!(said.recv().is_err());
    }

    #[test]
    fn what_is_due_first_comes_first_and_long_jobs_leave_a_thread() {
        let mut queue = Queue::default();
        let (say, said) = channel();
        let job = |name: &'static str| -> Job {
            let say = say.clone();
            Box::new(move || say.send(name).expect("the test listens"))
        };
        queue.long.insert((5, 1), job("modes due at 5"));
        queue.long.insert((3, 2), job("modes due at 3"));
        queue.short.insert((9, 3), job("blow due at 9"));
        queue.short.insert((7, 4), job("blow due at 7"));
        let next = |queue: &mut Queue| {
            let (_, job) = queue.next(1)?;
            job();
            said.recv().ok()
        };
        assert_eq!(next(&mut queue), Some("blow due at 7"));
        assert_eq!(next(&mut queue), Some("blow due at 9"));
        assert_eq!(next(&mut queue), Some("modes due at 3"));
        // One thread may be at long jobs, and is.
        assert_eq!(next(&mut queue), None);
        queue.at_long -= 1;
        assert_eq!(next(&mut queue), Some("modes due at 5"));
    }
}
