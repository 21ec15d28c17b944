//! Changes the material or size of an asset without baking it again.
//!
//! For a fixed shape and Poisson's ratio, K is proportional to E s and M to ρ s³, where s is the size. So
//! λ goes as E / (ρ s²), the mass-normalised shapes as 1 / √(ρ s³), their gradients one power of s lower, and
//! their stress as E / (√ρ s^2.5). Damping, strength, toughness, weak points, roughness and contact parameters do
//! not affect the modes and are simply replaced.
//!
//! Factors are formed in f64 and each stored f32 is rounded once per call, 6e-8 of it; eigenvalues stay in f64. To avoid
//! accumulating rounding errors, for example from a slider, always rescale the baked asset rather than the last result.

use std::sync::Arc;

use glam::{DVec3, Vec3};
use thiserror::Error;

use crate::asset::{Asset, EmbeddedPoint};
use crate::error::{InputError, positive};
use crate::material::Material;
use crate::mesh::MassProperties;

/// Smallest radius of curvature of a surface, m: edges and corners of real bodies are rounded at least this much, at any size.
pub const SMALLEST_CURVATURE_RADIUS: f64 = 0.003;

/// Poisson's ratios this close are the same: far above the rounding of a sum, far below what shows in a mode.
const SAME_RATIO: f64 = 1e-9;

/// Largest mode shape and stress there must be: numbers 1e-10 of it are still normal ones of f32.
const SMALLEST: f32 = 1e-28;

/// Error of rescaling an asset.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum RescaleError {
    /// The Poisson's ratio differs, so the modes cannot be rescaled.
    #[error(
        "`{asset}` was baked from {baked_material} with Poisson's ratio {baked}, but {wanted_material} has {wanted}, which changes the modes; bake it again from {wanted_material}, or give a material with Poisson's ratio {baked}"
    )]
    PoissonRatio {
        /// Name of the asset.
        asset: String,
        /// Material from which it was baked.
        baked_material: String,
        /// Poisson's ratio of the baked material.
        baked: f64,
        /// Requested material.
        wanted_material: String,
        /// Poisson's ratio of the requested material.
        wanted: f64,
    },
    /// The films of a laminate do not follow a change.
    #[error(
        "`{asset}` is laminated, or is to be: how much its plies bend as one depends on its size and its film; bake it again"
    )]
    Laminate {
        /// Name of the asset.
        asset: String,
    },
    /// Mode shapes or stresses would underflow or overflow f32.
    #[error(
        "this change takes the mode shapes of `{asset}` out of the range of f32; change the size or the material by less"
    )]
    OutOfRange {
        /// Name of the asset.
        asset: String,
    },
    /// An invalid number.
    #[error(transparent)]
    Input(#[from] InputError),
}

/// Returns the asset with another material of the same Poisson's ratio, as if it had been baked from it.
///
/// # Errors
/// [`RescaleError::PoissonRatio`] if the material has another Poisson's ratio; a value of the material is out of range.
pub fn with_material(asset: &Asset, material: &Material) -> Result<Asset, RescaleError> {
    material.validate().map_err(InputError::from)?;
    let old = &asset.material;
    if (material.poisson_ratio - old.poisson_ratio).abs() > SAME_RATIO {
        return Err(RescaleError::PoissonRatio {
            asset: asset.name.clone(),
            baked_material: old.name.clone(),
            baked: old.poisson_ratio,
            wanted_material: material.name.clone(),
            wanted: material.poisson_ratio,
        });
    }
    let same = material.youngs_modulus.to_bits() == old.youngs_modulus.to_bits();
    if material.laminate != old.laminate || (old.laminate.is_some() && !same) {
        return Err(RescaleError::Laminate {
            asset: asset.name.clone(),
        });
    }
    let stiffness = material.youngs_modulus / old.youngs_modulus;
    let density = material.density / old.density;
    let mut asset = asset.clone();
    // The ratio of the bake: many steps within rounding must not lead away from it.
    asset.material = material.clone();
    asset.material.poisson_ratio = old.poisson_ratio;
    rescale_modes(
        &mut asset,
        stiffness / density,
        density.sqrt().recip(),
        density.sqrt().recip(),
        stiffness / density.sqrt(),
    );
    weigh(&mut asset);
    checked(asset)
}

