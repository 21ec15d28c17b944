//! Input that cannot sound is refused by name; input that is too much is bounded.

use std::sync::Arc;

use crate::common::plate;
use frangible_sound::glam::{DQuat, DVec3, Vec3};
use frangible_sound::{
    AudibleDamping, EquivalentSphere, Limiter, Listener, Plate, PlateMaterial, SoundBody,
    SoundError, SoundFloor, SoundPulse, Strike, SurfaceElement, Synth, SynthConfig, wav,
};

fn config() -> SynthConfig {
    SynthConfig::new(Listener::at(DVec3::new(0.3, 0.5, 1.2), DVec3::ZERO))
}

fn tile() -> (Plate, Arc<SoundBody>) {
    let (plate, body) = plate([0.12, 0.1, 0.005]);
    (plate, Arc::new(body))
}

fn strike(plate: &Plate, impulse: f64) -> Strike {
    Strike {
        pulse: Arc::new(SoundPulse::half_sine(impulse, 2e-4)),
        push: plate.push(Vec3::new(0.05, 0.03, 0.0), Vec3::Z),
        direction: Vec3::Z,
    }
}

#[track_caller]
fn refused<T>(result: Result<T, SoundError>, words: &[&str]) {
    let error = result.err().expect("an error").to_string();
    for word in words {
        assert!(error.contains(word), "{error}");
    }
}

#[test]
fn rates_that_are_none_are_refused() {
    for rate in [0.0, -48_000.0, f64::NAN, f64::INFINITY, 3.0, 1e9] {
        refused(
            Synth::new(SynthConfig { rate, ..config() }),
            &["sampling rate"],
        );
        refused(wav(&[0.0; 2], 2, rate.min(-1.0), 1.0), &["sampling rate"]);
    }
    refused(
        wav(&[0.0; 3], 2, 48_000.0, 1.0),
        &["samples", "3", "multiple of 2"],
    );
    refused(wav(&[0.0, f32::NAN], 2, 48_000.0, 1.0), &["sample", "NaN"]);
    refused(
        wav(&[0.0, 1.0], 2, 48_000.0, f64::NAN),
        &["full scale", "NaN"],
    );
    refused(wav(&[0.0, 3.0], 2, 48_000.0, 2.0), &["sample", "1.5"]);
}

#[test]
fn listeners_and_floors_that_are_none_are_refused() {
    let listener = config().listener;
    for channels in [0, 3] {
        let listener = Listener {
            channels,
            ..listener
        };
        refused(
            Synth::new(SynthConfig {
                listener,
                ..config()
            }),
            &["channels"],
        );
    }
    let place = DVec3::new(f64::NAN, 0.0, 0.0);
    let listener = Listener { place, ..listener };
    refused(
        Synth::new(SynthConfig {
            listener,
            ..config()
        }),
        &["listener", "NaN"],
    );
    let floor = Some(SoundFloor {
        reflection: 2.0,
        ..SoundFloor::stone(0.0)
    });
    refused(
        Synth::new(SynthConfig { floor, ..config() }),
        &["reflection", "2"],
    );
    refused(Limiter::new(0.0), &["full scale", "0"]);
    refused(Limiter::new(f64::NAN), &["full scale", "NaN"]);
}

#[test]
fn pulses_that_are_no_numbers_are_refused() {
    let (plate, body) = tile();
    let mut synth = Synth::new(config()).expect("a configuration");
    let id = synth
        .add(body, DVec3::ZERO, DQuat::IDENTITY)
        .expect("a body");
    let good = strike(&plate, 0.01);
    for (force, step, word) in [
        (f32::NAN, 1e-5, "NaN"),
        (f32::INFINITY, 1e-5, "inf"),
        (1.0, 0.0, "time step"),
        (1.0, f64::NAN, "time step"),
        (1.0, 20.0, "duration"),
    ] {
        let pulse = Arc::new(SoundPulse {
            time_step: step,
            force: vec![1.0, force],
        });
        refused(
            synth.strike(
                0.0,
                id,
                Strike {
                    pulse: pulse.clone(),
                    ..good.clone()
                },
            ),
            &["pulse", word],
        );
        refused(synth.thump(0.0, DVec3::ZERO, pulse), &["pulse", word]);
    }
    let mut push = good.push.clone();
    push[1] = f32::NAN;
    refused(
        synth.strike(
            0.0,
            id,
            Strike {
                push,
                ..good.clone()
            },
        ),
        &["push", "tile", "NaN"],
    );
    let push = vec![1.0; 3];
    refused(
        synth.strike(
            0.0,
            id,
            Strike {
                push,
                ..good.clone()
            },
        ),
        &["push", "3", "12"],
    );
    let direction = Vec3::new(0.0, f32::NAN, 0.0);
    refused(
        synth.strike(
            0.0,
            id,
            Strike {
                direction,
                ..good.clone()
            },
        ),
        &["direction"],
    );
    refused(
        synth.strike(f64::NAN, id, good.clone()),
        &["time of an event"],
    );
    refused(synth.strike(0.0, 7, good), &["body 7"]);
    let nowhere = DVec3::new(0.0, f64::NAN, 0.0);
    refused(synth.put(0.0, id, nowhere, DQuat::IDENTITY), &["place"]);
    let rotation = DQuat::from_xyzw(0.0, 0.0, 0.0, 0.0);
    refused(synth.put(0.0, id, DVec3::ZERO, rotation), &["rotation"]);
    // None of them left anything behind.
    assert!(synth.render_all(1.0).expect("samples").is_empty());
}

