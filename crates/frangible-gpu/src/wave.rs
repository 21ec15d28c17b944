//! Packs impacts into waves: as many as fit the buffers at once.

use std::collections::HashMap;

use frangible::{Asset, Body, Vibration};

use crate::error::GpuError;
use crate::passes::COLUMNS;
use crate::response::Response;
use crate::scratch::{MOST, WAVE};

/// An impact to compute.
pub(crate) struct Job<'a> {
    pub(crate) body: &'a Body,
    pub(crate) vibration: &'a Vibration,
    pub(crate) response: Response,
}

/// Words of a job on the GPU: as the shader's `Job`.
const JOB: usize = 8;

/// Most impacts of a wave: the third axis of a dispatch.
const MOST_JOBS: usize = 65_535;

/// Impacts that are computed together, as the shaders read them.
#[derive(Debug, Default)]
pub(crate) struct Wave {
    pub(crate) jobs: Vec<u32>,
    pub(crate) blocks: Vec<u32>,
    pub(crate) matrices: Vec<f32>,
    pub(crate) restarts: Vec<f32>,
    pub(crate) weak: Vec<u32>,
    pub(crate) columns: usize,
    pub(crate) records: usize,
    /// First column and number of weak tetrahedra of each impact.
    pub(crate) spans: Vec<(usize, usize)>,
    /// Where the weak tetrahedra of a body begin: many impacts of one body share them.
    weak_of_body: HashMap<*const Body, u32>,
}

/// Packs impacts of one kind of body, in their order. `limit` is the bound below which a step of a body needs no look.
pub(crate) fn waves(
    asset: &Asset,
    jobs: &[Job<'_>],
    limit: impl Fn(&Body) -> f32,
) -> Result<Vec<Wave>, GpuError> {
    let modes = asset.modes.count();
    let mut waves: Vec<Wave> = Vec::new();
    for job in jobs {
        let steps = job.vibration.pulse.total_steps;
        let weak = job.body.weak_tets().len();
        let too_large = |what, bytes| GpuError::TooLarge {
            what,
            asset: asset.name.clone(),
            bytes,
            limit: MOST,
        };
        let own = [
            ("the motion of an impact", 4 * (steps * modes) as u64),
            ("the weak points of a body", 16 * weak as u64),
        ];
        if let Some((what, bytes)) = own.into_iter().find(|(_, bytes)| *bytes > MOST) {
            return Err(too_large(what, bytes));
        }
        let fits = waves.last().is_some_and(|wave| {
            let columns = wave.columns + steps;
            wave.spans.len() < MOST_JOBS
                && 4 * (columns * modes) as u64 <= WAVE
                && 16 * (wave.records + weak) as u64 <= WAVE
                && 4 * (wave.matrices.len() + job.response.matrices.len()) as u64 <= WAVE
                && 4 * (wave.restarts.len() + job.response.restarts.len()) as u64 <= WAVE
        });
        if !fits {
            waves.push(Wave::default());
        }
        if let Some(wave) = waves.last_mut() {
            wave.push(job, limit(job.body));
        }
    }
    Ok(waves)
}

impl Wave {
    fn push(&mut self, job: &Job<'_>, limit: f32) {
        let pulse = &job.vibration.pulse;
        let weak = job.body.weak_tets();
        let number = self.spans.len() as u32;
        let next = self.weak.len() as u32 / 2;
        let first_weak = *self
            .weak_of_body
            .entry(std::ptr::from_ref(job.body))
            .or_insert(next);
        if first_weak == next {
            let words = weak
                .iter()
                .flat_map(|&t| [t, job.body.strength(t).to_bits()]);
            self.weak.extend(words);
        }
        let words: [u32; JOB] = [
            self.columns as u32,
            pulse.total_steps as u32,
            pulse.contact_steps as u32,
            first_weak,
            weak.len() as u32,
            self.records as u32,
            limit.to_bits(),
            0,
        ];
        self.jobs.extend(words);
        for first in (0..pulse.total_steps).step_by(COLUMNS) {
            self.blocks.extend([number, first as u32]);
        }
        self.matrices.extend(&job.response.matrices);
        self.restarts.extend(&job.response.restarts);
        self.spans.push((self.columns, weak.len()));
        self.columns += pulse.total_steps;
        self.records += weak.len();
    }

    /// Impacts with a column in a range, and the most weak tetrahedra of one.
    pub(crate) fn within(&self, first: usize, end: usize) -> (usize, usize, usize) {
        let from = self.spans.partition_point(|s| s.0 <= first).max(1) - 1;
        let to = self.spans.partition_point(|s| s.0 < end);
        let most = self.spans[from..to].iter().map(|s| s.1).max();
        (from, to - from, most.unwrap_or(0))
    }
}
