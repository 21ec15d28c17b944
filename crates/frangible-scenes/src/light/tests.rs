//! A block whose top is a rough crack face.

use std::collections::BTreeMap;

use frangible::glam::Vec3;
use frangible::internals::RenderMesh;

use super::lightened;
use crate::output::{TOLERANCE, WANTED_OF_DRAWN, WANTED_OF_PIECE};

/// Cells of the top along a side.
const N: usize = 40;

/// A block of one metre with four sides and a bottom that its author drew, and a top of N × N cells, `rough` metres high.
fn block(rough: f32) -> RenderMesh {
    let mut mesh = RenderMesh {
        more_uvs: vec![Vec::new()],
        ..RenderMesh::default()
    };
    let mut seed = 1_u32;
    let mut noise = || {
        seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (seed >> 8) as f32 / (1 << 24) as f32 - 0.5
    };
    let heights: Vec<f32> = (0..(N + 1) * (N + 1))
        .map(|_| 1.0 + rough * noise())
        .collect();
    let top = |i: usize, j: usize| {
        Vec3::new(
            i as f32 / N as f32,
            heights[i * (N + 1) + j],
            j as f32 / N as f32,
        )
    };
    let mut add = |corners: &[Vec3], normal: Vec3, material: Option<u32>| {
        let first = mesh.positions.len() as u32;
        for &p in corners {
            mesh.positions.push(p);
            mesh.normals.push(normal);
            mesh.uvs.push([p.x + p.z, p.y]);
            mesh.more_uvs[0].push([p.y, 2.0 * p.x]);
            mesh.colors.push([p.x, p.y.clamp(0.0, 1.0), p.z, 1.0]);
        }
        for k in 2..corners.len() as u32 {
            mesh.triangles.push([first, first + k - 1, first + k]);
            mesh.material_of_triangle.extend(material);
        }
    };
    // Each side is a fan from the middle of its lower edge, so that the rim's corners are single triangles of it.
    let sides: [(Vec3, Vec3, [usize; 4]); 4] = [
        (Vec3::Z, Vec3::X, [0, N, N, N]),
        (Vec3::X, Vec3::NEG_Z, [N, N, N, 0]),
        (Vec3::NEG_Z, Vec3::NEG_X, [N, 0, 0, 0]),
        (Vec3::NEG_X, Vec3::Z, [0, 0, 0, N]),
    ];
    for (side, (normal, _, [i, j, k, l])) in sides.into_iter().enumerate() {
        let step = |n: usize| {
            let at = |from: usize, to: usize| {
                if from == to {
                    from
                } else if to > from {
                    n
                } else {
                    N - n
                }
            };
            top(at(i, k), at(j, l))
        };
        let low = |p: Vec3| Vec3::new(p.x, 0.0, p.z);
        let (a, b) = (low(step(0)), low(step(N)));
        let middle = 0.5 * (a + b);
        let material = Some(side as u32 % 2);
        add(&[middle, step(0), a][..], normal, material);
        add(&[middle, b, step(N)][..], normal, material);
        for n in 0..N {
            add(&[middle, step(n + 1), step(n)][..], normal, material);
        }
        // The bottom's fan.
        let centre = Vec3::new(0.5, 0.0, 0.5);
        add(&[centre, middle, a][..], Vec3::NEG_Y, Some(2));
        add(&[centre, b, middle][..], Vec3::NEG_Y, Some(2));
    }
    mesh.outer_triangles = mesh.triangles.len();
    let mut add = |corners: [Vec3; 3]| {
        let first = mesh.positions.len() as u32;
        let [a, b, c] = corners;
        let normal = (b - a).cross(c - a).normalize();
        mesh.positions.extend(corners);
        mesh.normals.extend([normal; 3]);
        mesh.uvs.extend([[0.0; 2]; 3]);
        mesh.more_uvs[0].extend([[0.0; 2]; 3]);
        mesh.colors.extend([[1.0; 4]; 3]);
        mesh.triangles.push([first, first + 1, first + 2]);
    };
    for i in 0..N {
        for j in 0..N {
            add([top(i, j), top(i, j + 1), top(i + 1, j + 1)]);
            add([top(i, j), top(i + 1, j + 1), top(i + 1, j)]);
        }
    }
    mesh
}

