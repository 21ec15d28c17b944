//! Quadratic elements for the modal analysis: a conforming mesh of the shape, or a lattice that covers it.

use frangible::glam::DVec3;
use frangible::internals::asset::{AnalysisMesh, Embedding};

use crate::eigen::Constraints;
use crate::embed::Locator;
use crate::error::BakeError;
use crate::fem::{
    Cover, Elasticity, Elements, MID_EDGES, QuadraticMesh, System, assemble,
    assemble_supported_cover,
};
use crate::mesh::BodyMesh;
use crate::report::MeshReport;
use crate::supports::Holder;

/// Message about a support that the elements cannot see.
const TOO_SMALL: &str = "contains only a part of the body smaller than an element of the analysis mesh; enlarge its region or refine the analysis mesh";

/// Elements that carry the modes.
pub(crate) enum Analysis {
    /// Elements that conform to the boundary, for parametric shapes.
    Conforming(QuadraticMesh, MeshReport),
    /// Elements of a covering lattice, integrated over the body only, for any solid, even with thin walls.
    Covering(Cover),
    /// Linear elements of the body's own mesh, stored as quadratic elements with linear displacements.
    Linear(QuadraticMesh, MeshReport),
}

impl Analysis {
    /// Quadratic elements on a coarse mesh of the body.
    pub(crate) fn conforming(coarse: &BodyMesh) -> Self {
        let mesh = QuadraticMesh::new(coarse);
        let report = MeshReport {
            nodes: mesh.positions.len(),
            ..MeshReport::of(coarse)
        };
        Self::Conforming(mesh, report)
    }

    /// Linear elements on the fine mesh itself.
    pub(crate) fn linear(fine: &BodyMesh) -> Self {
        Self::Linear(QuadraticMesh::new(fine), MeshReport::of(fine))
    }

    /// About `elements` elements over the fine mesh of the body.
    pub(crate) fn covering(fine: &BodyMesh, elements: usize) -> Result<Self, BakeError> {
        Ok(Self::Covering(Cover::new(fine, elements)?))
    }

    fn mesh(&self) -> &QuadraticMesh {
        match self {
            Self::Conforming(mesh, _) | Self::Linear(mesh, _) => mesh,
            Self::Covering(cover) => &cover.mesh,
        }
    }

    /// Figures of the elements; the volume of a covering mesh is that of the body it is integrated over.
    pub(crate) fn report(&self, fine: &BodyMesh) -> MeshReport {
        match self {
            Self::Conforming(_, report) | Self::Linear(_, report) => *report,
            Self::Covering(cover) => MeshReport {
                nodes: cover.mesh.positions.len(),
                tets: cover.mesh.elements.len(),
                volume: fine.volume(),
                // The angle of every tetrahedron of a body-centred cubic lattice.
                min_dihedral: 60.0,
            },
        }
    }

    /// Assembles stiffness, mass and constraints. `held`: axes of each node of the fine mesh, or nothing.
    ///
    /// Nodes of a conforming mesh are on the body: those within a support's region are held. Those of a lattice are
    /// not: there springs hold the nodes of the fine mesh.
    ///
    /// # Errors
    /// A support that holds no node of the conforming mesh, or supports that hold all of them.
    pub(crate) fn assemble(
        &self,
        material: &Elasticity,
        fine: &BodyMesh,
        held: &[[bool; 3]],
        holder: &Holder<'_>,
    ) -> Result<(System, Constraints), BakeError> {
        match self {
            Self::Conforming(mesh, _) => {
                let elements = Elements::Quadratic(&mesh.elements);
                let system = assemble(&mesh.positions, elements, material);
                let held = holder.axes(&mesh.positions, &mesh.elements, TOO_SMALL)?;
                let constraints = Constraints::of_nodes(&mesh.positions, &held);
                Ok((system, constraints))
            }
            Self::Linear(..) => {
                let elements = Elements::Linear(&fine.tets);
                let system = assemble(&fine.positions, elements, material);
                let constraints = Constraints::of_nodes(&fine.positions, held);
                Ok((system, constraints))
            }
            Self::Covering(cover) => Ok((
                assemble_supported_cover(cover, material, fine, held),
                Constraints::of_places(&fine.positions, held),
            )),
        }
    }

    /// Locates the fine mesh in the elements.
    ///
    /// # Errors
    /// [`BakeError::OutsideAnalysisMesh`] for a conforming mesh that is too coarse.
    pub(crate) fn embed(&self, fine: &BodyMesh) -> Result<Embedding, BakeError> {
        match self {
            Self::Conforming(mesh, _) | Self::Linear(mesh, _) => {
                let locator = Locator::new(mesh);
                let centroids =
                    (0..fine.tets.len()).map(|e| fine.corners(e).iter().sum::<DVec3>() / 4.0);
                Ok(Embedding {
                    tets: centroids
                        .map(|p| locator.embed(p))
                        .collect::<Result<_, _>>()?,
                    nodes: fine
                        .positions
                        .iter()
                        .map(|&p| locator.embed(p))
                        .collect::<Result<_, _>>()?,
                })
            }
            Self::Covering(cover) => Ok(cover.embedding(fine)),
        }
    }

    /// Mode shapes of the unknowns, row by row → of the stored nodes. A linear element's middles move as the mean of
    /// their ends: then the quadratic element's displacements are the linear ones.
    pub(crate) fn shapes(&self, mut rows: Vec<f32>, modes: usize) -> Vec<f32> {
        let Self::Linear(mesh, _) = self else {
            return rows;
        };
        rows.resize(3 * mesh.positions.len() * modes, 0.0);
        for element in &mesh.elements {
            for (k, [i, j]) in MID_EDGES.into_iter().enumerate() {
                let [middle, i, j] =
                    [element[4 + k], element[i], element[j]].map(|node| 3 * modes * node as usize);
                for row in 0..3 * modes {
                    rows[middle + row] = 0.5 * (rows[i + row] + rows[j + row]);
                }
            }
        }
        rows
    }

    /// The mesh in the form that an asset stores.
    pub(crate) fn stored(&self) -> AnalysisMesh {
        self.mesh().stored()
    }
}
