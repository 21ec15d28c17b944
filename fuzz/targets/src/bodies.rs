//! Small baked bodies, those that the core's own tests break.

use std::sync::{Arc, OnceLock};

use frangible::{Asset, Breakable};

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

/// The assets, made ready to be broken.
pub(crate) fn kinds() -> &'static [Breakable; COUNT] {
    static KINDS: OnceLock<[Breakable; COUNT]> = OnceLock::new();
    KINDS.get_or_init(|| {
        let kind = |asset: &Arc<Asset>| Breakable::new(Arc::clone(asset)).expect("a sound body");
        assets().each_ref().map(kind)
    })
}
