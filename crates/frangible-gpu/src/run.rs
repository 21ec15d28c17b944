//! Runs a wave: all passes in one submission, one read back.

use std::sync::mpsc;

use frangible::Asset;
use wgpu::{Buffer, BufferUsages, ComputePipeline};

use crate::device::Gpu;
use crate::error::GpuError;
use crate::initiation::LIST;
use crate::loaded::{Buffers, quadratic_modulus};
use crate::passes::{COLUMNS, HEADER, ROW};
use crate::scratch::{MOST, Scratch, UNIFORM};
use crate::wave::Wave;

/// Words that come back of an impact.
pub(crate) const RESULT: usize = HEADER + 4 * LIST;

/// Words of a slot of uniforms.
const SLOT: usize = UNIFORM as usize / 4;

/// A run of columns.
struct Chunk {
    first: usize,
    count: usize,
    /// First impact in it, number of impacts, most weak tetrahedra of one.
    jobs: (usize, usize, usize),
}

/// The bounds that a dispatch reads: its pipeline, its slot of uniforms, its other buffers in their order, workgroups.
struct Dispatch<'a> {
    pipeline: &'a ComputePipeline,
    slot: usize,
    buffers: &'a [&'a Buffer],
    groups: [usize; 3],
}

impl Gpu {
    /// Computes a wave of impacts: [`RESULT`] words of each.
    pub(crate) fn run(
        &self,
        asset: &Asset,
        kind: &Buffers,
        wave: &Wave,
    ) -> Result<Vec<u32>, GpuError> {
        let mut scratch = self
            .scratch
            .lock()
            .unwrap_or_else(std::sync::PoisonError::into_inner);
        self.checked(|| {
            let bytes = self.submit(asset, kind, wave, &mut scratch)?;
            self.read(&mut scratch, bytes)
        })
    }

    fn submit(
        &self,
        asset: &Asset,
        kind: &Buffers,
        wave: &Wave,
        scratch: &mut Scratch,
    ) -> Result<u64, GpuError> {
        let modes = asset.modes.count();
        let rows = 3 * asset.analysis.nodes.len();
        let room = (scratch.chunk_bytes as usize / (4 * rows * COLUMNS)).max(1);
        let stride = COLUMNS * room.min(wave.columns.div_ceil(COLUMNS));
        let displacement_bytes = 4 * (rows * stride) as u64;
        if displacement_bytes > MOST {
            return Err(GpuError::TooLarge {
                what: "the analysis mesh",
                asset: asset.name.clone(),
                bytes: displacement_bytes,
                limit: MOST,
            });
        }
        let chunks: Vec<Chunk> = (0..wave.columns)
            .step_by(stride)
            .map(|first| {
                let end = (first + stride).min(wave.columns);
                Chunk {
                    first,
                    count: end - first,
                    jobs: wave.within(first, end),
                }
            })
            .collect();
        let uniforms = uniforms(asset, wave, &chunks, rows, stride);
        let (device, queue) = (&self.device, &self.queue);
        let job_count = wave.spans.len();
        let result_bytes = 4 * (job_count * RESULT) as u64;
        let on_gpu = BufferUsages::STORAGE | BufferUsages::COPY_SRC | BufferUsages::COPY_DST;
        let s = scratch;
        let slots = s.chunks.filled(device, queue, &uniforms);
        let jobs = s.jobs.filled(device, queue, &wave.jobs);
        let blocks = s.blocks.filled(device, queue, &wave.blocks);
        let matrices = bytemuck::cast_slice(&wave.matrices);
        let matrices = s.matrices.filled(device, queue, matrices);
        let restarts = bytemuck::cast_slice(&wave.restarts);
        let restarts = s.restarts.filled(device, queue, restarts);
        let weak = s.weak.filled(device, queue, &wave.weak);
        let column_bytes = 4 * wave.columns as u64;
        let amplitudes = s
            .amplitudes
            .room(device, column_bytes * modes as u64, on_gpu);
        let bounds = s.bounds.room(device, column_bytes, on_gpu);
        let tiles = s.tiles.room(device, column_bytes, on_gpu);
        let displacements = s.displacements.room(device, displacement_bytes, on_gpu);
        let records = s.records.room(device, 16 * wave.records as u64, on_gpu);
        let results = s.results.room(device, result_bytes, on_gpu);
        let to_host = BufferUsages::MAP_READ | BufferUsages::COPY_DST;
        let readback = s.readback.room(device, result_bytes, to_host);

        let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        encoder.clear_buffer(records, 0, None);
        encoder.clear_buffer(results, 0, None);
        let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
        let mut go = |dispatch: Dispatch<'_>| self.dispatch(&mut pass, slots, &dispatch);
        let block_count = wave.blocks.len() / 2;
        go(Dispatch {
            pipeline: &self.passes.amplitudes,
            slot: 0,
            buffers: &[jobs, blocks, matrices, restarts, amplitudes, bounds],
            groups: [
                modes.div_ceil(64),
                block_count.min(ROW),
                block_count.div_ceil(ROW),
            ],
        });
        go(Dispatch {
            pipeline: &self.passes.bounds,
            slot: 0,
            buffers: &[amplitudes, &kind.root, bounds, tiles],
            groups: [wave.columns.div_ceil(COLUMNS), 1, 1],
        });
        for (slot, chunk) in chunks.iter().enumerate() {
            let (_, jobs_here, most_weak) = chunk.jobs;
            go(Dispatch {
                pipeline: &self.passes.displacements,
                slot,
                buffers: &[&kind.shapes, amplitudes, tiles, displacements],
                groups: [rows.div_ceil(64), chunk.count.div_ceil(COLUMNS), 1],
            });
            go(Dispatch {
                pipeline: &self.passes.stress,
                slot,
                buffers: &[
                    jobs,
                    weak,
                    &kind.samples,
                    &kind.elements,
                    displacements,
                    bounds,
                    records,
                ],
                groups: [most_weak.min(ROW), most_weak.div_ceil(ROW), jobs_here],
            });
        }
        go(Dispatch {
            pipeline: &self.passes.gather,
            slot: chunks.len(),
            buffers: &[jobs, weak, records, bounds, results],
            groups: [job_count, 1, 1],
        });
        drop(pass);
        encoder.copy_buffer_to_buffer(results, 0, readback, 0, result_bytes);
        queue.submit([encoder.finish()]);
        Ok(result_bytes)
    }

