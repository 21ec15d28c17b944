//! Detection of the graphics adapter.

use std::sync::OnceLock;

use crate::DrawError;

/// Returns true if there is a hardware or software graphics adapter.
#[must_use]
pub fn has_adapter() -> bool {
    texture_limit().is_ok()
}

/// Returns true if the adapter renders in software on the CPU.
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

/// On Linux, restarts the program with `XDG_RUNTIME_DIR` set if it is not, because the Wayland library of the graphics drivers otherwise prints
/// four warnings. The folder need not exist, since there is no Wayland in that case. Call it first in `main`, because everything before it
/// is executed twice.
pub fn quiet_the_drivers() {
    #[cfg(target_os = "linux")]
    {
        use std::os::unix::process::CommandExt;
        use std::process::Command;

        const NAME: &str = "XDG_RUNTIME_DIR";
        let mut words = std::env::args_os();
        if let (None, Ok(program), Some(own)) = (
            std::env::var_os(NAME),
            std::env::current_exe(),
            words.next(),
        ) {
            let mut anew = Command::new(program);
            anew.arg0(own).args(words).env(NAME, "/nonexistent");
            // Only a failure comes back; then the lines are the lesser evil.
            let _ = anew.exec();
        }
    }
}

/// Properties of the adapter that drawing depends on.
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
