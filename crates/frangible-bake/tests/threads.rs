//! A break on several threads is the break on one, bit for bit.

use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use frangible::glam::Vec3;
use frangible::internals::{Pool, Threads};
use frangible::{Body, Breakable, Contact, FractureConfig, Material, Outcome, Striker, impact};
use frangible_bake::{BakeSpec, ImportOptions, Shape, bake, import_mesh};

use crate::clipped_render::ball;
use crate::common::breakable;

/// So many threads, started anew for each task.
struct Started {
    count: usize,
    tasks: AtomicUsize,
}

impl Pool for Started {
    fn threads(&self) -> usize {
        self.count
    }

    fn run(&self, workers: usize, work: &(dyn Fn(usize) + Sync)) {
        self.tasks.fetch_add(1, Ordering::Relaxed);
        std::thread::scope(|scope| {
            for worker in 0..workers {
                scope.spawn(move || work(worker));
            }
        });
    }
}

/// Everything that a blow on a body leaves, as bits.
fn outcome(body: &Body, hit: &Contact, threads: Threads) -> Vec<u64> {
    let mut config = FractureConfig::default();
    config.threads = threads;
    let outcome = impact(body, std::slice::from_ref(hit), &config).expect("an outcome");
    let report = outcome.report();
    let mut bits = vec![
        report.peak_stress.to_bits(),
        report.stress_bound.to_bits(),
        report.crack_area.to_bits(),
    ];
    match &outcome {
        Outcome::Held { margin, state, .. } => {
            bits.push(margin.to_bits());
            let bytes = state.iter().flat_map(|state| state.to_bytes());
            bits.extend(bytes.map(u64::from));
        }
        Outcome::Broke(fracture) => {
            for fragment in &fracture.fragments {
                bits.push(fragment.mass.mass.to_bits());
                let mesh = &fragment.mesh;
                bits.extend(
                    mesh.positions
                        .iter()
                        .flat_map(|p| p.to_array())
                        .map(|x| u64::from(x.to_bits())),
                );
                bits.extend(mesh.triangles.iter().flatten().map(|&v| u64::from(v)));
                if let Some(drawn) = &fragment.render {
                    let places = drawn.positions.iter().flat_map(|p| p.to_array());
                    bits.extend(places.map(|x| u64::from(x.to_bits())));
                    bits.extend(drawn.triangles.iter().flatten().map(|&v| u64::from(v)));
                }
            }
        }
        _ => panic!("an outcome of another kind"),
    }
    bits
}

/// A ball of glass with the surface of its mesh.
fn drawn() -> Body {
    let mut options = ImportOptions::default();
    options.tets = 12_000;
    let imported = import_mesh(&ball(24), &options).expect("an import");
    let spec = BakeSpec {
        modes: 20,
        render: imported.render,
        ..BakeSpec::new(
            "ball",
            imported.shape,
            Material::preset("glass").expect("a preset"),
        )
    };
    let asset = bake(&spec).expect("a baked ball");
    Breakable::uniform(Arc::new(asset))
        .expect("a sound asset")
        .body(3)
}

#[test]
fn a_break_on_several_threads_is_the_same() {
    let bodies = [
        breakable(Shape::plate(0.3, 0.3, 0.004), "glass", 40_000.0, 40).body(3),
        breakable(Shape::block([0.2, 0.1, 0.06]), "brick", 20_000.0, 20).body(3),
        drawn(),
    ];
    let steel = Material::preset("steel").expect("a preset");
    let (mut broke, mut tasks) = (0, 0);
    for body in &bodies {
        for speed in [0.5, 3.0, 100.0] {
            let ball = Striker::ball(&steel, 0.25, 0.02);
            let point = Vec3::new(0.01, 0.02, 1.0);
            let hit = Contact::collision(body.asset(), point, Vec3::NEG_Z, speed, ball);
            let one = outcome(body, &hit, Threads::default());
            broke += usize::from(one.len() > 1000);
            for count in [2, 5] {
                let pool = Arc::new(Started {
                    count,
                    tasks: AtomicUsize::new(0),
                });
                let many = outcome(body, &hit, Threads::of(pool.clone()));
                assert!(one == many, "{count} threads, {speed} m/s");
                tasks += pool.tasks.load(Ordering::Relaxed);
            }
        }
    }
    assert!(broke >= 4 && tasks > 50, "{broke} {tasks}");
}
