//! Mesh files: the calls into the mesher.

use std::path::Path;

use frangible_bake::{ImportOptions, import_mesh};
use frangible_mesh::{InputMesh, RepairReport};

use super::Opened;
use crate::error::SceneError;

/// A mesh in metres, y up, as a shape with a fracture mesh of about `tets` tetrahedra: the solid that it encloses, or a wall of this
/// thickness, m, along it.
pub(super) fn shape(
    mesh: &InputMesh,
    path: &Path,
    tets: Option<usize>,
    wall: Option<f64>,
) -> Result<Opened, SceneError> {
    let mut options = ImportOptions::default();
    options.tets = tets.unwrap_or(options.tets);
    options.wall = wall;
    let imported = import_mesh(mesh, &options).map_err(|error| SceneError::File {
        path: path.to_path_buf(),
        problem: error.to_string(),
    })?;
    let mut notes = Vec::new();
    // Welding is no news: every STL has its corners doubled, and every mesh with a texture its seams.
    let mended = RepairReport {
        welded: 0,
        ..imported.mended
    };
    let mended = mended.to_string();
    if !mended.is_empty() {
        notes.push(format!("{}: {mended}", path.display()));
    }
    Ok(Opened::Shape {
        shape: imported.shape,
        render: imported.render.map(Box::new),
        groups: imported.groups,
        notes,
        open: wall.is_none() && imported.mended.open_shells > 0,
    })
}
