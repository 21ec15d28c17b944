//! Properties of all methods, and of each of them.

use std::collections::BTreeSet;

use super::common::{Case, baked, in_the_middle, plate, plate_of, preset};
use frangible::glam::{DVec3, Vec3};
use frangible::{Contact, Striker, TriMesh};
use frangible_bake::Shape;
use frangible_lab::compare::{Broken, CompareError, Hit, Method, Options, compare};

/// Returns true if every edge is passed in both directions by equally many triangles.
fn balanced(mesh: &TriMesh) -> bool {
    let edges = |t: &[u32; 3]| [[t[0], t[1]], [t[1], t[2]], [t[2], t[0]]];
    let mut there: Vec<[u32; 2]> = mesh.triangles.iter().flat_map(edges).collect();
    let mut back: Vec<[u32; 2]> = there.iter().map(|&[a, b]| [b, a]).collect();
    there.sort_unstable();
    back.sort_unstable();
    there == back
}

fn cases() -> Vec<Case> {
    let tumbler = baked(Shape::drinking_glass(), preset("glass"), 9000.0);
    let stone = Striker::fixed(&preset("stone"));
    let rim = tumbler.fracture().positions.iter().copied();
    let rim = rim
        .max_by(|a, b| (a.x + a.z).total_cmp(&(b.x + b.z)))
        .expect("a node");
    let on_rim = Contact::collision(&tumbler, rim, Vec3::new(-1.0, 0.0, -1.0), 6.0, stone);
    vec![Case::of_plate(), Case::new(&tumbler, on_rim)]
}

#[test]
fn the_pieces_of_every_method_tile_the_body() {
    for case in cases() {
        let asset = case.body.asset();
        let whole = asset.fracture().total_volume();
        for broken in case.by_all() {
            let (method, pieces) = (broken.method, &broken.fragments);
            assert!(pieces.len() > 1, "{method} held");
            let volume: f64 = pieces.iter().map(|f| f.mass.volume).sum();
            assert!(
                (volume / whole - 1.0).abs() < 1e-12,
                "{method}: {volume} of {whole}"
            );
            let drawn: f64 = pieces.iter().map(|f| f.mesh.volume()).sum();
            assert!(
                (drawn / whole - 1.0).abs() < 1e-6,
                "{method}: {drawn} of {whole}, f32"
            );
            let moment: DVec3 = pieces.iter().map(|f| f.mass.centre * f.mass.mass).sum();
            let mass: f64 = pieces.iter().map(|f| f.mass.mass).sum();
            // Nodes are stored in f32: the body's own centre is as exact.
            assert!(
                (moment / mass - asset.mass().centre).length() < 1e-8,
                "{method}"
            );
            for piece in pieces {
                assert!(piece.mass.volume > 0.0, "{method}");
                assert!(balanced(&piece.mesh), "{method}: an open surface");
                let corners: usize = piece.cell_shares.iter().map(|(_, share)| share.len()).sum();
                assert!(corners >= 4, "{method}: a piece without a collider");
            }
        }
    }
}

#[test]
fn the_same_seed_gives_the_same_bits_and_another_one_other_cells() {
    let case = Case::of_plate();
    let bits = |all: &[Broken]| -> Vec<Vec<[u32; 3]>> {
        let of = |b: &Broken| {
            let places = b.fragments.iter().flat_map(|f| &f.mesh.positions);
            places.map(|p| p.to_array().map(f32::to_bits)).collect()
        };
        all.iter().map(of).collect()
    };
    let first = case.by_all();
    assert_eq!(bits(&first), bits(&case.by_all()));
    for method in [Method::EnergyVoronoi, Method::Voronoi] {
        let mut options = Options::default();
        let one = case.by(method, &options);
        options.seed += 1;
        let other = case.by(method, &options);
        assert_ne!(bits(&[one]), bits(&[other]), "{method}");
    }
}

