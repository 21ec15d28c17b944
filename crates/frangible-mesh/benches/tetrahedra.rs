//! The mesher's stages: solids to tetrahedra, by signed distance and by mesh.

use criterion::{Criterion, criterion_group, criterion_main};
use frangible_mesh::{
    DistanceSolid, MeshSolid, Resolution, Surface, TetOptions, ready_shape, tetrahedralize,
};
use glam::DVec3;

fn options(tets: usize) -> TetOptions {
    let mut options = TetOptions::default();
    options.resolution = Resolution::Tets(tets);
    options.irregular = Some(1);
    options
}

fn distances(c: &mut Criterion) {
    let mut group = c.benchmark_group("tetrahedralize");
    group.sample_size(10);
    let ball = DistanceSolid::sphere(DVec3::ZERO, 0.05);
    group.bench_function("ball 20k", |b| {
        b.iter(|| tetrahedralize(&ball, &options(20_000)));
    });
    for name in ["rabbit", "piggy_bank"] {
        if let Some(shape) = ready_shape(name) {
            group.bench_function(format!("{name} 40k"), |b| {
                b.iter(|| tetrahedralize(&shape, &options(40_000)));
            });
        }
    }
    group.finish();
}

/// A ball of about 70 000 triangles stands for a scanned mesh.
fn meshes(c: &mut Criterion) {
    let surface = ball_of_triangles(187);
    let mut group = c.benchmark_group("mesh");
    group.sample_size(10);
    group.bench_function("70k triangles to a solid", |b| {
        b.iter(|| MeshSolid::new(&surface));
    });
    if let Ok(solid) = MeshSolid::new(&surface) {
        group.bench_function("70k triangles, 20k tetrahedra", |b| {
            b.iter(|| tetrahedralize(&solid, &options(20_000)));
        });
    }
    group.finish();
}

/// Rings × 2 rings of a unit sphere.
fn ball_of_triangles(rings: u32) -> Surface {
    let sectors = rings;
    let mut surface = Surface::default();
    for i in 0..=rings {
        for j in 0..sectors {
            let (polar, turn) = (
                std::f64::consts::PI * f64::from(i) / f64::from(rings),
                std::f64::consts::TAU * f64::from(j) / f64::from(sectors),
            );
            let (s, c) = polar.sin_cos();
            surface
                .positions
                .push(DVec3::new(s * turn.cos(), s * turn.sin(), c));
        }
    }
    let at = |i: u32, j: u32| i * sectors + j % sectors;
    for i in 0..rings {
        for j in 0..sectors {
            surface
                .triangles
                .push([at(i, j), at(i + 1, j), at(i, j + 1)]);
            surface
                .triangles
                .push([at(i, j + 1), at(i + 1, j), at(i + 1, j + 1)]);
        }
    }
    surface
}

criterion_group!(benches, distances, meshes);
criterion_main!(benches);
