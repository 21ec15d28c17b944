//! Weak places of a body.

use super::{Fault, quantity};
use crate::body::BodySpec;
use crate::error::SceneError;
use crate::source::BodySource;
use frangible_bake::weakness::{Paint, Patch};

/// Most weak places of a body.
const MOST_PATCHES: usize = 1000;

pub(super) fn check_weakness(body: &BodySpec) -> Result<(), Fault> {
    let given = body.weakness.len() + body.paint.len();
    if given > MOST_PATCHES {
        let must = "at most 1000";
        return Err(quantity(
            "weakness",
            "the number of weak places",
            given,
            must,
        ));
    }
    body.weakness.iter().try_for_each(check_patch)?;
    body.paint.iter().try_for_each(check_paint)?;
    if !body.paint.is_empty()
        && !matches!(body.source, BodySource::Mesh { .. } | BodySource::Asset(_))
    {
        let problem = "`paint` needs vertex colours, which a built-in shape does not have; give a `mesh`, or define weak places with `box`, \
                       `sphere`, `plane` or `line`";
        return Err(Fault::new("weakness", SceneError::Clash(problem.into())));
    }
    let m = body.weibull_modulus.unwrap_or(0.0);
    if m.to_bits() != 0 && !(m.is_finite() && m >= 1.0) {
        let must = "0 (no scatter), or 1 or above";
        return Err(quantity("weibull_modulus", "the Weibull modulus", m, must));
    }
    let volume = body.specimen.unwrap_or(1.0);
    if !(volume.is_finite() && volume > 0.0) {
        let must = "a finite number above zero, m³";
        return Err(quantity("specimen", "the specimen's volume", volume, must));
    }
    if let Some(fatigue) = body.fatigue {
        fatigue
            .validate()
            .map_err(|e| Fault::new("fatigue", frangible::InputError::from(e)))?;
    }
    Ok(())
}

fn check_patch(patch: &Patch) -> Result<(), Fault> {
    patch.zone.check().map_err(|e| Fault::new("weakness", e))?;
    let one = |factor: Option<f32>| factor.map(|f| [f, f]);
    check_groove(one(patch.groove))?;
    let factors = [patch.strength, patch.toughness, patch.weak_points];
    if patch.groove.is_some() && factors[..2].iter().any(Option::is_some) {
        let problem = "`groove` sets the strength and the toughness of its zone by its depth; remove `strength` and `toughness`, or `groove`";
        return Err(Fault::new("weakness", SceneError::Clash(problem.into())));
    }
    check_factors(factors.map(one))
}

fn check_paint(paint: &Paint) -> Result<(), Fault> {
    check_groove(paint.groove)?;
    check_factors([paint.strength, paint.toughness, paint.weak_points])
}

/// Checks the depth of a groove.
fn check_groove(depths: Option<[f32; 2]>) -> Result<(), Fault> {
    let sound = |d: &f32| (0.0..=1.0).contains(d);
    match depths.iter().flatten().find(|d| !sound(d)) {
        Some(depth) => {
            let must = "0 to 1 m";
            Err(quantity("weakness", "the depth of a groove", depth, must))
        }
        None => Ok(()),
    }
}

/// Checks the factors of strength, toughness and weak points that are given.
fn check_factors(factors: [Option<[f32; 2]>; 3]) -> Result<(), Fault> {
    const WHAT: [&str; 3] = [
        "the strength of a weak place",
        "the toughness of a weak place",
        "the weak points of a weak place",
    ];
    for (k, (what, given)) in WHAT.into_iter().zip(factors).enumerate() {
        // Its square, too, must be a number.
        let sound = |f: &f32| (1e-6..=1e6).contains(f) || (k == 2 && *f == 0.0);
        if let Some(factor) = given.iter().flatten().find(|f| !sound(f)) {
            let must = "a factor on the material's: 1e-6 to 1e6 (weak points also 0)";
            return Err(quantity("weakness", what, factor, must));
        }
    }
    Ok(())
}
