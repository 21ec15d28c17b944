//! Bodies for the tests.
#![allow(unreachable_pub, dead_code)]

use std::sync::Arc;

use frangible::internals::modal::ModalBasis;
use frangible::internals::{Elastic, Portion};
use frangible::{Body, Breakable, FractureConfig, Material};
use frangible_bake::{BakeSpec, MeshSize, Shape, bake};

/// A baked shape of about so many fracture tetrahedra.
pub fn breakable(shape: Shape, material: &str, tets: f64, modes: usize) -> Breakable {
    let fracture: MeshSize = shape.size_for(tets).expect("a size");
    let spec = BakeSpec {
        modes,
        fracture: Some(fracture),
        ..BakeSpec::new("body", shape, Material::preset(material).expect("a preset"))
    };
    let (asset, _) = bake(&spec, &mut |_| {}).expect("a baked body");
    Breakable::new(Arc::new(asset)).expect("a sound asset")
}

/// All of a body as a portion.
pub fn whole(body: &Body) -> Arc<Portion> {
    let config = FractureConfig::default();
    Arc::new(Portion::of_cracked(body, &config).expect("a sound configuration"))
}

/// The modes of an elastic body.
pub fn modes(elastic: &Elastic) -> &ModalBasis {
    &elastic.modes
}

/// The first five frequencies, Hz.
pub fn frequencies(modes: &ModalBasis) -> Vec<f64> {
    (0..5).map(|i| modes.frequency(i)).collect()
}
