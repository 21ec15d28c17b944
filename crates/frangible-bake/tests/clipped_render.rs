//! The author's surface clipped to the fragments of real breaks.

use std::f64::consts::{PI, TAU};

use frangible::glam::{DVec3, Vec2, Vec3};
use frangible::internals::fracture_at;
use frangible::internals::mesh::closest_on_triangle;
use frangible::{Breakable, FractureConfig, Fragment, Material, Outcome};
use frangible_bake::frangible_mesh::{InputMaterial, InputMesh};
use frangible_bake::{BakeSpec, ImportOptions, bake, import_mesh};

const RADIUS: f64 = 0.05;

/// Texture coordinates as a linear function of the place, so that interpolation has a closed form.
fn uv_at(p: DVec3) -> Vec2 {
    Vec2::new((10.0 * p.x + 4.0 * p.y) as f32, (7.0 * p.z) as f32)
}

/// A ball of `rings` × 2 `rings` quads, its lower half of another material.
pub(crate) fn ball(rings: u32) -> InputMesh {
    let mut mesh = InputMesh::default();
    let sectors = 2 * rings;
    for i in 0..=rings {
        for j in 0..=sectors {
            let (polar, turn) = (
                PI * f64::from(i) / f64::from(rings),
                TAU * f64::from(j % sectors) / f64::from(sectors),
            );
            let n = DVec3::new(
                polar.sin() * turn.cos(),
                polar.cos(),
                -polar.sin() * turn.sin(),
            );
            mesh.positions.push(n * RADIUS);
            mesh.normals.push(n.as_vec3());
        }
    }
    let at = |i: u32, j: u32| i * (sectors + 1) + j;
    for i in 0..rings {
        for j in 0..sectors {
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            for (t, flat) in [([a, b, d], i == 0), ([d, b, c], i + 1 == rings)] {
                if !flat {
                    mesh.triangles.push(t);
                    mesh.material_of_triangle.push(u32::from(2 * i >= rings));
                }
            }
        }
    }
    painted(mesh)
}

/// A box of twelve triangles, a side of another material.
fn block() -> InputMesh {
    let mut mesh = InputMesh::default();
    for side in 0..6_usize {
        let (axis, high) = (side / 2, side % 2 == 1);
        let first = mesh.positions.len() as u32;
        for [i, j] in [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]] {
            let mut p = DVec3::ZERO;
            p[axis] = f64::from(u8::from(high));
            (p[(axis + 1) % 3], p[(axis + 2) % 3]) = (i, j);
            mesh.positions.push(p * DVec3::new(0.1, 0.02, 0.07));
        }
        for [a, b, c] in [[0, 1, 2], [0, 2, 3]] {
            let [a, b, c] = [a, b, c].map(|k| first + k);
            mesh.triangles
                .push(if high { [a, b, c] } else { [a, c, b] });
            mesh.material_of_triangle.push(u32::from(side == 3));
        }
    }
    painted(mesh)
}

fn painted(mut mesh: InputMesh) -> InputMesh {
    mesh.uvs = mesh.positions.iter().map(|&p| uv_at(p)).collect();
    mesh.materials = vec![InputMaterial::default(); 2];
    mesh
}

fn area(positions: &[Vec3], triangles: &[[u32; 3]]) -> f64 {
    let double = |t: &[u32; 3]| {
        let [a, b, c] = t.map(|v| positions[v as usize].as_dvec3());
        (b - a).cross(c - a).length()
    };
    0.5 * triangles.iter().map(double).sum::<f64>()
}

