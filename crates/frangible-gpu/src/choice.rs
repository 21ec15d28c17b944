//! Choice between CPU and GPU: as requested, or by measurement.

use std::time::Instant;

use frangible::internals::Stage;
use frangible::{Breakable, FractureConfig, Outcome};
use rayon::prelude::*;

use crate::device::Gpu;
use crate::error::GpuError;
use crate::impacts::{Impact, begin};
use crate::loaded::Loaded;

/// Least number of impacts that the two are compared with. With more threads it is one for each, since they prepare the GPU's work.
const TRIAL: usize = 4;

/// Choice of the processor for the impacts of a [`Solver`]. Cracks and pieces are bit-identical in any case.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Choice {
    /// The CPU.
    Cpu,
    /// The GPU. Without a GPU this is an error.
    Gpu,
    /// The faster one for the size of the batch, determined by a short trial with the first batches. Without a GPU, the CPU.
    #[default]
    Auto,
}

/// Processor that computed a batch.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RanOn {
    /// The CPU, on all its threads.
    Cpu,
    /// The GPU, and the CPU for undecided impacts.
    Gpu,
}

/// Report of the computation of a batch.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Ran {
    /// Processor that was used.
    pub on: RanOn,
    /// Reason for the choice, as a sentence.
    pub why: String,
    /// Number of impacts that the first bound did not decide.
    pub past_bound: usize,
}

/// Computes batches of impacts, on the CPU or on the GPU.
#[derive(Debug)]
pub struct Solver {
    gpu: Result<Gpu, GpuError>,
    choice: Choice,
    speed: Option<Speed>,
}

/// Time of a batch of n impacts past the first bound, as found by a trial.
#[derive(Clone, Copy, Debug)]
struct Speed {
    /// Impacts in the trial. A trial of one impact tells nothing of larger batches.
    trial: usize,
    /// Threads of the CPU.
    threads: usize,
    /// Time of one impact on each thread of the CPU, s.
    cpu_round: f64,
    /// Time of a call of the GPU, and of each impact in it, s.
    gpu_call: f64,
    gpu_each: f64,
}

impl Speed {
    fn cpu(&self, impacts: usize) -> f64 {
        self.cpu_round * impacts.div_ceil(self.threads) as f64
    }

    fn gpu(&self, impacts: usize) -> f64 {
        self.gpu_call + self.gpu_each * impacts as f64
    }
}

impl Solver {
    /// Makes a solver that uses the CPU, the GPU, or whichever is faster.
    ///
    /// # Errors
    /// No usable GPU, with [`Choice::Gpu`].
    pub fn new(choice: Choice) -> Result<Self, GpuError> {
        let gpu = match choice {
            Choice::Cpu => Err(GpuError::NoAdapter),
            Choice::Gpu => Ok(Gpu::new()?),
            Choice::Auto => Gpu::new(),
        };
        let speed = None;
        Ok(Self { gpu, choice, speed })
    }

    /// Prepares a kind of body, once for all its bodies.
    ///
    /// # Errors
    /// A kind that is too large for the GPU, with [`Choice::Gpu`]; otherwise the CPU is used.
    pub fn load(&self, kind: &Breakable) -> Result<Loaded, GpuError> {
        let Ok(gpu) = &self.gpu else {
            return Ok(Loaded::on_cpu(kind));
        };
        match gpu.load(kind) {
            Err(GpuError::TooLarge { .. }) if self.choice == Choice::Auto => {
                Ok(Loaded::on_cpu(kind))
            }
            other => other,
        }
    }

