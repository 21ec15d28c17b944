//! Pieces are bodies again: they break, their pieces tile them, and what was theirs stays theirs.

use std::sync::Arc;

use crate::bodies::{self, block, block_hit, pane, pane_hit, pieces, strike};
use frangible::glam::{DVec3, Vec3};
use frangible::internals::{Elastic, Portion};
use frangible::{Body, Contact, Fracture, FractureConfig, InputError, Outcome, impact};

/// The piece moves as its part of the whole body did: with the elements and the modes of what was baked.
fn as_before(portion: &Portion) -> Elastic {
    let root = portion.root();
    let pick = |points: &[frangible::internals::asset::EmbeddedPoint], of: &[u32]| {
        of.iter().map(|&i| points[i as usize]).collect()
    };
    Elastic {
        analysis: root.analysis().clone(),
        tets: pick(&root.embedding().tets, portion.tets()),
        nodes: pick(&root.embedding().nodes, portion.nodes()),
        modes: root.modes().clone(),
    }
}

/// Large pieces of a break as bodies, each with its fragment's number.
fn bodies_of(parent: &Body, fracture: &Fracture) -> Vec<(usize, Body)> {
    let portions = fracture.portions(parent, |_, _| true);
    let mut bodies = Vec::new();
    for (number, portion) in portions.iter().enumerate() {
        let portion = portion.as_ref().expect("every fragment was wanted");
        if portion.tets().len() >= 8 {
            let piece = parent.piece(portion, as_before(portion)).expect("a piece");
            bodies.push((number, piece));
        }
    }
    bodies
}

/// Asks of a break, and of those of its pieces, that the fragments tile the body; counts the breaks of each generation.
fn check(parent: &Body, fracture: &Fracture, breaks: &mut [usize; 4]) {
    let generation = parent.generation() as usize;
    breaks[generation] += 1;
    assert!(fracture.report.volume_error.abs() < 1e-9);
    let whole = &parent.asset().mass();
    let mass: f64 = fracture.fragments.iter().map(|f| f.mass.mass).sum();
    let moments = fracture
        .fragments
        .iter()
        .map(|f| f.mass.centre * f.mass.mass);
    assert!((mass / whole.mass - 1.0).abs() < 1e-9);
    assert!((moments.sum::<DVec3>() / mass - whole.centre).length() < 1e-8);
    assert!(fracture.fragments.iter().all(|f| f.mesh.is_closed()));
    if generation + 1 == breaks.len() {
        return;
    }
    for (number, piece) in bodies_of(parent, fracture) {
        let fragment = &fracture.fragments[number];
        assert_eq!(piece.generation(), parent.generation() + 1);
        assert!((piece.asset().mass().mass / fragment.mass.mass - 1.0).abs() < 1e-12);
        let at = fragment.mesh.positions[0];
        let toward = -at.normalize_or(Vec3::X);
        let hit = Contact::strike(at, toward, 40.0, bodies::steel_ball(0.4));
        let outcome = impact(&piece, &[hit], &FractureConfig::default()).expect("an outcome");
        if let Outcome::Broke(again) = outcome {
            check(&piece, &again, breaks);
        }
    }
}

#[test]
fn pieces_of_pieces_tile_them() {
    let mut generations = [0; 4];
    for seed in 1..=3 {
        for speed in [5.0, 12.0, 20.0] {
            for (kind, hit) in [
                (pane(), pane_hit(0.05, 0.0, speed)),
                (block(), block_hit(speed)),
            ] {
                let body = kind.body(seed);
                let outcome = impact(&body, &[hit], &FractureConfig::default());
                if let Outcome::Broke(fracture) = outcome.expect("an outcome") {
                    check(&body, &fracture, &mut generations);
                }
            }
        }
    }
    println!("breaks of each generation: {generations:?}");
    assert!(generations[1] > 5 && generations[2] > 0, "{generations:?}");
}

