//! What the bounds pass over holds no crack: results with and without them are the same bits.

use crate::bodies::{self, bits, block, breaking, models, pane, shelf};
use crate::common::Numbers;
use frangible::glam::Vec3;
use frangible::internals::blow::Blow;
use frangible::internals::{Blast, blast, impact_traced, rest_margin_at_least};
use frangible::internals::{Factors, Fields, Force, LookedAt, is_harmless, rest};
use frangible::{Breakable, Contact, FractureConfig, Outcome, Striker, impact, would_break};

fn without_bounds(config: &FractureConfig) -> FractureConfig {
    let mut config = config.clone();
    config.culling = false;
    config
}

/// Compares blows on one kind of body with and without the bounds: counts what had to be looked at, and returns how many broke. The
/// report has one strength, so that only where it is `uniform` the margin can be compared with it.
fn compare(
    kind: &Breakable,
    name: &str,
    blows: u64,
    uniform: bool,
    looked: &mut [usize; 5],
) -> usize {
    let mut numbers = Numbers(1);
    let mut broke = 0;
    for k in 0..blows {
        let body = kind.body(k);
        let contacts: Vec<Contact> = (0..1 + k % 3).map(|_| numbers.blow(kind.asset())).collect();
        for (model, config) in models() {
            let what = format!("{name}, {model}, blow {k}");
            let fast = impact(&body, &contacts, &config).unwrap();
            let slow = impact(&body, &contacts, &without_bounds(&config)).unwrap();
            let (a, b) = (fast.report(), slow.report());
            assert_eq!(a.cracks, b.cracks, "{what}");
            assert_eq!(a.crack_area.to_bits(), b.crack_area.to_bits(), "{what}");
            assert_eq!(a.first_crack_time, b.first_crack_time, "{what}");
            if let (Outcome::Broke(_), _) | (_, Outcome::Broke(_)) = (&fast, &slow) {
                assert!(bits(&fast) == bits(&slow), "{what}");
                broke += 1;
            }
            assert!(
                a.stress_bound >= b.peak_stress * (1.0 - 1e-6),
                "{what}: the bound {} is below the stress {}",
                a.stress_bound,
                b.peak_stress
            );
            if let (Outcome::Held { margin, .. }, true) = (&fast, uniform) {
                let within = b.peak_stress <= b.strength;
                assert_eq!(*margin >= 1.0, within, "{what}: {margin}");
            }
            if is_harmless(&body, &contacts, &config) {
                assert!(b.peak_stress <= b.strength && b.cracks == 0, "{what}");
                assert!(!would_break(&body, &contacts, &config).unwrap(), "{what}");
            }
            looked[a.looked_at as usize] += 1;
        }
    }
    broke
}

#[test]
fn the_bounds_change_no_bit_of_what_breaks() {
    let mut looked = [0; 5];
    for (name, kind) in [("pane", pane()), ("block", block()), ("shelf", shelf())] {
        let broke = compare(kind, name, 16, true, &mut looked);
        assert!(broke > 2, "{name}: {broke} of 48 broke");
    }
    let [sizes, impulses, amplitudes, clusters, stresses] = looked;
    println!("{looked:?}");
    assert!(sizes + impulses > 10 && amplitudes + clusters > 2 && stresses > 10);
}

#[test]
fn the_bounds_change_no_bit_where_strength_varies() {
    let mut looked = [0; 5];
    for (name, kind) in [("pane", pane()), ("block", block())] {
        let waves = Fields::from_function(kind.asset(), |p| Factors {
            strength: 1.0 + 0.9 * (90.0 * p.x).sin(),
            toughness: 1.0 + 0.8 * (70.0 * p.y).cos(),
            weak_points: 1.0 + (50.0 * p.z).sin(),
            ..Factors::ONE
        })
        .with_weibull_modulus(0.0);
        for fields in [waves.clone(), waves.with_weibull_modulus(6.0)] {
            let kind = kind.clone().with_fields(fields).unwrap();
            compare(&kind, name, 8, false, &mut looked);
        }
    }
    assert!(looked[4] > 10, "{looked:?}");
}

#[test]
fn the_bounds_change_no_bit_of_breaking_blows() {
    for (name, kind, contact) in breaking() {
        for (model, config) in models() {
            let body = kind.body(5);
            let fast = impact(&body, std::slice::from_ref(&contact), &config).unwrap();
            let slow = impact(
                &body,
                std::slice::from_ref(&contact),
                &without_bounds(&config),
            )
            .unwrap();
            assert!(bits(&fast) == bits(&slow), "{name}, {model}");
        }
    }
}

