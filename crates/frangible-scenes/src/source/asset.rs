//! Baked bodies on disk: the calls into the core's file format.

use std::path::Path;

use frangible::Asset;

use crate::error::SceneError;

/// Reads a baked body.
pub(super) fn load(_path: &Path) -> Result<Asset, SceneError> {
    Err(SceneError::NotBuilt("files of baked bodies"))
}

/// Writes a baked body; the file is whole or absent.
///
/// # Errors
/// What the system said.
pub fn save_asset(_asset: &Asset, _path: &Path) -> Result<(), SceneError> {
    Err(SceneError::NotBuilt("files of baked bodies"))
}
