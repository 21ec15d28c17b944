//! Runs a wave. First the motion and its bound at every time step, which the CPU reads to choose the steps to analyse; then all the rest in one
//! submission.

use std::sync::mpsc;

use frangible::FractureConfig;
use wgpu::{Buffer, BufferUsages, CommandEncoder};

use super::clock::Clock;
use super::device::Gpu;
use super::error::GpuError;
use super::initiation::{Initiation, LIST};
use super::loaded::{Buffers, Loaded, quadratic_modulus};
use super::passes::{CLUSTERS, COLUMNS, HEADER, POINTS, Pass, ROW, TILE};
use super::scratch::{CHUNK, Growing, MOST, Scratch, UNIFORM};
use super::wave::{Job, Wave};

/// Words that come back of an impact.
pub(crate) const RESULT: usize = HEADER + 4 * LIST;

/// Bytes of a summary: as the shader's `Summary`.
const SUMMARY: u64 = 40;

/// Columns per workgroup: as in `bounds.wgsl`.
const BOUND_COLUMNS: usize = 16;

/// Words of a slot of uniforms.
const SLOT: usize = UNIFORM as usize / 4;

/// A run of live columns; the default stands for the whole wave.
#[derive(Default)]
struct Chunk {
    first: usize,
    count: usize,
    /// First impact in it, number of impacts, most weak tetrahedra of one.
    jobs: (usize, usize, usize),
}

/// A pass, its slot of uniforms, its other buffers in their order, and its number of workgroups.
struct Dispatch<'a> {
    pass: &'a Pass,
    slot: usize,
    buffers: &'a [&'a Buffer],
    groups: [usize; 3],
}

/// Data that the passes of a wave share.
struct Shared<'a> {
    kind: &'a Loaded,
    buffers: &'a Buffers,
    rows: usize,
    config: &'a FractureConfig,
}

const ON_GPU: BufferUsages = BufferUsages::STORAGE
    .union(BufferUsages::COPY_SRC)
    .union(BufferUsages::COPY_DST);