/// Returns the asset scaled by `factor`, with the same material, as if the shape had been baked at that size.
///
/// Curvature radii at [`SMALLEST_CURVATURE_RADIUS`] stay unchanged: edges of a larger body are no blunter. Radii that the bake
/// clamped to this value are therefore not recovered by enlarging the asset.
///
/// # Errors
/// The factor is not positive, or so large or small that values leave the range of f32.
pub fn scaled(asset: &Asset, factor: f64) -> Result<Asset, RescaleError> {
    positive("the factor of the size", factor, "times").map_err(InputError::from)?;
    if asset.material.laminate.is_some() && factor.to_bits() != 1.0_f64.to_bits() {
        return Err(RescaleError::Laminate {
            asset: asset.name.clone(),
        });
    }
    let mut asset = asset.clone();
    let scale = |v: &mut Vec3| *v = (v.as_dvec3() * factor).as_vec3();
    let fracture = Arc::make_mut(&mut asset.fracture);
    fracture.positions.iter_mut().for_each(scale);
    asset.analysis.nodes.iter_mut().for_each(scale);
    for gradient in asset.analysis.barycentric_gradients.iter_mut().flatten() {
        *gradient = (gradient.as_dvec3() / factor).as_vec3();
    }
    let offset = |p: &mut EmbeddedPoint| scale(&mut p.offset);
    asset.embedding.tets.iter_mut().for_each(offset);
    asset.embedding.nodes.iter_mut().for_each(offset);
    for cell in &mut asset.cells {
        cell.points.iter_mut().for_each(scale);
    }
    if let Some(render) = &mut asset.render {
        render.positions.iter_mut().for_each(scale);
    }
    for radius in &mut asset.surface.curvature_radius {
        if *radius > SMALLEST_CURVATURE_RADIUS as f32 {
            *radius = (f64::from(*radius) * factor).max(SMALLEST_CURVATURE_RADIUS) as f32;
        }
    }
    rescale_walls(&mut asset, factor);
    rescale_modes(
        &mut asset,
        (factor * factor).recip(),
        (factor * factor.sqrt()).recip(),
        (factor * factor * factor.sqrt()).recip(),
        (factor * factor * factor.sqrt()).recip(),
    );
    weigh(&mut asset);
    checked(asset)
}

fn rescale_walls(asset: &mut Asset, factor: f64) {
    let walls = &mut asset.surface.walls;
    for (numbers, factor) in [
        (&mut walls.thickness, factor),
        (&mut walls.stiffening, (factor * factor).recip()),
        (&mut walls.margin, factor),
    ] {
        for x in numbers {
            *x = (f64::from(*x) * factor) as f32;
        }
    }
}

fn rescale_modes(asset: &mut Asset, eigenvalues: f64, shapes: f64, gradient: f64, stress: f64) {
    let modes = &mut asset.modes;
    modes.eigenvalues.iter_mut().for_each(|l| *l *= eigenvalues);
    for (numbers, factor) in [
        (&mut modes.shapes, shapes),
        (&mut modes.peak_stress, stress),
        (&mut asset.bounds.stress, stress),
        (&mut asset.bounds.gradient, gradient),
    ] {
        for x in numbers {
            *x = (f64::from(*x) * factor) as f32;
        }
    }
}

fn checked(asset: Asset) -> Result<Asset, RescaleError> {
    let stored = |numbers: &[f32]| {
        let largest = numbers.iter().fold(0.0_f32, |m, x| m.max(x.abs()));
        (SMALLEST..f32::INFINITY).contains(&largest)
    };
    if !(stored(&asset.modes.shapes) && stored(&asset.modes.peak_stress)) {
        return Err(RescaleError::OutOfRange { asset: asset.name });
    }
    asset.validate()?;
    Ok(asset)
}

/// Mass properties of the mesh as stored, as the bake finds them, so that the masses of its pieces sum to them.
fn weigh(asset: &mut Asset) {
    let mesh = &asset.fracture;
    let corners = (0..mesh.tets.len()).map(|e| mesh.corners(e).map(|p| p.as_dvec3()));
    asset.mass = MassProperties::of_tetrahedra(asset.material.density, corners);
    asset.mass.centre = DVec3::ZERO;
}
