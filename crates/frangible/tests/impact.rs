//! What must hold of every impact, whatever it does.

use crate::bodies::{
    self, bits, block, block_hit, breaking, models, pane, pane_hit, pieces, shelf, shelf_hit,
    strike,
};
use frangible::glam::Vec3;
use frangible::internals::blow::Blow;
use frangible::internals::outcome::ContactReport;
use frangible::internals::stress::StressBounds;
use frangible::internals::{Blast, blast};
use frangible::{Body, Breakable, Contact, FractureConfig, Outcome, impact, would_break};

#[test]
fn the_same_blow_gives_the_same_bits_on_any_thread() {
    for (name, kind, contact) in breaking() {
        for (model, config) in models() {
            for seed in [1, 7] {
                let first = bits(&strike(kind, seed, contact.clone(), &config));
                let others: Vec<_> = (0..3)
                    .map(|_| {
                        let (contact, config) = (contact.clone(), config.clone());
                        std::thread::spawn(move || bits(&strike(kind, seed, contact, &config)))
                    })
                    .collect();
                for other in others {
                    assert!(first == other.join().unwrap(), "{name}, {model}, {seed}");
                }
            }
        }
    }
}

#[test]
fn another_seed_gives_another_break() {
    for (name, kind, contact) in breaking() {
        let mut seen: Vec<Vec<u64>> = (1..=4)
            .map(|seed| {
                bits(&strike(
                    kind,
                    seed,
                    contact.clone(),
                    &FractureConfig::default(),
                ))
            })
            .collect();
        seen.sort();
        seen.dedup();
        assert_eq!(seen.len(), 4, "{name}");
    }
}

#[test]
fn soft_blows_hold_and_hard_ones_break() {
    for (model, config) in models() {
        for seed in 1..=3 {
            for (kind, soft, hard) in [
                (pane(), pane_hit(0.0, 0.0, 0.1), pane_hit(0.0, 0.0, 25.0)),
                (block(), block_hit(0.05), block_hit(20.0)),
                (shelf(), shelf_hit(0.05), shelf_hit(20.0)),
            ] {
                let name = format!("{}, {model}, seed {seed}", kind.asset().name());
                let held = strike(kind, seed, soft.clone(), &config);
                assert!(
                    matches!(held, Outcome::Held { margin, state: None, .. } if margin > 1.0),
                    "{name}: {held:?}"
                );
                assert_eq!(held.report().cracks, 0, "{name}");
                let broke = strike(kind, seed, hard.clone(), &config);
                assert!(pieces(&broke) > 1, "{name} held 20 m/s");
                let body = kind.body(seed);
                assert!(!would_break(&body, &[soft], &config).unwrap());
                assert!(would_break(&body, &[hard], &config).unwrap());
            }
        }
    }
}

#[test]
fn bad_contacts_are_refused_and_nothing_comes_of_nothing() {
    let body = pane().body(1);
    let config = FractureConfig::default();
    let good = pane_hit(0.02, 0.01, 10.0);
    let mut bad: [_; 5] = std::array::from_fn(|_| good.clone());
    bad[0].point.x = f32::NAN;
    bad[1].normal = Vec3::ZERO;
    bad[2].impulse = -1.0;
    bad[3].striker.restitution = 2.0;
    bad[4].approach_speed = f32::NAN;
    for (i, contact) in bad.into_iter().enumerate() {
        let refused = impact(&body, &[good.clone(), contact], &config);
        assert!(refused.is_err(), "bad contact {i}");
    }
    let nothing = Contact {
        impulse: 0.0,
        approach_speed: 0.0,
        ..good.clone()
    };
    for contacts in [
        &[][..],
        std::slice::from_ref(&nothing),
        &[nothing.clone(), nothing.clone()],
    ] {
        for (model, config) in models() {
            let outcome = impact(&body, contacts, &config).unwrap();
            let held = matches!(outcome, Outcome::Held { margin, .. } if margin == f64::INFINITY);
            assert!(held, "{model}: {outcome:?}");
            assert_eq!(outcome.report().cracks, 0);
        }
    }
    // A contact without impulse beside a real one changes nothing.
    let both = impact(&body, &[good.clone(), nothing], &config).unwrap();
    assert!(bits(&both) == bits(&impact(&body, std::slice::from_ref(&good), &config).unwrap()));
    // The length of the normal does not matter.
    let long = Contact {
        normal: 4.0 * good.normal,
        ..good
    };
    let outcome = impact(&body, &[long], &config).unwrap();
    assert_eq!(pieces(&outcome), pieces(&both));
}

#[test]
fn a_body_without_modes_holds() {
    let mut asset = (**block().asset()).clone();
    asset.parts_mut().modes.eigenvalues.clear();
    asset.parts_mut().modes.shapes.clear();
    asset.parts_mut().modes.peak_stress.clear();
    asset.parts_mut().modes.residual_modes = 0;
    *asset.parts_mut().bounds = StressBounds::default();
    let body = Breakable::uniform(asset).unwrap().body(1);
    let pulse = Blast {
        origin: Vec3::Z,
        impulse: 200.0,
        duration: 2e-3,
    };
    for (model, mut config) in models() {
        for culling in [true, false] {
            config.culling = culling;
            let blow = impact(&body, &[block_hit(5.0)], &config).unwrap();
            let wave = blast(&body, &pulse, &config).unwrap();
            for outcome in [blow, wave] {
                assert_eq!(
                    (pieces(&outcome), outcome.report().cracks),
                    (1, 0),
                    "{model}"
                );
            }
        }
    }
}

