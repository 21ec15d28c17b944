//! Output of the synthesiser.

use std::f64::consts::{PI, TAU};
use std::sync::Arc;

use frangible_sound::glam::{DQuat, DVec3, Vec3};
use frangible_sound::{
    AIR_DENSITY, AudibleDamping, EquivalentSphere, HARMONICS, Hold, Listener, Mode, SPEED_OF_SOUND,
    SoundBody, SoundFloor, SoundPulse, Strike, Synth, SynthConfig, harmonic,
};

const RATE: f64 = 48_000.0;

/// A ball of 3 cm with one mode per harmonic asked for: place, frequency, Hz, and how its sphere moves, 1/√kg.
fn body(modes: &[(usize, f64, f32)], damping: AudibleDamping) -> Arc<SoundBody> {
    let sphere = EquivalentSphere::ball(0.03).expect("a ball");
    let mode = |&(place, frequency, size): &(usize, f64, f32)| {
        let mut motion = vec![0.0; HARMONICS];
        motion[place] = size;
        Mode::new(frequency, motion, &sphere, &damping, Hold::Free)
    };
    Arc::new(SoundBody {
        name: "ball".into(),
        mass: 0.3,
        modes: modes.iter().map(mode).collect(),
        sphere,
    })
}

fn glass() -> AudibleDamping {
    AudibleDamping::published("glass").expect("known").0
}

fn mono(place: DVec3) -> SynthConfig {
    let listener = Listener {
        channels: 1,
        ..Listener::at(place, DVec3::ZERO)
    };
    SynthConfig::new(listener)
}

fn balanced(push: Vec<f32>, impulse: f64, duration: f64) -> Strike {
    Strike {
        pulse: Arc::new(SoundPulse::half_sine(impulse, duration)),
        push,
        direction: Vec3::ZERO,
    }
}

/// Pressure at the listener, Pa, of one strike on a body at the origin.
fn heard(
    config: SynthConfig,
    body: &Arc<SoundBody>,
    strike: Strike,
    time: f64,
    long: f64,
) -> Vec<f64> {
    let mut synth = Synth::new(config).expect("a configuration");
    let id = synth
        .add(body.clone(), DVec3::ZERO, DQuat::IDENTITY)
        .expect("a body");
    synth.strike(time, id, strike).expect("a strike");
    let mut out = vec![0.0; (long * config.rate) as usize * config.listener.channels];
    synth.render(&mut out);
    out.iter().map(|&s| f64::from(s)).collect()
}

#[test]
fn a_mode_rings_as_the_closed_form_says() {
    // One pulsating mode, struck by a short pulse: v = J cos ωt e^{−dt/2}, p = Re(ρc ka/(ka − i) · a/r · v).
    let size = 2.0;
    let body = body(&[(harmonic(0, 0), 1000.0, size)], glass());
    let (distance, impulse, radius) = (1.5, 0.02, 0.03);
    let config = mono(DVec3::new(0.0, 0.0, distance));
    let p = heard(config, &body, balanced(vec![1.0], impulse, 2e-5), 0.0, 0.5);
    let mode = &body.modes[0];
    let omega = (TAU * 1000.0_f64).powi(2) - (0.5 * mode.loss).powi(2);
    let omega = omega.sqrt();
    let x = TAU * 1000.0 * radius / SPEED_OF_SOUND;
    // 1/(1 − i/x) = x² (1 + i/x)/(1 + x²), times the surface's velocity c_00 Y_00.
    let surface = f64::from(size) / (4.0 * PI).sqrt();
    let scale = AIR_DENSITY * SPEED_OF_SOUND * surface * radius / distance * x * x / (1.0 + x * x);
    let delay = ((distance - radius) / SPEED_OF_SOUND * RATE).round();
    let mut worst = 0.0_f64;
    for (n, &p) in p.iter().enumerate().skip(delay as usize + 10) {
        let t = (n as f64 - delay) / RATE - 1e-5;
        let decay = (-0.5 * mode.loss * t).exp();
        let wanted = scale * impulse * decay * ((omega * t).cos() - (omega * t).sin() / x);
        worst = worst.max((p - wanted).abs());
    }
    // The half-sine of 20 µs is 0.05 % below a blow of no duration; the rest is f32.
    assert!(
        worst < 2e-3 * scale * impulse / x,
        "{worst} of {}",
        scale * impulse / x
    );
    // From nothing to all of it within two samples of the arrival.
    let onset = p
        .iter()
        .position(|p| p.abs() > 0.3 * scale * impulse)
        .expect("heard");
    assert!((onset as f64 - delay).abs() <= 2.0, "{onset} {delay}");
}

