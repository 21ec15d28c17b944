//! Promises of the repair, on small meshes whose right answer is known.

mod orientation;
mod seams;

use std::path::PathBuf;

use frangible_mesh::glam::DVec3;
use frangible_mesh::{InputMesh, RepairError, RepairReport, Similarity, Surface, repair};

fn mesh(positions: Vec<DVec3>, triangles: Vec<[u32; 3]>) -> InputMesh {
    InputMesh {
        positions,
        triangles,
        ..InputMesh::default()
    }
}

/// A ball of `2 * around * (rows - 1)` triangles, wound outwards.
fn ball(radius: f64, centre: DVec3) -> InputMesh {
    let (rows, around) = (8, 12);
    let mut positions = vec![centre + radius * DVec3::Y, centre - radius * DVec3::Y];
    for row in 1..rows {
        let polar = std::f64::consts::PI * f64::from(row) / f64::from(rows);
        for k in 0..around {
            let turn = std::f64::consts::TAU * f64::from(k) / f64::from(around);
            let across = DVec3::new(turn.cos(), 0.0, -turn.sin());
            positions.push(centre + radius * (polar.sin() * across + polar.cos() * DVec3::Y));
        }
    }
    let at = |row: u32, k: u32| 2 + (row - 1) * around as u32 + k % around as u32;
    let mut triangles = Vec::new();
    for k in 0..around as u32 {
        triangles.push([0, at(1, k), at(1, k + 1)]);
        triangles.push([1, at(rows as u32 - 1, k + 1), at(rows as u32 - 1, k)]);
        for row in 1..rows as u32 - 1 {
            triangles.push([at(row, k), at(row + 1, k), at(row + 1, k + 1)]);
            triangles.push([at(row, k), at(row + 1, k + 1), at(row, k + 1)]);
        }
    }
    mesh(positions, triangles)
}

/// Twelve triangles on eight corners, wound outwards.
fn cube(low: DVec3, side: f64) -> InputMesh {
    let corner = |i: u32| {
        low + side
            * DVec3::new(
                f64::from(i & 1),
                f64::from(i >> 1 & 1),
                f64::from(i >> 2 & 1),
            )
    };
    let quads = [
        [0, 2, 3, 1],
        [4, 5, 7, 6],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 4, 6, 2],
        [1, 3, 7, 5],
    ];
    let triangles = quads
        .iter()
        .flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]])
        .collect();
    mesh((0..8).map(corner).collect(), triangles)
}

fn turned(mut mesh: InputMesh) -> InputMesh {
    mesh.triangles.iter_mut().for_each(|t| t.swap(0, 1));
    mesh
}

fn joined(parts: &[InputMesh]) -> InputMesh {
    let mut all = InputMesh::default();
    for part in parts {
        let first = all.positions.len() as u32;
        all.positions.extend(&part.positions);
        all.triangles
            .extend(part.triangles.iter().map(|t| t.map(|v| first + v)));
    }
    all
}

/// Every triangle with vertices of its own.
fn soup(mesh: &InputMesh) -> InputMesh {
    let corners = mesh.triangles.iter().flatten();
    let positions: Vec<DVec3> = corners.map(|&v| mesh.positions[v as usize]).collect();
    let triangles = (0..mesh.triangles.len() as u32)
        .map(|t| [3 * t, 3 * t + 1, 3 * t + 2])
        .collect();
    self::mesh(positions, triangles)
}

fn volume(surface: &Surface) -> f64 {
    (0..surface.triangles.len())
        .map(|t| {
            let [a, b, c] = surface.corners(t);
            a.dot(b.cross(c)) / 6.0
        })
        .sum()
}

fn input_volume(mesh: &InputMesh) -> f64 {
    volume(&Surface {
        positions: mesh.positions.clone(),
        triangles: mesh.triangles.clone(),
    })
}

fn repaired(mesh: &InputMesh) -> (Surface, RepairReport) {
    let (surface, report) = repair(mesh).expect("a sound mesh");
    assert_eq!(
        (surface.positions.len(), surface.triangles.len()),
        (report.vertices_out, report.faces_out)
    );
    (surface, report)
}

#[test]
fn a_sound_mesh_comes_back_as_it_is() {
    let ball = ball(1.0, DVec3::new(3.0, -2.0, 5.0));
    let (surface, report) = repaired(&ball);
    assert_eq!(
        (&surface.positions, &surface.triangles),
        (&ball.positions, &ball.triangles)
    );
    let mended = report.welded + report.degenerate + report.duplicate + report.flipped;
    assert!(mended == 0 && report.is_watertight(), "{report:?}");
    assert_eq!(report.to_string(), "");
    assert_eq!((report.shells, report.boundary_loops), (1, 0));
}

