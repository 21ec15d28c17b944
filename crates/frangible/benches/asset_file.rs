//! Cost of loading and saving an asset of the default size, and of what that consists of.

use std::hint::black_box;
use std::path::Path;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use frangible::Asset;
use frangible::internals::TetMesh;
use frangible::internals::asset::seal;

#[allow(dead_code, reason = "shared with the tests")]
#[path = "../tests/common/mod.rs"]
mod common;
use common::{Size, synthetic_asset};

fn asset_file(c: &mut Criterion) {
    let asset = synthetic_asset(&Size {
        cubes: 19,
        analysis_nodes: 6000,
        elements: 3000,
        modes: 120,
    });
    let bytes = asset.to_bytes();
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join("bench.frangible");
    asset.save(&path).unwrap();
    println!(
        "{} tetrahedra, {:.2} MB",
        asset.fracture().tets.len(),
        bytes.len() as f64 / 1e6
    );

    let mut group = c.benchmark_group("asset_file");
    group.throughput(Throughput::Bytes(bytes.len() as u64));
    group.bench_function("load", |b| b.iter(|| Asset::load(&path).unwrap()));
    group.bench_function("save", |b| b.iter(|| asset.save(&path).unwrap()));
    group.bench_function("from_bytes", |b| {
        b.iter(|| Asset::from_bytes(black_box(&bytes)).unwrap());
    });
    group.bench_function("to_bytes", |b| b.iter(|| black_box(&asset).to_bytes()));
    group.bench_function("validate", |b| b.iter(|| black_box(&asset).validate()));
    let mut sealed = bytes.clone();
    group.bench_function("checksum", |b| b.iter(|| seal(black_box(&mut sealed))));
    group.finish();
    // What storing the adjacency saves.
    let mesh = asset.fracture();
    c.bench_function("rebuild_adjacency", |b| {
        b.iter(|| TetMesh::new(mesh.positions.clone(), mesh.tets.clone()));
    });
    let _ = std::fs::remove_file(&path);
}

criterion_group!(benches, asset_file);
criterion_main!(benches);