/// Volume, after a check that each directed side has an opposite one.
fn closed_volume(mesh: &RenderMesh) -> f64 {
    let mut sides: BTreeMap<[[u32; 3]; 2], i32> = BTreeMap::new();
    let mut volume = 0.0;
    for t in &mesh.triangles {
        let corners = t.map(|v| mesh.positions[v as usize]);
        let [a, b, c] = corners.map(|p| p.as_dvec3());
        volume += a.dot(b.cross(c)) / 6.0;
        let bits = corners.map(|p| p.to_array().map(|x| (x + 0.0).to_bits()));
        for k in 0..3 {
            let (from, to) = (bits[k], bits[(k + 1) % 3]);
            if from < to {
                *sides.entry([from, to]).or_default() += 1;
            } else {
                *sides.entry([to, from]).or_default() -= 1;
            }
        }
    }
    assert!(sides.values().all(|&count| count == 0), "open");
    volume
}

#[test]
fn crack_faces_get_few_triangles_and_stay_where_they_were() {
    let full = block(0.002);
    let volume = closed_volume(&full);
    let (light, error) = lightened(&full, Vec3::ZERO, true, 0.005);
    assert!(error > 0.0 && error <= 0.005, "{error}");
    assert!((closed_volume(&light) / volume - 1.0).abs() < 0.005);
    let inner = light.triangles.len() - light.outer_triangles;
    assert!(inner < 200, "{inner} of {} triangles", 2 * N * N);
    // The rim lies in planes: few corners of it are left.
    assert!(light.outer_triangles < 60, "{}", light.outer_triangles);
    let again = lightened(&full, Vec3::ZERO, true, 0.005);
    assert_eq!((light, error), again);
}

#[test]
fn a_surface_rougher_than_the_tolerance_keeps_its_shape() {
    let full = block(0.05);
    for tolerance in [0.02, 0.005, 0.001] {
        let (light, error) = lightened(&full, Vec3::ZERO, true, tolerance);
        assert!(error <= tolerance, "{error} of {tolerance}");
        closed_volume(&light);
    }
    let count = |tolerance| {
        lightened(&full, Vec3::ZERO, true, tolerance)
            .0
            .triangles
            .len()
    };
    assert!(count(0.02) < count(0.005));
    // The error comes before the wanted number of triangles.
    let wanted = WANTED_OF_DRAWN * full.outer_triangles + WANTED_OF_PIECE;
    let least = count(TOLERANCE);
    assert!(least > wanted, "{least} of {wanted}");
}

#[test]
fn the_outer_surface_keeps_its_shape_and_attributes() {
    let full = block(0.002);
    let (light, _) = lightened(&full, Vec3::ZERO, true, 0.005);
    // The lower corners of the block.
    for corner in [Vec3::ZERO, Vec3::X, Vec3::Z, Vec3::X + Vec3::Z] {
        assert!(light.positions.contains(&corner), "{corner}");
    }
    let (vertices, triangles) = (light.positions.len(), light.outer_triangles);
    assert_eq!((light.normals.len(), light.uvs.len()), (vertices, vertices));
    assert_eq!(
        (light.colors.len(), light.more_uvs[0].len()),
        (vertices, vertices)
    );
    assert_eq!(light.material_of_triangle.len(), triangles);
    for (t, triangle) in light.triangles.iter().enumerate() {
        let [a, b, c] = triangle.map(|v| light.positions[v as usize]);
        let flat = (b - a).cross(c - a).normalize();
        for &v in triangle {
            let (p, v) = (light.positions[v as usize], v as usize);
            assert!((light.normals[v].length() - 1.0).abs() < 1e-5);
            if t < triangles {
                assert!(flat.dot(light.normals[v]) > 0.999);
                assert_eq!(light.uvs[v], [p.x + p.z, p.y]);
                assert_eq!(light.more_uvs[0][v], [p.y, 2.0 * p.x]);
                assert_eq!(light.colors[v][..2], [p.x, p.y.clamp(0.0, 1.0)]);
            } else {
                assert_eq!(light.colors[v], [1.0; 4]);
            }
        }
    }
    // Sides of one material that meet at an edge stay apart.
    let materials: Vec<u32> = (0..3)
        .filter(|m| light.material_of_triangle.contains(m))
        .collect();
    assert_eq!(materials, [0, 1, 2]);
}
