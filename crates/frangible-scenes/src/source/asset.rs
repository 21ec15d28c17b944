//! Baked bodies on disk: the calls into the core's file format.

use std::path::Path;

use frangible::Asset;
use frangible::internals::asset::SaveOptions;

use crate::error::SceneError;

/// Writes a baked body; the file is whole or absent.
///
/// # Errors
/// The reason that the system gave.
pub fn save_asset(asset: &Asset, path: &Path) -> Result<(), SceneError> {
    Ok(asset.save(path)?)
}

/// Writes a baked body with mode shapes in half precision, see [`compacted`]; the file is whole or absent.
///
/// # Errors
/// The reason that the system gave.
pub fn save_compact_asset(asset: &Asset, path: &Path) -> Result<(), SceneError> {
    Ok(asset.save_with(path, &SaveOptions::compact())?)
}

/// The asset with mode shapes rounded to half precision and the peak stresses that follow, and the largest relative change of a
/// mode's peak stress.
#[must_use]
pub fn compacted(asset: &Asset) -> (Asset, f64) {
    let compact = asset.clone().with_compact_shapes().restressed();
    let stresses = compact.modes().peak_stress.iter();
    let change = stresses
        .zip(&asset.modes().peak_stress)
        .map(|(&new, &old)| (f64::from(new) / f64::from(old) - 1.0).abs())
        .fold(0.0, f64::max);
    (compact, change)
}
