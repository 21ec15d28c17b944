//! Where the stress of a weak tetrahedron is taken, and by which law.

use super::{Law, Skin, Wall};
use crate::asset::{Asset, EmbeddedPoint};
use crate::config::FractureConfig;

/// The wall that fracture tetrahedron `e` is part of, where the configuration knows walls.
pub(crate) fn wall_of(
    asset: &Asset,
    skin: &Skin,
    config: &FractureConfig,
    e: usize,
) -> Option<Wall> {
    if config.plane_stress_walls {
        skin.wall(asset, e)
    } else {
        None
    }
}

/// Where a crack may start in a fracture tetrahedron, and the law of the stress there.
pub(crate) struct WeakPlace<'a> {
    pub(crate) point: &'a EmbeddedPoint,
    pub(crate) law: Law,
    /// Whether it is its flaw on the free surface, else it is its centroid.
    pub(crate) on_surface: bool,
    /// The wall that it is in.
    pub(crate) wall: Option<Wall>,
}

/// The place of fracture tetrahedron `e`: at its flaw on the free surface, else at its centroid.
///
/// Under a contact the surface is pressed together, which no mode resolves: there the centroid serves.
#[inline(always)]
pub(crate) fn weak_place<'a>(
    asset: &'a Asset,
    skin: &'a Skin,
    config: &FractureConfig,
    pressed: &[u32],
    e: usize,
) -> WeakPlace<'a> {
    let wall = wall_of(asset, skin, config, e);
    let flaw = skin.flaw(asset.place(e)).filter(|_| config.surface_flaws);
    let (point, law, on_surface) = match flaw.filter(|flaw| !pressed.contains(&flaw.triangle)) {
        Some(flaw) => match wall.and_then(|wall| wall.edge(flaw.normal)) {
            Some(along) => (&flaw.point, Law::Edge(along), true),
            None => (&flaw.point, Law::Free(flaw.normal), true),
        },
        None => {
            let law = wall.map_or(Law::Solid, |wall| Law::Free(wall.normal));
            (asset.embedded_tet(e), law, false)
        }
    };
    WeakPlace {
        point,
        law,
        on_surface,
        wall,
    }
}
