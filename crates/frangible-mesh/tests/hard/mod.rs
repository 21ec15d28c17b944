//! Surfaces that are hard to fill, and some that nothing can fill.

pub(crate) mod broken;
pub(crate) mod crossing;
pub(crate) mod refused;
pub(crate) mod shapes;
pub(crate) mod sound;

use frangible_mesh::Surface;

/// Result expected of meshing a surface.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Expect {
    /// A body.
    Solid {
        /// Volume from a closed form, to a per cent, m³.
        volume: f64,
        /// True if the triangles close without holes, overlaps, or faces the wrong way round.
        watertight: bool,
    },
    /// An error.
    Refused,
}

/// A surface and what to expect.
#[derive(Clone, Debug)]
pub(crate) struct HardCase {
    pub(crate) name: &'static str,
    pub(crate) surface: Surface,
    pub(crate) expect: Expect,
}

/// A case with one closed surface.
fn closed(name: &'static str, surface: Surface, volume: f64) -> HardCase {
    let watertight = true;
    HardCase {
        name,
        surface,
        expect: Expect::Solid { volume, watertight },
    }
}

/// A case with holes, overlaps or wrong faces.
fn leaky(name: &'static str, surface: Surface, volume: f64) -> HardCase {
    let watertight = false;
    HardCase {
        name,
        surface,
        expect: Expect::Solid { volume, watertight },
    }
}

/// Every case.
pub(crate) fn all() -> Vec<HardCase> {
    [sound::all(), crossing::all(), broken::all(), refused::all()].concat()
}