#[test]
fn a_refused_contact_allocates_nothing() {
    let body = block().body(1);
    let config = FractureConfig::default();
    let soft = bodies::block_hit(1e-4);
    let contacts = [
        soft.clone(),
        Contact {
            friction: Vec3::Y * 1e-5,
            ..soft
        },
    ];
    let force = Force {
        point: soft.point,
        force: Vec3::NEG_X,
    };
    let refused = |outcome: Outcome| {
        matches!(outcome, Outcome::Held { margin, report, .. }
            if margin > 1.0 && report.looked_at <= LookedAt::Impulses)
    };
    let mut all = true;
    let counted = allocation_counter::measure(|| {
        all &= refused(impact(&body, &contacts, &config).unwrap());
        all &= !would_break(&body, &contacts, &config).unwrap();
        all &= refused(rest(&body, &[force], Vec3::NEG_Z, &config).unwrap());
    });
    assert!(all);
    assert_eq!(counted.count_total, 0, "{counted:?}");
}

/// The cheapest bound of steady loads is below what they do, wherever they act.
#[test]
fn no_steady_force_has_less_margin_than_the_bound_says() {
    let config = without_bounds(&FractureConfig::default());
    let mut numbers = Numbers(3);
    for kind in [pane(), block(), shelf()] {
        let body = kind.body(1);
        for _ in 0..20 {
            let at = numbers.blow(kind.asset());
            let size = 10.0_f32.powf(4.0 * numbers.next() as f32 - 2.0);
            let force = Force {
                point: at.point,
                force: at.normal * size,
            };
            let gravity = Vec3::NEG_Z * 9.81;
            let least = rest_margin_at_least(&body, size, 9.81, config.load_duration);
            let outcome = rest(&body, &[force], gravity, &config).unwrap();
            let report = outcome.report();
            let found = report.strength / report.peak_stress;
            assert!(least <= found, "{}: {least} {found}", kind.asset().name());
            assert!(least > 0.0);
        }
    }
}

#[test]
fn the_bounds_change_no_bit_of_a_blast() {
    let body = pane().body(1);
    let config = FractureConfig::default();
    let mut broke = 0;
    for distance in [0.05, 0.1, 0.3, 1.0, 10.0, 100.0] {
        let pulse = Blast {
            origin: Vec3::Z * distance,
            impulse: 200.0,
            duration: 2e-3,
        };
        let fast = blast(&body, &pulse, &config).unwrap();
        let slow = blast(&body, &pulse, &without_bounds(&config)).unwrap();
        assert_eq!(fast.report().cracks, slow.report().cracks);
        if let Outcome::Broke(_) = slow {
            assert!(bits(&fast) == bits(&slow), "{distance} m");
            broke += 1;
        }
    }
    assert!((1..6).contains(&broke), "{broke}");
}

/// However hard a contact rubs, its normal force is that of one that does not: on a solid and on a wall, of a ball and of what vibrates too.
#[test]
fn friction_adds_nothing_to_the_force_that_it_follows() {
    let config = FractureConfig::default();
    let (point, toward) = (Vec3::new(-0.1, 0.1, 0.001), Vec3::new(1.0, -0.1, -0.1));
    let ball = bodies::steel_ball(0.05);
    let along_the_pane = Contact::collision(pane().asset(), point, toward, 0.05, ball);
    let on_the_pane = bodies::pane_hit(0.03, 0.02, 0.1);
    let mut by_a_block = on_the_pane.clone();
    let other = block().body(1);
    by_a_block.striker = Striker::flexible(&other, &bodies::block_hit(0.1), &config).unwrap();
    let mut compared = 0;
    for (kind, contact) in [
        (pane(), along_the_pane),
        (pane(), on_the_pane),
        (pane(), by_a_block),
        (block(), bodies::block_hit(0.2)),
    ] {
        let body = kind.body(1);
        let blow = |friction: Vec3| {
            let contact = Contact {
                friction: contact.impulse * friction,
                ..contact.clone()
            };
            let found = Blow::new(&body, &[contact], &config).unwrap();
            found.expect("a contact that pushes").reports()[0].clone()
        };
        let smooth = blow(Vec3::ZERO);
        let beside = contact.normal.any_orthonormal_vector();
        for size in [0.3, 1.0, 10.0, 1e4] {
            for direction in [
                beside,
                -beside,
                beside.cross(contact.normal),
                -contact.normal,
            ] {
                let rough = blow(size * direction);
                for (rough, smooth) in [
                    (rough.impulse, smooth.impulse),
                    (rough.peak_force, smooth.peak_force),
                ] {
                    let apart = (rough / smooth - 1.0).abs();
                    assert!(apart < 1e-3, "{size} {direction}: {rough} {smooth}");
                }
                compared += 1;
            }
        }
    }
    assert_eq!(compared, 64);
}

