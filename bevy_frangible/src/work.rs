//! Long computations on other threads while the game continues. Without threads, as on a web page, they run when their result is needed.

#[cfg(not(target_family = "wasm"))]
use bevy::tasks::{Task, TaskPool, TaskPoolBuilder, block_on};

/// Threads of their own: in every step Avian waits for small tasks of its own on Bevy's pool for long work, which on few cores has one
/// thread. Behind modes of pieces they took 280 ms.
pub(crate) struct Workers(#[cfg(not(target_family = "wasm"))] TaskPool);

/// Something that is being made.
pub(crate) struct Promise<T>(
    #[cfg(not(target_family = "wasm"))] Task<T>,
    #[cfg(target_family = "wasm")] std::sync::Mutex<Box<dyn FnOnce() -> T + Send>>,
);

#[cfg(not(target_family = "wasm"))]
impl Workers {
    /// A pool of threads with a name. Their number follows from that of the machine's cores, and is at least one.
    pub(crate) fn new(name: &str, threads: fn(usize) -> usize) -> Self {
        let cores = std::thread::available_parallelism().map_or(1, usize::from);
        let pool = TaskPoolBuilder::new().num_threads(threads(cores).max(1));
        Self(pool.thread_name(name.into()).build())
    }

    pub(crate) fn begin<T: Send + 'static>(
        &self,
        work: impl FnOnce() -> T + Send + 'static,
    ) -> Promise<T> {
        Promise(self.0.spawn(async move { work() }))
    }
}

#[cfg(not(target_family = "wasm"))]
impl<T> Promise<T> {
    /// Waits for it.
    pub(crate) fn kept(self) -> T {
        block_on(self.0)
    }
}

#[cfg(target_family = "wasm")]
impl Workers {
    pub(crate) fn new(_name: &str, _threads: fn(usize) -> usize) -> Self {
        Self()
    }

    pub(crate) fn begin<T: Send + 'static>(
        &self,
        work: impl FnOnce() -> T + Send + 'static,
    ) -> Promise<T> {
        Promise(std::sync::Mutex::new(Box::new(work)))
    }
}

#[cfg(target_family = "wasm")]
impl<T> Promise<T> {
    pub(crate) fn kept(self) -> T {
        let work = self.0.into_inner();
        work.unwrap_or_else(std::sync::PoisonError::into_inner)()
    }
}
