//! Small baked bodies: those that the core's own tests break, and smaller ones for many inputs.

use std::sync::{Arc, OnceLock};

use frangible::glam::DVec3;
use frangible::{Asset, Breakable, Material};
use frangible_bake::{BakeSpec, Region, Shape, Support, bake};

/// Number of bodies.
pub(crate) const COUNT: usize = 3;

/// A pane, a block and a held shelf.
pub(crate) fn assets() -> &'static [Arc<Asset>; COUNT] {
    static ASSETS: OnceLock<[Arc<Asset>; COUNT]> = OnceLock::new();
    ASSETS.get_or_init(|| {
        [
            &include_bytes!("../../../crates/frangible/tests/bodies/pane.frangible")[..],
            include_bytes!("../../../crates/frangible/tests/bodies/block.frangible"),
            include_bytes!("../../../crates/frangible/tests/bodies/shelf.frangible"),
        ]
        .map(|bytes| Arc::new(Asset::from_bytes(bytes).expect("a body that this build can read")))
    })
}

/// Bodies that a target breaks.
pub(crate) type Kinds = [Breakable; COUNT];

/// The assets, made ready to be broken.
pub(crate) fn kinds() -> &'static Kinds {
    static KINDS: OnceLock<Kinds> = OnceLock::new();
    KINDS.get_or_init(|| {
        let kind = |asset: &Arc<Asset>| Breakable::new(Arc::clone(asset)).expect("a sound body");
        assets().each_ref().map(kind)
    })
}

/// Kinds of body with some 200 tetrahedra and 12 modes, baked once at the start: a blow takes a fraction of the time that it takes on those of [`kinds`].
pub(crate) fn small_kinds() -> &'static Kinds {
    static KINDS: OnceLock<Kinds> = OnceLock::new();
    KINDS.get_or_init(|| {
        let held = Region::Box {
            low: DVec3::splat(-1.0),
            high: DVec3::new(0.02, 1.0, 1.0),
        };
        let recipes = [
            ("glass", Shape::plate(0.2, 0.2, 0.004), Vec::new()),
            ("brick", Shape::block([0.21, 0.1, 0.05]), Vec::new()),
            (
                "glass",
                Shape::block([0.3, 0.04, 0.01]),
                vec![Support::clamped(held)],
            ),
        ];
        recipes.map(|(material, shape, supports)| {
            let material = Material::preset(material).expect("a preset");
            let spec = BakeSpec {
                modes: 12,
                analysis: shape.size_for(20.0).ok(),
                fracture: shape.size_for(200.0).ok(),
                supports,
                ..BakeSpec::new("small", shape, material)
            };
            let asset = bake(&spec).expect("a body");
            Breakable::new(asset).expect("a sound body")
        })
    })
}
