//! Packs impacts into waves: as many as fit the buffers at once.

use std::collections::HashMap;

use frangible::internals::Vibration;
use frangible::internals::contact::Pulse;
use frangible::internals::stress::Law;
use frangible::{Body, Breakable, FractureConfig};
use rayon::prelude::*;

use super::error::GpuError;
use super::passes::{COLUMNS, TILE};
use super::response::Response;
use super::scratch::{MOST, WAVE};

/// An impact to compute.
pub(crate) struct Job<'a> {
    pub(crate) body: &'a Body,
    pub(crate) vibration: &'a Vibration,
    pub(crate) pulse: &'a Pulse,
    pub(crate) response: Response,
}

/// Words of a job on the GPU: as the shader's `Job`.
const JOB: usize = 10;

/// Words of a job before its weak tetrahedra, and before its live columns.
const BEFORE_WEAK: usize = 3;
const BEFORE_ALIVE: usize = 6;

/// Words of a weak tetrahedron: as the shader's `Weak`.
const WEAK: usize = 12;

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
    pub(crate) tiles: usize,
    /// Span of each impact in the lists.
    pub(crate) spans: Vec<Span>,
}

/// Place of an impact in its wave.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Span {
    first_column: usize,
    steps: usize,
    /// Its weak tetrahedra, once it is known that it has a live column.
    weak: usize,
    limit: f32,
    /// Its first live column, once the bounds are known, and the number of live columns.
    first_alive: usize,
    pub(crate) alive: usize,
    /// Largest bound of its other columns, Pa.
    pub(crate) passed_over: f32,
    /// Largest bound of all columns, Pa.
    pub(crate) bound: f32,
}

