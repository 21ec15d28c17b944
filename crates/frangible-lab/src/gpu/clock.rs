//! Time of each pass by the GPU's own clock.

use wgpu::{Buffer, BufferUsages, CommandEncoder, Device, QuerySet, Queue};

use super::scratch::Growing;

/// Dispatches that one submission can time: a query set holds twice as many times.
const MOST: u32 = 2048;

/// Time of one kind of pass on the GPU.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct PassTime {
    /// The pass.
    pub pass: &'static str,
    /// Total time of its dispatches by the GPU's clock, s.
    pub seconds: f64,
}

/// Takes the time of every dispatch, up to [`MOST`] of a submission.
#[derive(Debug)]
pub(crate) struct Clock {
    set: QuerySet,
    resolved: Growing,
    /// Length of a tick, s.
    tick: f64,
    /// The passes of this submission so far.
    started: Vec<&'static str>,
    times: Vec<PassTime>,
}

impl Clock {
    pub(crate) fn new(device: &Device, queue: &Queue) -> Self {
        let set = device.create_query_set(&wgpu::QuerySetDescriptor {
            label: Some("pass times"),
            ty: wgpu::QueryType::Timestamp,
            count: 2 * MOST,
        });
        Self {
            set,
            resolved: Growing::default(),
            tick: 1e-9 * f64::from(queue.get_timestamp_period()),
            started: Vec::new(),
            times: Vec::new(),
        }
    }

    /// Timestamp writes of the next dispatch, which is of this pass. None if the query set is full.
    pub(crate) fn writes(
        &mut self,
        pass: &'static str,
    ) -> Option<wgpu::ComputePassTimestampWrites<'_>> {
        let first = 2 * self.started.len() as u32;
        if first >= 2 * MOST {
            return None;
        }
        self.started.push(pass);
        Some(wgpu::ComputePassTimestampWrites {
            query_set: &self.set,
            beginning_of_pass_write_index: Some(first),
            end_of_pass_write_index: Some(first + 1),
        })
    }

    /// Ends a submission. Returns the buffer with its times, and their size, bytes.
    pub(crate) fn resolve(
        &mut self,
        device: &Device,
        encoder: &mut CommandEncoder,
    ) -> (&Buffer, u64) {
        let count = 2 * self.started.len() as u32;
        let usage = BufferUsages::QUERY_RESOLVE | BufferUsages::COPY_SRC;
        let buffer = self.resolved.room(device, 8 * u64::from(count), usage);
        encoder.resolve_query_set(&self.set, 0..count, buffer, 0);
        (buffer, 8 * u64::from(count))
    }

    /// Adds up the times of a submission.
    pub(crate) fn add(&mut self, words: &[u32]) {
        let times = words.chunks_exact(4).map(|w| {
            let [begin, end] = [0, 2].map(|i| u64::from(w[i]) | u64::from(w[i + 1]) << 32);
            self.tick * end.saturating_sub(begin) as f64
        });
        for (pass, seconds) in self.started.drain(..).zip(times) {
            match self.times.iter_mut().find(|t| t.pass == pass) {
                Some(known) => known.seconds += seconds,
                None => self.times.push(PassTime { pass, seconds }),
            }
        }
    }

    pub(crate) fn into_times(self) -> Vec<PassTime> {
        self.times
    }
}
