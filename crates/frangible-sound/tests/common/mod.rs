//! Plates of glass to strike.

use frangible_sound::glam::DQuat;
use frangible_sound::{AudibleDamping, Plate, PlateMaterial, SoundBody};

/// A plate with these sides, m.
pub(crate) fn plate(sides: [f64; 3]) -> (Plate, SoundBody) {
    let glass = PlateMaterial {
        youngs_modulus: 71e9,
        poisson_ratio: 0.23,
        density: 2500.0,
        damping: AudibleDamping::published("glass").expect("known").0,
    };
    Plate::new("tile", sides, DQuat::IDENTITY, &glass).expect("a plate")
}
