//! The built-in shapes at both resolutions: sound tetrahedra, closed boundaries, right volumes.

use frangible::internals::TetMesh;
use frangible::internals::mesh::NO_NEIGHBOUR;
use frangible_bake::{BakeError, BodyMesh, MeshSize, PaneShape, Shape, Station};

fn built_in() -> Vec<(&'static str, Shape)> {
    vec![
        ("glass", Shape::drinking_glass()),
        ("bowl", Shape::bowl()),
        ("vase", Shape::vase()),
        ("dinner plate", Shape::dinner_plate()),
        ("pane", Shape::plate(0.3, 0.2, 0.004)),
        ("round pane", Shape::Pane(pane(0.03, 0.0))),
        ("bent pane", Shape::Pane(pane(0.02, 0.04))),
        ("rod", Shape::rod(0.25, 0.01)),
        ("block", Shape::block([0.1, 0.12, 0.08])),
    ]
}

/// A pane with corners of this radius and this bow, m.
fn pane(corner: f64, bow: f64) -> PaneShape {
    PaneShape {
        size: [0.3, 0.2, 0.004],
        corner,
        bow,
    }
}

#[test]
fn a_pane_reaches_as_high_as_its_bow_and_leaves_its_corners_out() {
    let shape = Shape::Pane(pane(0.03, 0.02));
    let mesh = shape
        .fracture_mesh(shape.fracture_size().unwrap(), 1)
        .unwrap();
    let highest = mesh.positions.iter().map(|p| p.z).fold(0.0, f64::max);
    assert!((highest - 0.024).abs() < 2e-4, "{highest} m");
    // A round corner stays (√2 − 1) radii away from the sharp one.
    let corner = mesh
        .positions
        .iter()
        .map(|p| p.x.hypot(p.y))
        .fold(1.0, f64::min);
    let expected = (2.0_f64.sqrt() - 1.0) * 0.03;
    assert!(
        (corner - expected).abs() < 1e-3,
        "{corner} m, not {expected} m"
    );
}

#[test]
fn a_pane_that_cannot_be_is_refused_by_its_number() {
    for (corner, bow, word) in [
        (-0.01, 0.0, "corners"),
        (0.11, 0.0, "corners"),
        (0.0, 0.2, "bow"),
        (0.0, f64::NAN, "bow"),
    ] {
        let error = Shape::Pane(pane(corner, bow)).volume().unwrap_err();
        let message = error.to_string();
        assert!(message.contains(word), "{message}");
    }
}

fn topology(mesh: &BodyMesh) -> TetMesh {
    TetMesh::new(
        mesh.positions.iter().map(|p| p.as_vec3()).collect(),
        mesh.tets.clone(),
    )
}

#[test]
fn every_shape_is_sound_at_both_resolutions() {
    for (name, shape) in built_in() {
        let exact = shape.volume().unwrap();
        let coarse = shape.analysis_mesh(shape.analysis_size().unwrap()).unwrap();
        let fine = shape
            .fracture_mesh(shape.fracture_size().unwrap(), 3)
            .unwrap();
        for (mesh, tolerance) in [(&coarse, 0.02), (&fine, 0.002)] {
            assert!(
                (mesh.volume() / exact - 1.0).abs() < tolerance,
                "{name}: {} of {exact}",
                mesh.volume()
            );
            assert!(
                mesh.min_dihedral() > 3.0,
                "{name}: dihedral angle {}",
                mesh.min_dihedral()
            );
            let tets = topology(mesh);
            assert!(
                (0..tets.tets.len()).all(|e| tets.volume(e) > 0.0),
                "{name}: volumes"
            );
            assert_boundary_is_closed(name, &tets);
            assert_one_component(name, &tets);
            let used: Vec<bool> = (0..mesh.cells as u32)
                .map(|c| mesh.cell_of_tet.contains(&c))
                .collect();
            assert!(used.iter().all(|u| *u), "{name}: an empty cell");
        }
        assert!(
            (2000..5000).contains(&coarse.tets.len()),
            "{name}: {} coarse",
            coarse.tets.len()
        );
        assert!(
            (35_000..65_000).contains(&fine.tets.len()),
            "{name}: {} fine",
            fine.tets.len()
        );
    }
}

