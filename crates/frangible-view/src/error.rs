//! Errors of the viewer. Each message says how to fix the problem.

use std::path::PathBuf;

use thiserror::Error;

/// Refuses a number outside of its range.
pub(crate) fn within(
    what: &str,
    value: f64,
    [least, most]: [f64; 2],
    unit: &str,
) -> Result<(), ViewError> {
    if (least..=most).contains(&value) {
        return Ok(());
    }
    let gap = if unit.is_empty() { "" } else { " " };
    Err(ViewError::NotNow(format!(
        "{what} is {value}{gap}{unit}; it must be {least} to {most}{gap}{unit}"
    )))
}

/// Error of a command or of the window.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ViewError {
    /// A line that is not a command.
    #[error("`{line}`: {problem}")]
    Command {
        /// The line.
        line: String,
        /// The error in it, and the correct form.
        problem: String,
    },
    /// A line of a script.
    #[error("{} line {line}: {problem}", path.display())]
    Script {
        /// The script.
        path: PathBuf,
        /// Line, from 1.
        line: usize,
        /// The error in it, and the correct form.
        problem: String,
    },
    /// A command that is not possible in the current state.
    #[error("{0}")]
    NotNow(String),
    /// An error of the scene or of a projectile.
    #[error(transparent)]
    Scene(#[from] frangible_scenes::SceneError),
    /// The fracture model rejected its input.
    #[error(transparent)]
    Fracture(#[from] frangible::InputError),
    /// The material is unknown.
    #[error(transparent)]
    Material(#[from] frangible::internals::UnknownMaterial),
    /// The body cannot be changed to the requested material.
    #[error(transparent)]
    Rescale(#[from] frangible_bake::RescaleError),
    /// The sound cannot be computed.
    #[error("the sound stopped: {0}")]
    Sound(#[from] frangible_sound::SoundError),
    /// The recording cannot be exported.
    #[error(transparent)]
    Export(#[from] frangible_export::ExportError),
    /// A file that cannot be written.
    #[error(transparent)]
    Write(#[from] frangible_recording::WriteError),
    /// A file that cannot be read or written.
    #[error("`{}` cannot be {doing}: {source}", path.display())]
    File {
        /// The file.
        path: PathBuf,
        /// The attempted operation: “read” or “written”.
        doing: &'static str,
        /// Error of the system.
        source: std::io::Error,
    },
    /// No display to open a window on.
    #[error(
        "there is no display to open a window on (DISPLAY and WAYLAND_DISPLAY are not set); run this on a desktop, or under `xvfb-run -a`"
    )]
    NoDisplay,
    /// No graphics driver, or one that failed.
    #[cfg(feature = "window")]
    #[error(transparent)]
    Draw(#[from] frangible_draw::DrawError),
    /// A still or a film that could not be made.
    #[cfg(feature = "window")]
    #[error(transparent)]
    Photo(#[from] frangible_photo::PhotoError),
    /// The window could not be opened.
    #[error(
        "the window could not be opened: {0}. Check that DISPLAY is correct and the X11 or Wayland libraries are installed; on Debian: apt-get install libxkbcommon-x11-0 libxcursor1 libxi6 libxrandr2"
    )]
    Window(String),
    /// The simulation thread panicked.
    #[error("the simulation thread panicked; see its message on the error output")]
    Worker,
}

#[cfg(test)]
mod tests {
    use super::within;

    #[test]
    fn a_number_without_a_unit_is_refused_without_a_gap() {
        let refused = |unit| {
            within("the number", 0.0, [1.0, 9.0], unit)
                .unwrap_err()
                .to_string()
        };
        assert_eq!(refused(""), "the number is 0; it must be 1 to 9");
        assert_eq!(refused("s"), "the number is 0 s; it must be 1 to 9 s");
    }
}
