//! The bodies that the experiments break.

use std::sync::Arc;

use frangible::internals::Fields;
use frangible::{Breakable, Material};
use frangible_bake::{BakeSpec, MeshSize, Region, Shape, Support, bake};

use crate::Result;

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
pub(crate) fn breakable(spec: &BakeSpec) -> Result<Breakable> {
    let asset = bake(spec)?;
    let fields = Fields::of_material(asset.material());
    Ok(Breakable::new(Arc::new(asset))?.with_fields(fields)?)
}
