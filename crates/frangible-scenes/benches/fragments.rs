//! Cost of the stages after the cracks, by their own clocks: labels, and partition with surfaces and masses.
//!
//! A glass and a pane in pieces, and one block of few elements and of many.

use std::hint::black_box;
use std::sync::Arc;
use std::time::Duration;

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use frangible::glam::Vec3;
use frangible::internals::StageTimings;
use frangible::{Asset, Breakable, Contact, FractureConfig, Material, impact};
use frangible_bake::{BakeSpec, Shape, bake};

#[allow(dead_code, reason = "shared with the tests")]
#[path = "../tests/common/mod.rs"]
mod common;

/// A block of about this many tetrahedra.
/// Reads one stage's time, s.
type Clock = fn(&StageTimings) -> f64;

fn block(tets: f64) -> Arc<Asset> {
    let shape = Shape::block([0.21, 0.1, 0.05]);
    let size = shape.size_for(tets).expect("a sound shape");
    let brick = Material::preset("brick").expect("a preset");
    let spec = BakeSpec {
        modes: 20,
        fracture: Some(size),
        ..BakeSpec::new("block", shape, brick)
    };
    Arc::new(bake(&spec).expect("a sound body"))
}

/// The block lands on its corner.
fn corner_hit(asset: &Asset, speed: f64) -> Contact {
    let corner = Vec3::new(0.105, 0.05, -0.025);
    common::blow(asset, corner, -corner, speed, common::stone_floor())
}

fn stages(c: &mut Criterion) {
    let config = FractureConfig::default();
    let (small, large) = (block(8000.0), block(175_000.0));
    let cases = [
        ("glass", common::glass(), common::rim_hit(20.0, 10.0)),
        ("pane", common::pane(), common::pane_hit(0.0, 0.0, 12.0)),
        ("block 8k", &small, corner_hit(&small, 6.0)),
        ("block 175k", &large, corner_hit(&large, 6.0)),
    ];
    let clocks: [(&str, Clock); 2] = [("labels", |t| t.labels), ("fragments", |t| t.fragments)];
    for (stage, clock) in clocks {
        let mut group = c.benchmark_group(stage);
        group.sample_size(10);
        for (name, asset, contact) in &cases {
            let body = Breakable::uniform(Arc::clone(asset))
                .expect("a sound asset")
                .body(1);
            let time = || {
                let outcome = impact(
                    black_box(&body),
                    black_box(std::slice::from_ref(contact)),
                    &config,
                );
                clock(&outcome.expect("a sound contact").report().timings)
            };
            group.bench_function(BenchmarkId::from_parameter(name), |b| {
                b.iter_custom(|rounds| (0..rounds).map(|_| Duration::from_secs_f64(time())).sum());
            });
        }
        group.finish();
    }
}

criterion_group!(benches, stages);
criterion_main!(benches);
