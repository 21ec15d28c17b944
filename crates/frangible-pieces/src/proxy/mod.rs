//! Modal proxies: the modes of the stored shape that a piece resembles most, scaled to it `[G12 §7.3.2]`.
//!
//! Frequencies of bodies of one shape go as √(E/ρ) / size, shapes as 1/√mass (the size's powers of
//! [`Asset::scaled`](frangible::Asset::scaled)). A proxy of other proportions is stretched along its principal axes to the
//! piece's; its frequencies take the mean factor, so they are rough there.

mod library;
mod shape;

use std::sync::Arc;

use frangible::asset::{AnalysisMesh, EmbeddedPoint};
use frangible::glam::{DMat3, DVec3, Vec3};
use frangible::modal::ModalBasis;
use frangible::piece::{Elastic, Portion};

use crate::PieceError;
pub use library::ProxyLibrary;
use library::{Proxy, Stature};

impl ProxyLibrary {
    /// The modes of the stored shape that the piece resembles most, scaled to it. Supports are not held.
    ///
    /// # Errors
    /// A piece without volume.
    pub fn fitted(&self, portion: &Arc<Portion>) -> Result<Elastic, PieceError> {
        let solid = portion.solid();
        let stature = Stature::of(&solid.positions, &solid.tets)?;
        let (proxy, flip) = self.closest(&stature);
        let fit = Fit::new(proxy, &stature, flip);
        let material = &portion.root().material;
        let stiffness = material.youngs_modulus / material.density;
        let size = fit.stretch.element_product().cbrt();
        let amplitude = 1.0 / portion.mass().mass.sqrt();
        let count = proxy.eigenvalues.len();
        let shapes = proxy.shapes.chunks_exact(3 * count).flat_map(|rows| {
            let turned = (0..count).map(|i| {
                let phi = DVec3::new(rows[i], rows[count + i], rows[2 * count + i]);
                fit.rotation * phi * amplitude
            });
            let turned: Vec<DVec3> = turned.collect();
            (0..3).flat_map(move |axis| turned.clone().into_iter().map(move |v| v[axis] as f32))
        });
        let shapes = shapes.collect();
        let positions = &portion.root().fracture.positions;
        let centroids = portion.tets().iter();
        let centroids = centroids.map(|&e| portion.root().fracture.centroid(e as usize));
        let nodes = portion.nodes().iter().map(|&v| positions[v as usize]);
        Ok(Elastic {
            tets: centroids.map(|p| fit.embed(p)).collect(),
            nodes: nodes.map(|p| fit.embed(p)).collect(),
            analysis: fit.analysis(),
            modes: ModalBasis {
                eigenvalues: proxy
                    .eigenvalues
                    .iter()
                    .map(|l| l * stiffness / (size * size))
                    .collect(),
                shapes,
                peak_stress: Vec::new(),
                ..ModalBasis::default()
            },
        })
    }
}

/// A proxy laid over a piece.
struct Fit<'a> {
    proxy: &'a Proxy,
    centre: DVec3,
    /// From the proxy's principal axes to the piece's frame.
    rotation: DMat3,
    /// Of the proxy along its principal axes.
    stretch: DVec3,
}

impl<'a> Fit<'a> {
    fn new(proxy: &'a Proxy, stature: &Stature, flip: DVec3) -> Self {
        let axes = stature.axes * DMat3::from_diagonal(flip);
        Self {
            proxy,
            centre: stature.centre,
            rotation: axes,
            stretch: stature.extents / proxy.stature.extents,
        }
    }

    fn to_piece(&self, p: DVec3) -> DVec3 {
        self.centre + self.rotation * (self.stretch * p)
    }

    fn to_proxy(&self, p: DVec3) -> DVec3 {
        self.rotation.transpose() * (p - self.centre) / self.stretch
    }

    /// Where a point of the piece lies in the proxy; one outside at the nearest place of its surface.
    fn embed(&self, p: Vec3) -> EmbeddedPoint {
        let (element, barycentric) = self.proxy.locate(self.to_proxy(p.as_dvec3()));
        EmbeddedPoint {
            element,
            barycentric,
            offset: Vec3::ZERO,
        }
    }

    fn analysis(&self) -> AnalysisMesh {
        let nodes = self.proxy.mesh.positions.iter();
        let mesh = frangible_bake::fem::QuadraticMesh {
            positions: nodes.map(|&p| self.to_piece(p)).collect(),
            elements: self.proxy.mesh.elements.clone(),
        };
        mesh.stored()
    }
}
