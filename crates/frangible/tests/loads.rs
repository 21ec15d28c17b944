//! Loads that are no impact: steady forces, blasts, scripted blows, motions from elsewhere.

use crate::bodies::{self, block, pane, pieces, shelf, strike};
use frangible::glam::Vec3;
use frangible::internals::{
    Blast, Force, LookedAt, Stage, Vibration, blast, follow, fracture_at, rest,
};
use frangible::{FractureConfig, Outcome};

const GRAVITY: Vec3 = Vec3::new(0.0, 0.0, -9.81);

#[test]
fn nothing_breaks_from_merely_lying_there() {
    let config = FractureConfig::default();
    for kind in [pane(), block()] {
        let asset = kind.asset();
        let positions = asset.fracture().positions.iter().copied();
        let lowest = positions.min_by(|a, b| a.z.total_cmp(&b.z)).unwrap();
        let force = Force {
            point: lowest,
            force: Vec3::Z * (9.81 * asset.mass().mass) as f32,
        };
        let outcome = rest(&kind.body(1), &[force], GRAVITY, &config).unwrap();
        let Outcome::Held { margin, report, .. } = outcome else {
            panic!("{} broke under its own weight", asset.name());
        };
        assert!(margin > 5.0, "{}: margin {margin}", asset.name());
        assert_eq!(report.looked_at, LookedAt::Impulses);
    }
}

/// Stress of a steady load is proportional to it, until the shelf breaks, and a load beyond that breaks it too.
#[test]
fn a_shelf_holds_less_than_its_strength_and_breaks_under_more() {
    let body = shelf().body(1);
    let mut config = FractureConfig::default();
    config.culling = false;
    let end = bodies::shelf_hit(1.0).point;
    let load = |newton: f32| {
        let force = Force {
            point: end,
            force: Vec3::NEG_Z * newton,
        };
        rest(&body, &[force], Vec3::ZERO, &config).unwrap()
    };
    let stress = |newton: f32| load(newton).report().peak_stress;
    assert!((stress(2.0) / stress(1.0) - 2.0).abs() < 1e-4);
    let mut broke_at = None;
    for k in 0..14 {
        let newton = 2.0_f32.powi(k);
        match load(newton) {
            Outcome::Broke(_) => {
                broke_at.get_or_insert(newton);
            }
            _ => assert!(broke_at.is_none(), "held {newton} N after it broke"),
        }
    }
    // Clamped at one end: σ = 6 F L / (b h²) is 40 MPa at 100 N, L = 0.27 m; elements as long as the bar is thick see less.
    let broke_at = broke_at.expect("it breaks under some load");
    assert!((60.0..1000.0).contains(&broke_at), "{broke_at} N");
}

/// The weight of a held body bends it, that of a free one does not.
#[test]
fn gravity_stresses_what_is_held() {
    let mut config = FractureConfig::default();
    config.culling = false;
    let stress = |body: &frangible::Body, gravity: Vec3| {
        let outcome = rest(body, &[], gravity, &config).unwrap();
        outcome.report().peak_stress
    };
    let held = shelf().body(1);
    let (one, two) = (stress(&held, GRAVITY), stress(&held, 2.0 * GRAVITY));
    assert!(one > 1e4, "{one} Pa");
    assert!((two / one - 2.0).abs() < 1e-4, "{two} {one}");
    assert_eq!(stress(&block().body(1), GRAVITY), 0.0);
}

#[test]
fn a_blast_breaks_a_pane_that_is_near_and_not_one_that_is_far() {
    let body = pane().body(1);
    let config = FractureConfig::default();
    let at = |distance: f32| {
        let pulse = Blast {
            origin: Vec3::Z * distance,
            impulse: 200.0,
            duration: 2e-3,
        };
        blast(&body, &pulse, &config).unwrap()
    };
    assert!(matches!(at(300.0), Outcome::Held { .. }));
    assert!(matches!(at(0.1), Outcome::Broke(_)));
    for (origin, impulse) in [(Vec3::NAN, 1.0), (Vec3::ONE, 0.0), (Vec3::ONE, f32::NAN)] {
        let bad = Blast {
            origin,
            impulse,
            duration: 1e-3,
        };
        assert!(blast(&body, &bad, &config).is_err());
    }
}

/// Far off, a blast is a uniform pressure on one side: it is the same from above and from below.
#[test]
fn a_far_blast_gives_a_symmetric_body_the_same_energy_from_both_sides() {
    let body = pane().body(1);
    let mut config = FractureConfig::default();
    config.culling = false;
    let from = |side: f32| {
        let pulse = Blast {
            origin: Vec3::Z * side * 1e4,
            impulse: 1e4,
            duration: 2e-3,
        };
        let outcome = blast(&body, &pulse, &config).unwrap();
        outcome.report().peak_elastic_energy
    };
    let (above, below) = (from(1.0), from(-1.0));
    assert!((above / below - 1.0).abs() < 1e-3, "{above} J, {below} J");
}

#[test]
fn a_scripted_blow_breaks_by_its_impulse() {
    let body = pane().body(1);
    let config = FractureConfig::default();
    let middle = Vec3::new(0.01, 0.02, 0.002);
    let broke = fracture_at(&body, middle, Vec3::NEG_Z * 2.0, &config).unwrap();
    assert!(pieces(&broke) > 1);
    let held = fracture_at(&body, middle, Vec3::NEG_Z * 1e-4, &config).unwrap();
    assert!(matches!(held, Outcome::Held { margin, .. } if margin > 1.0));
    assert!(fracture_at(&body, middle, Vec3::ZERO, &config).is_err());
    assert!(fracture_at(&body, middle, Vec3::NAN, &config).is_err());
}

/// The motion of an impact, followed as one from elsewhere, cracks as the impact does.
#[test]
fn a_motion_from_elsewhere_cracks_as_the_impact_that_it_is_of() {
    let mut config = FractureConfig::with_given_impulses();
    config.culling = false;
    let body = block().body(2);
    let hit = bodies::block_hit(12.0);
    let Stage::Vibrates(vibration) =
        Vibration::begin(&body, std::slice::from_ref(&hit), &config).unwrap()
    else {
        panic!("refused");
    };
    let motion = vibration.motion(&body);
    let (_, pulse) = vibration.pulse().expect("a pulse");
    let step = pulse.time_step;
    let own = follow(&body, &motion, &vibration.pressed, step, &config).unwrap();
    let whole = strike(block(), 2, hit, &config);
    assert!(whole.report().cracks > 0);
    assert_eq!(own.report().crack_area, whole.report().crack_area);
    assert_eq!(pieces(&own), pieces(&whole));
    let mut bad = motion.clone();
    bad.amplitudes[0] = f32::NAN;
    for (motion, step) in [(&bad, step), (&motion, 0.0), (&motion, f64::NAN)] {
        assert!(follow(&body, motion, &[], step, &config).is_err());
    }
}

#[test]
fn a_steady_load_whose_energy_is_no_number_is_refused() {
    let body = shelf().body(1);
    let mut config = FractureConfig::default();
    for culling in [true, false] {
        config.culling = culling;
        let gravity = Vec3::NEG_Z * 3e38;
        let error = rest(&body, &[], gravity, &config).unwrap_err().to_string();
        assert!(
            error.contains("elastic energy") && error.contains("gravity"),
            "{error}"
        );
    }
}