#[test]
fn methods_alone_give_what_they_give_together() {
    let case = Case::of_plate();
    for together in case.by_all() {
        let alone = case.by(together.method, &Options::default());
        assert_eq!(alone.pieces(), together.pieces());
        assert_eq!(alone.crack_area.to_bits(), together.crack_area.to_bits());
        assert_eq!(alone.energy.to_bits(), together.energy.to_bits());
    }
}

#[test]
fn who_asks_for_energy_spends_no_more_than_there_is() {
    for case in cases() {
        for broken in case.by_all() {
            if broken.method == Method::Voronoi {
                continue;
            }
            assert!(broken.available > 0.0);
            // Borders of joined crumbs and of junctions inside tetrahedra are not paid one by one.
            let spent = broken.energy / broken.available;
            assert!(spent <= 1.0 + 1e-9, "{}: {spent}", broken.method);
        }
    }
}

#[test]
fn areas_are_those_of_the_faces() {
    let case = Case::of_plate();
    let toughness = case.body.asset().material().fracture_energy;
    for broken in case.by_all() {
        let share = broken.border_area / broken.crack_area;
        match broken.method {
            // All borders are between pieces; vertices are f32.
            Method::Voronoi | Method::EnergyVoronoi => {
                assert!((share - 1.0).abs() < 1e-5, "{share}");
            }
            Method::Elements => assert!(share <= 1.0 + 1e-6, "{share}"),
            _ => {}
        }
        let expected = toughness * broken.crack_area;
        assert!(
            (broken.energy / expected - 1.0).abs() < 1e-9,
            "{}",
            broken.method
        );
    }
}

#[test]
fn crack_faces_along_elements_are_faces_of_the_mesh() {
    let case = Case::of_plate();
    let mesh = case.body.asset().fracture();
    let key = |p: Vec3| p.to_array().map(|x| (x * 1e6).round() as i64);
    let mut faces: BTreeSet<Vec<[i64; 3]>> = BTreeSet::new();
    for e in 0..mesh.tets.len() {
        for left_out in 0..4 {
            let corners = mesh.corners(e).into_iter().enumerate();
            let face = corners.filter(|(k, _)| *k != left_out).map(|(_, p)| key(p));
            let mut face: Vec<[i64; 3]> = face.collect();
            face.sort_unstable();
            faces.insert(face);
        }
    }
    let broken = case.by(Method::Elements, &Options::default());
    let mut seen = 0;
    for piece in &broken.fragments {
        let centre = piece.mass.centre.as_vec3();
        for triangle in &piece.mesh.triangles {
            let mut face = triangle
                .map(|v| key(piece.mesh.positions[v as usize] + centre))
                .to_vec();
            face.sort_unstable();
            // Rounding to a micrometre may go either way; the mesh's edges are millimetres.
            let near = |other: &Vec<[i64; 3]>| {
                let pairs = face.iter().flatten().zip(other.iter().flatten());
                pairs.clone().all(|(a, b)| (a - b).abs() <= 1)
            };
            assert!(faces.contains(&face) || faces.iter().any(near));
            seen += 1;
        }
    }
    assert!(seen > 100);
}

#[test]
fn a_body_that_costs_nothing_to_break_keeps_all_its_cells() {
    let mut glass = preset("glass");
    glass.fracture_energy = 1e-12;
    let asset = plate_of(glass);
    let case = Case::new(&asset, in_the_middle(&asset, 20.0));
    let mut options = Options::default();
    options.sites = 12;
    let all = case.by(Method::EnergyVoronoi, &options);
    // A convex body: every cell hangs together, and with so few none is without nodes or a crumb.
    assert_eq!(all.pieces(), 12);
    assert!((all.energy / all.available) < 1e-9);
}

#[test]
fn a_body_too_tough_to_break_stays_whole_where_energy_is_asked_for() {
    let mut glass = preset("glass");
    glass.fracture_energy = 1e9;
    let asset = plate_of(glass);
    let case = Case::new(&asset, in_the_middle(&asset, 20.0));
    for broken in case.by_all() {
        let holds = broken.method != Method::Voronoi;
        assert_eq!(broken.pieces() == 1, holds, "{}", broken.method);
        assert_eq!(broken.largest_share() == 1.0, holds);
    }
}