    fn dispatch(&self, pass: &mut wgpu::ComputePass<'_>, slots: &Buffer, dispatch: &Dispatch<'_>) {
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
            layout: &dispatch.pipeline.get_bind_group_layout(0),
            entries: &entries,
        });
        pass.set_pipeline(dispatch.pipeline);
        pass.set_bind_group(0, &group, &[]);
        let [x, y, z] = dispatch.groups.map(|n| n as u32);
        pass.dispatch_workgroups(x, y, z);
    }

    fn read(&self, scratch: &mut Scratch, bytes: u64) -> Result<Vec<u32>, GpuError> {
        let failed = |error: &dyn std::fmt::Display| GpuError::Device(error.to_string());
        let usage = BufferUsages::MAP_READ | BufferUsages::COPY_DST;
        let buffer = scratch.readback.room(&self.device, bytes, usage);
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

/// One slot per chunk, and one for the whole wave at the end: as the shader's `Chunk`.
fn uniforms(asset: &Asset, wave: &Wave, chunks: &[Chunk], rows: usize, stride: usize) -> Vec<u32> {
    let (lambda, mu) = (asset.material.lame_lambda(), asset.material.shear_modulus());
    let whole = Chunk {
        first: 0,
        count: wave.columns,
        jobs: (0, wave.spans.len(), 0),
    };
    let mut words = Vec::with_capacity(SLOT * (chunks.len() + 1));
    for chunk in chunks.iter().chain([&whole]) {
        let slot = words.len();
        words.extend([
            asset.modes.count() as u32,
            rows as u32,
            wave.columns as u32,
            chunk.first as u32,
            chunk.count as u32,
            stride as u32,
            chunk.jobs.0 as u32,
            wave.blocks.len() as u32 / 2,
            (lambda as f32).to_bits(),
            (mu as f32).to_bits(),
            (quadratic_modulus(&asset.material) as f32).to_bits(),
            LIST as u32,
        ]);
        words.resize(slot + SLOT, 0);
    }
    words
}
