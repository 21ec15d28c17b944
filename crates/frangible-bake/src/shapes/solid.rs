//! General solids: mesh files and signed distance functions.

use std::fmt;
use std::ops::ControlFlow;
use std::sync::Arc;

use frangible::internals::TetMesh;
use frangible_mesh::{
    Resolution, Solid, TetOptions, TetReport, VolumeAim, counted_volume, tetrahedralize_watched,
};

use crate::clusters::cluster;
use crate::error::{BakeError, positive};
use crate::mesh::BodyMesh;
use crate::shapes::MeshSize;

/// Collision cells of a body of any shape.
pub(crate) const CELLS: usize = 64;

/// Tetrahedra per lattice cube of body: twelve inside, a few more at the surface.
const TETS_PER_CUBE: f64 = 12.6;

/// Tetrahedra of the wine glass.
const WINE_GLASS: usize = 150_000;

/// Elements that carry the modes of a body with thin walls: at 3 000, a drinking glass is up to 6 % too stiff in its
/// first twenty modes, at 6 000 up to 2.5 %.
pub(crate) const SHELL_ELEMENTS: f64 = 5000.0;

/// A wall above this share of the cube root of the volume is no thin one: a ball is 1.2 of it thick, a cube 1.
const THICK: f64 = 0.5;

/// A solid, with settings for meshing it with tetrahedra.
#[derive(Clone)]
pub struct SolidShape {
    /// The solid, m.
    pub solid: Arc<dyn Solid>,
    /// Thickness of the thinnest walls, m, if the solid has thin walls; the fracture mesh resolves it.
    pub wall: Option<f64>,
    /// Requested number of tetrahedra of the fracture mesh; thin walls may need more.
    pub tets: usize,
    /// Largest number of tetrahedra of the fracture mesh; an error if walls need more.
    pub most: usize,
    /// Volume that the tetrahedra are given, by default what the lattice has of the solid.
    pub volume: VolumeAim,
}

impl SolidShape {
    /// Creates the settings for a solid without thin walls: about 42 000 and at most 250 000 tetrahedra.
    #[must_use]
    pub fn new(solid: Arc<dyn Solid>) -> Self {
        Self {
            solid,
            wall: None,
            tets: super::FRACTURE_TETS as usize,
            most: 250_000,
            volume: VolumeAim::Lattice,
        }
    }
}

/// A ready solid; the thickness of its walls was measured on it.
pub(crate) fn ready(name: &str) -> Option<SolidShape> {
    let solid = Arc::new(frangible_mesh::ready_shape(name)?);
    let wall = match name {
        "piggy_bank" => Some(0.0063),
        "statuette" => Some(0.0059),
        "coffee_cup" => Some(0.005),
        "hammer_head" => Some(0.005),
        "chandelier" | "candelabrum" => Some(0.01),
        "coral" => Some(0.0107),
        _ => None,
    };
    let mut shape = SolidShape {
        wall,
        ..SolidShape::new(solid)
    };
    // One and a half across a wall of 2 mm, or it falls apart.
    if name == "wine_glass" {
        shape.tets = WINE_GLASS;
    }
    Some(shape)
}

/// Elements of the lattice that carries the modes.
pub(crate) fn elements(shape: &SolidShape, size: Option<MeshSize>, volume: f64) -> usize {
    let elements = match (size, shape.wall) {
        (Some(size), _) => estimate(volume, size),
        (None, Some(wall)) if wall < THICK * volume.cbrt() => SHELL_ELEMENTS,
        (None, _) => super::ANALYSIS_TETS,
    };
    elements as usize
}

/// Two are equal if they are one and the same solid, since solids cannot be compared.
impl PartialEq for SolidShape {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.solid, &other.solid)
            && (self.wall, self.tets, self.most) == (other.wall, other.tets, other.most)
            && self.volume == other.volume
    }
}

impl fmt::Debug for SolidShape {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("SolidShape")
            .field("bounds", &self.solid.bounds())
            .field("wall", &self.wall)
            .field("tets", &self.tets)
            .field("most", &self.most)
            .field("volume", &self.volume)
            .finish()
    }
}

/// Volume as counted on a grid of a 128th of the longest side, m³.
pub(crate) fn volume(shape: &SolidShape) -> Result<f64, BakeError> {
    let [low, high] = shape.solid.bounds();
    let longest = (high - low).max_element();
    positive("the longest side of the solid, in m,", longest)?;
    let volume = counted_volume(shape.solid.as_ref(), longest / 128.0);
    positive("the volume of the solid, in m³,", volume)?;
    Ok(volume)
}

/// Tetrahedra that a lattice of cubes of side `size.edge` gives.
pub(crate) fn estimate(volume: f64, size: MeshSize) -> f64 {
    TETS_PER_CUBE * volume / size.edge.powi(3)
}

/// Lattice for about `tets` tetrahedra.
pub(crate) fn size_for(volume: f64, tets: f64) -> MeshSize {
    MeshSize {
        edge: (TETS_PER_CUBE * volume / tets).cbrt(),
        layers: 0,
    }
}

/// Told, does nothing.
pub(crate) fn unwatched(_: f64) -> ControlFlow<()> {
    ControlFlow::Continue(())
}

/// Tetrahedra, irregular for a seed; `cell` overrides the wanted number by the side of the lattice's cubes, m. `watch` is
/// told the share done.
pub(crate) fn mesh(
    shape: &SolidShape,
    cell: Option<f64>,
    seed: Option<u64>,
    watch: &mut dyn FnMut(f64) -> ControlFlow<()>,
) -> Result<(BodyMesh, TetReport), BakeError> {
    let mut options = TetOptions::default();
    options.resolution = cell.map_or(Resolution::Tets(shape.tets), Resolution::Cell);
    options.most = shape.most;
    options.wall = shape.wall;
    options.irregular = seed;
    options.volume = shape.volume;
    let (body, report) = tetrahedralize_watched(shape.solid.as_ref(), &options, watch)?;
    let mesh = TetMesh::new(
        body.positions.iter().map(|p| p.as_vec3()).collect(),
        body.tets.clone(),
    );
    let (cell_of_tet, cells) = cluster(&mesh, CELLS);
    let mesh = BodyMesh {
        positions: body.positions,
        tets: body.tets,
        cell_of_tet,
        cells,
    };
    Ok((mesh.finish()?, report))
}
