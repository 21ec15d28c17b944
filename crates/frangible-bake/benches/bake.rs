//! Stages of baking the drinking glass: `cargo bench -p frangible-bake`.

use std::hint::black_box;
use std::ops::ControlFlow;

use criterion::{Criterion, criterion_group, criterion_main};
use frangible::Material;
use frangible_bake::eigen::lowest_modes;
use frangible_bake::embed::Locator;
use frangible_bake::fem::{Elasticity, Elements, QuadraticMesh, assemble};
use frangible_bake::{BakeSpec, Shape, bake};

fn stages(c: &mut Criterion) {
    let glass = Shape::drinking_glass();
    let material = Material::preset("glass").expect("a built-in material");
    let size = glass.fracture_size().expect("a sound shape");
    let coarse = glass
        .analysis_mesh(glass.analysis_size().expect("a sound shape"))
        .expect("a sound mesh");
    let fine = glass.fracture_mesh(size, 1).expect("a sound mesh");
    let mesh = QuadraticMesh::new(&coarse);
    let elasticity = Elasticity::from(&material);
    let system = assemble(
        &mesh.positions,
        Elements::Quadratic(&mesh.elements),
        &elasticity,
    );
    let locator = Locator::new(&mesh);

    let mut group = c.benchmark_group("bake glass");
    group.sample_size(10);
    group.bench_function("fracture mesh", |b| {
        b.iter(|| glass.fracture_mesh(black_box(size), 1));
    });
    group.bench_function("assemble", |b| {
        b.iter(|| {
            assemble(
                &mesh.positions,
                Elements::Quadratic(&mesh.elements),
                &elasticity,
            )
        });
    });
    group.bench_function("120 modes", |b| {
        b.iter(|| lowest_modes(&system, black_box(120), &mut |_| ControlFlow::Continue(())));
    });
    group.bench_function("embed nodes", |b| {
        b.iter(|| {
            fine.positions
                .iter()
                .filter(|&&p| locator.embed(p).is_ok())
                .count()
        });
    });
    let spec = BakeSpec::new("glass", glass.clone(), material.clone());
    group.bench_function("everything", |b| {
        b.iter(|| bake(black_box(&spec)));
    });
    group.finish();
}

criterion_group!(benches, stages);
criterion_main!(benches);
