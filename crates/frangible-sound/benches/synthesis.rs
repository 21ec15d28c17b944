//! Time of the synthesis: per sample and resonator, and of a game's second.

use std::hint::black_box;
use std::sync::Arc;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use frangible_sound::glam::{DQuat, DVec3, Vec3};
use frangible_sound::{
    AudibleDamping, Listener, Plate, PlateMaterial, SoundPulse, Strike, Synth, SynthConfig,
};

const GLASS: PlateMaterial = PlateMaterial {
    youngs_modulus: 71e9,
    poisson_ratio: 0.23,
    density: 2500.0,
    damping: AudibleDamping {
        mass: 1.0,
        stiffness: 1e-7,
        loss_factor: 0.0,
    },
};

/// A number of shards, struck so hard that all of them ring on.
fn ringing(config: SynthConfig, shards: usize, impulse: f64) -> Synth {
    let mut synth = Synth::new(config).expect("a configuration");
    for i in 0..shards {
        let side = 0.06 + 0.0004 * i as f64;
        let sides = [side, 0.8 * side, 0.003];
        let (plate, body) = Plate::new("shard", sides, DQuat::IDENTITY, &GLASS).expect("a plate");
        let place = DVec3::new(0.01 * (i % 20) as f64, 0.0, 0.01 * (i / 20) as f64);
        let id = synth
            .add(Arc::new(body), place, DQuat::IDENTITY)
            .expect("a body");
        let strike = Strike {
            pulse: Arc::new(SoundPulse::half_sine(impulse, 1e-4)),
            push: plate.push(Vec3::new(0.3 * side as f32, 0.01, 0.0), Vec3::Z),
            direction: Vec3::Z,
        };
        synth
            .strike(0.0005 * (i % 10) as f64, id, strike)
            .expect("a strike");
    }
    let mut first = vec![0.0; 2 * 2000];
    synth.render(&mut first);
    synth
}

fn config() -> SynthConfig {
    SynthConfig::new(Listener::at(DVec3::new(0.0, 0.4, 1.5), DVec3::ZERO))
}

/// Cost of resonators by themselves, against the plain filters that everybody would write first.
fn plain(c: &mut Criterion) {
    let mut group = c.benchmark_group("one sample of one resonator");
    let count = 200;
    group.throughput(Throughput::Elements(count as u64 * 128));
    group.bench_function("plain two-pole filters, f32", |b| {
        let coefficients: Vec<[f32; 2]> = (0..count)
            .map(|i| {
                let angle = 0.01 + 0.01 * i as f32;
                [2.0 * 0.9999 * angle.cos(), -0.9999 * 0.9999]
            })
            .collect();
        let mut state = vec![[1.0_f32, 0.5]; count];
        let mut out = [0.0_f32; 128];
        b.iter(|| {
            for (c, y) in coefficients.iter().zip(&mut state) {
                for out in &mut out {
                    let new = c[0] * y[0] + c[1] * y[1];
                    *y = [new, y[0]];
                    *out += new;
                }
                // Held up, lest they die away into denormal numbers.
                y[0] += 1e-3;
            }
            black_box(&out);
        });
    });
    let synth = ringing(config(), 17, 10.0);
    let resonators = synth.resonators();
    group.throughput(Throughput::Elements(resonators as u64 * 128));
    let name = format!("frangible-sound, {resonators} resonators of 17 shards, stereo");
    group.bench_function(name, |b| {
        let mut out = [0.0_f32; 2 * 128];
        b.iter_batched_ref(
            || synth.clone(),
            |synth| synth.render(black_box(&mut out)),
            criterion::BatchSize::SmallInput,
        );
    });
    group.finish();
}

/// A hundredth of a second of 200 shards that ring, within the budget of a game: times 100 is the share of a core.
fn game(c: &mut Criterion) {
    let mut group = c.benchmark_group("10 ms of 200 ringing shards");
    for (name, config) in [("live budget", config().live()), ("all", config())] {
        let synth = ringing(config, 200, 0.05);
        let name = format!("{name}: {} resonators", synth.resonators());
        group.bench_function(name, |b| {
            let mut out = vec![0.0_f32; 2 * 480];
            b.iter_batched_ref(
                || synth.clone(),
                |synth| synth.render(black_box(&mut out)),
                criterion::BatchSize::LargeInput,
            );
        });
    }
    group.finish();
}

criterion_group!(benches, plain, game);
criterion_main!(benches);