#[test]
fn the_order_of_triangles_does_not_change_the_outcome() {
    let soup = soup(&ball(2.0, DVec3::ONE));
    let mut shuffled = soup.clone();
    // A fixed permutation: 97 is prime to the number of triangles.
    let n = soup.triangles.len();
    shuffled.triangles = (0..n).map(|i| soup.triangles[i * 97 % n]).collect();
    let (a, _) = repaired(&soup);
    let (b, _) = repaired(&shuffled);
    assert_eq!(a.positions, b.positions);
    let sorted = |s: &Surface| {
        let mut t = s.triangles.clone();
        t.sort_unstable();
        t
    };
    assert_eq!(sorted(&a), sorted(&b));
}

#[test]
fn what_cannot_be_a_solid_is_refused() {
    let cube = cube(DVec3::ZERO, 1.0);
    assert_eq!(repair(&InputMesh::default()), Err(RepairError::NoTriangles));

    let mut line = cube.clone();
    line.positions
        .iter_mut()
        .for_each(|p| *p = DVec3::new(p.x + p.y, 0.0, 0.0));
    assert_eq!(repair(&line), Err(RepairError::NoArea(12)));

    let mut flat = cube.clone();
    flat.positions.iter_mut().for_each(|p| p.z = 0.3 * p.x);
    assert_eq!(repair(&flat), Err(RepairError::Flat));

    let sheet = mesh(
        cube.positions[..4].to_vec(),
        vec![[0, 1, 3], [0, 3, 2], [0, 3, 1], [0, 2, 3]],
    );
    assert_eq!(repair(&sheet), Err(RepairError::Flat));

    for bad in [f64::NAN, f64::INFINITY, 1e200] {
        let mut far = cube.clone();
        far.positions[3].y = bad;
        assert_eq!(repair(&far), Err(RepairError::NotFinite { vertex: 4 }));
    }

    let mut wrong = cube;
    wrong.triangles[1][2] = 8;
    let (triangle, index, vertices) = (2, 8, 8);
    assert_eq!(
        repair(&wrong),
        Err(RepairError::IndexOutOfRange {
            triangle,
            index,
            vertices
        })
    );
}

#[test]
fn a_bent_open_sheet_is_left_to_the_winding_number() {
    let positions = vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::new(1.0, 1.0, 0.4)];
    let (surface, report) = repaired(&mesh(positions, vec![[0, 1, 2], [1, 3, 2]]));
    assert_eq!((surface.triangles.len(), report.open_shells), (2, 1));
}

#[test]
fn resizing_keeps_mesh_and_surface_aligned() {
    let mut input = cube(DVec3::new(4.0, -1.0, 2.0), 3.0);
    input.positions.iter_mut().for_each(|p| p.y *= 2.0);
    let (mut surface, _) = repaired(&input);
    let before = surface.bounds();
    let similarity = surface.resize(0.5);
    input.transform(&similarity);
    let [low, high] = surface.bounds();
    assert!(((high - low).max_element() - 0.5).abs() < 1e-12);
    assert!((0.5 * (low + high)).distance(0.5 * (before[0] + before[1])) < 1e-12);
    assert_eq!(surface.positions, input.positions);
    assert_eq!(
        Similarity::resizing([DVec3::ONE; 2], 1.0),
        Similarity::IDENTITY
    );
}

/// Independent counts: spot has 2930 lines `v`; the scan of the bunny is known for its five holes.
#[cfg(feature = "mesh-io")]
#[test]
fn real_meshes_come_out_as_counted() {
    let Some(folder) = std::env::var_os("FRANGIBLE_MESHES") else {
        println!("skipped: FRANGIBLE_MESHES names no folder of meshes");
        return;
    };
    let folder = PathBuf::from(folder);
    for name in ["spot", "stanford-bunny", "suzanne", "teapot"] {
        let path = folder.join(name).with_extension("obj");
        if !path.exists() {
            println!("skipped: {} is not there", path.display());
            continue;
        }
        let mesh = frangible_mesh::read_mesh(&path).expect("readable");
        let (surface, report) = repaired(&mesh);
        println!("{name}: {report}; {report:?}");
        assert!(volume(&surface) > 0.0);
        match name {
            "spot" => {
                assert!(report.is_watertight());
                assert_eq!((report.shells, report.vertices_out), (1, 2930));
            }
            "stanford-bunny" => {
                assert_eq!((report.boundary_loops, report.shells), (5, 1));
                assert!(report.loose > 0);
            }
            _ => {}
        }
    }
}
