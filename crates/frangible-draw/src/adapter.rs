//! Is there anything to draw with?

use std::sync::OnceLock;

use crate::DrawError;

/// Whether a graphics adapter, in hardware or in software, is there to draw with.
#[must_use]
pub fn has_adapter() -> bool {
    texture_limit().is_ok()
}

/// Whether the adapter is a program that draws with the processor.
#[must_use]
pub fn is_software() -> bool {
    adapter().is_some_and(|adapter| adapter.software)
}

/// The longest side of a picture that the adapter can hold, pixels.
///
/// The renderer panics where it finds no adapter; asking in the same words
/// beforehand turns that into an error. Asked once: adapters do not come and go,
/// and drivers like to chat on each question.
pub(crate) fn texture_limit() -> Result<u32, DrawError> {
    adapter()
        .map(|adapter| adapter.texture_limit)
        .ok_or(DrawError::NoAdapter)
}

/// What we need to know of the adapter.
#[derive(Clone, Copy)]
struct Adapter {
    texture_limit: u32,
    software: bool,
}

fn adapter() -> Option<Adapter> {
    static ADAPTER: OnceLock<Option<Adapter>> = OnceLock::new();
    *ADAPTER.get_or_init(probe)
}

fn probe() -> Option<Adapter> {
    // Through OpenGL the renderer draws nothing but the sky, and says nothing of it.
    let instance = wgpu::Instance::new(wgpu::InstanceDescriptor {
        backends: wgpu::Backends::all() - wgpu::Backends::GL,
        ..wgpu::InstanceDescriptor::new_without_display_handle()
    });
    let request = instance.request_adapter(&wgpu::RequestAdapterOptions::default());
    let adapter = pollster::block_on(request)
        .inspect_err(|error| log::debug!("no graphics adapter: {error}"))
        .ok()?;
    let info = adapter.get_info();
    log::debug!("drawing with {}", info.name);
    Some(Adapter {
        texture_limit: adapter.limits().max_texture_dimension_2d,
        software: info.device_type == wgpu::DeviceType::Cpu,
    })
}