#[test]
fn pieces_share_the_mesh_and_have_their_own_part_of_it() {
    let mut seen = 0;
    for seed in 1..=4 {
        let body = block().body(seed);
        let outcome = strike(block(), seed, block_hit(20.0), &FractureConfig::default());
        let Outcome::Broke(fracture) = outcome else {
            continue;
        };
        let portions = fracture.portions(&body, |_, _| true);
        let mut owner = vec![None; body.asset().fracture().tets.len()];
        for (number, portion) in portions.iter().enumerate() {
            for &e in portion.as_ref().expect("it was wanted").tets() {
                assert_eq!(owner[e as usize].replace(number), None, "tetrahedron {e}");
            }
        }
        for (_, piece) in bodies_of(&body, &fracture) {
            assert!(Arc::ptr_eq(
                piece.asset().fracture(),
                body.asset().fracture()
            ));
            for e in piece.weak_tets() {
                assert!(body.weak_tets().binary_search(e).is_ok());
                assert_eq!(piece.strength(*e).to_bits(), body.strength(*e).to_bits());
            }
            seen += 1;
        }
    }
    assert!(seen > 4, "{seen}");
}

#[test]
fn modes_that_do_not_fit_a_piece_are_refused_by_name() {
    let body = block().body(1);
    let hard = block_hit(20.0);
    let Outcome::Broke(fracture) = strike(block(), 1, hard, &FractureConfig::default()) else {
        panic!("the block held");
    };
    let portions = fracture.portions(&body, |_, _| true);
    let uncut = |p: &&Arc<Portion>| !p.tets().is_empty() && !p.nodes().is_empty();
    let portion = portions
        .iter()
        .flatten()
        .find(uncut)
        .expect("a piece with elements of its own");
    assert!(body.piece(portion, as_before(portion)).is_ok());
    let stranger = pane().body(1).piece(portion, as_before(portion));
    let error = stranger.expect_err("it is no part of the pane");
    assert!(error.to_string().contains("another body"), "{error}");
    type Spoil = fn(&mut Elastic);
    let cases: [(&str, Spoil); 9] = [
        ("one point for each", |e| {
            e.tets.pop();
        }),
        ("one point for each", |e| {
            e.nodes.pop();
        }),
        ("element", |e| e.tets[0].element = u32::MAX),
        ("element", |e| e.analysis.elements[0][0] = u32::MAX),
        ("shapes", |e| {
            e.modes.shapes.pop();
        }),
        ("shapes", |e| e.modes.shapes[3] = f32::NAN),
        ("eigenvalue", |e| e.modes.eigenvalues[0] = f64::NAN),
        ("eigenvalue", |e| e.modes.eigenvalues[0] = 0.0),
        ("centroid", |e| e.tets[0].barycentric[1] = f32::NAN),
    ];
    for (word, spoil) in cases {
        let mut elastic = as_before(portion);
        spoil(&mut elastic);
        let Err(error) = body.piece(portion, elastic) else {
            panic!("{word}")
        };
        assert!(matches!(error, InputError::Asset { .. }));
        assert!(error.to_string().contains(word), "{word}: {error}");
    }
}

#[test]
fn a_whole_body_with_its_modes_again_breaks_as_it_did() {
    let config = FractureConfig::default();
    let body = pane().body(2);
    let portion = Arc::new(Portion::of_cracked(&body, &config).unwrap());
    let again = body.piece(&portion, as_before(&portion)).unwrap();
    assert_eq!(again.generation(), 0);
    assert_eq!(again.weak_tets(), body.weak_tets());
    let hit = pane_hit(0.02, 0.03, 15.0);
    let [one, other] =
        [&body, &again].map(|b| impact(b, std::slice::from_ref(&hit), &config).unwrap());
    assert_eq!(pieces(&one), pieces(&other));
    let area = |o: &Outcome| o.report().crack_area;
    assert!((area(&one) / area(&other) - 1.0).abs() < 1e-3);
}

#[test]
fn crumbs_stay_with_a_cracked_body_as_its_configuration_says() {
    let default = FractureConfig::default();
    let mut together = default.clone();
    together.crumb_share = 0.99;
    let mut body = pane().body(2);
    let hit = pane_hit(0.02, 0.03, 15.0);
    assert!(pieces(&impact(&body, std::slice::from_ref(&hit), &default).unwrap()) > 1);
    // All pieces but one are crumbs then, and stay with it.
    let Outcome::Held { state, .. } = impact(&body, &[hit], &together).unwrap() else {
        panic!("it parts")
    };
    body.set_state(*state.unwrap()).unwrap();
    let nodes = |config| Portion::of_cracked(&body, config).unwrap().nodes().len();
    assert_eq!(nodes(&together), body.asset().fracture().positions.len());
    assert!(nodes(&default) < nodes(&together));
    together.crumb_share = 2.0;
    assert!(Portion::of_cracked(&body, &together).is_err());
}
