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
    /// Meshing the shape, twice.
    Mesh,
    /// Assembling stiffness and mass.
    Assemble,
    /// Finding the vibration modes; nearly all of the time.
    Modes,
    /// Locating the fracture mesh in the analysis mesh.
    Embed,
    /// Normals, curvature, convex cells.
    Surface,
    /// Thickness, curvature and edges of thin walls.
    Walls,
    /// Peak stress of each mode.
    Stress,
    /// Finding the number of modes that a blow follows.
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
    /// The stage that runs.
    pub stage: Stage,
    /// Share of the stage that is done, 0..=1.
    pub fraction: f64,
}

/// Figures of one mesh.
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

/// Figures of a bake.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct BakeReport {
    /// The mesh that carries the modes.
    pub analysis: MeshReport,
    /// The mesh that carries cracks.
    pub fracture: MeshReport,
    /// Report of filling a solid with tetrahedra; `None` for shapes that are meshed by a rule.
    pub tetrahedra: Option<TetReport>,
    /// Unknowns of the eigenvalue problem.
    pub unknowns: usize,
    /// Rigid motions that the supports leave: six of a free body, none of a clamped one.
    pub rigid_motions: usize,
    /// The first ten natural frequencies, Hz.
    pub frequencies: Vec<f64>,
    /// Modes that the asset keeps.
    pub modes: usize,
    /// Number of the lowest modes that a blow follows through time; the others answer statically.
    pub followed: usize,
    /// Largest relative residual ‖Kφ − λMφ‖ / ‖Kφ‖ of all modes.
    pub max_residual: f64,
    /// Number of convex cells.
    pub cells: usize,
    /// Mass, kg.
    pub mass: f64,
    /// Centre of mass in the frame of the shape, m: the origin of the body frame.
    pub centre: DVec3,
    /// Wall-clock time of each stage, s.
    pub seconds: Vec<(Stage, f64)>,
    /// Wall-clock time of each phase of [`Stage::Modes`], s.
    pub mode_seconds: Vec<(Phase, f64)>,
}