impl Gpu {
    /// Computes a wave of impacts: the initiation of each.
    pub(crate) fn run(
        &self,
        kind: &Loaded,
        buffers: &Buffers,
        wave: &mut Wave,
        jobs: &[&Job<'_>],
        config: &FractureConfig,
    ) -> Result<Vec<Initiation>, GpuError> {
        let mut scratch = self.scratch();
        let shared = Shared {
            kind,
            buffers,
            rows: 3 * kind.asset().analysis().nodes.len(),
            config,
        };
        let results = self.checked(|| {
            let bounds = self.bounds(&shared, wave, &mut scratch)?;
            let live = wave.revive(bytemuck::cast_slice(&bounds), &kind.kind, jobs, config);
            if live.is_empty() {
                return Ok(Vec::new());
            }
            self.stresses(&shared, wave, &live, &mut scratch)
        })?;
        let found = jobs.iter().zip(&wave.spans).enumerate();
        Ok(found
            .map(|(i, (job, span))| {
                let (body, steps) = (job.body, job.pulse.total_steps);
                if span.alive == 0 {
                    Initiation::passed_over(span.bound, body, steps)
                } else {
                    let words = &results[RESULT * i..RESULT * (i + 1)];
                    Initiation::read(words, [span.passed_over, span.bound], body, steps)
                }
            })
            .collect())
    }

    /// Amplitudes of the modes and the stress bound of every column.
    fn bounds(
        &self,
        shared: &Shared<'_>,
        wave: &Wave,
        s: &mut Scratch,
    ) -> Result<Vec<u32>, GpuError> {
        let (device, queue) = (&self.device, &self.queue);
        let modes = shared.kind.root.len();
        let whole = Chunk::default();
        let uniforms = uniforms(shared, wave, &[whole], 0, 0);
        let slots = s.chunks.filled(device, queue, &uniforms);
        let jobs = s.jobs.filled(device, queue, &wave.jobs);
        let blocks = s.blocks.filled(device, queue, &wave.blocks);
        let matrices = bytemuck::cast_slice(&wave.matrices);
        let matrices = s.matrices.filled(device, queue, matrices);
        let restarts = bytemuck::cast_slice(&wave.restarts);
        let restarts = s.restarts.filled(device, queue, restarts);
        let bytes = 4 * wave.columns as u64;
        let amplitudes = s.amplitudes.room(device, bytes * modes as u64, ON_GPU);
        let bounds = s.bounds.room(device, bytes, ON_GPU);
        let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        let block_count = wave.blocks.len() / 2;
        let response = Dispatch {
            pass: &self.passes.amplitudes,
            slot: 0,
            buffers: &[jobs, blocks, matrices, restarts, amplitudes],
            groups: [
                modes.div_ceil(64),
                block_count.min(ROW),
                block_count.div_ceil(ROW),
            ],
        };
        let bound = Dispatch {
            pass: &self.passes.bounds,
            slot: 0,
            buffers: &[amplitudes, &shared.buffers.root, bounds],
            groups: rows_of(wave.columns.div_ceil(BOUND_COLUMNS), 1),
        };
        for dispatch in [&response, &bound] {
            self.dispatch(&mut encoder, &mut s.clock, slots, dispatch);
        }
        self.finish(encoder, bounds, bytes, &mut s.readback, &mut s.clock)
    }

    /// Stresses at the live columns: [`RESULT`] words of each impact.
    fn stresses(
        &self,
        shared: &Shared<'_>,
        wave: &Wave,
        live: &[u32],
        s: &mut Scratch,
    ) -> Result<Vec<u32>, GpuError> {
        let (device, queue) = (&self.device, &self.queue);
        let (rows, clusters, alive) = (shared.rows, shared.kind.clusters(), live.len() / 2);
        let room = (CHUNK as usize / (4 * rows * COLUMNS)).max(1);
        let stride = COLUMNS * room.min(alive.div_ceil(COLUMNS));
        let groups = clusters.div_ceil(CLUSTERS);
        let displacement_bytes = 4 * (rows * stride) as u64;
        let passed_bytes = 4 * (groups * alive) as u64;
        let passing_bytes = 4 * (clusters * stride) as u64;
        let largest = displacement_bytes.max(passed_bytes).max(passing_bytes);
        if largest > MOST {
            return Err(GpuError::TooLarge {
                what: "the motion of the meshes",
                asset: shared.kind.asset().name().to_owned(),
                bytes: largest,
                limit: MOST,
            });
        }
        let chunks: Vec<Chunk> = (0..alive)
            .step_by(stride)
            .map(|first| {
                let end = (first + stride).min(alive);
                Chunk {
                    first,
                    count: end - first,
                    jobs: wave.within(first, end),
                }
            })
            .chain([Chunk::default()])
            .collect();
        let slots = uniforms(shared, wave, &chunks, stride, alive);
        let slots = s.chunks.filled(device, queue, &slots);
        let jobs = s.jobs.filled(device, queue, &wave.jobs);
        let weak = s.weak.filled(device, queue, &wave.weak);
        let live = s.live.filled(device, queue, live);
        let amplitudes = s.amplitudes.room(device, 0, ON_GPU);
        let passing = s.passing.room(device, passing_bytes, ON_GPU);
        let passed_over = s.passed_over.room(device, passed_bytes, ON_GPU);
        let displacements = s.displacements.room(device, displacement_bytes, ON_GPU);
        let records = s.records.room(device, 16 * wave.records as u64, ON_GPU);
        let summary_bytes = SUMMARY * wave.tiles as u64;
        let summaries = s.summaries.room(device, summary_bytes, ON_GPU);
        let result_bytes = 4 * (wave.spans.len() * RESULT) as u64;
        let results = s.results.room(device, result_bytes, ON_GPU);

        let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        encoder.clear_buffer(records, 0, None);
        encoder.clear_buffer(results, 0, None);
        let kind = shared.buffers;
        for (slot, chunk) in chunks.iter().enumerate().filter(|(_, c)| c.count > 0) {
            let (_, jobs_here, most_weak) = chunk.jobs;
            let columns = chunk.count.div_ceil(COLUMNS);
            let of_chunk = [
                Dispatch {
                    pass: &self.passes.clusters,
                    slot,
                    buffers: &[jobs, live, amplitudes, &kind.clusters, passing, passed_over],
                    groups: [columns, groups, 1],
                },
                Dispatch {
                    pass: &self.passes.displacements,
                    slot,
                    buffers: &[&kind.shapes, amplitudes, live, displacements],
                    groups: [rows.div_ceil(64), columns, 1],
                },
                Dispatch {
                    pass: &self.passes.stress,
                    slot,
                    buffers: &[
                        jobs,
                        weak,
                        &kind.elements,
                        displacements,
                        live,
                        passing,
                        records,
                    ],
                    groups: rows_of(most_weak.div_ceil(POINTS), jobs_here),
                },
            ];
            for dispatch in &of_chunk {
                self.dispatch(&mut encoder, &mut s.clock, slots, dispatch);
            }
        }
        let summarize = Dispatch {
            pass: &self.passes.summaries,
            slot: chunks.len() - 1,
            buffers: &[jobs, weak, records, passed_over, summaries],
            groups: [wave.most_weak().div_ceil(TILE), wave.spans.len(), 1],
        };
        let gather = Dispatch {
            pass: &self.passes.gather,
            slot: chunks.len() - 1,
            buffers: &[jobs, records, summaries, results],
            groups: [wave.spans.len(), 1, 1],
        };
        for dispatch in [&summarize, &gather] {
            self.dispatch(&mut encoder, &mut s.clock, slots, dispatch);
        }
        self.finish(
            encoder,
            results,
            result_bytes,
            &mut s.readback,
            &mut s.clock,
        )
    }

    fn dispatch(
        &self,
        encoder: &mut CommandEncoder,
        clock: &mut Option<Clock>,
        slots: &Buffer,
        dispatch: &Dispatch<'_>,
    ) {
        if dispatch.groups.contains(&0) {
            return;
        }
        let uniform = wgpu::BindingResource::Buffer(wgpu::BufferBinding {
            buffer: slots,
            offset: UNIFORM * dispatch.slot as u64,
            size: wgpu::BufferSize::new(UNIFORM),
        });
        let storage = dispatch.buffers.iter().map(|b| b.as_entire_binding());
        let entries: Vec<wgpu::BindGroupEntry<'_>> = (0..)
            .zip(std::iter::once(uniform).chain(storage))
            .map(|(binding, resource)| wgpu::BindGroupEntry { binding, resource })
            .collect();
        let group = self.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: None,
            layout: &dispatch.pass.pipeline.get_bind_group_layout(0),
            entries: &entries,
        });
        let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
            label: Some(dispatch.pass.name),
            timestamp_writes: clock
                .as_mut()
                .and_then(|clock| clock.writes(dispatch.pass.name)),
        });
        pass.set_pipeline(&dispatch.pass.pipeline);
        pass.set_bind_group(0, &group, &[]);
        let [x, y, z] = dispatch.groups.map(|n| n as u32);
        pass.dispatch_workgroups(x, y, z);
    }

    /// Submits the encoded commands, waits, and reads the first bytes of a buffer and the times of the passes.
    fn finish(
        &self,
        mut encoder: CommandEncoder,
        from: &Buffer,
        bytes: u64,
        readback: &mut Growing,
        clock: &mut Option<Clock>,
    ) -> Result<Vec<u32>, GpuError> {
        let Some(clock) = clock else {
            return self.read(encoder, from, bytes, readback);
        };
        let (times, time_bytes) = clock.resolve(&self.device, &mut encoder);
        let words = self.read(encoder, from, bytes, readback)?;
        let encoder = self
            .device
            .create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        let times = self.read(encoder, times, time_bytes, readback)?;
        clock.add(&times);
        Ok(words)
    }

    /// Submits the encoded commands, waits, and reads the first bytes of a buffer.
    fn read(
        &self,
        mut encoder: CommandEncoder,
        from: &Buffer,
        bytes: u64,
        readback: &mut Growing,
    ) -> Result<Vec<u32>, GpuError> {
        let failed = |error: &dyn std::fmt::Display| GpuError::Device(error.to_string());
        let usage = BufferUsages::MAP_READ | BufferUsages::COPY_DST;
        let buffer = readback.room(&self.device, bytes, usage);
        encoder.copy_buffer_to_buffer(from, 0, buffer, 0, bytes);
        self.queue.submit([encoder.finish()]);
        let slice = buffer.slice(..bytes);
        let (sender, receiver) = mpsc::channel();
        slice.map_async(wgpu::MapMode::Read, move |result| {
            // Nobody listens only when the caller has failed already.
            let _ = sender.send(result);
        });
        self.device
            .poll(wgpu::PollType::wait_indefinitely())
            .map_err(|error| failed(&error))?;
        receiver
            .recv()
            .map_err(|error| failed(&error))?
            .map_err(|error| failed(&error))?;
        let view = slice.get_mapped_range().map_err(|error| failed(&error))?;
        let words = bytemuck::pod_collect_to_vec::<u8, u32>(&view);
        drop(view);
        buffer.unmap();
        Ok(words)
    }
}

