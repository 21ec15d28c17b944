//! Is there anything to draw with?

use crate::DrawError;

/// Whether a graphics adapter, in hardware or in software, is there to draw with.
#[must_use]
pub fn has_adapter() -> bool {
    texture_limit().is_ok()
}

/// The longest side of a picture that the adapter can hold, pixels.
///
/// The renderer panics where it finds no adapter; asking in the same words
/// beforehand turns that into an error.
pub(crate) fn texture_limit() -> Result<u32, DrawError> {
    let instance = wgpu::Instance::new(wgpu::InstanceDescriptor {
        backends: wgpu::Backends::all(),
        ..wgpu::InstanceDescriptor::new_without_display_handle()
    });
    let request = instance.request_adapter(&wgpu::RequestAdapterOptions::default());
    let adapter = pollster::block_on(request).map_err(|error| {
        log::debug!("no graphics adapter: {error}");
        DrawError::NoAdapter
    })?;
    log::debug!("drawing with {}", adapter.get_info().name);
    Ok(adapter.limits().max_texture_dimension_2d)
}
