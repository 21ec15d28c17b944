//! The window on a desktop.

use std::panic::{self, AssertUnwindSafe};
use std::path::PathBuf;

use frangible_draw::kiss3d::window::{CanvasSetup, NumSamples, Window};
use frangible_draw::{DrawError, has_adapter, is_software};

use crate::command::Command;
use crate::error::ViewError;
use crate::script::Script;
use crate::worker::Worker;

use super::Viewer;
use super::director::Director;
use super::panels::Panels;
use super::shade::Shade;
#[cfg(feature = "sound")]
use super::speaker;

/// Options of the window.
#[derive(Clone, Debug)]
pub struct WindowOptions {
    /// Command that loads the first scene.
    pub first: Command,
    /// Commands to give instead of a person's; the clock stands then, and the window closes at the end.
    pub script: Option<Script>,
    /// Folder for files saved with keys and buttons.
    pub folder: PathBuf,
    /// Width and height, pixels.
    pub size: [u32; 2],
}

/// Opens the window and stays until it is closed.
///
/// # Errors
/// No display or no graphics driver; in a script, the first command that failed.
pub fn run(options: WindowOptions) -> Result<(), ViewError> {
    let display = |name| std::env::var_os(name).is_some_and(|value| !value.is_empty());
    if cfg!(target_os = "linux") && !display("DISPLAY") && !display("WAYLAND_DISPLAY") {
        return Err(ViewError::NoDisplay);
    }
    // The adapter is asked for afterwards: on the way to it some drivers visit the display, and one without other guests
    // may be shut for a moment when they leave.
    let mut window = match open(options.size) {
        Ok(window) => window,
        Err(_) if !has_adapter() => return Err(DrawError::NoAdapter.into()),
        Err(error) => return Err(error),
    };
    if is_software() {
        // Smooth edges take such a driver most of the time.
        window.set_samples(NumSamples::One);
    }
    let mut viewer = viewer(options);
    let result = pollster::block_on(viewer.live(&mut window));
    // The contents of the stage belong to the window.
    drop(viewer);
    drop(window);
    result
}

/// The window system's refusals are panics; they are turned into an error, and not printed as well.
fn open([width, height]: [u32; 2]) -> Result<Window, ViewError> {
    let setup = CanvasSetup {
        samples: NumSamples::Four,
        ..CanvasSetup::default()
    };
    let open = || pollster::block_on(Window::new_with_setup("Frangible", width, height, setup));
    let hook = panic::take_hook();
    panic::set_hook(Box::new(|_| {}));
    let opened = panic::catch_unwind(AssertUnwindSafe(open));
    panic::set_hook(hook);
    opened.map_err(|payload| {
        let text = payload.downcast_ref::<String>().cloned();
        let text = text.or_else(|| payload.downcast_ref::<&str>().map(ToString::to_string));
        ViewError::Window(text.unwrap_or_default())
    })
}

fn viewer(options: WindowOptions) -> Viewer {
    let scripted = options.script.is_some();
    #[cfg(feature = "sound")]
    let (opened, why) = match (!scripted).then(speaker::open) {
        Some(Ok((speaker, outlet))) => (Some((speaker, outlet)), None),
        Some(Err(why)) => (None, Some(why)),
        None => (None, None),
    };
    #[cfg(feature = "sound")]
    let outlet = opened.as_ref().map(|(_, outlet)| outlet.clone());
    #[cfg(not(feature = "sound"))]
    let outlet = None;
    let mut worker = Worker::start(!scripted, outlet);
    if options.script.is_none() {
        worker.send(options.first);
    }
    let panels = Panels::new(options.folder, scripted);
    let director = Director::new(options.script);
    let mut viewer = Viewer::of(worker, panels, director, Shade::start(false));
    viewer.hurries = scripted;
    #[cfg(feature = "sound")]
    {
        viewer._speaker = opened.map(|(speaker, _)| speaker);
        if let Some(why) = why {
            viewer.panels.tell(format!("no sound: {why}"));
        }
    }
    viewer
}