fn assert_boundary_is_closed(name: &str, mesh: &TetMesh) {
    let mut edges: Vec<(u32, u32)> = mesh
        .boundary()
        .iter()
        .flat_map(|&([a, b, c], _)| [(a, b), (b, c), (c, a)])
        .collect();
    edges.sort_unstable();
    assert!(
        edges.windows(2).all(|w| w[0] != w[1]),
        "{name}: an edge runs twice the same way"
    );
    assert!(
        edges
            .iter()
            .all(|&(a, b)| edges.binary_search(&(b, a)).is_ok()),
        "{name}: an open edge"
    );
}

fn assert_one_component(name: &str, mesh: &TetMesh) {
    let mut seen = vec![false; mesh.tets.len()];
    let mut stack = vec![0_usize];
    seen[0] = true;
    while let Some(e) = stack.pop() {
        for n in mesh.neighbours[e]
            .into_iter()
            .filter(|&n| n != NO_NEIGHBOUR)
        {
            if !std::mem::replace(&mut seen[n as usize], true) {
                stack.push(n as usize);
            }
        }
    }
    assert!(seen.iter().all(|s| *s), "{name}: more than one component");
}

#[test]
fn box_faces_stay_flat() {
    let mesh = Shape::block([0.1, 0.12, 0.08])
        .fracture_mesh(
            MeshSize {
                edge: 0.01,
                layers: 0,
            },
            5,
        )
        .unwrap();
    assert!((mesh.volume() / (0.1 * 0.12 * 0.08) - 1.0).abs() < 1e-12);
}

#[test]
fn volume_of_a_disc_of_revolution_is_exact_in_the_limit() {
    let disc = Shape::Revolution {
        profile: vec![
            Station::sharp([0.0, 0.0], [0.0, 0.01]),
            Station::sharp([0.05, 0.0], [0.05, 0.01]),
        ],
    };
    let exact = std::f64::consts::PI * 0.05 * 0.05 * 0.01;
    assert!((disc.volume().unwrap() / exact - 1.0).abs() < 1e-9);
    let mesh = disc
        .fracture_mesh(
            MeshSize {
                edge: 0.002,
                layers: 2,
            },
            1,
        )
        .unwrap();
    assert!((mesh.volume() / exact - 1.0).abs() < 1e-3);
}

#[test]
fn the_seed_decides_the_mesh() {
    let glass = Shape::drinking_glass();
    let size = MeshSize {
        edge: 0.004,
        layers: 1,
    };
    let mesh = |seed: u64| glass.fracture_mesh(size, seed).unwrap();
    assert_eq!(mesh(1).positions, mesh(1).positions);
    assert_eq!(mesh(1).tets, mesh(1).tets);
    assert_ne!(mesh(1).positions, mesh(2).positions);
}

#[test]
fn bad_sizes_are_refused() {
    let size = MeshSize {
        edge: 0.01,
        layers: 1,
    };
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let error = Shape::block([0.1, bad, 0.1])
            .analysis_mesh(size)
            .unwrap_err();
        assert!(matches!(error, BakeError::NotPositive { .. }), "{error}");
        let error = Shape::block([0.1; 3])
            .fracture_mesh(
                MeshSize {
                    edge: bad,
                    layers: 1,
                },
                1,
            )
            .unwrap_err();
        assert!(matches!(error, BakeError::NotPositive { .. }), "{error}");
    }
    let error = Shape::block([1.0; 3])
        .fracture_mesh(
            MeshSize {
                edge: 1e-4,
                layers: 0,
            },
            1,
        )
        .unwrap_err();
    assert!(matches!(error, BakeError::TooFine { .. }), "{error}");
}

#[test]
fn bad_profiles_are_refused_with_their_station() {
    let axis = Station::smooth([0.0, 0.0], [0.0, 0.01]);
    let rim = Station::smooth([0.05, 0.0], [0.05, 0.01]);
    let profiles = [
        (vec![], 0),
        (vec![axis], 0),
        (vec![rim, rim], 0),
        (vec![axis, axis], 1),
        (
            vec![axis, Station::smooth([0.05, f64::NAN], [0.05, 0.01])],
            1,
        ),
        (vec![axis, Station::smooth([0.05, 0.0], [0.05, 0.0])], 1),
        (vec![axis, rim, rim], 2),
    ];
    for (profile, at) in profiles {
        let error = Shape::Revolution {
            profile: profile.clone(),
        }
        .volume()
        .unwrap_err();
        assert!(
            matches!(error, BakeError::Profile { station, .. } if station == at),
            "{profile:?}: {error}"
        );
    }
}
