//! Accuracy of the ways to find how a piece vibrates. Fragments of broken bodies are each hit at three places, by every way and by a full analysis of
//! its own: `frangible-lab pieces`.
//!
//! The truth is an analysis of the piece as fine as a bake's; some pieces are also meshed anew from their surface and baked, which shares neither
//! elements nor lattice with it. Nothing passes or fails.

mod baked;
mod choose;
mod clock;
mod impacts;
mod measure;
mod report;
mod scenes;
mod statistics;
mod way;

pub use baked::Rebaked;
pub use choose::Broken;
pub use measure::{Blow, PieceSample, Reading, Sample};
pub use scenes::broken_scenes;
pub use way::{WAYS, Way};

use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use serde::Serialize;

use crate::{Progress, Result};
use choose::{Chosen, choose};
use way::Ways;

/// Plan of the computation.
#[derive(Clone, Debug, Serialize)]
pub struct TruthPlan {
    /// Fragments, spread over the bodies and over sizes; fewer where there are not so many.
    pub fragments: usize,
    /// Number of fragments that are meshed anew and baked.
    pub baked: usize,
    /// Quadratic elements and modes of the full analysis.
    pub elements: usize,
    /// See [`Self::elements`].
    pub modes: usize,
    /// Threads; times are those of the thread that works.
    pub threads: usize,
}

impl TruthPlan {
    /// The plan of the published page.
    #[must_use]
    pub const fn full() -> Self {
        Self {
            fragments: 200,
            baked: 10,
            elements: 3000,
            modes: 100,
            threads: 2,
        }
    }

    /// A few pieces against a coarser truth: to see that everything runs.
    #[must_use]
    pub const fn tiny() -> Self {
        Self {
            fragments: 4,
            baked: 1,
            elements: 800,
            modes: 40,
            threads: 2,
        }
    }
}

/// Results of the comparison.
#[derive(Clone, Debug)]
pub struct Truth {
    /// Plan of the computation.
    pub plan: TruthPlan,
    /// One per fragment, in the order of the bodies, smaller ones first.
    pub pieces: Vec<PieceSample>,
    /// Pieces that were baked anew.
    pub baked: Vec<Rebaked>,
    /// Pieces whose full analysis was refused, with the reason.
    pub refused: Vec<String>,
}

impl Truth {
    /// Measures fragments of these bodies. All but times is the same on any number of threads.
    ///
    /// # Errors
    /// An error of the fracture code; a thread that could not be started.
    pub fn compute(plan: TruthPlan, broken: &[Broken], hear: Progress<'_>) -> Result<Self> {
        let chosen = choose(broken, plan.fragments);
        let ways = Ways::new();
        let every = (chosen.len() / plan.baked.max(1)).max(1);
        // The middle one of each stretch, so that small and large pieces come up.
        let to_bake = |i: usize| plan.baked > 0 && i % every == every / 2;
        let rows = side_by_side(&chosen, plan.threads, hear, &|i, piece: &Chosen| {
            let sample = measure::measure(&plan, &ways, &broken[piece.broken], piece, i)?;
            let baked = match &sample {
                Ok(sample) if to_bake(i) => baked::rebake(&broken[piece.broken], piece, sample),
                _ => None,
            };
            Ok((sample, baked))
        })?;
        let mut truth = Self {
            plan,
            pieces: Vec::new(),
            baked: Vec::new(),
            refused: Vec::new(),
        };
        for (sample, baked) in rows {
            match sample {
                Ok(sample) => truth.pieces.push(sample),
                Err(reason) => truth.refused.push(reason),
            }
            truth.baked.extend(baked);
        }
        truth.baked.truncate(truth.plan.baked);
        Ok(truth)
    }
}

/// Applies `work` to all, the largest (last) first, each thread with a pool of its own so that whatever it calls stays on it.
fn side_by_side<T: Sync, R: Send>(
    all: &[T],
    threads: usize,
    hear: Progress<'_>,
    work: &(dyn Fn(usize, &T) -> Result<R> + Sync),
) -> Result<Vec<R>> {
    let (next, done) = (AtomicUsize::new(0), AtomicUsize::new(0));
    let results: Mutex<Vec<(usize, Result<R>)>> = Mutex::default();
    hear(0.0);
    let one = || {
        loop {
            let taken = next.fetch_add(1, Ordering::Relaxed);
            if taken >= all.len() {
                return;
            }
            let i = all.len() - 1 - taken;
            let result = work(i, &all[i]);
            if let Ok(mut results) = results.lock() {
                results.push((i, result));
            }
            let done = done.fetch_add(1, Ordering::Relaxed) + 1;
            hear(done as f64 / all.len() as f64);
        }
    };
    let pools: Vec<rayon::ThreadPool> = (0..threads.max(1))
        .map(|_| rayon::ThreadPoolBuilder::new().num_threads(1).build())
        .collect::<std::result::Result<_, _>>()?;
    std::thread::scope(|scope| {
        for pool in &pools {
            scope.spawn(|| pool.install(one));
        }
    });
    let mut results = results.into_inner().map_err(|e| e.to_string())?;
    results.sort_by_key(|r| r.0);
    results.into_iter().map(|r| r.1).collect()
}
