//! Bodies for the tests, their modes, and how near numbers are.

use std::ops::ControlFlow;
use std::sync::Arc;

use frangible::internals::Portion;
use frangible::internals::modal::ModalBasis;
use frangible::{Body, Breakable, FractureConfig, Material};
use frangible_bake::eigen::{Constraints, Modes, lowest_modes, lowest_supported_modes};
use frangible_bake::fem::System;
use frangible_bake::{BakeSpec, MeshSize, Shape, bake};

/// A baked shape of about this number of fracture tetrahedra.
pub(crate) fn breakable(shape: Shape, material: &str, tets: f64, modes: usize) -> Breakable {
    let fracture: MeshSize = shape.size_for(tets).expect("a size");
    let spec = BakeSpec {
        modes,
        fracture: Some(fracture),
        ..BakeSpec::new("body", shape, Material::preset(material).expect("a preset"))
    };
    let asset = bake(&spec).expect("a baked body");
    Breakable::uniform(Arc::new(asset)).expect("a sound asset")
}

/// All of a body as a portion.
pub(crate) fn whole(body: &Body) -> Arc<Portion> {
    let config = FractureConfig::default();
    Arc::new(Portion::of_cracked(body, &config).expect("a sound configuration"))
}

/// The lowest modes of what nothing holds.
pub(crate) fn free_modes(system: &System, wanted: usize) -> Modes {
    lowest_modes(system, wanted, &mut |_| ControlFlow::Continue(())).unwrap()
}

/// The lowest modes of a held system.
pub(crate) fn held_modes(system: &System, constraints: &Constraints, wanted: usize) -> Modes {
    let progress = &mut |_| ControlFlow::Continue(());
    lowest_supported_modes(system, constraints, wanted, progress).unwrap()
}

/// The first five frequencies, Hz.
pub(crate) fn frequencies(modes: &ModalBasis) -> Vec<f64> {
    (0..5).map(|i| modes.frequency(i)).collect()
}

pub(crate) fn norm(x: &[f64]) -> f64 {
    x.iter().map(|x| x * x).sum::<f64>().sqrt()
}

pub(crate) fn assert_near(value: f64, reference: f64, tolerance: f64, what: &str) {
    assert!(
        (value / reference - 1.0).abs() < tolerance,
        "{what}: {value} is not within {tolerance} of {reference}"
    );
}