/// Distances from the rim of a fragment's crack faces to its own part of the author's surface, m.
fn gaps(fragment: &Fragment) -> Vec<f64> {
    let mesh = fragment.render.as_ref().unwrap();
    let (outer, inner) = mesh.triangles.split_at(mesh.outer_triangles);
    let corners = |t: &[u32; 3]| t.map(|v| mesh.positions[v as usize]);
    // An edge of one crack face only is rim; corners of crack faces are not shared, places are.
    let mut edges: Vec<[[u32; 3]; 2]> = Vec::new();
    let key = |p: Vec3| p.to_array().map(f32::to_bits);
    for t in inner {
        let [a, b, c] = corners(t);
        for (p, q) in [(a, b), (b, c), (c, a)] {
            let mut edge = [key(p), key(q)];
            edge.sort_unstable();
            edges.push(edge);
        }
    }
    edges.sort_unstable();
    let place = |k: [u32; 3]| Vec3::from_array(k.map(f32::from_bits)).as_dvec3();
    let mut gaps = Vec::new();
    for same in edges.chunk_by(|a, b| a == b).filter(|same| same.len() == 1) {
        let [p, q] = same[0].map(place);
        for along in [0.0, 0.5] {
            let point = p.lerp(q, along);
            let nearest = outer.iter().map(|t| {
                let x = corners(t).map(Vec3::as_dvec3);
                let w = closest_on_triangle(x, point);
                (x[0] * w[0] + x[1] * w[1] + x[2] * w[2]).distance(point)
            });
            gaps.push(nearest.fold(f64::INFINITY, f64::min));
        }
    }
    gaps
}

/// Breaks the mesh and checks the drawn pieces; mean and largest gap over the fracture mesh's mean edge.
fn check(mesh: &InputMesh, tets: usize) -> [f64; 2] {
    let mut options = ImportOptions::default();
    options.tets = tets;
    let imported = import_mesh(mesh, &options).unwrap();
    let spec = BakeSpec {
        modes: 20,
        render: imported.render,
        ..BakeSpec::new(
            "body",
            imported.shape,
            Material::preset("porcelain").unwrap(),
        )
    };
    let asset = bake(&spec).unwrap();
    let render = asset.render().cloned().unwrap();
    let shift = render.positions[0].as_dvec3() - mesh.positions[0];
    let edge = f64::from(asset.fracture().mean_edge());
    let top = asset
        .fracture()
        .positions
        .iter()
        .copied()
        .max_by(|a, b| a.y.total_cmp(&b.y))
        .unwrap();
    let breakable = Breakable::uniform(asset).unwrap();
    let config = FractureConfig::default();
    // Harder and harder until it breaks.
    let outcomes = (0..30).map(|k| {
        let impulse = Vec3::NEG_Y * 1.4_f32.powi(k);
        let outcome = || fracture_at(&breakable.body(1), top, impulse, &config).unwrap();
        (outcome(), outcome())
    });
    let broke = |(a, b)| match (a, b) {
        (Outcome::Broke(a), Outcome::Broke(b)) => Some((a, b)),
        _ => None,
    };
    let (fracture, again) = outcomes.into_iter().find_map(broke).unwrap();
    let (mut drawn, mut all_gaps) = (0.0, Vec::new());
    for (fragment, same) in fracture.fragments.iter().zip(&again.fragments) {
        assert_eq!(fragment.render, same.render);
        let piece = fragment.render.as_ref().unwrap();
        let outer = &piece.triangles[..piece.outer_triangles];
        drawn += area(&piece.positions, outer);
        assert!(piece.normals.iter().all(|n| n.is_normalized()));
        for v in outer.iter().flatten().map(|&v| v as usize) {
            let p = piece.positions[v].as_dvec3() + fragment.mass.centre - shift;
            let apart = uv_at(p).distance(Vec2::from(piece.uvs[v]));
            assert!(apart < 1e-5, "texture coordinates off by {apart}");
        }
        all_gaps.extend(gaps(fragment));
    }
    let whole = area(&render.positions, &render.triangles);
    let off = drawn / whole - 1.0;
    assert!(off.abs() < 1e-5, "area {drawn} m² of {whole} m²");
    let mean = all_gaps.iter().sum::<f64>() / all_gaps.len() as f64;
    let largest = all_gaps.iter().copied().fold(0.0, f64::max);
    let figures = [mean / edge, largest / edge];
    eprintln!(
        "{} triangles, {} fragments, {} rim points: area off by {off:.0e}; gap {:.4} mean, {:.3} largest, in edges of {:.1} mm",
        render.triangles.len(),
        fracture.fragments.len(),
        all_gaps.len(),
        figures[0],
        figures[1],
        1e3 * edge
    );
    figures
}

#[test]
fn surfaces_finer_and_coarser_than_the_tetrahedra_are_clipped_whole_and_meet_the_crack_faces() {
    for mesh in [ball(60), ball(8), block()] {
        let [mean, largest] = check(&mesh, 4000);
        assert!(mean < 0.01, "the mean gap is {mean} edges");
        assert!(largest < 0.3, "the largest gap is {largest} edges");
    }
}
