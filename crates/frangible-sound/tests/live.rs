//! The budget of a game: bounded, without clicks, silent in the end.

use std::sync::Arc;

use crate::common::plate;
use frangible_sound::glam::{DQuat, DVec3, Vec3};
use frangible_sound::{Listener, Plate, SoundBody, SoundPulse, Strike, Synth, SynthConfig};

fn shard(sides: [f64; 3]) -> (Plate, Arc<SoundBody>) {
    let (plate, body) = plate(sides);
    (plate, Arc::new(body))
}

fn config() -> SynthConfig {
    let listener = Listener {
        channels: 1,
        ..Listener::at(DVec3::new(0.0, 0.4, 1.0), DVec3::ZERO)
    };
    SynthConfig::new(listener)
}

fn strike(plate: &Plate, impulse: f64) -> Strike {
    Strike {
        pulse: Arc::new(SoundPulse::half_sine(impulse, 1e-4)),
        push: plate.push(Vec3::new(0.04, 0.03, 0.0), Vec3::Z),
        direction: Vec3::Z,
    }
}

/// Rings of fifty plates of different sizes, struck one after the other.
fn clatter(config: SynthConfig) -> (Synth, Vec<f32>) {
    let mut synth = Synth::new(config).expect("a configuration");
    for i in 0..50 {
        let side = 0.05 + 0.002 * f64::from(i);
        let (plate, body) = shard([side, 0.8 * side, 0.004]);
        let id = synth
            .add(body, DVec3::ZERO, DQuat::IDENTITY)
            .expect("a body");
        let hit = strike(&plate, 2e-3);
        synth
            .strike(0.004 * f64::from(i), id, hit)
            .expect("a strike");
    }
    let mut out = vec![0.0; 2 * 48_000];
    synth.render(&mut out);
    (synth, out)
}

#[test]
fn a_budget_is_kept_and_costs_the_quiet_ones() {
    let (whole, all) = clatter(config());
    let (kept, some) = clatter(SynthConfig {
        budget: 60,
        ..config()
    });
    let report = kept.report();
    let free = whole.report();
    assert!(
        free.most_resonators > 100 && free.over_budget == 0,
        "{free:?}"
    );
    // What comes within a block fades within it.
    assert!(report.most_resonators <= 60 + 12 * 2, "{report:?}");
    assert!(report.over_budget > 30, "{report:?}");
    let energy = |out: &[f32]| out.iter().map(|s| f64::from(s * s)).sum::<f64>();
    let ratio = energy(&some) / energy(&all);
    assert!((0.7..1.1).contains(&ratio), "{ratio}");
}

#[test]
fn what_is_taken_away_does_not_click() {
    // A low tone of one plate; all its resonators are taken away while it rings.
    let (plate, body) = shard([0.3, 0.25, 0.004]);
    let ring = |hush: bool| {
        let mut synth = Synth::new(config()).expect("a configuration");
        let id = synth
            .add(body.clone(), DVec3::ZERO, DQuat::IDENTITY)
            .expect("a body");
        synth
            .strike(0.0, id, strike(&plate, 1e-2))
            .expect("a strike");
        if hush {
            synth.hush(0.3, id).expect("a body");
        }
        let mut out = vec![0.0; 24_000];
        synth.render(&mut out);
        out
    };
    // A click is a jump from one sample to the next.
    let jump = |out: &[f32]| {
        let step = |w: &[f32]| (w[1] - w[0]).abs();
        out.windows(2).map(step).fold(0.0_f32, f32::max)
    };
    let (rings, ends) = (ring(false), ring(true));
    let at = (0.29 * 48_000.0) as usize;
    // The fade over 128 samples is itself a slope.
    let (fades, sounds) = (jump(&ends[at..]), jump(&rings[at..]));
    assert!(fades <= 1.3 * sounds, "{fades} {sounds}");
    assert!(ends[at + 2000..].iter().all(|&s| s == 0.0));
    assert!(rings[at + 2000..].iter().any(|&s| s != 0.0));
}

#[test]
fn it_falls_silent_without_denormal_numbers() {
    let (plate, body) = shard([0.08, 0.06, 0.003]);
    let mut synth = Synth::new(config()).expect("a configuration");
    let id = synth
        .add(body, DVec3::ZERO, DQuat::IDENTITY)
        .expect("a body");
    synth
        .strike(0.0, id, strike(&plate, 1e-3))
        .expect("a strike");
    let out = synth.render_all(60.0).expect("samples");
    assert!(synth.is_silent() && synth.resonators() == 0);
    assert!(out.len() < 30 * 48_000);
    assert!(out.iter().all(|s| *s == 0.0 || s.is_normal()));
    let mut after = vec![1.0; 5000];
    synth.render(&mut after);
    assert!(after.iter().all(|&s| s == 0.0));
}

#[test]
fn a_number_is_given_again_after_a_body_was_removed() {
    let (plate, body) = shard([0.08, 0.06, 0.003]);
    let mut synth = Synth::new(config()).expect("a configuration");
    let id = synth
        .add(body.clone(), DVec3::ZERO, DQuat::IDENTITY)
        .expect("a body");
    synth
        .strike(0.1, id, strike(&plate, 1e-3))
        .expect("a strike");
    synth.remove(id).expect("a body");
    assert!(synth.strike(0.0, id, strike(&plate, 1e-3)).is_err());
    assert_eq!(synth.add(body, DVec3::ZERO, DQuat::IDENTITY), Ok(id));
    // The strike on the former body is not heard.
    assert!(synth.render_all(1.0).expect("samples").is_empty());
}
