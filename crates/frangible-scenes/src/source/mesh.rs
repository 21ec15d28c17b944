//! Mesh files: the calls into the reader and the mesher.

use std::path::Path;

use frangible_bake::{MeshSize, Shape};
use frangible_mesh::InputMesh;

use crate::error::SceneError;

/// Triangles of a mesh file, in its own unit and axes.
pub(super) fn read(_path: &Path) -> Result<InputMesh, SceneError> {
    Err(SceneError::NotBuilt("bodies from mesh files"))
}

/// Shape of a mesh in metres, y up.
pub(super) fn shape(_mesh: &InputMesh) -> Result<Shape, SceneError> {
    Err(SceneError::NotBuilt("bodies from mesh files"))
}

/// Elements that give about `tets` tetrahedra: as many fit in as the cube of the edge leaves room for.
pub(super) fn fracture_size(shape: &Shape, tets: usize) -> Result<MeshSize, SceneError> {
    const DEFAULT_TETS: f64 = 42_000.0;
    let mut size = shape.fracture_size()?;
    size.edge *= (DEFAULT_TETS / tets as f64).cbrt();
    Ok(size)
}