#[test]
fn bodies_that_are_none_are_refused() {
    let (_, body) = tile();
    let mut synth = Synth::new(config()).expect("a configuration");
    let mut add = |change: fn(&mut SoundBody)| {
        let mut body = (*body).clone();
        change(&mut body);
        synth.add(Arc::new(body), DVec3::ZERO, DQuat::IDENTITY)
    };
    refused(add(|b| b.mass = f64::NAN), &["mass", "tile"]);
    refused(add(|b| b.mass = 0.0), &["mass", "tile"]);
    refused(
        add(|b| b.modes[2].frequency = -5.0),
        &["frequency of mode 2", "-5"],
    );
    refused(
        add(|b| b.modes[0].loss = f64::INFINITY),
        &["loss of mode 0", "inf"],
    );
    refused(
        add(|b| b.modes[0].motion[3] = f32::NAN),
        &["motion of mode 0", "NaN"],
    );
    refused(
        add(|b| b.modes[0].motion.truncate(4)),
        &["motion of mode 0", "4", "49"],
    );
    refused(EquivalentSphere::of(&[]), &["area"]);
    let inside_out = SurfaceElement {
        place: DVec3::X,
        area: -DVec3::X,
    };
    refused(EquivalentSphere::of(&[inside_out]), &["inside out"]);
    refused(SoundBody::ball("ball", -1.0, 1.0), &["radius"]);
    let nothing = PlateMaterial {
        youngs_modulus: 0.0,
        poisson_ratio: 0.2,
        density: 2500.0,
        damping: AudibleDamping::default(),
    };
    refused(
        Plate::new("tile", [0.1; 3], DQuat::IDENTITY, &nothing),
        &["Young's modulus"],
    );
    refused(
        Plate::new("tile", [0.1, f64::NAN, 0.1], DQuat::IDENTITY, &nothing),
        &["side"],
    );
}

#[test]
fn a_body_without_modes_is_heard_as_it_is_shaken() {
    let mut synth = Synth::new(config()).expect("a configuration");
    let ball = Arc::new(SoundBody::ball("ball", 0.02, 0.1).expect("a ball"));
    let id = synth
        .add(ball, DVec3::ZERO, DQuat::IDENTITY)
        .expect("a body");
    let hit = Strike {
        pulse: Arc::new(SoundPulse::half_sine(0.1, 1e-4)),
        push: Vec::new(),
        direction: Vec3::Z,
    };
    synth.strike(0.0, id, hit).expect("a strike");
    let out = synth.render_all(2.0).expect("samples");
    assert!(synth.report().peak > 1e-3);
    // A click, the way and its reflection: no more than a few milliseconds.
    assert!(out.len() < 2 * 600, "{}", out.len());
}

#[test]
fn ten_thousand_contacts_at_once_are_bounded_and_told() {
    let (plate, body) = tile();
    let config = config().live();
    let mut synth = Synth::new(config).expect("a configuration");
    let ids: Vec<usize> = (0..500)
        .map(|i| {
            let place = DVec3::new(0.01 * f64::from(i % 30), 0.0, 0.0);
            synth
                .add(body.clone(), place, DQuat::IDENTITY)
                .expect("a body")
        })
        .collect();
    for k in 0..10_000 {
        let hard = strike(&plate, 1e3 * (1.0 + (k % 17) as f64));
        synth.strike(0.0, ids[k % 500], hard).expect("a strike");
    }
    let mut out = vec![0.0; 48_000];
    synth.render(&mut out);
    let report = synth.report();
    assert!(out.iter().all(|s| s.is_finite()));
    assert_eq!(report.strikes_left_out, 10_000 - 64);
    assert!(report.most_resonators <= 64 * 12);
    // Megapascals do not fit, and the limiter says so.
    let mut limiter = Limiter::new(20.0).expect("a limiter");
    assert!(out.iter().all(|&s| limiter.sample(s).abs() < 1.0));
    let report = limiter.report();
    assert!(report.limited > 0 && report.reduction > 20.0);
}

#[test]
fn the_samples_stay_inside_full_scale_whatever_comes() {
    let (plate, body) = tile();
    for impulse in [1e-9, 1e-3, 1.0, 1e6, 1e30] {
        let mut synth = Synth::new(config()).expect("a configuration");
        let id = synth
            .add(body.clone(), DVec3::ZERO, DQuat::IDENTITY)
            .expect("a body");
        synth
            .strike(0.0, id, strike(&plate, impulse))
            .expect("a strike");
        let mut out = vec![0.0; 20_000];
        synth.render(&mut out);
        assert!(out.iter().all(|s| s.is_finite()), "{impulse}");
        let mut limiter = Limiter::new(20.0).expect("a limiter");
        assert!(
            out.iter().all(|&s| limiter.sample(s).abs() < 1.0),
            "{impulse}"
        );
    }
}
