//! Baked bodies on disk: the calls into the core's file format.

use std::path::Path;

use frangible::Asset;

use crate::error::SceneError;

/// Reads a baked body.
pub(super) fn load(path: &Path) -> Result<Asset, SceneError> {
    Ok(Asset::load(path)?)
}

/// Writes a baked body; the file is whole or absent.
///
/// # Errors
/// What the system said.
pub fn save_asset(asset: &Asset, path: &Path) -> Result<(), SceneError> {
    Ok(asset.save(path)?)
}
