//! No number of a contact makes an impact endless.

use frangible::glam::Vec3;
use frangible::{Breakable, Contact, FractureConfig, Striker};

use crate::common::{Size, synthetic_asset};

#[test]
fn however_slowly_a_contact_approaches_its_steps_are_few() {
    let mut asset = synthetic_asset(&Size {
        cubes: 2,
        analysis_nodes: 12,
        elements: 3,
        modes: 2,
    });
    for eigenvalue in &mut asset.parts_mut().modes.eigenvalues {
        // 10 kHz: a contact of a second lasts as many periods.
        *eigenvalue *= 1e4;
    }
    let body = Breakable::uniform(asset).unwrap().body(1);
    for config in [
        FractureConfig::default(),
        FractureConfig::with_given_impulses(),
        FractureConfig::as_in_the_paper(),
    ] {
        for speed in [0.0, f32::from_bits(1), f32::MIN_POSITIVE, 1e-20, 1e-6] {
            for impulse in [f32::from_bits(1), 1e-6, 1.0, 1e6] {
                let striker = Striker::rigid();
                let contacts = [Contact {
                    impulse,
                    ..Contact::strike(Vec3::ONE, Vec3::NEG_ONE, speed, striker)
                }];
                let (outcome, _) =
                    frangible::internals::impact_traced(&body, &contacts, &config).unwrap();
                let steps = outcome.report().time_steps;
                // A blow that is followed with the body has as many more after the contact, fine and coarse.
                let most = if config.residual { 60_000 } else { 20_000 };
                assert!(steps <= most, "{steps} steps at {speed} m/s, {impulse} N·s");
            }
        }
    }
}
