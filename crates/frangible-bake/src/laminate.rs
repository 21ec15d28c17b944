//! Modes of a laminated wall, from those of one plate as thick as it.
//!
//! A mode of the plate is a wave whose number k follows from its frequency, `k⁴ = μ λ/D`. The laminate has the stiffness of
//! [`Material::laminate_bending`] at this k and the same mass: its eigenvalue is λ times the ratio of the stiffnesses. The deflections stay, and the faces
//! move less along the wall, since the films are sheared: then the strain of the outer faces is that of the outer plies. For a plate on simple
//! supports all of this is exact; elsewhere shapes of short waves beside a clamped edge differ.

use std::collections::BTreeMap;

use frangible::InputError;
use frangible::glam::DVec3;
use frangible::internals::asset::SurfaceWalls;

use crate::error::BakeError;
use crate::fem::QuadraticMesh;
use crate::shapes::{MeshSize, PaneShape, Shape};
use crate::spec::BakeSpec;

/// A laminated wall.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Layers {
    /// Thickness of the wall, m.
    wall: f64,
    /// Thickness of a ply, m.
    pub(crate) ply: f64,
    plies: usize,
}

impl Layers {
    /// The plies of a body, if it is to have any.
    ///
    /// # Errors
    /// A body that is not one wall, or plies that do not fit in it.
    pub(crate) fn of(spec: &BakeSpec) -> Result<Option<Self>, BakeError> {
        let Some(laminate) = &spec.material.laminate else {
            return Ok(None);
        };
        let wrong =
            |problem: String| InputError::laminate(&spec.name, &spec.material.name, &problem);
        let wall = match &spec.shape {
            Shape::Box { size } | Shape::Pane(PaneShape { size, .. }) => size[2],
            Shape::Wall(shape) => shape.wall.thickness(),
            _ => {
                return Err(wrong(
                    "it is no wall between two faces; give it the shape of a pane or of a thin wall, or a material of one layer"
                        .into(),
                )
                .into());
            }
        };
        Ok(Some(Self {
            wall,
            ply: laminate.ply_in(wall).map_err(wrong)?,
            plies: laminate.plies as usize,
        }))
    }

    /// Elements for the modes: one layer of them.
    pub(crate) fn analysis(size: MeshSize) -> MeshSize {
        MeshSize { layers: 1, ..size }
    }

    /// Elements for the cracks, as many as those of a size: a layer for each ply, whose films are parts of them.
    pub(crate) fn fracture(&self, size: MeshSize) -> MeshSize {
        let layers = match size.layers {
            0 => (self.wall / size.edge).round().max(1.0),
            layers => layers as f64,
        };
        MeshSize {
            edge: size.edge * (self.plies as f64 / layers).sqrt(),
            layers: self.plies,
        }
    }

    /// Turns modes of the plate, one after the other, into those of the laminate.
    ///
    /// # Errors
    /// A mesh that is not one layer of elements between two faces.
    pub(crate) fn laminate(
        &self,
        spec: &BakeSpec,
        mesh: &QuadraticMesh,
        eigenvalues: &mut [f64],
        shapes: &mut [f64],
    ) -> Result<(), BakeError> {
        let pairs = self.pairs(mesh).ok_or_else(|| InputError::laminate(&spec.name, &spec.material.name, "the mesh that carries its modes is not one layer of elements of even thickness; give it the shape of a pane"))?;
        let material = &spec.material;
        let plate = material.contact_modulus() * self.wall.powi(3) / 12.0;
        let mass = material.density * self.wall;
        let unknowns = 3 * mesh.positions.len();
        for (eigenvalue, shape) in eigenvalues.iter_mut().zip(shapes.chunks_mut(unknowns)) {
            let k = (mass * *eigenvalue / plate).sqrt().sqrt();
            let bending = material.laminate_bending(self.ply, k, true);
            *eigenvalue *= (bending.deflection / self.wall).powi(3);
            for &([low, high], normal) in &pairs {
                let at = |v: usize| DVec3::from_slice(&shape[3 * v..]);
                let half = 0.5 * (at(high) - at(low));
                let along = half - half.dot(normal) * normal;
                let less = (1.0 - bending.face) * along;
                (at(low) + less).write_to_slice(&mut shape[3 * low..]);
                (DVec3::from_slice(&shape[3 * high..]) - less)
                    .write_to_slice(&mut shape[3 * high..]);
            }
        }
        Ok(())
    }

    /// Nodes of the lower face, those opposite them, and the direction from each to the other. Corners of one column follow each other.
    fn pairs(&self, mesh: &QuadraticMesh) -> Option<Vec<([usize; 2], DVec3)>> {
        let mut middles = BTreeMap::new();
        for element in &mesh.elements {
            for (k, [i, j]) in crate::fem::MID_EDGES.into_iter().enumerate() {
                let ends = [element[i].min(element[j]), element[i].max(element[j])];
                middles.insert(ends, element[4 + k]);
            }
        }
        let corners = middles.values().min().map_or(0, |&first| first as usize);
        let mut pairs: Vec<[usize; 2]> = (0..corners / 2).map(|v| [2 * v, 2 * v + 1]).collect();
        for (&[i, j], &low) in &middles {
            if i % 2 == 0
                && j % 2 == 0
                && let Some(&high) = middles.get(&[i + 1, j + 1])
            {
                pairs.push([low as usize, high as usize]);
            }
        }
        let place = |v: usize| mesh.positions[v];
        let pairs = pairs.into_iter().map(|pair @ [low, high]| {
            let across = place(high) - place(low);
            ((across.length() / self.wall - 1.0).abs() < 0.25).then(|| (pair, across.normalize()))
        });
        pairs.collect()
    }

    /// Gives the near field of a contact the ply that it touches: short waves do not go through a film.
    pub(crate) fn thin(&self, walls: &mut SurfaceWalls) {
        for thickness in &mut walls.thickness {
            if thickness.is_finite() {
                *thickness = self.ply as f32;
            }
        }
    }
}