    /// Computes the outcome of each impact, like successive calls of [`frangible::impact()`].
    ///
    /// # Errors
    /// An invalid contact; with the GPU, the errors of [`Gpu::impacts`].
    pub fn impacts(
        &mut self,
        impacts: &[Impact<'_>],
        config: &FractureConfig,
    ) -> Result<(Vec<Outcome>, Ran), GpuError> {
        let begun = begin(impacts, config)?;
        let ran = self.decide(impacts, &begun, config)?;
        let outcomes = match (&self.gpu, ran.on) {
            (Ok(gpu), RanOn::Gpu) => gpu.end(impacts, begun, config)?,
            _ => end_on_cpu(impacts, begun, config),
        };
        Ok((outcomes, ran))
    }

    fn decide(
        &mut self,
        impacts: &[Impact<'_>],
        begun: &[Stage],
        config: &FractureConfig,
    ) -> Result<Ran, GpuError> {
        let gpu = match (&self.gpu, self.choice) {
            (_, Choice::Cpu) => return Ok(ran(RanOn::Cpu, 0, "the CPU was requested".into())),
            (Ok(_), Choice::Gpu) => return Ok(ran(RanOn::Gpu, 0, "the GPU was requested".into())),
            (Err(error), _) => return Ok(ran(RanOn::Cpu, 0, error.to_string())),
            (Ok(gpu), Choice::Auto) => gpu,
        };
        if impacts.iter().any(|i| i.kind.buffers.is_none()) {
            let why = "a kind in the batch is too large for the GPU".into();
            return Ok(ran(RanOn::Cpu, 0, why));
        }
        let costly: Vec<Impact<'_>> = (impacts.iter().zip(begun))
            .filter(|(_, stage)| matches!(stage, Stage::Vibrates(_)))
            .map(|(impact, _)| *impact)
            .collect();
        let n = costly.len();
        if n == 0 {
            let why = "the first bound rules out cracks in the whole batch".into();
            return Ok(ran(RanOn::Cpu, n, why));
        }
        let trial = &costly[..n.min(TRIAL.max(rayon::current_num_threads()))];
        let speed = match self.speed {
            Some(speed) if speed.trial >= trial.len() => speed,
            _ => *self.speed.insert(measure(gpu, trial, config)?),
        };
        let (on_cpu, on_gpu) = (speed.cpu(n), speed.gpu(n));
        let on = if on_gpu < on_cpu {
            RanOn::Gpu
        } else {
            RanOn::Cpu
        };
        let why = format!(
            "after a trial, {} is expected to take {:.2} ms for these {n} impacts, and the CPU's {} threads {:.2} ms",
            gpu.adapter(),
            1e3 * on_gpu,
            speed.threads,
            1e3 * on_cpu,
        );
        Ok(ran(on, n, why))
    }
}

fn ran(on: RanOn, past_bound: usize, why: String) -> Ran {
    Ran {
        on,
        why,
        past_bound,
    }
}

/// The second stage of each impact on the CPU, on all its threads.
fn end_on_cpu(impacts: &[Impact<'_>], begun: Vec<Stage>, config: &FractureConfig) -> Vec<Outcome> {
    begun
        .into_par_iter()
        .zip(impacts)
        .map(|(stage, impact)| match stage {
            Stage::Held(outcome) => outcome,
            Stage::Vibrates(vibration) => vibration.end(impact.body, config, 0),
        })
        .collect()
}

/// Both on the same few impacts, and the GPU on one of them as well; the first run of each warms up.
fn measure(gpu: &Gpu, trial: &[Impact<'_>], config: &FractureConfig) -> Result<Speed, GpuError> {
    gpu.impacts(trial, config)?;
    let cpu = seconds(|| {
        drop(end_on_cpu(trial, begin(trial, config)?, config));
        Ok(())
    })?;
    let many = seconds(|| gpu.impacts(trial, config).map(drop))?;
    let one = seconds(|| gpu.impacts(&trial[..1], config).map(drop))?;
    let (n, threads) = (trial.len(), rayon::current_num_threads());
    let gpu_each = if n > 1 {
        ((many - one) / (n as f64 - 1.0)).max(0.0)
    } else {
        0.0
    };
    Ok(Speed {
        trial: n,
        threads,
        cpu_round: cpu / n.div_ceil(threads) as f64,
        gpu_call: (one - gpu_each).max(0.0),
        gpu_each,
    })
}

/// Time of the faster of two runs: other load of the machine only adds to it.
fn seconds(run: impl Fn() -> Result<(), GpuError>) -> Result<f64, GpuError> {
    let mut least = f64::INFINITY;
    for _ in 0..2 {
        let start = Instant::now();
        run()?;
        least = least.min(start.elapsed().as_secs_f64());
    }
    Ok(least)
}

#[cfg(test)]
mod tests {
    use super::Speed;

    #[test]
    fn a_cpu_of_many_threads_takes_many_impacts_at_once() {
        let speed = Speed {
            trial: 4,
            threads: 16,
            cpu_round: 3.0,
            gpu_call: 1.0,
            gpu_each: 0.5,
        };
        assert!(speed.gpu(1) < speed.cpu(1));
        assert!(speed.gpu(16) > speed.cpu(16));
        assert!((speed.cpu(17) - 6.0).abs() < 1e-12);
    }
}
