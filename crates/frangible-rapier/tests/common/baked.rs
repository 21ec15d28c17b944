//! Baked glass: what breaks here breaks by its own modes.

use std::sync::{Arc, OnceLock};

use frangible::{Asset, Material};
use frangible_bake::{BakeSpec, Region, Shape, Support, bake};

/// A fracture mesh with edges `coarser` times the default's, and few modes.
fn bake_small(name: &str, shape: Shape, coarser: f64, supports: Vec<Support>) -> Arc<Asset> {
    let mut size = shape.fracture_size().unwrap();
    size.edge *= coarser;
    let spec = BakeSpec {
        modes: 40,
        fracture: Some(size),
        supports,
        ..BakeSpec::new(name, shape, Material::preset("glass").unwrap())
    };
    Arc::new(bake(&spec).unwrap())
}

/// Pane 0.3 × 0.3 m, 4 mm thick, its normal z.
pub(crate) fn pane() -> &'static Arc<Asset> {
    static ASSET: OnceLock<Arc<Asset>> = OnceLock::new();
    ASSET.get_or_init(|| bake_small("pane", Shape::plate(0.3, 0.3, 0.004), 2.4, Vec::new()))
}

/// Block 0.1 × 0.1 × 0.05 m.
pub(crate) fn block() -> &'static Arc<Asset> {
    static ASSET: OnceLock<Arc<Asset>> = OnceLock::new();
    ASSET.get_or_init(|| bake_small("block", Shape::block([0.1, 0.1, 0.05]), 2.4, Vec::new()))
}

/// Bar 0.4 × 0.04 × 0.01 m along x, 2 cm of both ends clamped.
pub(crate) fn shelf() -> &'static Arc<Asset> {
    static ASSET: OnceLock<Arc<Asset>> = OnceLock::new();
    ASSET.get_or_init(|| {
        let low = frangible::glam::DVec3::new(0.0, -1.0, -1.0);
        let ends = [(0.0, 0.02), (0.38, 0.4)].map(|(from, to)| {
            let high = frangible::glam::DVec3::ONE;
            Support::clamped(Region::Box {
                low: low.with_x(from),
                high: high.with_x(to),
            })
        });
        bake_small("shelf", Shape::block([0.4, 0.04, 0.01]), 1.6, ends.into())
    })
}
