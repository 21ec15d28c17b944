//! Cost of one call of `frangible::impact`: a break, a blow that holds, a pane in pieces.

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use frangible::{Breakable, FractureConfig, Outcome, impact};

#[allow(dead_code, reason = "shared with the tests")]
#[path = "../tests/common/mod.rs"]
mod common;

fn breaks(c: &mut Criterion) {
    let config = FractureConfig::default();
    let mut group = c.benchmark_group("impact");
    group.sample_size(10);
    for (name, asset, contact, held) in [
        (
            "glass breaks",
            common::glass(),
            common::rim_hit(20.0, 10.0),
            false,
        ),
        (
            "glass holds",
            common::glass(),
            common::rim_hit(20.0, 0.2),
            true,
        ),
        (
            "pane breaks",
            common::pane(),
            common::pane_hit(0.0, 0.0, 12.0),
            false,
        ),
    ] {
        let body = Breakable::uniform(asset.clone())
            .expect("a sound asset")
            .body(1);
        let outcome =
            impact(&body, std::slice::from_ref(&contact), &config).expect("a sound contact");
        assert_eq!(matches!(outcome, Outcome::Held { .. }), held, "{name}");
        group.bench_function(name, |b| {
            b.iter(|| {
                impact(
                    black_box(&body),
                    black_box(std::slice::from_ref(&contact)),
                    &config,
                )
            });
        });
    }
    group.finish();
}

criterion_group!(benches, breaks);
criterion_main!(benches);
