//! The program `frangible`; what it does is in the library beside it.

use std::ffi::OsString;
use std::process::ExitCode;

/// Begins anew with `XDG_RUNTIME_DIR` set, where it is not: the graphics drivers' library for Wayland complains four times of its
/// absence before anything else is said. A folder that does not exist will do, since there is no Wayland then.
#[cfg(all(feature = "draw", target_os = "linux"))]
fn quiet_the_drivers() {
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

fn main() -> ExitCode {
    #[cfg(all(feature = "draw", target_os = "linux"))]
    quiet_the_drivers();
    let words: Vec<OsString> = std::env::args_os().collect();
    ExitCode::from(frangible_cli::run(&words))
}
