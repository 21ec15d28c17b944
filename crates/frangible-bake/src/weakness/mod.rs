//! Weak places of a body: zones, scored lines and paint, made into [`Fields`] of strength, toughness and weak points.
//!
//! Nothing of it is baked: the same asset serves scored and plain bodies, see
//! [`Breakable::with_fields`](frangible::Breakable::with_fields).

mod paint;
mod zone;

use frangible::glam::Vec3;
use frangible::internals::{Factors, Fields};
use frangible::{Asset, InputError};

pub use paint::{Channel, Paint, from_paint};
pub use zone::{Patch, Zone};

/// Fields painted by patches, one over the other: a factor of a later patch replaces those below.
///
/// A tetrahedron belongs to a patch when its centre does; a scored line needs a radius of about the fracture mesh's
/// edge to hang together.
///
/// # Errors
/// A zone with a number that is not finite, a radius that is not above zero, or a normal without direction.
pub fn from_patches(asset: &Asset, patches: &[Patch]) -> Result<Fields, InputError> {
    patched(Fields::default(), asset, patches)
}

/// Fields with patches over those given, see [`from_patches`].
///
/// # Errors
/// Errors of [`from_patches`].
pub fn patched(mut fields: Fields, asset: &Asset, patches: &[Patch]) -> Result<Fields, InputError> {
    patches.iter().try_for_each(|p| p.zone.check())?;
    if patches.is_empty() {
        return Ok(fields);
    }
    fields
        .of_tet
        .resize(asset.fracture.tets.len(), Factors::ONE);
    for (tet, factors) in fields.of_tet.iter_mut().enumerate() {
        let p = asset.fracture.centroid(tet);
        let over = patches.iter().filter(|patch| patch.zone.contains(p));
        over.for_each(|patch| patch.paint(factors));
    }
    Ok(fields)
}

/// Fields painted on the vertices of a surface (m, body frame): each tetrahedron takes the paint of the nearest point of it.
/// `factors` gives the factors that the colour, or other value, of a vertex stands for, by the vertex's number.
///
/// # Errors
/// Errors of [`Fields::from_surface`].
pub fn from_vertices(
    asset: &Asset,
    positions: &[Vec3],
    triangles: &[[u32; 3]],
    factors: impl Fn(usize) -> Factors,
) -> Result<Fields, InputError> {
    Fields::from_surface(asset, positions, triangles, |at| {
        let mut mean = Factors {
            strength: 0.0,
            toughness: 0.0,
            weak_points: 0.0,
        };
        for (v, w) in at {
            let of_vertex = factors(v);
            mean.strength += w * of_vertex.strength;
            mean.toughness += w * of_vertex.toughness;
            mean.weak_points += w * of_vertex.weak_points;
        }
        mean
    })
}
