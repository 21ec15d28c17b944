//! Promises of the repair, on small meshes whose right answer is known.

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
fn a_split_cube_is_welded_to_eight_closed_corners() {
    let (surface, report) = repaired(&soup(&cube(DVec3::splat(0.3), 0.1)));
    assert_eq!(surface.positions.len(), 8);
    assert_eq!(
        (report.welded, report.boundary_edges, report.shells),
        (28, 0, 1)
    );
    assert!((volume(&surface) - 1e-3).abs() < 1e-15);
    assert_eq!(report.to_string(), "welded 28 vertices");
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
fn hairline_cracks_close_and_thin_walls_do_not() {
    let mut cracked = soup(&ball(1.0, DVec3::ZERO));
    for (i, p) in cracked.positions.iter_mut().enumerate() {
        *p *= 1.0 + 1e-6 * ((i * 7 % 5) as f64 - 2.0);
    }
    let (surface, report) = repaired(&cracked);
    assert_eq!((surface.positions.len(), report.boundary_edges), (86, 0));

    // A closed sheet far thinner than the reach of the crack rule.
    let mut thin = cube(DVec3::ZERO, 1.0);
    thin.positions.iter_mut().for_each(|p| p.z *= 4e-6);
    let (surface, report) = repaired(&soup(&thin));
    assert_eq!((surface.positions.len(), report.boundary_edges), (8, 0));
    assert!((volume(&surface) / 4e-6 - 1.0).abs() < 1e-9);
}

#[test]
fn a_finely_divided_rim_keeps_its_vertices() {
    // A cup whose rim has edges of 6e-6 of its size.
    let n = 1000_u32;
    let ring = |k: u32| {
        let turn = std::f64::consts::TAU * f64::from(k) / f64::from(n);
        DVec3::new(1e-3 * turn.cos(), 0.0, -1e-3 * turn.sin())
    };
    let mut positions: Vec<DVec3> = (0..n).map(ring).collect();
    positions.push(-DVec3::Y);
    let cup = mesh(positions, (0..n).map(|k| [k, n, (k + 1) % n]).collect());
    let (surface, report) = repaired(&cup);
    assert_eq!(
        (surface.positions.len() as u32, report.boundary_edges as u32),
        (n + 1, n)
    );
}

#[test]
fn scrambled_windings_are_made_one() {
    let mut scrambled = ball(1.0, DVec3::ZERO);
    let expected = input_volume(&scrambled);
    let mut turned = 0;
    for (i, t) in scrambled.triangles.iter_mut().enumerate() {
        if i * i % 7 == 2 {
            t.swap(1, 2);
            turned += 1;
        }
    }
    let (surface, report) = repaired(&scrambled);
    assert!((volume(&surface) - expected).abs() < 1e-12);
    assert_eq!(report.flipped, turned);
}

#[test]
fn an_inside_out_ball_is_turned() {
    let ball = ball(1.0, DVec3::ONE);
    let (surface, report) = repaired(&turned(ball.clone()));
    assert_eq!(report.flipped, ball.triangles.len());
    assert!((volume(&surface) - input_volume(&ball)).abs() < 1e-12);
}

#[test]
fn a_hollow_ball_stays_hollow_even_inside_out() {
    let (outer, inner) = (ball(1.0, DVec3::ZERO), ball(0.7, DVec3::X * 0.1));
    let expected = input_volume(&outer) - input_volume(&inner);
    let hollow = joined(&[outer, turned(inner)]);
    for mesh in [hollow.clone(), turned(hollow)] {
        let (surface, report) = repaired(&mesh);
        assert!((volume(&surface) - expected).abs() < 1e-12);
        assert_eq!(
            (report.shells, report.cavities, report.nested_alike),
            (2, 1, 0)
        );
    }
}

#[test]
fn shells_wound_alike_are_solid_within_solid() {
    let (outer, inner) = (ball(1.0, DVec3::ZERO), ball(0.2, DVec3::X * 0.5));
    let expected = input_volume(&outer) + input_volume(&inner);
    let (surface, report) = repaired(&joined(&[inner, outer]));
    assert!((volume(&surface) - expected).abs() < 1e-12);
    assert_eq!((report.cavities, report.nested_alike), (0, 1));
}

#[test]
fn a_stone_in_a_cavity_faces_outwards_whatever_its_winding() {
    let shell = [ball(1.0, DVec3::ZERO), turned(ball(0.7, DVec3::ZERO))];
    let stone = ball(0.2, DVec3::Z * 0.2);
    let expected = input_volume(&shell[0]) + input_volume(&shell[1]) + input_volume(&stone);
    for stone in [stone.clone(), turned(stone)] {
        let (surface, report) = repaired(&joined(&[shell[0].clone(), stone, shell[1].clone()]));
        assert!((volume(&surface) - expected).abs() < 1e-12);
        assert_eq!(
            (report.shells, report.cavities, report.nested_alike),
            (3, 1, 0)
        );
    }
}

#[test]
fn crossing_and_separate_balls_all_face_outwards() {
    let balls = [
        ball(1.0, DVec3::ZERO),
        turned(ball(0.8, DVec3::X)),
        turned(ball(1.0, DVec3::Y * 9.0)),
    ];
    let expected: f64 = balls.iter().map(|b| input_volume(b).abs()).sum();
    let (surface, report) = repaired(&joined(&balls));
    assert!((volume(&surface) - expected).abs() < 1e-9);
    assert_eq!(
        (report.shells, report.cavities + report.nested_alike),
        (3, 0)
    );
}

#[test]
fn a_doubled_shell_counts_once_either_way() {
    let ball = ball(1.0, DVec3::ZERO);
    for copy in [ball.clone(), turned(ball.clone())] {
        let (surface, report) = repaired(&joined(&[ball.clone(), copy]));
        assert_eq!(report.duplicate, ball.triangles.len());
        assert!(report.is_watertight());
        assert!((volume(&surface) - input_volume(&ball)).abs() < 1e-12);
    }
}

#[test]
fn a_membrane_between_two_cubes_goes() {
    let (left, right) = (cube(DVec3::ZERO, 1.0), cube(DVec3::X, 1.0));
    let on_wall = |m: &InputMesh, t: &[u32; 3]| t.iter().all(|&v| m.positions[v as usize].x == 1.0);
    // Both cut the wall along the same diagonal: the right cube takes the left one's triangles, turned.
    let wall: Vec<[u32; 3]> = left
        .triangles
        .iter()
        .copied()
        .filter(|t| on_wall(&left, t))
        .collect();
    let mut open = right.clone();
    open.triangles.retain(|t| !on_wall(&right, t));
    let mut both = joined(&[left, open]);
    both.triangles
        .extend(wall.iter().map(|&[a, b, c]| [a, c, b]));
    let (surface, report) = repaired(&both);
    assert_eq!(
        (report.duplicate, report.non_manifold_edges, report.shells),
        (4, 0, 1)
    );
    assert!(report.is_watertight());
    assert!((volume(&surface) - 2.0).abs() < 1e-12);
}

#[test]
fn a_fin_goes_and_a_double_sided_lid_stays() {
    let body = cube(DVec3::ZERO, 1.0);
    let mut finned = body.clone();
    finned.positions.push(DVec3::new(-1.0, 0.5, -1.0));
    finned.triangles.extend([[0, 2, 8], [2, 0, 8]]);
    let (surface, report) = repaired(&finned);
    assert_eq!((surface.triangles.len(), report.duplicate), (12, 2));
    assert!(report.is_watertight());

    let mut lidded = body.clone();
    let lid = lidded.triangles[0];
    lidded.triangles.push([lid[0], lid[2], lid[1]]);
    let (surface, report) = repaired(&lidded);
    assert_eq!((surface.triangles.len(), report.duplicate), (12, 1));
    assert!(report.is_watertight() && (volume(&surface) - 1.0).abs() < 1e-12);
}

#[test]
fn two_cubes_on_one_edge_are_two_shells() {
    let both = joined(&[
        cube(DVec3::ZERO, 1.0),
        turned(cube(DVec3::new(1.0, 1.0, 0.0), 1.0)),
    ]);
    let (surface, report) = repaired(&both);
    assert_eq!(
        (report.non_manifold_edges, report.shells, report.open_shells),
        (1, 2, 0)
    );
    assert!((volume(&surface) - 2.0).abs() < 1e-12);
}

#[test]
fn a_moebius_strip_is_reported() {
    let n = 24_u32;
    let mut positions = Vec::new();
    for k in 0..n {
        let turn = std::f64::consts::TAU * f64::from(k) / f64::from(n);
        for side in [-0.3, 0.3] {
            let r = 1.0 + side * (turn / 2.0).cos();
            positions.push(DVec3::new(
                r * turn.cos(),
                side * (turn / 2.0).sin(),
                r * turn.sin(),
            ));
        }
    }
    let mut triangles = Vec::new();
    for k in 0..n {
        let (a, b) = (2 * k, 2 * k + 1);
        let (c, d) = if k + 1 == n {
            (1, 0)
        } else {
            (2 * k + 2, 2 * k + 3)
        };
        triangles.extend([[a, b, c], [b, d, c]]);
    }
    let (_, report) = repaired(&mesh(positions, triangles));
    assert_eq!(
        (report.shells, report.one_sided, report.boundary_loops),
        (1, 1, 1)
    );
}

#[test]
fn holes_loose_vertices_and_needles_are_counted() {
    let mut open = ball(1.0, DVec3::ZERO);
    open.triangles
        .retain(|t| !t.contains(&0) && !t.contains(&1));
    let needle = [2, 2, 3];
    open.triangles.push(needle);
    let (surface, report) = repaired(&open);
    assert_eq!(
        (report.boundary_loops, report.boundary_edges, report.loose),
        (2, 24, 2)
    );
    assert_eq!((report.degenerate, surface.positions.len()), (1, 84));
    // Turned as a whole, it is still turned back: closed over its rims it would be inside out.
    let (_, report) = repaired(&turned(open));
    assert_eq!(report.flipped, surface.triangles.len());
}

#[test]
fn a_triangle_without_area_goes_but_leaves_its_neighbours_wound_alike() {
    // A cube with one edge split on one side only; a needle bridges the split.
    let mut split = cube(DVec3::ZERO, 1.0);
    split.positions.push(DVec3::new(0.5, 0.0, 0.0));
    let at = split
        .triangles
        .iter()
        .position(|t| t.contains(&0) && t.contains(&1) && t.iter().all(|&v| v < 4));
    let [a, b, c] = split.triangles.remove(at.expect("a triangle on the edge"));
    let apex = [a, b, c]
        .into_iter()
        .find(|&v| v > 1)
        .expect("a third corner");
    split
        .triangles
        .extend([[apex, 1, 8], [apex, 8, 0], [0, 8, 1]]);
    let (surface, report) = repaired(&split);
    assert_eq!((report.degenerate, report.boundary_edges), (1, 0));
    assert!((volume(&surface) - 1.0).abs() < 1e-12);
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
