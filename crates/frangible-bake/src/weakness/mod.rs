//! Local weakness: conversion of zones, scored lines and vertex colours to [`Fields`] of strength, toughness and weak points.
//!
//! Weakness is not baked, so scored and plain bodies share an asset; see
//! [`Breakable::with_fields`](frangible::Breakable::with_fields).

mod paint;
mod zone;

use frangible::glam::Vec3;
use frangible::internals::{Factors, Fields};
use frangible::{Asset, InputError};

pub use paint::{Channel, Paint, from_paint};
pub use zone::{Patch, Zone};

/// Makes fields from patches, with the scatter of the asset's material; where patches overlap, the factor of the later one applies.
///
/// A tetrahedron belongs to a patch if its centre does, so a scored line needs a radius of about the edge length of the fracture mesh to be
/// continuous.
///
/// # Errors
/// A zone has a value that is not finite, a radius that is not positive, or a zero normal.
pub fn from_patches(asset: &Asset, patches: &[Patch]) -> Result<Fields, InputError> {
    patched(Fields::of_material(asset.material()), asset, patches)
}

/// Applies patches to existing fields; see [`from_patches`].
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
        .resize(asset.fracture().tets.len(), Factors::ONE);
    for (tet, factors) in fields.of_tet.iter_mut().enumerate() {
        let p = asset.fracture().centroid(tet);
        let over = patches.iter().filter(|patch| patch.zone.contains(p));
        over.for_each(|patch| patch.paint(factors));
    }
    Ok(fields)
}

/// Makes fields from values at the vertices of a surface (m, body frame): each tetrahedron gets the interpolated factors of the nearest surface
/// point. `factors` returns the factors of a vertex by its index.
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
            groove: 0.0,
        };
        for (v, w) in at {
            let of_vertex = factors(v);
            mean.strength += w * of_vertex.strength;
            mean.toughness += w * of_vertex.toughness;
            mean.weak_points += w * of_vertex.weak_points;
            mean.groove += w * of_vertex.groove;
        }
        mean
    })
}
