//! The sheet as its author drew it, to which moved vertices return.

use glam::DVec3;

use crate::surface::Surface;
use crate::winding::{MeshSolid, SolidError};

/// The original triangles of a sheet.
pub(crate) struct Reference(MeshSolid);

impl Reference {
    /// Builds the search tree.
    ///
    /// # Errors
    /// [`SolidError`] for triangles without area or with invalid coordinates.
    pub(crate) fn new(surface: &Surface) -> Result<Self, SolidError> {
        MeshSolid::skin(surface).map(Self)
    }

    /// The closest place of the sheet if it is no farther than `within`, m, else the point itself.
    pub(crate) fn closest(&self, p: DVec3, within: f64) -> DVec3 {
        self.0.nearest(p, within).map_or(p, |found| found.position)
    }
}
