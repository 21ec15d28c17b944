//! A truth that shares nothing with the pieces' own: the closed surface of a fragment, meshed anew and baked.

use std::sync::Arc;

use frangible_bake::frangible_mesh::{MeshSolid, Surface};
use frangible_bake::{BakeSpec, Shape, SolidShape, bake};

use super::choose::{Broken, Chosen};
use super::measure::{FREQUENCIES, PieceSample};

/// Tetrahedra and elements of the new meshes.
const TETS: usize = 20_000;

/// A fragment baked from its surface.
#[derive(Clone, Debug)]
pub struct Rebaked {
    /// Name of the body that it comes from.
    pub name: String,
    /// Its uncut tetrahedra.
    pub tets: usize,
    /// Volume of the new mesh over that of the fragment.
    pub volume: f64,
    /// First frequencies of the full analysis over those of the bake.
    pub frequencies: Vec<f64>,
}

/// Bakes a free fragment; none where the mesher refuses its rough surface.
pub(crate) fn rebake(broken: &Broken, chosen: &Chosen, sample: &PieceSample) -> Option<Rebaked> {
    if sample.held {
        return None;
    }
    let fragment = &broken.fracture.fragments[chosen.fragment];
    let positions = fragment.mesh.positions.iter().map(|p| p.as_dvec3());
    let surface = Surface {
        positions: positions.collect(),
        triangles: fragment.mesh.triangles.clone(),
    };
    let solid = MeshSolid::new(&surface).ok()?;
    let shape = Shape::Solid(SolidShape {
        tets: TETS,
        ..SolidShape::new(Arc::new(solid))
    });
    let spec = BakeSpec {
        modes: FREQUENCIES + 3,
        ..BakeSpec::new("a fragment", shape, broken.body.asset().material().clone())
    };
    let asset = bake(&spec).ok()?;
    let own = sample.truth.frequencies.iter().enumerate();
    Some(Rebaked {
        name: sample.name.clone(),
        tets: sample.tets,
        volume: asset.mass().volume / fragment.mass.volume,
        frequencies: own.map(|(i, f)| f / asset.modes().frequency(i)).collect(),
    })
}