#[test]
fn a_shaken_ball_sends_what_its_dipole_sends_in_the_far_field() {
    let ball = Arc::new(SoundBody::ball("ball", 0.03, 0.2).expect("a ball"));
    let (r, duration) = (2.0, 4e-3);
    // A half-sine of 40 N without corners that could be heard.
    let steps = 800;
    let force = |k: i32| 40.0 * (PI * f64::from(k) / f64::from(steps)).sin();
    let pulse = Arc::new(SoundPulse {
        time_step: duration / f64::from(steps),
        force: (1..=steps).map(|k| force(k) as f32).collect(),
    });
    let strike = Strike {
        pulse: pulse.clone(),
        push: Vec::new(),
        direction: Vec3::Z,
    };
    let p = heard(mono(DVec3::new(0.0, 0.0, r)), &ball, strike, 0.0, 0.05);
    // A slow force (k a = 0.2): p = ρ D/(4π m) (F/r² + F'/(cr)), D = 2πa³.
    let delay = ((r - 0.03) / SPEED_OF_SOUND * RATE).round();
    let size = AIR_DENSITY * 0.03_f64.powi(3) / (2.0 * 0.2);
    let (mut worst, mut peak) = (0.0_f64, 0.0_f64);
    for (n, &p) in p.iter().enumerate() {
        // The sphere answers a/c late.
        let t = (n as f64 - delay) / RATE - 0.03 / SPEED_OF_SOUND;
        let inside = t > 3e-4 && t < duration - 3e-4;
        let (force, growth) = pulse.at(t);
        let wanted = size * (force / (r * r) + growth / (SPEED_OF_SOUND * r));
        if inside {
            worst = worst.max((p - wanted).abs());
        }
        peak = peak.max(p.abs());
    }
    // The way is rounded to whole samples.
    assert!(worst < 0.02 * peak && peak > 0.0, "{worst} of {peak}");
}

#[test]
fn the_energy_that_reaches_a_sphere_of_listeners_is_what_the_mode_radiates() {
    // Of the modes of degree 0, 1 and 2, over listeners all around; against the share of the loss that is radiation.
    for (place, frequency) in [
        (harmonic(0, 0), 900.0),
        (harmonic(1, 0), 2500.0),
        (harmonic(2, 1), 6000.0),
    ] {
        let body = body(&[(place, frequency, 3.0)], glass());
        let strike = balanced(vec![1.0], 0.01, 5e-5);
        let lost = strike.energy(&body);
        let mode = &body.modes[0];
        let wanted = lost * mode.radiated / mode.loss;
        let r = 3.0;
        let (rings, around) = (16, 6);
        let mut energy = 0.0;
        for i in 0..rings {
            let z = -1.0 + 2.0 * (i as f64 + 0.5) / f64::from(rings);
            for j in 0..around {
                let angle = TAU * (f64::from(j) + 0.37) / f64::from(around);
                let level = (1.0 - z * z).sqrt();
                let place = r * DVec3::new(level * angle.cos(), level * angle.sin(), z);
                let p = heard(mono(place), &body, strike.clone(), 0.0, 2.5);
                let flux: f64 = p.iter().map(|p| p * p).sum::<f64>() / RATE;
                let area = 4.0 * PI * r * r / f64::from(rings * around);
                energy += area * flux / (AIR_DENSITY * SPEED_OF_SOUND);
            }
        }
        // Sixteen rings of a polynomial of degree four in z are 1 % off; the near field at 3 m adds 1/(kr)² of the power.
        assert!(
            (energy / wanted - 1.0).abs() < 0.02,
            "{frequency}: {energy} of {wanted} J"
        );
        assert!(energy <= lost, "{energy} of {lost} J");
    }
}

#[test]
fn onsets_come_when_the_sound_has_travelled() {
    let body = body(&[(harmonic(0, 0), 3000.0, 3.0)], glass());
    for (distance, time) in [(0.5, 0.0), (1.0, 0.1), (7.0, 0.0321), (60.0, 0.02)] {
        let config = mono(DVec3::new(distance, 0.0, 0.0));
        let p = heard(config, &body, balanced(vec![1.0], 0.1, 2e-5), time, 0.4);
        let peak = p.iter().fold(0.0_f64, |a, p| a.max(p.abs()));
        let onset = p.iter().position(|p| p.abs() > 0.1 * peak).expect("heard") as f64 / RATE;
        let wanted = time + (distance - 0.03) / SPEED_OF_SOUND;
        assert!(
            (onset - wanted).abs() < 1e-4,
            "{distance}: {onset} {wanted}"
        );
    }
}

#[test]
fn ten_times_the_force_is_twenty_decibels_louder() {
    let body = body(
        &[(harmonic(2, 0), 2000.0, 3.0), (harmonic(1, 0), 5000.0, 2.0)],
        glass(),
    );
    let config = mono(DVec3::new(0.3, 0.1, 1.0));
    let level = |impulse: f64| {
        let p = heard(
            config,
            &body,
            balanced(vec![1.0, 0.5], impulse, 1e-4),
            0.0,
            0.3,
        );
        10.0 * p.iter().map(|p| p * p).sum::<f64>().log10()
    };
    assert!((level(0.05) - level(0.005) - 20.0).abs() < 0.05);
}