/// Splits a number of workgroups over the first two axes, in rows of [`ROW`] at most; `third` is the number along the third.
fn rows_of(count: usize, third: usize) -> [usize; 3] {
    [count.min(ROW), count.div_ceil(ROW), third]
}

/// One slot per chunk: as the shader's `Chunk`.
fn uniforms(
    shared: &Shared<'_>,
    wave: &Wave,
    chunks: &[Chunk],
    stride: usize,
    alive: usize,
) -> Vec<u32> {
    let material = shared.kind.asset().material();
    let (lambda, mu) = (material.lame_lambda(), material.shear_modulus());
    let mut words = Vec::with_capacity(SLOT * chunks.len());
    for chunk in chunks {
        let slot = words.len();
        let counts = [
            shared.kind.root.len(),
            shared.rows,
            wave.columns,
            chunk.first,
            chunk.count,
            stride,
            alive,
            chunk.jobs.0,
            wave.blocks.len() / 2,
            shared.kind.clusters(),
            LIST,
        ];
        let moduli = [
            lambda,
            mu,
            quadratic_modulus(material, shared.config),
            2.0 * lambda * mu / (lambda + 2.0 * mu),
            material.youngs_modulus,
            f64::from(u8::from(shared.config.is_paper())),
        ];
        words.extend(counts.map(|n| n as u32));
        words.extend(moduli.map(|x| (x as f32).to_bits()));
        words.resize(slot + SLOT, 0);
    }
    words
}
