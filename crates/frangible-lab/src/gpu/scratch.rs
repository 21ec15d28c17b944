//! Buffers that live from batch to batch, and their size limit.

use wgpu::{Buffer, BufferUsages, Device, Queue};

use super::clock::Clock;

/// Most bytes of one binding: WebGPU's default limit.
pub(crate) const MOST: u64 = 128 << 20;

/// Bytes of each list of a wave of impacts; more impacts make more waves.
pub(crate) const WAVE: u64 = 64 << 20;

/// Bytes of displacements of a chunk: they stay in the cache of a card, or of a CPU.
pub(crate) const CHUNK: u64 = 32 << 20;

/// Offsets of uniforms are multiples of this.
pub(crate) const UNIFORM: u64 = 256;

/// A buffer that grows when it must.
#[derive(Debug, Default)]
pub(crate) struct Growing {
    buffer: Option<Buffer>,
}

impl Growing {
    /// The buffer, with room for so many bytes. Its contents are lost when it grows.
    pub(crate) fn room(&mut self, device: &Device, bytes: u64, usage: BufferUsages) -> &Buffer {
        let needed = bytes.max(16).next_multiple_of(16);
        let buffer = match self.buffer.take() {
            Some(buffer) if buffer.size() >= needed => buffer,
            // The old one is gone before the new one is made.
            old => {
                drop(old);
                // A quarter more, so that batches that grow slowly do not make a buffer each.
                let size = (needed + needed / 4).next_multiple_of(16);
                device.create_buffer(&wgpu::BufferDescriptor {
                    label: None,
                    size: size.min(MOST.max(needed)),
                    usage,
                    mapped_at_creation: false,
                })
            }
        };
        self.buffer.insert(buffer)
    }

    /// The buffer, holding these words.
    pub(crate) fn filled(&mut self, device: &Device, queue: &Queue, words: &[u32]) -> &Buffer {
        let usage = BufferUsages::STORAGE | BufferUsages::UNIFORM | BufferUsages::COPY_DST;
        let buffer = self.room(device, 4 * words.len() as u64, usage);
        queue.write_buffer(buffer, 0, bytemuck::cast_slice(words));
        buffer
    }
}

/// The buffers of a wave.
#[derive(Debug)]
pub(crate) struct Scratch {
    pub(crate) chunks: Growing,
    pub(crate) jobs: Growing,
    pub(crate) blocks: Growing,
    pub(crate) matrices: Growing,
    pub(crate) restarts: Growing,
    pub(crate) weak: Growing,
    pub(crate) amplitudes: Growing,
    pub(crate) bounds: Growing,
    pub(crate) live: Growing,
    pub(crate) passing: Growing,
    pub(crate) passed_over: Growing,
    pub(crate) displacements: Growing,
    pub(crate) records: Growing,
    pub(crate) summaries: Growing,
    pub(crate) results: Growing,
    pub(crate) readback: Growing,
    /// Takes the times of the passes, where they are asked for.
    pub(crate) clock: Option<Clock>,
}

impl Scratch {
    pub(crate) fn new() -> Self {
        let new = Growing::default;
        Self {
            chunks: new(),
            jobs: new(),
            blocks: new(),
            matrices: new(),
            restarts: new(),
            weak: new(),
            amplitudes: new(),
            bounds: new(),
            live: new(),
            passing: new(),
            passed_over: new(),
            displacements: new(),
            records: new(),
            summaries: new(),
            results: new(),
            readback: new(),
            clock: None,
        }
    }
}
