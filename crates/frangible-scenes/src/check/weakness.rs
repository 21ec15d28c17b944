//! Weak places of a body.

use frangible::Patch;

use super::{Fault, quantity};
use crate::body::BodySpec;

/// Most weak places of a body.
const MOST_PATCHES: usize = 1000;

pub(super) fn check_weakness(body: &BodySpec) -> Result<(), Fault> {
    let given = body.weakness.len();
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
    let m = body.weibull_modulus;
    if m.to_bits() != 0 && !(m.is_finite() && m >= 1.0) {
        let must = "0 (no scatter), or 1 or above";
        return Err(quantity("weibull_modulus", "the Weibull modulus", m, must));
    }
    Ok(())
}

fn check_patch(patch: &Patch) -> Result<(), Fault> {
    patch.zone.check().map_err(|e| Fault::new("weakness", e))?;
    for (what, factor, least) in [
        (
            "the strength of a weak place",
            patch.strength,
            f32::MIN_POSITIVE,
        ),
        (
            "the toughness of a weak place",
            patch.toughness,
            f32::MIN_POSITIVE,
        ),
        ("the weak points of a weak place", patch.weak_points, 0.0),
    ] {
        // Its square, too, must be a number.
        if let Some(factor) = factor
            && !((least.max(1e-6)..=1e6).contains(&factor) || (factor == 0.0 && least == 0.0))
        {
            let must = "a factor on the material's: 1e-6 to 1e6 (weak points also 0)";
            return Err(quantity("weakness", what, factor, must));
        }
    }
    Ok(())
}