#[test]
fn a_hard_floor_doubles_what_comes_along_it_and_ears_hear_their_side_first() {
    let body = body(&[(harmonic(0, 0), 500.0, 3.0)], glass());
    let strike = || balanced(vec![1.0], 0.01, 1e-4);
    let free = mono(DVec3::new(3.0, 0.01, 0.0));
    let floor = SynthConfig {
        floor: Some(SoundFloor {
            reflection: 1.0,
            ..SoundFloor::stone(0.0)
        }),
        ..free
    };
    let energy = |p: &[f64]| p.iter().map(|p| p * p).sum::<f64>();
    let ratio = energy(&heard(floor, &body, strike(), 0.0, 0.2))
        / energy(&heard(free, &body, strike(), 0.0, 0.2));
    assert!((ratio - 4.0).abs() < 0.1, "{ratio}");
    // The body is to the right of the head.
    let listener = Listener {
        right: DVec3::X,
        ..Listener::at(DVec3::new(-2.0, 0.0, 0.0), DVec3::ZERO)
    };
    let p = heard(SynthConfig::new(listener), &body, strike(), 0.0, 0.05);
    let onset = |channel: usize| {
        p.iter()
            .skip(channel)
            .step_by(2)
            .position(|p| p.abs() > 1e-2)
    };
    let (left, right) = (onset(0).expect("left"), onset(1).expect("right"));
    // 18 cm are 25 samples.
    assert!((23..=27).contains(&(left - right)), "{left} {right}");
}

#[test]
fn how_many_samples_are_asked_for_changes_nothing() {
    let body = body(
        &[(harmonic(0, 0), 700.0, 3.0), (harmonic(2, 2), 4321.0, 9.0)],
        glass(),
    );
    let run = |sizes: &[usize]| {
        let mut synth = Synth::new(mono(DVec3::new(0.0, 1.0, 1.0))).expect("a configuration");
        let id = synth
            .add(body.clone(), DVec3::ZERO, DQuat::IDENTITY)
            .expect("a body");
        for k in 0..5 {
            let strike = balanced(vec![1.0, -1.0], 0.01, 3e-4);
            synth
                .strike(0.013 * f64::from(k), id, strike)
                .expect("a strike");
        }
        synth
            .put(0.02, id, DVec3::new(0.2, 0.0, 0.0), DQuat::IDENTITY)
            .expect("a place");
        let mut out = vec![0.0; 9000];
        let (mut from, mut k) = (0, 0);
        while from < out.len() {
            let to = (from + sizes[k % sizes.len()]).min(out.len());
            synth.render(&mut out[from..to]);
            (from, k) = (to, k + 1);
        }
        out
    };
    let whole = run(&[9000]);
    assert!(whole.iter().any(|&s| s != 0.0));
    assert_eq!(whole, run(&[1, 64, 127, 1000]));
}

#[test]
fn a_floor_takes_a_shake_across_it_away_and_doubles_one_along_it() {
    // Pressures of a dipole and of its image in a rigid floor: shaken up and down the image moves against it, along the floor with it. The ball
    // lies far nearer to the floor than a wave is long, so that nothing is left of the one and twice as much of the other.
    let ball = Arc::new(SoundBody::ball("ball", 0.005, 0.2).expect("a ball"));
    let floor = SoundFloor {
        reflection: 1.0,
        ..SoundFloor::stone(-0.005)
    };
    let steps = 800;
    let pulse = Arc::new(SoundPulse {
        time_step: 4e-3 / f64::from(steps),
        force: (1..=steps)
            .map(|k| 40.0 * (PI * f64::from(k) / f64::from(steps)).sin() as f32)
            .collect(),
    });
    let energy = |floor: Option<SoundFloor>, direction: Vec3| {
        let config = SynthConfig {
            floor,
            ..mono(DVec3::new(1.0, 0.7, 0.0))
        };
        let strike = Strike {
            pulse: pulse.clone(),
            push: Vec::new(),
            direction,
        };
        let p = heard(config, &ball, strike, 0.0, 0.05);
        p.iter().map(|p| p * p).sum::<f64>()
    };
    let gain = |direction| energy(Some(floor), direction) / energy(None, direction);
    let (across, along) = (gain(Vec3::Y), gain(Vec3::X));
    // The delays are whole samples, 7 mm apart, which is more than the way from the ball to its image and back.
    assert!(across < 0.02, "{across}");
    assert!((along / 4.0 - 1.0).abs() < 0.05, "{along}");
}
