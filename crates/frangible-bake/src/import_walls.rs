//! Import of thin walls, which are meshed in layers along one of their faces.

use frangible_mesh::{RepairReport, Surface, Thickness, Wall};

use crate::error::BakeError;
use crate::shapes::{Shape, WallShape};

/// An open surface that faces one way by more than this is a sheet: half a sphere has 0.5, half a tube 0.64, a flat sheet 1.
const SHEET: f64 = 0.6;

/// A wall whose mesh has another volume than its surface by more than this share is left to the lattice.
const VOLUME_OFF: f64 = 0.01;

/// Refuses an open sheet, which encloses nothing.
pub(crate) fn sheet(surface: &Surface, mended: &RepairReport) -> Result<(), BakeError> {
    let is_sheet = mended.open_shells == mended.shells && surface.facing() > SHEET;
    if is_sheet {
        return Err(BakeError::OpenSheet);
    }
    Ok(())
}

/// Thickness, area and volume of a wall of this thickness, m, along a surface.
pub(crate) fn measures(wall: Option<&Wall>, thickness: f64) -> Thickness {
    let (area, volume) = wall.map_or((0.0, 0.0), |wall| (wall.area(), wall.volume()));
    Thickness {
        thinnest: thickness,
        median: thickness,
        area: 2.0 * area,
        volume,
    }
}

/// The wall as a shape of about so many tetrahedra if it can be meshed in layers.
pub(crate) fn layered(wall: Wall, tets: usize) -> Option<Shape> {
    let shape = Shape::Wall(WallShape {
        tets,
        ..WallShape::new(wall)
    });
    let size = shape.size_for(tets as f64).ok()?;
    let mesh = shape.fracture_mesh(size, 1).ok()?;
    let volume = shape.volume().ok()?;
    ((mesh.volume() / volume - 1.0).abs() < VOLUME_OFF).then_some(shape)
}
