//! Thin walls from files: layers of prisms between their two faces, cut into tetrahedra.
//!
//! The mesh that cracks cut has as many layers as make the height and the length of its elements most alike, one for most walls.
//! Quadratic elements represent bending exactly through the thickness, so one layer carries the modes. Curved walls get more of these, so
//! that the middle of an element lies little beside the wall.

use std::fmt;
use std::sync::Arc;

use frangible::internals::TetMesh;
use frangible_mesh::Wall;

use crate::clusters::cluster;
use crate::error::BakeError;
use crate::extrude::extrude;
use crate::mesh::BodyMesh;
use crate::random;
use crate::shapes::MeshSize;
use crate::shapes::solid::{CELLS, SHELL_ELEMENTS};
use crate::sheet::Sheet;

/// Area of an equilateral triangle of edge 1, with a correction: the mesher's triangles are a little smaller.
const TRIANGLE: f64 = 0.412;
/// Tetrahedra of a prism.
const TETS: f64 = 3.0;
/// Distance of the middle of an analysis element from the curved wall, in thicknesses: as in a drinking glass of the built-in shapes.
const BESIDE: f64 = 0.1;
/// Most elements that carry the modes of a curved wall.
const MOST_ELEMENTS: f64 = 10_000.0;
/// Seed of the analysis mesh: an irregular mesh is as stiff in every direction.
const ANALYSIS_SEED: u64 = 0;
/// A coarse mesh whose columns cross on a tight bend is refined up to this often.
const REFINEMENTS: usize = 3;
/// Largest move of nodes between two layers, in heights of a layer.
const SHAKE: f64 = 0.2;

/// A thin wall, meshed along its faces.
#[derive(Clone)]
pub struct WallShape {
    /// The wall, m.
    pub wall: Arc<Wall>,
    /// Requested number of tetrahedra of the fracture mesh.
    pub tets: usize,
}

impl WallShape {
    /// Creates a wall with a fracture mesh of about 42 000 tetrahedra.
    #[must_use]
    pub fn new(wall: Wall) -> Self {
        Self {
            wall: Arc::new(wall),
            tets: super::FRACTURE_TETS as usize,
        }
    }

    /// Returns the number of layers of elements of this size.
    #[must_use]
    pub fn layers(&self, size: MeshSize) -> usize {
        match size.layers {
            0 => ((self.wall.thickness() / size.edge).round() as usize).max(1),
            layers => layers,
        }
    }
}

/// Two are equal if they are one and the same wall: comparing large meshes takes as long as reading them.
impl PartialEq for WallShape {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.wall, &other.wall) && self.tets == other.tets
    }
}

impl fmt::Debug for WallShape {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("WallShape")
            .field("thickness", &self.wall.thickness())
            .field("area", &self.wall.area())
            .field("tets", &self.tets)
            .finish()
    }
}

/// Estimated tetrahedra of elements of this size.
pub(crate) fn estimate(shape: &WallShape, size: MeshSize) -> f64 {
    let triangles = shape.wall.area() / (TRIANGLE * size.edge * size.edge);
    TETS * triangles * shape.layers(size) as f64
}

/// Elements for about `tets` tetrahedra: as many layers as make their height and their edges most alike.
pub(crate) fn size_for(shape: &WallShape, tets: f64) -> MeshSize {
    let size = |layers: usize| MeshSize {
        edge: (TETS * layers as f64 * shape.wall.area() / (TRIANGLE * tets)).sqrt(),
        layers,
    };
    // How many times an element is higher than long, or longer than high.
    let uneven = |size: MeshSize| {
        let height = shape.wall.thickness() / size.layers as f64;
        (height / size.edge).ln().abs()
    };
    let mut best = size(1);
    while uneven(size(best.layers + 1)) < uneven(best) {
        best = size(best.layers + 1);
    }
    best
}

/// Elements for the modes: about 5 000, more where the wall bends.
pub(crate) fn analysis_size(shape: &WallShape) -> MeshSize {
    let edge_for = |elements: f64| (TETS * shape.wall.area() / (TRIANGLE * elements)).sqrt();
    // The middle of a chord of length l lies l² / 8R beside the arc.
    let bent = (8.0 * BESIDE * shape.wall.thickness() / shape.wall.bending()).sqrt();
    MeshSize {
        edge: edge_for(SHELL_ELEMENTS).min(bent.max(edge_for(MOST_ELEMENTS))),
        layers: 1,
    }
}

/// The mesh that carries the modes; `None` if the wall bends too sharply for large elements.
pub(crate) fn analysis_mesh(
    shape: &WallShape,
    mut size: MeshSize,
) -> Result<Option<BodyMesh>, BakeError> {
    for _ in 0..=REFINEMENTS {
        match mesh(shape, size, ANALYSIS_SEED) {
            Err(BakeError::Fold { .. }) => size.edge *= 0.75,
            mesh => return mesh.map(Some),
        }
    }
    Ok(None)
}

/// Irregular layers of tetrahedra.
///
/// # Errors
/// [`BakeError::Fold`] where the wall bends too sharply.
pub(crate) fn mesh(shape: &WallShape, size: MeshSize, seed: u64) -> Result<BodyMesh, BakeError> {
    let wall = shape.wall.mesh(size.edge, Some(seed));
    let wall = wall.ok_or(BakeError::Fold {
        thickness: shape.wall.thickness(),
        edge: size.edge,
    })?;
    let layers = shape.layers(size);
    let sheet = Sheet {
        coords: vec![[0.0; 2]; wall.columns.len()],
        triangles: wall.triangles,
        ..Sheet::default()
    };
    let position = |v: usize, layer: usize| {
        let [back, front] = wall.columns[v];
        let lot = if layer > 0 && layer < layers {
            SHAKE * random::symmetric(seed ^ 0x5eed, (v * (layers + 1) + layer) as u64)
        } else {
            0.0
        };
        back.lerp(front, (layer as f64 + lot) / layers as f64)
    };
    let mut mesh = extrude(&sheet, layers, Some(seed), &position, &|_, _| 0)?;
    let clustered = TetMesh::new(
        mesh.positions.iter().map(|p| p.as_vec3()).collect(),
        mesh.tets.clone(),
    );
    (mesh.cell_of_tet, mesh.cells) = cluster(&clustered, CELLS);
    Ok(mesh)
}
