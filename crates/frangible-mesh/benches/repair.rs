//! Repair of a ball of 70 000 triangles: as an indexed mesh, as a soup, and as two shells.

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use frangible_mesh::glam::DVec3;
use frangible_mesh::{InputMesh, repair};

/// A ball open at the poles, of 2 · 140 · 250 triangles.
fn ball(radius: f64) -> InputMesh {
    let (rows, around) = (140_u32, 250_u32);
    let mut mesh = InputMesh::default();
    for row in 0..=rows {
        let polar = std::f64::consts::PI * (0.01 + 0.98 * f64::from(row) / f64::from(rows));
        for k in 0..around {
            let turn = std::f64::consts::TAU * f64::from(k) / f64::from(around);
            let across = DVec3::new(turn.cos(), 0.0, -turn.sin());
            mesh.positions
                .push(radius * (polar.sin() * across + polar.cos() * DVec3::Y));
        }
    }
    let at = |row: u32, k: u32| row * around + k % around;
    for (row, k) in (0..rows).flat_map(|row| (0..around).map(move |k| (row, k))) {
        let [a, b, c, d] = [
            at(row, k),
            at(row + 1, k),
            at(row + 1, k + 1),
            at(row, k + 1),
        ];
        mesh.triangles.extend([[a, b, c], [a, c, d]]);
    }
    mesh
}

/// Closes both poles.
fn capped(mut mesh: InputMesh) -> InputMesh {
    let around = 250;
    let last = mesh.positions.len() as u32 - around;
    let poles = mesh.positions.len() as u32;
    mesh.positions.extend([
        mesh.positions[0].project_onto(DVec3::Y),
        mesh.positions[last as usize].project_onto(DVec3::Y),
    ]);
    for k in 0..around {
        let next = (k + 1) % around;
        mesh.triangles
            .extend([[poles, k, next], [poles + 1, last + next, last + k]]);
    }
    mesh
}

fn soup(mesh: &InputMesh) -> InputMesh {
    let corners = mesh.triangles.iter().flatten();
    InputMesh {
        positions: corners.map(|&v| mesh.positions[v as usize]).collect(),
        triangles: (0..mesh.triangles.len() as u32)
            .map(|t| [3 * t, 3 * t + 1, 3 * t + 2])
            .collect(),
        ..InputMesh::default()
    }
}

fn benchmark(c: &mut Criterion) {
    let outer = capped(ball(1.0));
    let mut hollow = outer.clone();
    let first = hollow.positions.len() as u32;
    hollow
        .positions
        .extend(outer.positions.iter().map(|p| 0.8 * *p));
    hollow.triangles.extend(
        outer
            .triangles
            .iter()
            .map(|&[a, b, c]| [first + a, first + c, first + b]),
    );
    let mut group = c.benchmark_group("repair");
    group.sample_size(20);
    for (name, mesh) in [
        ("indexed, 70k", outer.clone()),
        ("soup, 70k", soup(&outer)),
        ("hollow, 140k", hollow),
    ] {
        group.bench_function(name, |b| b.iter(|| repair(black_box(&mesh))));
    }
    group.finish();
}

criterion_group!(benches, benchmark);
criterion_main!(benches);
