//! Ready solids by name.

use frangible_bake::{READY_SHAPES, Shape};
use frangible_mesh::did_you_mean;

use crate::error::SceneError;

/// The solid of this name, its fracture mesh of about `resolution` tetrahedra if that is given.
pub(super) fn shape(name: &str, resolution: Option<usize>) -> Result<Shape, SceneError> {
    let mut shape = Shape::ready(name).ok_or_else(|| {
        let hint = did_you_mean(name, READY_SHAPES);
        let known = READY_SHAPES.join(", ");
        SceneError::Clash(format!(
            "there is no ready shape `{name}`{hint}; ready shapes: {known}"
        ))
    })?;
    if let (Shape::Solid(solid), Some(tets)) = (&mut shape, resolution) {
        solid.tets = tets;
        solid.most = solid.most.max(3 * tets);
    }
    Ok(shape)
}