#[test]
fn a_light_tap_breaks_only_where_nobody_asks_for_stress() {
    let asset = plate();
    let case = Case::new(&asset, in_the_middle(&asset, 0.01));
    for broken in case.by_all() {
        let blind = broken.method == Method::Voronoi;
        assert_eq!(broken.pieces() > 1, blind, "{}", broken.method);
        if !blind {
            let nothing = [broken.crack_area, broken.border_area, broken.energy];
            assert_eq!(nothing.map(f64::to_bits), [0; 3], "{}", broken.method);
        }
    }
}

#[test]
fn a_plain_voronoi_border_is_a_plane_half_way() {
    let case = Case::of_plate();
    let mut options = Options::default();
    options.cells = Some(2);
    let broken = case.by(Method::Voronoi, &options);
    assert_eq!(broken.pieces(), 2);
    let piece = &broken.fragments[0];
    let inner = &piece.mesh.triangles[piece.mesh.outer_triangles..];
    let corners = |t: &[u32; 3]| t.map(|v| piece.mesh.positions[v as usize].as_dvec3());
    let areas = inner.iter().map(|t| {
        let [a, b, c] = corners(t);
        (b - a).cross(c - a)
    });
    let normal = areas.sum::<DVec3>().normalize();
    let level = |p: DVec3| p.dot(normal);
    let levels: Vec<f64> = inner.iter().flat_map(corners).map(level).collect();
    let low = levels.iter().copied().fold(f64::INFINITY, f64::min);
    let high = levels.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    // Cuts keep away from the nodes by 0.02 of an edge.
    let edge = f64::from(case.body.asset().fracture().mean_edge());
    assert!(high - low < 0.1 * edge, "{} of {edge}", high - low);
}

#[test]
fn a_quasi_static_break_knows_the_step_and_not_the_striker() {
    let case = Case::of_plate();
    let area = |case: &Case, step: f64| {
        let mut options = Options::default();
        options.step = step;
        case.by(Method::QuasiStatic, &options).crack_area
    };
    let (short, long) = (area(&case, 1e-4), area(&case, 1e-3));
    assert!(short > 2.0 * long, "{short} and {long} m²");
    assert_eq!(area(&case, 1.0), 0.0);
    let mut soft = Case::of_plate();
    soft.contacts[0].striker.contact_modulus = 1e6;
    assert_eq!(area(&soft, 1e-4).to_bits(), short.to_bits());
    let ours = |case: &Case| case.by(Method::Ours, &Options::default()).crack_area;
    assert!(ours(&case) > ours(&soft));
}

#[test]
fn what_cannot_be_compared_is_refused() {
    let case = Case::of_plate();
    let refused = |hit: Hit<'_>, options: &Options| {
        compare(hit, &Method::ALL, options, &mut |_| {}).expect_err("refused")
    };
    let mut still = case.contacts.clone();
    still[0].impulse = 0.0;
    let hit = Hit {
        contacts: &still,
        ..case.hit()
    };
    assert_eq!(refused(hit, &Options::default()), CompareError::NoImpulse);
    let mut nan = case.contacts.clone();
    nan[0].impulse = f32::NAN;
    let hit = Hit {
        contacts: &nan,
        ..case.hit()
    };
    assert!(matches!(
        refused(hit, &Options::default()),
        CompareError::Input(_)
    ));
    for wrong in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let mut options = Options::default();
        options.step = wrong;
        let message = refused(case.hit(), &options).to_string();
        assert!(message.contains("the quasi-static step is"), "{message}");
    }
    for wrong in [0, 10_001] {
        let mut options = Options::default();
        options.cells = Some(wrong);
        let message = refused(case.hit(), &options).to_string();
        assert!(message.contains("the number of cells is"), "{message}");
    }
}

#[test]
fn a_name_stands_for_its_method_only() {
    for method in Method::ALL {
        assert_eq!(Method::from_name(method.name()), Ok(method));
    }
    let error = Method::from_name("Ours").unwrap_err();
    assert!(error.contains("did you mean `ours`"), "{error}");
}
