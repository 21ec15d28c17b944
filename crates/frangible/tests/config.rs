//! A configuration whose numbers cannot be used is refused by every load, by the name of the field.

use frangible::glam::Vec3;
use frangible::internals::{Blast, DurationModel, Force};
use frangible::{Body, Breakable, Contact, FractureConfig, InputError, Striker};

use crate::common::{Size, synthetic_asset};

fn body() -> Body {
    let asset = synthetic_asset(&Size {
        cubes: 2,
        analysis_nodes: 12,
        elements: 3,
        modes: 2,
    });
    Breakable::uniform(asset).unwrap().body(1)
}

fn hit(impulse: f32, speed: f32) -> Contact {
    Contact {
        impulse,
        ..Contact::strike(Vec3::ONE, Vec3::NEG_ONE, speed, Striker::rigid())
    }
}

/// What every load says of a configuration.
fn refusals(body: &Body, config: &FractureConfig) -> Vec<Option<InputError>> {
    let contacts = [hit(1.0, 1.0)];
    let blast = Blast {
        origin: Vec3::ONE,
        impulse: 1.0,
        duration: 1e-3,
    };
    let force = Force {
        point: Vec3::ONE,
        force: Vec3::NEG_Y,
    };
    vec![
        config.validate().err(),
        frangible::impact(body, &contacts, config).err(),
        frangible::internals::impact_traced(body, &contacts, config).err(),
        frangible::would_break(body, &contacts, config).err(),
        frangible::internals::blast(body, &blast, config).err(),
        frangible::internals::rest(body, &[force], Vec3::ZERO, config).err(),
        frangible::internals::fracture_at(body, Vec3::ONE, Vec3::NEG_ONE, config).err(),
        frangible::internals::blow::Blow::new(body, &contacts, config).err(),
    ]
}

#[test]
fn a_configuration_with_a_number_out_of_its_range_is_refused_by_every_load() {
    let body = body();
    let of = |change: &dyn Fn(&mut FractureConfig)| {
        let mut config = FractureConfig::default();
        change(&mut config);
        config
    };
    for config in [
        FractureConfig::default(),
        FractureConfig::with_given_impulses(),
        FractureConfig::as_in_the_paper(),
    ] {
        assert!(refusals(&body, &config).iter().all(Option::is_none));
    }
    for x in [f64::NAN, f64::INFINITY, -1.0, 0.0] {
        let mut wrong = vec![
            (
                "samples_per_period",
                of(&|c: &mut FractureConfig| c.samples_per_period = x),
            ),
            (
                "AsPrinted.c",
                of(&|c: &mut FractureConfig| c.duration = DurationModel::AsPrinted { c: x }),
            ),
        ];
        wrong.push((
            "samples_per_period",
            of(&|c: &mut FractureConfig| c.samples_per_period = f64::MIN_POSITIVE),
        ));
        if x.to_bits() != 0 {
            wrong.push((
                "crumb_share",
                of(&|c: &mut FractureConfig| c.crumb_share = x),
            ));
        }
        for (field, config) in wrong {
            for refusal in refusals(&body, &config) {
                let text = refusal.expect(field).to_string();
                assert!(text.contains(field) && text.contains("must be"), "{text}");
            }
            let contacts = [hit(1e-9, 1.0)];
            assert!(!frangible::internals::is_harmless(
                &body, &contacts, &config
            ));
        }
    }
}

#[test]
fn an_error_about_a_number_without_a_unit_has_no_gap() {
    let contact = Contact::strike(Vec3::ONE, Vec3::ZERO, 1.0, Striker::rigid());
    let text = contact.validate().unwrap_err().to_string();
    assert!(text.contains("is 0; it must"), "{text}");
    assert!(!text.contains("  "), "{text}");
}
