//! Each stage on a small pane: first bound, response, u = Φ q, stresses at weak points, propagation, fragments.

use std::hint::black_box;
use std::time::Duration;

use criterion::{Criterion, criterion_group, criterion_main};
use frangible::FractureConfig;
use frangible::internals::StageTimings;
use frangible_lab::bench::stages::{Bench, Depth, small_body};

fn stages(c: &mut Criterion) {
    let bench = Bench::new(small_body().expect("the pane bakes")).expect("the pane is sound");
    bench.check().expect("the blows do as meant");
    let mut group = c.benchmark_group("stage");
    group
        .sample_size(20)
        .measurement_time(Duration::from_secs(2))
        .warm_up_time(Duration::from_millis(500));
    group.bench_function("first bound", |b| {
        b.iter(|| bench.asked(black_box(Depth::Impulse)));
    });
    group.bench_function("refused by amplitudes", |b| {
        b.iter(|| bench.asked(black_box(Depth::Amplitudes)));
    });
    group.bench_function("looked at, holds", |b| {
        b.iter(|| bench.asked(black_box(Depth::Stresses)));
    });
    group.bench_function("response of the modes", |b| b.iter(|| bench.response()));
    group.bench_function("displacements, 64 steps", |b| {
        b.iter(|| bench.displacements());
    });
    let mut middle = bench.middle();
    group.bench_function("stresses at weak points, one step", |b| {
        b.iter(|| bench.stresses(black_box(&mut middle)));
    });
    let models = [("paper's model", &bench.paper), ("our model", &bench.ours)];
    for (model, config) in models {
        // These stages have no function of their own: the report of the whole impact has their times.
        let mut reported = |stage: &str, part: fn(StageTimings) -> f64| {
            group.bench_function(format!("{stage}, {model}"), |b| {
                b.iter_custom(|runs| seconds(&bench, config, runs, part));
            });
        };
        reported("stresses and propagation", |t| t.cracks);
        reported("fragments", |t| t.fragments);
        group.bench_function(format!("break, {model}"), |b| {
            b.iter(|| bench.broken(config));
        });
    }
    group.finish();
}

fn seconds(
    bench: &Bench,
    config: &FractureConfig,
    runs: u64,
    part: fn(StageTimings) -> f64,
) -> Duration {
    let all: f64 = (0..runs).map(|_| part(bench.broken(config))).sum();
    Duration::from_secs_f64(all)
}

criterion_group!(benches, stages);
criterion_main!(benches);
