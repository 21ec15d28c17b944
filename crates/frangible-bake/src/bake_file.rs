//! From a mesh file to assets.

use std::path::Path;

use frangible::Material;
use frangible_mesh::read_mesh;

use crate::bake::{Baked, bake_with};
use crate::error::BakeError;
use crate::import::{ImportOptions, import_parts};
use crate::report::Progress;
use crate::spec::BakeSpec;

/// Reads a mesh file and bakes each of its parts, in the order of the file. An asset has the name of its part, or of the file if that is one
/// part. The body frame of an asset has its origin at [`BakeReport::centre`](crate::BakeReport::centre) in the frame of the file, which places the parts to each other.
///
/// ```no_run
/// use frangible::Material;
/// use frangible_bake::{ImportOptions, bake_file};
///
/// let porcelain = Material::preset("porcelain")?;
/// for part in bake_file("lamp.glb", &porcelain, &ImportOptions::default())? {
///     println!("{}: {:.3} kg, at {}", part.asset.name(), part.report.mass, part.report.centre);
/// }
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// A file that cannot be read, and the errors of [`import_parts`] and [`bake()`](crate::bake()).
pub fn bake_file(
    path: impl AsRef<Path>,
    material: &Material,
    options: &ImportOptions,
) -> Result<Vec<Baked>, BakeError> {
    bake_file_with(path, material, options, |_| {})
}

/// Bakes a file like [`bake_file`], and calls `progress` at every advance of a part.
///
/// # Errors
/// The errors of [`bake_file`].
pub fn bake_file_with(
    path: impl AsRef<Path>,
    material: &Material,
    options: &ImportOptions,
    mut progress: impl FnMut(Progress),
) -> Result<Vec<Baked>, BakeError> {
    let path = path.as_ref();
    let mesh = read_mesh(path).map_err(|error| BakeError::File {
        path: path.to_path_buf(),
        problem: error.to_string(),
    })?;
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    let imported = import_parts(&mesh, options)?;
    let mut baked = Vec::with_capacity(imported.parts.len());
    for part in imported.parts {
        let name = match part.name.is_empty() {
            true => stem.clone().into_owned(),
            false => part.name,
        };
        let spec = BakeSpec {
            groups: part.body.groups,
            render: part.body.render,
            ..BakeSpec::new(name, part.body.shape, material.clone())
        };
        baked.push(bake_with(&spec, &mut progress)?);
    }
    Ok(baked)
}
