//! The program `frangible`; its code is in the library beside it.

use std::ffi::OsString;
use std::process::ExitCode;

fn main() -> ExitCode {
    #[cfg(feature = "view")]
    frangible_draw::quiet_the_drivers();
    let words: Vec<OsString> = std::env::args_os().collect();
    ExitCode::from(frangible_cli::run(&words))
}
