//! Files of tetrahedra: the calls into the reader and the bake.

use std::path::Path;

use frangible_bake::{AnalysisChoice, Shape, import_tets};
use frangible_mesh::TetInput;
use frangible_mesh::glam::DVec3;

use super::fit::{scale, turned};
use super::{Axis, Opened};
use crate::error::SceneError;

/// A body of tetrahedra in metres, y up; the file is read once it is known that nothing else was asked for.
pub(super) fn open(
    read: impl FnOnce() -> Result<TetInput, SceneError>,
    path: &Path,
    size: Option<f64>,
    up: Axis,
    resolution: Option<usize>,
    wall: Option<f64>,
) -> Result<Opened, SceneError> {
    let refused = |problem: String| SceneError::File {
        path: path.to_path_buf(),
        problem,
    };
    if resolution.is_some() {
        let problem = "the resolution cannot be set: the tetrahedra of the file are used unchanged; mesh the body again, or give its surface (.stl, .obj)";
        return Err(refused(problem.into()));
    }
    if wall.is_some() {
        let problem = "a wall thickness cannot be set: the tetrahedra of the file are used unchanged; give the surface of the body (.stl, .obj)";
        return Err(refused(problem.into()));
    }
    let mut input = read()?;
    let scale = scale(input.bounds(), path, size)?;
    for p in &mut input.positions {
        *p = scale * DVec3::from_array(turned(p.to_array(), up));
    }
    let imported = import_tets(&input, None, AnalysisChoice::Auto)
        .map_err(|error| refused(error.to_string()))?;
    let mut notes = Vec::new();
    let mended = imported.mend.to_string();
    if !mended.is_empty() {
        notes.push(format!("{}: {mended}", path.display()));
    }
    if !imported.volumes.is_empty() {
        notes.push(format!(
            "{}: the parts {} get the same material, because a body has only one",
            path.display(),
            imported.volumes.join(", ")
        ));
    }
    let groups = match &imported.shape {
        Shape::Tets(shape) => shape.named_parts(),
        _ => Vec::new(),
    };
    Ok(Opened::Shape {
        shape: imported.shape,
        render: None,
        groups,
        notes,
        open: false,
    })
}
