//! A bull in a china shop: a thousand breakable things on planks, a ball of 400 kg at 7 m/s, frame times.
//!
//! Every run gives the same bits, so a frame's time is its least over the runs, and percentiles are over frames. Beside it the same shop in Rapier
//! alone, with everything that will break in pieces from the beginning.

mod alone;
mod crockery;
mod furnish;
mod play;

use serde::Serialize;

pub use play::{Frame, Happened, PARTS};

use crate::bench::error::BenchError;
use crate::bench::fingerprint::Fingerprint;
use crate::bench::stats::{Spread, Times};
use play::FRAME_RATE;

/// Options of the benchmark.
#[derive(Clone, Copy, Debug)]
pub struct Options {
    /// Equal runs: of each frame the least time counts.
    pub runs: usize,
    /// Simulated time, s.
    pub seconds: usize,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            runs: 5,
            seconds: 4,
        }
    }
}

/// A kind of thing.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct KindOfThing {
    /// Its name.
    pub name: String,
    /// Its tetrahedra.
    pub tets: usize,
    /// Mass, kg.
    pub mass: f64,
    /// Size of its file, bytes.
    pub file_size: usize,
}

/// Results of the benchmark.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Findings {
    /// Kinds of things.
    pub kinds: Vec<KindOfThing>,
    /// Modes of each.
    pub modes: usize,
    /// Things in the shop.
    pub things: usize,
    /// Work per step, tetrahedra, and steps that a break has: [`frangible_rapier::Breaking::AfterStep`].
    pub budget: [usize; 2],
    /// Equal runs.
    pub runs: usize,
    /// Every frame, the least of each time over the runs.
    pub frames: Vec<Frame>,
    /// Events of every frame.
    pub happened: Vec<Happened>,
    /// Every frame of Rapier alone, s.
    pub alone: Vec<f64>,
    /// Pieces that Rapier alone has from the beginning.
    pub pieces: usize,
    /// Memory of a thing in the shop, with all that Rapier keeps of it, bytes; if the system reports it.
    pub bytes_per_thing: Option<f64>,
    /// A number made of all bodies in the end; it is the same in every run.
    pub fingerprint: String,
}

impl Findings {
    /// Spread over frames of a part of their times, s.
    #[must_use]
    pub fn spread(&self, part: impl Fn(&Frame) -> f64) -> Spread {
        Times::new(self.frames.iter().map(part).collect()).spread()
    }

    /// The spread of Rapier's part of the frames alone.
    #[must_use]
    pub fn spread_alone(&self) -> Spread {
        Times::new(self.alone.clone()).spread()
    }
}

/// Bakes the things, furnishes the shop and lets the bull in.
///
/// # Errors
/// A thing that does not bake, a world that cannot be stepped, runs that differ.
pub fn measure(
    options: &Options,
    progress: &mut dyn FnMut(&str, f64),
) -> Result<Findings, BenchError> {
    let runs = options.runs.max(1);
    let count = options.seconds.max(1) * FRAME_RATE as usize;
    progress("baking crockery", 0.0);
    let kinds = crockery::bake_all()?;
    let bytes_per_thing = bytes_per_thing(&kinds)?;
    let share = |run: usize| run as f64 / (2 * runs) as f64;
    progress("a bull in a china shop", 0.0);
    let mut best = play::play(&kinds, count)?;
    for run in 1..runs {
        progress("a bull in a china shop", share(run));
        let other = play::play(&kinds, count)?;
        same(best.print, other.print)?;
        for (frame, other) in best.frames.iter_mut().zip(&other.frames) {
            frame.least(other);
        }
    }
    progress("Rapier alone", share(runs));
    let (mut alone, print) = alone::play_alone(&kinds, &best.pieces, count)?;
    for run in 1..runs {
        progress("Rapier alone", share(runs + run));
        let (times, other) = alone::play_alone(&kinds, &best.pieces, count)?;
        same(print, other)?;
        for (time, t) in alone.iter_mut().zip(times) {
            *time = time.min(t);
        }
    }
    let assets = kinds.iter().map(|kind| kind.breakable.asset());
    Ok(Findings {
        modes: assets.clone().map(|a| a.modes().count()).max().unwrap_or(0),
        kinds: assets
            .map(|asset| KindOfThing {
                name: asset.name().to_owned(),
                tets: asset.fracture().tets.len(),
                mass: asset.mass().mass,
                file_size: asset.to_bytes().len(),
            })
            .collect(),
        things: best.things,
        budget: [play::BUDGET, play::DELAY],
        runs,
        frames: best.frames,
        happened: best.happened,
        alone,
        pieces: best.pieces.len(),
        bytes_per_thing,
        fingerprint: format!("{:016x}", best.print.value()),
    })
}

fn same(a: Fingerprint, b: Fingerprint) -> Result<(), BenchError> {
    if a == b {
        return Ok(());
    }
    let (a, b) = (a.value(), b.value());
    Err(BenchError::NotAsMeant(format!(
        "two equal runs of the china shop differ, {a:016x} and {b:016x}: please report it"
    )))
}

/// Memory of one more thing, bytes, by the memory of this process. The bake leaves free memory behind: the first shops fill it.
fn bytes_per_thing(kinds: &[crockery::Kind]) -> Result<Option<f64>, BenchError> {
    const FIRST: usize = 3;
    const SHOPS: usize = 7;
    let mut shops = Vec::with_capacity(SHOPS);
    let mut used = Vec::with_capacity(SHOPS);
    for _ in 0..SHOPS {
        shops.push(furnish::furnish(kinds, play::config(), play::SEED)?);
        let Some(bytes) = resident() else {
            return Ok(None);
        };
        used.push(bytes);
    }
    let things: usize = shops[FIRST..].iter().map(|shop| shop.things.len()).sum();
    Ok(Some((used[SHOPS - 1] - used[FIRST - 1]) / things as f64))
}

/// Memory of this process, bytes, if the system reports it.
fn resident() -> Option<f64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find(|l| l.starts_with("VmRSS:"))?;
    let kilobytes = line.split_whitespace().nth(1)?.parse::<f64>().ok()?;
    Some(kilobytes * 1024.0)
}