#[test]
fn vibration_holds_no_more_energy_than_the_blow_brought() {
    let config = FractureConfig::with_given_impulses();
    let mut free = config.clone();
    free.admissible_duration = false;
    let mut lengthened = 0;
    for (name, kind, contact) in breaking() {
        let outcome = strike(kind, 1, contact.clone(), &config);
        let report = outcome.report();
        let e = f64::from(contact.striker.restitution);
        let brought =
            0.5 * f64::from(contact.impulse) * f64::from(contact.approach_speed) / (1.0 + e);
        assert!(
            (report.approach_energy / brought - 1.0).abs() < 1e-6,
            "{name}: {} J of {brought} J",
            report.approach_energy
        );
        let share = report.peak_elastic_energy / report.approach_energy;
        assert!(share <= 1.02, "{name}: the vibration holds {share}");
        assert!(report.contact_duration >= report.unadjusted_duration);
        lengthened += usize::from(report.contact_duration > report.unadjusted_duration);
        let outcome = strike(kind, 1, contact, &free);
        let report = outcome.report();
        assert_eq!(report.contact_duration, report.unadjusted_duration);
    }
    assert!(lengthened > 0);
}

#[test]
fn a_script_lasts_as_long_as_it_says() {
    let hit = block_hit(1.0);
    let script = Contact::push(hit.point, 0.1 * hit.normal, 5e-3);
    for mut config in [
        FractureConfig::default(),
        FractureConfig::with_given_impulses(),
    ] {
        config.culling = false;
        let outcome = strike(block(), 1, script.clone(), &config);
        let report = outcome.report();
        for found in [report.contact_duration, report.unadjusted_duration] {
            assert!(
                (found / 5e-3 - 1.0).abs() < 0.02,
                "{found} s, {:?}",
                config.duration
            );
        }
    }
}

/// The force of one contact as it would be if nothing broke.
fn unbroken(body: &Body, contact: Contact) -> ContactReport {
    let blow = Blow::new(body, &[contact], &FractureConfig::default()).unwrap();
    blow.expect("something pushes").reports().remove(0)
}

#[test]
fn a_blow_is_as_if_nothing_broke_until_a_piece_parts() {
    let (mut changed, mut whole) = (0, 0);
    for seed in 1..=12 {
        for (kind, hit) in [
            (block(), block_hit(1.0)),
            (block(), block_hit(20.0)),
            (shelf(), shelf_hit(4.0)),
            (shelf(), shelf_hit(10.0)),
            (shelf(), shelf_hit(20.0)),
        ] {
            let body = kind.body(seed);
            let alone = unbroken(&body, hit.clone());
            let outcome = strike(kind, seed, hit.clone(), &FractureConfig::default());
            let report = outcome.report();
            let contact = &report.contacts[0];
            let pairs = || contact.force.iter().zip(&alone.force);
            if pairs().all(|(a, b)| a == b) && contact.force.len() == alone.force.len() {
                whole += 1;
                continue;
            }
            // What parts cannot be felt before the first crack.
            changed += 1;
            assert!(matches!(outcome, Outcome::Broke(_)));
            let same = pairs().take_while(|(a, b)| a == b).count();
            assert!(same as f64 * report.time_step > report.first_crack_time.unwrap());
            let mass = 1.0 / f64::from(hit.striker.inverse_effective_mass);
            let slower = contact.departure_speed + contact.approach_speed;
            let most = contact.impulse / mass;
            assert!(slower > (1.0 - 1e-4) * most, "{slower} m/s, {most} m/s");
        }
    }
    println!("{changed} blows changed, {whole} did not");
    assert!(changed > 3 && whole > 3);
}

#[test]
fn cracks_spend_what_a_shortened_blow_brought_and_no_more() {
    for seed in 1..=12 {
        let hit = block_hit(20.0);
        let outcome = strike(block(), seed, hit, &FractureConfig::default());
        let report = outcome.report();
        assert!(report.fracture_energy <= report.peak_strain_energy * (1.0 + 1e-9));
    }
}

#[test]
fn a_blow_hangs_on_what_strikes_and_not_on_the_impulse_that_an_engine_found() {
    let (body, hit) = (bodies::pane().body(3), bodies::pane_hit(0.03, 0.02, 9.0));
    let broken = |impulse: f32| {
        let contact = Contact {
            impulse,
            ..hit.clone()
        };
        let outcome = impact(&body, &[contact], &FractureConfig::default());
        let Ok(Outcome::Broke(fracture)) = outcome else {
            panic!("it breaks");
        };
        let report = &fracture.report;
        let steps = (report.time_step, report.time_steps);
        let cracks = (report.fracture_energy, report.first_crack_time);
        (fracture.fragments.len(), steps, cracks)
    };
    assert!(hit.impulse > 0.0);
    assert_eq!(broken(hit.impulse), broken(0.0));
    assert_eq!(broken(hit.impulse), broken(100.0 * hit.impulse));
}
