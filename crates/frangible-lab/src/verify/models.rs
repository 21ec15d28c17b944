//! Finite-element models of shapes, and their modes, for all cases.

use std::ops::ControlFlow;
use std::sync::Arc;

use frangible::Material;
use frangible::glam::DVec3;
use frangible_bake::eigen::{Constraints, Modes, lowest_supported_modes};
use frangible_bake::fem::{
    Cover, Elasticity, Elements, QuadraticMesh, System, assemble, assemble_cover,
};
use frangible_bake::frangible_mesh::DistanceSolid;
use frangible_bake::{BakeError, BakeSpec, MeshSize, Shape, SolidShape};

/// Soda-lime glass.
pub(crate) const GLASS: Elasticity = Elasticity {
    youngs_modulus: 70e9,
    poisson_ratio: 0.23,
    density: 2500.0,
};

/// Glass's stiffness with the ν = 0.3 of the tables.
pub(crate) const TABLES: Elasticity = Elasticity {
    poisson_ratio: 0.3,
    ..GLASS
};

/// Ten-node tetrahedra of a shape.
pub(crate) fn quadratic_mesh(
    shape: &Shape,
    edge: f64,
    layers: usize,
) -> Result<QuadraticMesh, BakeError> {
    Ok(QuadraticMesh::new(
        &shape.analysis_mesh(MeshSize { edge, layers })?,
    ))
}

/// A free shape in quadratic elements (T10).
pub(crate) fn quadratic(
    shape: &Shape,
    edge: f64,
    layers: usize,
    material: &Elasticity,
) -> Result<System, BakeError> {
    let mesh = quadratic_mesh(shape, edge, layers)?;
    Ok(assemble(
        &mesh.positions,
        Elements::Quadratic(&mesh.elements),
        material,
    ))
}

/// A free shape in linear elements (T4).
pub(crate) fn linear(
    shape: &Shape,
    edge: f64,
    layers: usize,
    material: &Elasticity,
) -> Result<System, BakeError> {
    let mesh = shape.analysis_mesh(MeshSize { edge, layers })?;
    Ok(assemble(
        &mesh.positions,
        Elements::Linear(&mesh.tets),
        material,
    ))
}

/// A shape meshed with this edge, carried by a lattice of about `elements` quadratic elements.
pub(crate) fn covered(
    shape: &Shape,
    edge: f64,
    elements: usize,
    material: &Elasticity,
) -> Result<System, BakeError> {
    let body = shape.analysis_mesh(MeshSize { edge, layers: 0 })?;
    Ok(assemble_cover(&Cover::new(&body, elements)?, material))
}

/// The lowest modes of a free body.
pub(crate) fn free_modes(system: &System, wanted: usize) -> Result<Modes, BakeError> {
    modes(system, &Constraints::default(), wanted)
}

/// The lowest modes of a body, held or free.
pub(crate) fn modes(
    system: &System,
    held: &Constraints,
    wanted: usize,
) -> Result<Modes, BakeError> {
    lowest_supported_modes(system, held, wanted, &mut |_| ControlFlow::Continue(()))
}

/// Settings for baking a ball: about 12 000 tetrahedra, 10 modes, carried by elements of this edge or the default.
pub(crate) fn ball(radius: f64, elasticity: &Elasticity, edge: Option<f64>) -> BakeSpec {
    // Damping, strength and so on do not matter to any case, but must be there.
    let mut material = Material::preset("glass").expect("glass is a preset");
    material.youngs_modulus = elasticity.youngs_modulus;
    material.poisson_ratio = elasticity.poisson_ratio;
    material.density = elasticity.density;
    let shape = SolidShape {
        tets: 12_000,
        ..SolidShape::new(Arc::new(DistanceSolid::sphere(DVec3::ZERO, radius)))
    };
    let mut spec = BakeSpec::new("ball", Shape::Solid(shape), material);
    spec.modes = 10;
    spec.analysis = edge.map(|edge| MeshSize { edge, layers: 0 });
    spec
}

pub(crate) fn norm(x: &[f64]) -> f64 {
    x.iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// The root of `f` between `low` and `high`, where it has opposite signs.
pub(crate) fn root(f: impl Fn(f64) -> f64, mut low: f64, mut high: f64) -> f64 {
    let rising = f(high) > 0.0;
    // 60 halvings leave nothing but rounding.
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if (f(middle) > 0.0) == rising {
            high = middle;
        } else {
            low = middle;
        }
    }
    0.5 * (low + high)
}
