//! Messages on the program's standard output.

use std::io::{self, ErrorKind, Write};

/// Writes text; a reader that has seen enough (`frangible scenes | head`) is no error.
pub(crate) fn say(text: &str) -> io::Result<()> {
    let mut out = io::stdout().lock();
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        Err(error) if error.kind() == ErrorKind::BrokenPipe => Ok(()),
        result => result,
    }
}
