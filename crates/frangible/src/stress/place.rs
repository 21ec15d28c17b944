//! Place at which the stress of a weak tetrahedron is taken, and the law there.

use std::sync::Arc;

use glam::Vec3;

use super::{Law, Skin, Wall};
use crate::asset::{Asset, EmbeddedPoint};
use crate::config::FractureConfig;
use crate::rng::{Purpose, stream, uniform};

/// Places of a body's flaws on their faces, drawn by its seed. If they were at the middle of each face, or at any other place that is the same for
/// all bodies, the first cracks about a contact would start at the few places nearest to it, and run in the directions in which the mesh has these.
#[derive(Clone, Debug)]
pub(crate) struct Places {
    /// Weights of the second and the third corner of the face of each fracture tetrahedron.
    of_tet: Arc<[[f32; 2]]>,
}

impl Places {
    /// Weights of the corners of a face at its middle.
    pub(crate) const MIDDLE: [f32; 3] = [1.0 / 3.0; 3];

    /// Places in so many fracture tetrahedra: drawn in weak ones, the middles of the faces in the others.
    pub(crate) fn new(tets: usize, weak_tets: &[u32], seed: u64) -> Self {
        let mut of_tet = vec![[Self::MIDDLE[0]; 2]; tets];
        let mut rng = stream(seed, Purpose::Places, 0);
        for &e in weak_tets {
            let [a, b] = [uniform(&mut rng), uniform(&mut rng)].map(|x| x as f32);
            // The half of a square beyond its diagonal is turned onto the other one.
            let inside = a + b <= 1.0;
            of_tet[e as usize] = if inside { [a, b] } else { [1.0 - a, 1.0 - b] };
        }
        Self {
            of_tet: of_tet.into(),
        }
    }

    /// Weights of the corners of the face of a fracture tetrahedron.
    #[inline(always)]
    pub(crate) fn weights(&self, e: usize) -> [f32; 3] {
        let [a, b] = self.of_tet[e];
        [1.0 - a - b, a, b]
    }
}

/// The wall that fracture tetrahedron `e` is part of, where the configuration knows walls.
pub(crate) fn wall_of(
    asset: &Asset,
    skin: &Skin,
    config: &FractureConfig,
    e: usize,
) -> Option<Wall> {
    match config.is_paper() {
        true => None,
        false => skin.wall(asset, e),
    }
}

/// Place at which a crack may start in a fracture tetrahedron, and the law of the stress there.
pub(crate) struct WeakPlace {
    pub(crate) point: EmbeddedPoint,
    pub(crate) law: Law,
    /// Position of the flaw on the free surface, m, if the place is one; else it is the centroid.
    pub(crate) flaw: Option<Vec3>,
    /// The wall that it is in.
    pub(crate) wall: Option<Wall>,
}

/// The place of fracture tetrahedron `e`: at its flaw on the free surface, else at its centroid.
///
/// Under a contact the surface is pressed together, which no mode resolves: there the centroid serves.
#[inline(always)]
pub(crate) fn weak_place(
    asset: &Asset,
    skin: &Skin,
    places: &Places,
    config: &FractureConfig,
    pressed: &[u32],
    e: usize,
) -> WeakPlace {
    let wall = wall_of(asset, skin, config, e);
    let flaw = skin.flaw(asset.place(e)).filter(|_| !config.is_paper());
    match flaw.filter(|flaw| !pressed.contains(&flaw.triangle)) {
        Some(flaw) => {
            let (place, point) = Skin::on_face(asset, flaw, places.weights(e));
            let edge = wall.and_then(|wall| wall.edge(flaw.normal));
            WeakPlace {
                point,
                law: edge.map_or(Law::Free(flaw.normal), Law::Edge),
                flaw: Some(place),
                wall,
            }
        }
        None => {
            let film = wall.and_then(|wall| skin.beside_film(asset, e, &wall));
            let normal = film.map(|(_, normal)| normal);
            WeakPlace {
                point: *asset.embedded_tet(e),
                law: wall.map_or(Law::Solid, |wall| Law::Free(normal.unwrap_or(wall.normal))),
                flaw: film.map(|(place, _)| place),
                wall,
            }
        }
    }
}
