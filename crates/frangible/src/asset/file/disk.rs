//! Assets on disk: whole or not at all.

use std::ffi::OsString;
use std::fs::{self, OpenOptions};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU32, Ordering};

use super::{AssetFileError, SaveOptions};
use crate::asset::Asset;

/// Tells apart the temporary files of this process; shows in no result.
static SAVES: AtomicU32 = AtomicU32::new(0);

impl Asset {
    /// Reads a `.frangible` file.
    ///
    /// # Errors
    /// [`AssetFileError::Io`] where the file cannot be read, [`AssetFileError::InFile`] with the error of
    /// [`Asset::from_bytes`] where its content is at fault; both name the path.
    pub fn load(path: impl AsRef<Path>) -> Result<Self, AssetFileError> {
        let path = path.as_ref();
        let bytes = fs::read(path).map_err(|e| io_error(path, &e))?;
        Self::from_bytes(&bytes).map_err(|e| in_file(path, e))
    }

    /// Writes a `.frangible` file: to a temporary file beside it, then renamed, so that nobody ever sees half
    /// of it and a failure leaves what was there.
    ///
    /// # Errors
    /// [`AssetFileError::InFile`] where the asset fails [`Asset::validate`], since it could not be loaded
    /// again; [`AssetFileError::Io`] where it cannot be written; both name the path.
    pub fn save(&self, path: impl AsRef<Path>) -> Result<(), AssetFileError> {
        self.save_with(path, &SaveOptions::default())
    }

    /// Saves the asset as [`Asset::save`] does, in the form that the options ask for.
    ///
    /// # Errors
    /// The errors of [`Asset::save`].
    #[doc(hidden)]
    pub fn save_with(
        &self,
        path: impl AsRef<Path>,
        options: &SaveOptions,
    ) -> Result<(), AssetFileError> {
        let path = path.as_ref();
        self.validate().map_err(|e| in_file(path, e.into()))?;
        let temporary = sibling(path).map_err(|e| io_error(path, &e))?;
        let written = write_new(&temporary, &self.to_bytes_with(options));
        written.map_err(|(e, created)| {
            if created {
                // The first error is the one to tell.
                let _ = fs::remove_file(&temporary);
            }
            io_error(path, &e)
        })?;
        fs::rename(&temporary, path).map_err(|e| {
            let _ = fs::remove_file(&temporary);
            io_error(path, &e)
        })
    }
}

/// Writes a new file. An error comes with true if there is now a file to remove.
fn write_new(path: &Path, bytes: &[u8]) -> Result<(), (io::Error, bool)> {
    // Never through a file, or a link, that somebody else put there.
    let mut options = OpenOptions::new();
    let file = options.write(true).create_new(true).open(path);
    let mut file = file.map_err(|e| (e, false))?;
    let written = file.write_all(bytes).and_then(|()| file.sync_all());
    written.map_err(|e| (e, true))
}

fn sibling(path: &Path) -> io::Result<PathBuf> {
    let name = path.file_name().ok_or_else(|| {
        io::Error::new(io::ErrorKind::InvalidInput, "the path does not name a file")
    })?;
    let mut temporary = OsString::from(".");
    temporary.push(name);
    let count = SAVES.fetch_add(1, Ordering::Relaxed);
    temporary.push(format!(".{}-{count}.part", std::process::id()));
    Ok(path.with_file_name(temporary))
}

fn io_error(path: &Path, error: &io::Error) -> AssetFileError {
    AssetFileError::Io {
        path: path.to_owned(),
        problem: error.to_string(),
    }
}

fn in_file(path: &Path, problem: AssetFileError) -> AssetFileError {
    AssetFileError::InFile {
        path: path.to_owned(),
        problem: Box::new(problem),
    }
}
