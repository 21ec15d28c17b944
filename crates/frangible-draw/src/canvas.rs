//! The renderer for a canvas of a web page.

use std::sync::Arc;
use std::sync::atomic::{AtomicU32, Ordering};

use kiss3d::context::Context;
use kiss3d::window::{CanvasSetup, NumSamples, Window};
use wasm_bindgen::JsCast;

use crate::DrawError;

/// Complaints of the driver that are written down; more say nothing new.
const MOST_COMPLAINTS: u32 = 20;

/// Opens a window in the canvas with this identifier, drawn with WebGPU or else WebGL 2. `smooth` turns on antialiasing, which takes most of the
/// time of a software renderer.
///
/// # Errors
/// An unknown canvas, or neither WebGPU nor WebGL 2.
pub async fn open_canvas(id: &str, smooth: bool) -> Result<Window, DrawError> {
    let document = web_sys::window().and_then(|window| window.document());
    let canvas = document.and_then(|document| document.get_element_by_id(id));
    let canvas: web_sys::HtmlCanvasElement = canvas
        .and_then(|element| element.dyn_into().ok())
        .ok_or(DrawError::NoAdapter)?;
    let descriptor = wgpu::InstanceDescriptor::new_without_display_handle();
    let instance = wgpu::util::new_instance_with_webgpu_detection(descriptor).await;
    let surface = instance
        .create_surface(wgpu::SurfaceTarget::Canvas(canvas))
        .map_err(|_| DrawError::NoAdapter)?;
    let adapter = instance
        .request_adapter(&wgpu::RequestAdapterOptions {
            compatible_surface: Some(&surface),
            ..wgpu::RequestAdapterOptions::default()
        })
        .await
        .map_err(|_| DrawError::NoAdapter)?;
    let (device, queue) = adapter
        .request_device(&wgpu::DeviceDescriptor {
            label: Some("page"),
            required_limits: adapter.limits(),
            ..wgpu::DeviceDescriptor::default()
        })
        .await
        .map_err(|_| DrawError::NoAdapter)?;
    note_complaints(&device);
    // Gamma is corrected in the shaders.
    let formats = surface.get_capabilities(&adapter).formats;
    let format = formats.iter().find(|format| !format.is_srgb());
    let format = *format.or(formats.first()).ok_or(DrawError::NoAdapter)?;
    Context::init(instance, device, queue, adapter, format);
    let setup = CanvasSetup {
        samples: match smooth {
            true => NumSamples::Four,
            false => NumSamples::One,
        },
        canvas_id: id.into(),
        ..CanvasSetup::default()
    };
    // The canvas has a size of its own.
    let window = Window::new_with_setup("Frangible", 1280, 800, setup).await;
    // The window has a surface of its own, of the same canvas.
    drop(surface);
    Ok(window)
}

/// Logs complaints instead of ending the program: through WebGL 2 the renderer prepares points and wireframes, which need storage buffers, even if
/// they are not drawn.
fn note_complaints(device: &wgpu::Device) {
    let count = AtomicU32::new(0);
    device.on_uncaptured_error(Arc::new(move |error: wgpu::Error| {
        if count.fetch_add(1, Ordering::Relaxed) < MOST_COMPLAINTS {
            log::warn!("{error}");
        }
    }));
}