/// A script may push anywhere: with friction along its push, or against it, it strains the body as the one that pushes so at once.
#[test]
fn a_script_with_friction_is_a_push() {
    let config = FractureConfig::default();
    // What follows the force shows where the force is slow, and where a wall has a near field.
    for (kind, hit, factor, duration) in [
        (pane(), bodies::pane_hit(0.03, 0.02, 1.0), 3.0, 1e-4),
        (pane(), bodies::pane_hit(0.03, 0.02, 1.0), 3.0, 1e-2),
        (block(), bodies::block_hit(1.0), -1.0, 1e-4),
    ] {
        let body = kind.body(1);
        let impulse = 1e-3 * hit.normal.normalize();
        let strained = |contact: Contact| {
            let (outcome, _) = impact_traced(&body, &[contact], &config).unwrap();
            outcome.report().peak_strain_energy
        };
        let at_once = strained(Contact::push(hit.point, factor * impulse, duration));
        let mut rubbing = Contact::push(hit.point, impulse, duration);
        rubbing.friction = (factor - 1.0) * impulse;
        let apart = strained(rubbing) / at_once - 1.0;
        assert!(at_once > 0.0 && apart.abs() < 1e-3, "{at_once} {apart}");
    }
}

/// A script all of whose push is friction is not refused as if it did not push.
#[test]
fn a_script_of_friction_alone_pushes() {
    for config in [
        FractureConfig::default(),
        FractureConfig::with_given_impulses(),
    ] {
        let hit = bodies::block_hit(20.0);
        let mut rubbing = Contact::push(hit.point, hit.normal, 1e-4);
        (rubbing.impulse, rubbing.friction) = (0.0, 500.0 * hit.normal);
        let at_once = Contact::push(hit.point, 500.0 * hit.normal, 1e-4);
        let outcome = |contact: &Contact, config: &FractureConfig| {
            impact(&block().body(1), std::slice::from_ref(contact), config).unwrap()
        };
        let expected = bodies::bits(&outcome(&at_once, &config));
        assert!(matches!(outcome(&at_once, &config), Outcome::Broke(_)));
        assert!(bodies::bits(&outcome(&rubbing, &config)) == expected);
        assert!(bodies::bits(&outcome(&rubbing, &without_bounds(&config))) == expected);
    }
}

/// What a script's friction does to the body is felt by a striker beside it.
#[test]
fn a_script_with_friction_moves_what_a_striker_beside_it_feels() {
    let config = FractureConfig::default();
    let body = pane().body(1);
    let ball = bodies::pane_hit(0.05, 0.02, 0.5);
    let felt = |script: Contact| {
        let contacts = [ball.clone(), script];
        let found = Blow::new(&body, &contacts, &config).unwrap();
        found.expect("a contact that pushes").reports()[0].impulse
    };
    let push = bodies::pane_hit(0.0, 0.0, 1.0);
    let script = |impulse: f32| Contact::push(push.point, impulse * push.normal, 5e-4);
    let mut rubbing = script(1e-2);
    rubbing.friction = 2e-2 * push.normal;
    let (alone, at_once, rubbing) = (felt(script(1e-6)), felt(script(3e-2)), felt(rubbing));
    assert!(
        (rubbing / at_once - 1.0).abs() < 1e-3,
        "{at_once} {rubbing}"
    );
    assert!((alone / at_once - 1.0).abs() > 0.01, "{alone} {at_once}");
}

#[test]
fn friction_without_a_force_to_follow_is_refused() {
    for impulse in [1e-39, 0.0] {
        let mut contact = bodies::pane_hit(0.0, 0.0, 1.0);
        (contact.impulse, contact.friction) = (impulse, Vec3::X);
        let refused = impact(&pane().body(1), &[contact], &FractureConfig::default());
        let said = refused.unwrap_err().to_string();
        assert!(said.contains("friction impulse over its impulse"), "{said}");
    }
}
