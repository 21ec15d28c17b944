//! Atomic writing of files.

use std::ffi::OsString;
use std::fs::{self, File};
use std::io::Write;
use std::path::Path;

use crate::WriteError;

/// Writes a file atomically: its final name never refers to a partial file.
///
/// The bytes are written to `NAME.PROCESS.part` in the same folder, which is then renamed in one file-system operation. On failure that file is
/// removed, and an existing file with the final name is unchanged.
///
/// # Errors
///
/// [`WriteError`] with the path and the system's error.
pub fn write_atomically(path: &Path, bytes: &[u8]) -> Result<(), WriteError> {
    let fail = |source| WriteError {
        path: path.to_path_buf(),
        source,
    };
    let Some(name) = path.file_name() else {
        return Err(fail(std::io::Error::other("the path does not name a file")));
    };
    // The process number keeps two programs that write one file apart.
    let mut sibling_name = OsString::from(name);
    sibling_name.push(format!(".{}.part", std::process::id()));
    let sibling = path.with_file_name(sibling_name);
    let written = write_through(&sibling, bytes).and_then(|()| fs::rename(&sibling, path));
    written.map_err(|source| {
        // The first failure is the one worth reporting.
        let _ = fs::remove_file(&sibling);
        fail(source)
    })
}

fn write_through(path: &Path, bytes: &[u8]) -> std::io::Result<()> {
    let mut file = File::create(path)?;
    file.write_all(bytes)?;
    // Else a power cut after the renaming could leave an empty file.
    file.sync_all()
}