/// Packs impacts of one kind of body, in their order. `limit` is the bound below which a step of a body needs no look.
pub(crate) fn waves(
    kind: &Breakable,
    jobs: &[Job<'_>],
    limit: impl Fn(&Body) -> f32,
) -> Result<Vec<Wave>, GpuError> {
    let asset = kind.asset();
    let modes = asset.modes().count();
    let mut waves: Vec<Wave> = Vec::new();
    for job in jobs {
        let steps = job.pulse.total_steps;
        let weak = job.body.weak_tets().len();
        let too_large = |what, bytes| GpuError::TooLarge {
            what,
            asset: asset.name().to_owned(),
            bytes,
            limit: MOST,
        };
        let own = [
            ("the motion of an impact", 4 * (steps * modes) as u64),
            ("the weak points of a body", 4 * (WEAK * weak) as u64),
        ];
        if let Some((what, bytes)) = own.into_iter().find(|(_, bytes)| *bytes > MOST) {
            return Err(too_large(what, bytes));
        }
        let fits = waves.last().is_some_and(|wave| {
            let columns = wave.columns + steps;
            wave.spans.len() < MOST_JOBS
                && 4 * (columns * modes) as u64 <= WAVE
                && 4 * (WEAK * (wave.records + weak)) as u64 <= WAVE
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

/// Weak tetrahedra with an outer face under a contact, ascending.
fn pressed_weak(job: &Job<'_>) -> Vec<u32> {
    let tet_of_triangle = &job.body.asset().surface().tets;
    let tets = job.vibration.pressed.iter();
    let mut tets: Vec<u32> = tets.map(|&t| tet_of_triangle[t as usize]).collect();
    tets.retain(|tet| job.body.weak_tets().binary_search(tet).is_ok());
    tets.sort_unstable();
    tets.dedup();
    tets
}

/// A weak point in the form that the shader's `Weak` has.
fn weak_words(job: &Job<'_>, config: &FractureConfig, cluster: u32, tet: u32) -> [u32; WEAK] {
    let (point, law) = job.body.weak_place(tet, config, &job.vibration.pressed);
    let (law, direction) = match law {
        Law::Solid => (0, [0.0; 3]),
        Law::Free(normal) => (1, normal.to_array()),
        Law::Edge(along) => (2, along.to_array()),
    };
    let strength = job.body.strength(tet).to_bits();
    let [a, b, c, d] = point.barycentric.map(f32::to_bits);
    let [x, y, z] = direction.map(f32::to_bits);
    let element = point.element;
    [tet, strength, cluster, law, a, b, c, d, x, y, z, element]
}

impl Wave {
    fn push(&mut self, job: &Job<'_>, limit: f32) {
        let pulse = job.pulse;
        let weak = job.body.weak_tets().len();
        let number = self.spans.len() as u32;
        let words: [u32; JOB] = [
            self.columns as u32,
            pulse.total_steps as u32,
            pulse.contact_steps as u32,
            0,
            0,
            self.records as u32,
            0,
            0,
            limit.to_bits(),
            self.tiles as u32,
        ];
        self.jobs.extend(words);
        for first in (0..pulse.total_steps).step_by(COLUMNS) {
            self.blocks.extend([number, first as u32]);
        }
        self.matrices.extend(&job.response.matrices);
        self.restarts.extend(&job.response.restarts);
        self.spans.push(Span {
            first_column: self.columns,
            steps: pulse.total_steps,
            weak,
            limit,
            first_alive: 0,
            alive: 0,
            passed_over: 0.0,
            bound: 0.0,
        });
        self.columns += pulse.total_steps;
        self.records += weak;
        self.tiles += weak.div_ceil(TILE);
    }

    /// Finds out which columns are alive: column and impact of each. Of the impacts that have some, the weak tetrahedra are listed.
    pub(crate) fn revive(
        &mut self,
        bounds: &[f32],
        kind: &Breakable,
        jobs: &[&Job<'_>],
        config: &FractureConfig,
    ) -> Vec<u32> {
        let cluster_of_tet = &kind.stress_bounds().cluster_of_tet;
        // Where the weak tetrahedra of a body begin, with some of them under a contact: impacts of one body share them. Looked
        // up only, never iterated.
        let mut known: HashMap<(*const Body, Vec<u32>), u32> = HashMap::new();
        let mut live = Vec::new();
        for (number, (span, job)) in self.spans.iter_mut().zip(jobs).enumerate() {
            span.first_alive = live.len() / 2;
            let end = span.first_column + span.steps;
            for (&bound, column) in bounds[span.first_column..end]
                .iter()
                .zip(span.first_column..)
            {
                span.bound = span.bound.max(bound);
                if bound <= span.limit {
                    span.passed_over = span.passed_over.max(bound);
                } else {
                    live.extend([column as u32, number as u32]);
                }
            }
            span.alive = live.len() / 2 - span.first_alive;
            if span.alive == 0 {
                span.weak = 0;
                continue;
            }
            let next = (self.weak.len() / WEAK) as u32;
            let first_weak = *known
                .entry((std::ptr::from_ref(job.body), pressed_weak(job)))
                .or_insert(next);
            if first_weak == next {
                let words = |&tet: &u32| weak_words(job, config, cluster_of_tet[tet as usize], tet);
                let tets = job.body.weak_tets().par_iter();
                self.weak.par_extend(tets.flat_map_iter(words));
            }
            let job = &mut self.jobs[JOB * number..JOB * (number + 1)];
            job[BEFORE_WEAK..BEFORE_WEAK + 2].copy_from_slice(&[first_weak, span.weak as u32]);
            job[BEFORE_ALIVE..BEFORE_ALIVE + 2]
                .copy_from_slice(&[span.first_alive as u32, span.alive as u32]);
        }
        live
    }

    /// Most weak tetrahedra of an impact.
    pub(crate) fn most_weak(&self) -> usize {
        self.spans.iter().map(|s| s.weak).max().unwrap_or(0)
    }

    /// Impacts with a live column in a range: the first, their number, and the most weak tetrahedra of one.
    pub(crate) fn within(&self, first: usize, end: usize) -> (usize, usize, usize) {
        let from = self
            .spans
            .partition_point(|s| s.first_alive <= first)
            .max(1)
            - 1;
        let to = self.spans.partition_point(|s| s.first_alive < end);
        let most = self.spans[from..to].iter().map(|s| s.weak).max();
        (from, to - from, most.unwrap_or(0))
    }
}
