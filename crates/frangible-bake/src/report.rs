//! Progress and report of a bake.

use std::fmt;

use frangible::glam::DVec3;
use frangible_mesh::TetReport;

use crate::mesh::BodyMesh;
use crate::phase::Phase;

/// Stages of a bake, in order.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Stage {
    /// Generating the two meshes.
    Mesh,
    /// Assembling stiffness and mass.
    Assemble,
    /// Computing the vibration modes, which takes nearly all of the time.
    Modes,
    /// Locating the fracture mesh in the analysis mesh.
    Embed,
    /// Computing normals, curvature and convex cells.
    Surface,
    /// Measuring thickness, curvature and edges of thin walls.
    Walls,
    /// Computing the peak stress of each mode.
    Stress,
    /// Determining the number of modes that are integrated through time.
    Followed,
}

impl fmt::Display for Stage {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Mesh => "meshing",
            Self::Assemble => "assembling",
            Self::Modes => "finding modes",
            Self::Embed => "embedding",
            Self::Surface => "surface",
            Self::Walls => "walls",
            Self::Stress => "peak stresses",
            Self::Followed => "modes to follow",
        })
    }
}

/// Progress of a bake.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Progress {
    /// The current stage.
    pub stage: Stage,
    /// Completed share of the stage, 0..=1.
    pub fraction: f64,
}

/// Statistics of a mesh.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MeshReport {
    /// Number of nodes, mid-edge nodes included.
    pub nodes: usize,
    /// Number of tetrahedra.
    pub tets: usize,
    /// Volume, m³.
    pub volume: f64,
    /// Smallest dihedral angle, degrees.
    pub min_dihedral: f64,
}

impl MeshReport {
    pub(crate) fn of(mesh: &BodyMesh) -> Self {
        Self {
            nodes: mesh.positions.len(),
            tets: mesh.tets.len(),
            volume: mesh.volume(),
            min_dihedral: mesh.min_dihedral(),
        }
    }
}

/// Statistics of a bake.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct BakeReport {
    /// The analysis mesh.
    pub analysis: MeshReport,
    /// The fracture mesh.
    pub fracture: MeshReport,
    /// Report of filling a solid with tetrahedra; `None` for boxes, bodies of revolution and thin walls.
    pub tetrahedra: Option<TetReport>,
    /// Unknowns of the eigenvalue problem.
    pub unknowns: usize,
    /// Number of rigid-body modes left by the supports: six for a free body, none for a clamped one.
    pub rigid_motions: usize,
    /// The first ten natural frequencies, Hz.
    pub frequencies: Vec<f64>,
    /// Number of modes stored in the asset.
    pub modes: usize,
    /// Number of the lowest modes that are integrated through time during a blow; the others respond statically.
    pub followed: usize,
    /// Largest relative residual ‖Kφ − λMφ‖ / ‖Kφ‖ of all modes.
    pub max_residual: f64,
    /// Number of convex cells.
    pub cells: usize,
    /// Mass, kg.
    pub mass: f64,
    /// Volume inside the closed surface from which the body was made, or of the wall along a sheet, m³, if it is known. The fracture mesh has
    /// it, unless the mesher could not move its surface that far.
    pub closed_volume: Option<f64>,
    /// Centre of mass in the frame of the shape, m: the origin of the body frame.
    pub centre: DVec3,
    /// Wall-clock time of each stage, s.
    pub seconds: Vec<(Stage, f64)>,
    /// Wall-clock time of each phase of [`Stage::Modes`], s.
    pub mode_seconds: Vec<(Phase, f64)>,
}
