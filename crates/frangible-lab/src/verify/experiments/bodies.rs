//! The bodies that the experiments break.

use std::sync::Arc;

use frangible::internals::Fields;
use frangible::{Breakable, Material};
use frangible_bake::{BakeSpec, MeshSize, Region, Shape, Support, bake};

use crate::verify::VerifyError;

/// A preset has this name, or an error says that it is missing.
pub(crate) fn preset(name: &'static str) -> Result<Material, VerifyError> {
    Material::preset(name).map_err(|source| VerifyError::Material { name, source })
}

/// A square plate of this side and thickness, m, clamped on its four sides.
pub(crate) fn clamped(
    side: f64,
    thickness: f64,
    material: Material,
    [analysis, fracture]: [f64; 2],
    modes: usize,
) -> BakeSpec {
    let sides = [0, 1].into_iter().flat_map(|axis| {
        [Region::below(axis, 0.0), Region::above(axis, side)].map(Support::clamped)
    });
    let size = |edge, layers| Some(MeshSize { edge, layers });
    BakeSpec {
        analysis: size(analysis, 1),
        fracture: size(fracture, 0),
        modes,
        supports: sides.collect(),
        ..BakeSpec::new("plate", Shape::plate(side, side, thickness), material)
    }
}

/// The bake makes a body of the specification, and its weak points get the scatter of its material.
pub(crate) fn breakable(case: &'static str, spec: &BakeSpec) -> Result<Breakable, VerifyError> {
    let asset = bake(spec).map_err(|source| VerifyError::Bake { case, source })?;
    let fields = Fields::of_material(asset.material());
    Breakable::new(Arc::new(asset))
        .and_then(|body| body.with_fields(fields))
        .map_err(|source| VerifyError::Impact { case, source })
}
