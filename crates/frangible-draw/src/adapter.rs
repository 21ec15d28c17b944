//! Is there anything to draw with?

use std::sync::OnceLock;

use crate::DrawError;

/// Whether a graphics adapter, in hardware or in software, is there to draw with.
#[must_use]
pub fn has_adapter() -> bool {
    texture_limit().is_ok()
}

/// The longest side of a picture that the adapter can hold, pixels.
///
/// The renderer panics where it finds no adapter; asking in the same words
/// beforehand turns that into an error. Asked once: adapters do not come and go,
/// and drivers like to chat on each question.
pub(crate) fn texture_limit() -> Result<u32, DrawError> {
    static LIMIT: OnceLock<Option<u32>> = OnceLock::new();
    LIMIT.get_or_init(probe).ok_or(DrawError::NoAdapter)
}

fn probe() -> Option<u32> {
    // Through OpenGL the renderer draws nothing but the sky, and says nothing of it.
    let instance = wgpu::Instance::new(wgpu::InstanceDescriptor {
        backends: wgpu::Backends::all() - wgpu::Backends::GL,
        ..wgpu::InstanceDescriptor::new_without_display_handle()
    });
    let request = instance.request_adapter(&wgpu::RequestAdapterOptions::default());
    let adapter = pollster::block_on(request)
        .inspect_err(|error| log::debug!("no graphics adapter: {error}"))
        .ok()?;
    log::debug!("drawing with {}", adapter.get_info().name);
    Some(adapter.limits().max_texture_dimension_2d)
}
