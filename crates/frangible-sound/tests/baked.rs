//! Baked bodies, struck and heard: partials against closed forms, decay against the damping.

use std::f64::consts::TAU;
use std::sync::Arc;

use frangible::{Breakable, Material};
use frangible_bake::{BakeSpec, Shape, bake};
use frangible_sound::glam::{DQuat, DVec3, Vec3};
use frangible_sound::{
    AssetSound, AudibleDamping, Hold, Listener, SoundBody, SoundPulse, Strike, Synth, SynthConfig,
};

const RATE: f64 = 48_000.0;

/// A baked body ready to sound, of few elements and modes.
fn baked(shape: Shape, material: Material) -> (AssetSound, SoundBody) {
    let damping = AudibleDamping::of(&material);
    let spec = BakeSpec {
        modes: 24,
        followed: Some(24),
        ..BakeSpec::for_games("body", shape, material).expect("a shape")
    };
    let asset = bake(&spec).expect("a bake");
    let kind = Breakable::uniform(Arc::new(asset)).expect("a kind");
    AssetSound::new(&kind.body(1), &damping, Hold::Free).expect("a sound")
}

/// Sound pressure of a blow at 1 m, Pa.
fn heard(body: &SoundBody, push: Vec<f32>) -> Vec<f64> {
    let listener = Listener {
        channels: 1,
        ..Listener::at(DVec3::new(0.5, 0.4, 0.75), DVec3::ZERO)
    };
    let mut synth = Synth::new(SynthConfig::new(listener)).expect("a configuration");
    let id = synth
        .add(Arc::new(body.clone()), DVec3::ZERO, DQuat::IDENTITY)
        .expect("a body");
    let strike = Strike {
        pulse: Arc::new(SoundPulse::half_sine(0.01, 1e-4)),
        push,
        direction: Vec3::ZERO,
    };
    synth.strike(0.0, id, strike).expect("a strike");
    let mut out = vec![0.0; 48_000];
    synth.render(&mut out);
    out.iter().map(|&s| f64::from(s)).collect()
}

/// Amplitude at a frequency, Hz, under Hann's window.
fn amplitude(samples: &[f64], frequency: f64) -> f64 {
    let n = samples.len() as f64;
    let (mut re, mut im) = (0.0, 0.0);
    for (k, sample) in samples.iter().enumerate() {
        let window = 0.5 - 0.5 * (TAU * (k as f64 + 0.5) / n).cos();
        let (sin, cos) = (TAU * frequency * k as f64 / RATE).sin_cos();
        (re, im) = (re + window * sample * cos, im + window * sample * sin);
    }
    4.0 * re.hypot(im) / n
}

/// The frequency of the strongest tone within 6 % of one, Hz.
fn tone(samples: &[f64], about: f64) -> f64 {
    let tones = (-120..=120).map(|k| about * (1.0 + 5e-4 * f64::from(k)));
    let level = |f: &f64| amplitude(&samples[..24_000], *f);
    tones
        .max_by(|a, b| level(a).total_cmp(&level(b)))
        .expect("some")
}

#[test]
fn a_free_bar_sounds_its_partials_and_dies_away_as_its_damping_says() {
    let glass = Material::preset("glass").expect("known");
    let (length, high) = (0.3, 0.008);
    let speed = (glass.youngs_modulus / glass.density).sqrt();
    let (shape, body) = baked(Shape::block([length, 0.012, high]), glass.clone());
    let push = shape.push(Vec3::new(0.149, 0.0, 0.004), Vec3::NEG_Z);
    let samples = heard(&body, push);
    let damping = AudibleDamping::of(&glass);
    for root in [4.730_041, 7.853_205, 10.995_608_f64] {
        // Euler and Bernoulli, less the shear and rotation of a section to first order.
        let thin = root * root / (TAU * length * length) * speed * high / 12.0_f64.sqrt();
        let wave = (root * high / length).powi(2) / 12.0;
        let wanted = thin / (1.0 + wave * (1.0 + 2.4 * 1.23)).sqrt();
        let found = tone(&samples, wanted);
        assert!((found / wanted - 1.0).abs() < 0.015, "{found} {wanted}");
        // From 0.05 s to 0.4 s after the blow.
        let level = |from: usize| amplitude(&samples[from..from + 9600], found);
        let rate = 2.0 * (level(2400) / level(19_200)).ln() / 0.35;
        let mode = body.modes.iter().min_by(|a, b| {
            let off = |f: f64| (f / found - 1.0).abs();
            off(a.frequency).total_cmp(&off(b.frequency))
        });
        let mode = mode.expect("a mode");
        let material = damping.loss(TAU * found);
        assert!((mode.loss - mode.radiated) / material - 1.0 < 0.01);
        assert!(
            (rate / mode.loss - 1.0).abs() < 0.03,
            "{rate} {}",
            mode.loss
        );
        assert!(mode.radiated < 0.5 * mode.loss);
    }
}

#[test]
fn a_free_square_plate_sounds_its_partials() {
    let mut porcelain = Material::preset("porcelain").expect("known");
    porcelain.poisson_ratio = 0.3;
    let (side, high, nu) = (0.15, 0.003, 0.3_f64);
    let speed = (porcelain.youngs_modulus / porcelain.density / (1.0 - nu * nu)).sqrt();
    let (shape, body) = baked(Shape::plate(side, side, high), porcelain);
    let push = shape.push(Vec3::new(0.07, 0.055, 0.0015), Vec3::NEG_Z);
    let samples = heard(&body, push);
    // Leissa, J. Sound Vib. 31, 1973: free edges, ν = 0.3.
    for parameter in [13.489, 19.789, 24.432] {
        let wanted = parameter / (TAU * side * side) * speed * high / 12.0_f64.sqrt();
        let found = tone(&samples, wanted);
        assert!((found / wanted - 1.0).abs() < 0.02, "{found} {wanted}");
    }
}
