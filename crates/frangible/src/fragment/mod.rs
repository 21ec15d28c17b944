//! Fragments: labels of nodes, exact partition of tetrahedra, closed surfaces and masses `[G12 §6]`.

mod apart;
mod breakup;
mod build;
mod components;
mod draft;
mod draw;
mod film;
mod finish;
mod foreign;
mod fractured;
mod junction;
mod label;
mod partition;
mod points;
mod volumes;

#[cfg(test)]
mod draw_tests;
#[cfg(test)]
mod junction_tests;
#[cfg(test)]
mod label_tests;
#[cfg(test)]
mod tests;

pub(crate) use breakup::Breakup;
pub(crate) use build::{Built, build};
pub(crate) use draw::draw;
pub use film::FilmBond;
pub(crate) use film::film_of;
pub use foreign::{CutEdge, interfaces_of_labels, pieces_of_cuts};
pub(crate) use label::{Labels, label};
pub(crate) use partition::{Point, face_parts, interfaces};
pub(crate) use points::PointTable;
pub(crate) use volumes::Volumes;

use glam::{DVec3, Vec3};

use crate::mesh::{MassProperties, RenderMesh, TriMesh};

/// One piece of a broken body.
#[derive(Clone, Debug)]
pub struct Fragment {
    /// Closed surface, m, in the **fragment frame**: origin at the piece's centre of mass, axes of the parent's body frame.
    pub mesh: TriMesh,
    /// For each crack face, `mesh.triangles[outer_triangles..]`, the index in [`Fracture::fragments`](crate::Fracture::fragments) of the fragment
    /// on its other side, which has the same face reversed; [`Fragment::PARTED`] for a face of an earlier break.
    pub neighbours: Vec<u32>,
    /// Surface to draw instead of `mesh`, if the asset has an [authored surface](crate::Asset::render).
    pub render: Option<RenderMesh>,
    /// Mass properties; `centre` is in the **parent's body frame**.
    pub mass: MassProperties,
    /// The parts of the parent's convex cells that belong to this piece: cell number and corner points, m, fragment frame.
    pub cell_shares: Vec<(u32, Vec<Vec3>)>,
    /// True if it has one of the [supported nodes](crate::Asset::supported) and so stays fixed.
    pub supported: bool,
    /// Velocity of its centre of mass relative to the rigid motion of the whole body after the blow, m/s, body frame of the parent. Zero for all
    /// fragments if no piece separated during the blow.
    pub velocity: DVec3,
    /// Angular velocity relative to that motion, rad/s.
    pub angular_velocity: DVec3,
}

impl Fragment {
    /// Entry of [`Fragment::neighbours`] for a crack face of an earlier break.
    pub const PARTED: u32 = u32::MAX;
}
