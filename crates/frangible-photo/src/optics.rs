//! Reflection and refraction of light at a face.

use frangible_recording::glam::{Vec3, Vec3A};

use crate::set::Met;

/// The direction of a mirror image.
pub(crate) fn mirror(along: Vec3A, normal: Vec3A) -> Vec3A {
    along - 2.0 * along.dot(normal) * normal
}

/// The normal on the side that a ray comes from.
pub(crate) fn facing(normal: Vec3A, along: Vec3A) -> Vec3A {
    if normal.dot(along) > 0.0 {
        -normal
    } else {
        normal
    }
}

/// A mirrored direction kept on the side of a face that the light came from.
pub(crate) fn outward(along: Vec3A, flat: Vec3A, came: Vec3A) -> Vec3A {
    let side = -came.dot(flat).signum();
    let above = along.dot(flat) * side;
    if above > 0.01 {
        along
    } else {
        (along + flat * (side * (0.02 - above))).normalize()
    }
}

/// The smooth normal with the bumps of the skin.
pub(crate) fn bumpy(met: &Met<'_>, bump: Vec3A) -> Vec3A {
    if bump == Vec3A::ZERO {
        return met.smooth;
    }
    let turned = met.turn * Vec3::from(bump);
    let normal = (met.smooth + Vec3A::from(turned)).normalize_or(met.smooth);
    if normal.dot(met.flat) < 0.05 {
        met.flat
    } else {
        normal
    }
}

/// Share of light that glass mirrors (Fresnel), and the way of the rest; `normal` points out of the glass.
pub(crate) fn at_glass(along: Vec3A, normal: Vec3A, ior: f32) -> (f32, Option<Vec3A>) {
    let entering = along.dot(normal) < 0.0;
    let (normal, ratio) = if entering {
        (normal, ior.recip())
    } else {
        (-normal, ior)
    };
    let cosine = -along.dot(normal).min(0.0);
    let sine_squared = ratio * ratio * (1.0 - cosine * cosine);
    if sine_squared >= 1.0 {
        return (1.0, None);
    }
    let behind = (1.0 - sine_squared).sqrt();
    let bent = ratio * along + (ratio * cosine - behind) * normal;
    // Amplitudes of both polarisations; with ratio = n1 / n2.
    let across = (ratio * cosine - behind) / (ratio * cosine + behind);
    let within = (cosine - ratio * behind) / (cosine + ratio * behind);
    let reflected = 0.5 * (across * across + within * within);
    (reflected, Some(bent.normalize()))
}

/// [`at_glass`] of a crack within glass: the air in it reflects light at grazing angles, and lets most of the rest go straight on.
pub(crate) fn at_crack(along: Vec3A, normal: Vec3A, ior: f32) -> (f32, Option<Vec3A>) {
    let (reflected, bent) = at_glass(along, -facing(normal, along), ior);
    // Two faces, with all that goes to and fro between them.
    let both = 2.0 * reflected / (1.0 + reflected);
    (both, bent.map(|_| along))
}
