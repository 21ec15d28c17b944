//! Queries of a mesh solid on the Stanford bunny, or a sphere of as many triangles where it is absent.

use std::hint::black_box;
use std::path::PathBuf;

use criterion::{Criterion, criterion_group, criterion_main};
use frangible_mesh::glam::DVec3;
use frangible_mesh::{MeshSolid, Solid, Surface, wall_thickness};

#[allow(dead_code, reason = "shared with the tests")]
#[path = "../tests/hard/mod.rs"]
mod hard;

fn bunny() -> Surface {
    let Some(folder) = std::env::var_os("FRANGIBLE_MESHES").map(PathBuf::from) else {
        println!("FRANGIBLE_MESHES names no folder of meshes: a sphere instead of the bunny");
        return hard::shapes::sphere(DVec3::ZERO, 1.0, 190);
    };
    let Ok(text) = std::fs::read_to_string(folder.join("stanford-bunny.obj")) else {
        println!(
            "no stanford-bunny.obj in {}: a sphere instead",
            folder.display()
        );
        return hard::shapes::sphere(DVec3::ZERO, 1.0, 190);
    };
    let mut surface = Surface::default();
    for line in text.lines() {
        let mut words = line.split_whitespace();
        let kind = words.next();
        let mut numbers = words.map(|word| word.parse::<f64>().unwrap_or(f64::NAN));
        let mut next = || numbers.next().unwrap_or(f64::NAN);
        match kind {
            Some("v") => surface.positions.push(DVec3::new(next(), next(), next())),
            Some("f") => surface
                .triangles
                .push([next(), next(), next()].map(|i| i as u32 - 1)),
            _ => {}
        }
    }
    surface
}

fn queries(c: &mut Criterion) {
    let surface = bunny();
    let solid = MeshSolid::new(&surface).expect("a body");
    let [low, high] = solid.bounds();
    const GRID: usize = 20;
    let points: Vec<DVec3> = (0..GRID.pow(3))
        .map(|i| {
            [i / GRID / GRID, i / GRID % GRID, i % GRID].map(|i| (i as f64 + 0.5) / GRID as f64)
        })
        .map(|place| low + DVec3::from_array(place) * (high - low))
        .collect();
    c.bench_function("build", |b| b.iter(|| MeshSolid::new(black_box(&surface))));
    c.bench_function("winding number, 8000 points", |b| {
        b.iter(|| points.iter().map(|&p| solid.winding_number(p)).sum::<f64>());
    });
    c.bench_function("nearest, 8000 points", |b| {
        b.iter(|| {
            let nearest = points
                .iter()
                .filter_map(|&p| solid.nearest(p, f64::INFINITY));
            nearest.map(|n| n.distance).sum::<f64>()
        });
    });
    c.bench_function("nearest with a bound, 8000 points", |b| {
        b.iter(|| {
            let mut last = (points[0], f64::INFINITY);
            for &p in &points {
                let within = last.1 + p.distance(last.0) * (1.0 + 1e-9);
                last = (
                    p,
                    solid
                        .nearest(p, within)
                        .map_or(f64::INFINITY, |n| n.distance),
                );
            }
            last
        });
    });
    let inside: Vec<DVec3> = points
        .iter()
        .copied()
        .filter(|&p| solid.inside(p))
        .collect();
    let crossings = format!("crossing, {} segments", inside.len());
    c.bench_function(&crossings, |b| {
        b.iter(|| {
            inside
                .iter()
                .map(|&p| solid.crossing(p, high))
                .sum::<DVec3>()
        });
    });
    c.bench_function("wall thickness, 1000 samples", |b| {
        b.iter(|| wall_thickness(&solid, 1000, 1));
    });
}

criterion_group! {
    name = benches;
    config = Criterion::default().sample_size(10);
    targets = queries
}
criterion_main!(benches);
