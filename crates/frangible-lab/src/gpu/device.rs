//! The device that computes.

use std::sync::{Mutex, MutexGuard};

use super::error::GpuError;
use super::passes::Passes;
use super::scratch::Scratch;

/// A graphics adapter for computing. Concurrent calls are serialized.
#[derive(Debug)]
pub struct Gpu {
    pub(crate) device: wgpu::Device,
    pub(crate) queue: wgpu::Queue,
    pub(crate) passes: Passes,
    scratch: Mutex<Scratch>,
    info: wgpu::AdapterInfo,
}

impl Gpu {
    /// Opens the fastest adapter, or a software adapter if there is no other.
    ///
    /// # Errors
    /// No adapter, or one below WebGPU's default limits.
    pub fn new() -> Result<Self, GpuError> {
        pollster::block_on(Self::open())
    }

    async fn open() -> Result<Self, GpuError> {
        let instance = wgpu::Instance::new(wgpu::InstanceDescriptor {
            backends: wgpu::Backends::all() - wgpu::Backends::GL,
            ..wgpu::InstanceDescriptor::new_without_display_handle()
        });
        let adapter = instance
            .request_adapter(&wgpu::RequestAdapterOptions {
                power_preference: wgpu::PowerPreference::HighPerformance,
                ..wgpu::RequestAdapterOptions::default()
            })
            .await
            .inspect_err(|error| log::debug!("no graphics adapter: {error}"))
            .map_err(|_| GpuError::NoAdapter)?;
        let info = adapter.get_info();
        let unusable = |problem: String| GpuError::Adapter {
            adapter: info.name.clone(),
            problem,
        };
        let (device, queue) = adapter
            .request_device(&wgpu::DeviceDescriptor {
                label: Some("frangible"),
                // Only to measure with.
                required_features: adapter.features() & wgpu::Features::TIMESTAMP_QUERY,
                // WebGPU's defaults, so that it also works in a browser.
                required_limits: wgpu::Limits::default(),
                ..wgpu::DeviceDescriptor::default()
            })
            .await
            .map_err(|error| unusable(error.to_string()))?;
        let scope = device.push_error_scope(wgpu::ErrorFilter::Validation);
        let passes = Passes::new(&device);
        if let Some(error) = scope.pop().await {
            return Err(unusable(error.to_string()));
        }
        log::debug!("computing on {}", info.name);
        Ok(Self {
            scratch: Mutex::new(Scratch::new()),
            device,
            queue,
            passes,
            info,
        })
    }

    /// Name of the adapter.
    #[must_use]
    pub fn adapter(&self) -> &str {
        &self.info.name
    }

    /// Returns true if the adapter computes on the CPU.
    #[must_use]
    pub fn is_software(&self) -> bool {
        self.info.device_type == wgpu::DeviceType::Cpu
    }

    /// The buffers that batches share.
    pub(crate) fn scratch(&self) -> MutexGuard<'_, Scratch> {
        self.scratch
            .lock()
            .unwrap_or_else(std::sync::PoisonError::into_inner)
    }

    /// Runs something on the device. A problem that the device finds, or a lack of its memory, is an error.
    pub(crate) fn checked<T>(
        &self,
        run: impl FnOnce() -> Result<T, GpuError>,
    ) -> Result<T, GpuError> {
        let memory = self.device.push_error_scope(wgpu::ErrorFilter::OutOfMemory);
        let validity = self.device.push_error_scope(wgpu::ErrorFilter::Validation);
        let result = run();
        let problems = [
            pollster::block_on(validity.pop()),
            pollster::block_on(memory.pop()),
        ];
        match problems.into_iter().flatten().next() {
            Some(error) => Err(GpuError::Device(error.to_string())),
            None => result,
        }
    }
}
