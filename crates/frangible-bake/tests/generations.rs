//! Pieces of pieces: they tile the body that broke, are closed, and keep their weak points and cracks.

use std::sync::Arc;

use crate::common::breakable;
use frangible::glam::DVec3;
use frangible::internals::Portion;
use frangible::{
    Body, Contact, Fracture, FractureConfig, Fragment, Material, Outcome, Striker, glam::Vec3,
    impact,
};
use frangible_bake::Shape;
use frangible_bake::pieces::reanalysis;

/// Breaks that follow one another.
const GENERATIONS: u32 = 3;

fn stone() -> Striker {
    Striker::fixed(&Material::preset("stone").expect("a preset"))
}

fn volume(portion: &Portion) -> f64 {
    let solid = portion.solid();
    let of_tet = |t: &[u32; 4]| {
        let [a, b, c, d] = t.map(|v| solid.positions[v as usize]);
        (b - a).cross(c - a).dot(d - a) / 6.0
    };
    solid.tets.iter().map(of_tet).sum()
}

/// Counts of the breaks of each generation, and of the pieces.
#[derive(Default)]
struct Seen {
    breaks: [usize; GENERATIONS as usize + 1],
    pieces: usize,
}

fn check(body: &Body, fracture: &Fracture, seen: &mut Seen) {
    seen.breaks[body.generation() as usize] += 1;
    let report = &fracture.report;
    assert!(report.volume_error.abs() < 1e-9, "{}", report.volume_error);
    let mass: f64 = fracture.fragments.iter().map(|f| f.mass.mass).sum();
    let moment: DVec3 = fracture
        .fragments
        .iter()
        .map(|f| f.mass.centre * f.mass.mass)
        .sum();
    let parent = &body.asset().mass();
    assert!((mass / parent.mass - 1.0).abs() < 1e-9);
    // The centre of all of them is that of the body; its surface is stored in f32.
    assert!((moment / mass - parent.centre).length() < 1e-8);
    for fragment in &fracture.fragments {
        assert!(fragment.mesh.is_closed());
    }
    let portions = fracture.portions(body, |_, f| f.mass.mass > 1e-3);
    for (fragment, portion) in fracture.fragments.iter().zip(&portions) {
        let Some(portion) = portion else { continue };
        seen.pieces += 1;
        assert_eq!(portion.generation(), body.generation() + 1);
        // Parts of cut tetrahedra are filled from a point in their middle, which warped faces hide a little of: up to 1.1 % here,
        // of the smallest pieces.
        let tolerance = 2e-2;
        let solid = volume(portion) / fragment.mass.volume - 1.0;
        assert!(solid.abs() < tolerance, "the solid is off by {solid}");
        if portion.tets().len() < 100 || body.generation() + 1 > GENERATIONS {
            continue;
        }
        let elastic = reanalysis(portion, 150, 20).expect("modes");
        let piece = body.piece(portion, elastic).expect("a piece");
        let own = body.weak_tets();
        assert!(
            piece
                .weak_tets()
                .iter()
                .all(|e| own.binary_search(e).is_ok())
        );
        let at = fragment.mesh.positions[0];
        let hit = Contact::strike(at, -at.normalize_or(Vec3::X), 6.0, stone());
        let outcome = impact(
            &piece,
            std::slice::from_ref(&hit),
            &FractureConfig::default(),
        )
        .expect("an outcome");
        if let Outcome::Broke(again) = outcome {
            check(&piece, &again, seen);
        }
    }
}

#[test]
fn pieces_of_pieces_tile_them_over_three_generations() {
    let kind = breakable(Shape::drinking_glass(), "glass", 15_000.0, 40);
    let body = kind.body(1);
    let hit = Contact::strike(Vec3::new(-0.038, 0.0, 0.068), Vec3::X, 5.0, stone());
    let outcome = impact(
        &body,
        std::slice::from_ref(&hit),
        &FractureConfig::default(),
    )
    .expect("an outcome");
    let Outcome::Broke(fracture) = outcome else {
        panic!("the glass held");
    };
    let mut seen = Seen::default();
    check(&body, &fracture, &mut seen);
    for generation in 0..GENERATIONS {
        assert!(seen.breaks[generation as usize] > 0, "{:?}", seen.breaks);
    }
    assert!(seen.pieces >= 8, "{}", seen.pieces);
}

/// A piece of a plate is as thick as the plate, ends at its cracks, and has no wall behind them.
fn check_walls(piece: &Body, fragment: &Fragment) {
    let (mesh, surface) = (&fragment.mesh, piece.asset().surface());
    assert_eq!(surface.walls.thickness.len(), mesh.triangles.len());
    let (outer, inner) = mesh.triangles.split_at(mesh.outer_triangles);
    let at_crack: Vec<u32> = inner.iter().flatten().copied().collect();
    for (t, corners) in outer.iter().enumerate() {
        let Some(wall) = surface.walls.at(t as u32) else {
            continue;
        };
        assert!((wall.thickness - 0.004).abs() < 1e-6, "{wall:?}");
        assert!(wall.margin <= 0.1);
        let x = corners.map(|v| mesh.positions[v as usize]);
        let longest = x[0]
            .distance(x[1])
            .max(x[1].distance(x[2]))
            .max(x[2].distance(x[0]));
        if corners.iter().any(|v| at_crack.contains(v)) {
            assert!(
                wall.margin <= f64::from(longest),
                "{wall:?}, edge {longest}"
            );
        }
    }
    let behind_cracks = outer.len()..mesh.triangles.len();
    assert!(
        behind_cracks
            .into_iter()
            .all(|t| surface.walls.at(t as u32).is_none())
    );
}

#[test]
fn pieces_share_the_parents_mesh_and_weak_points() {
    let kind = breakable(Shape::plate(0.2, 0.2, 0.004), "glass", 12_000.0, 40);
    let body = kind.body(3);
    let hit = Contact::strike(Vec3::new(0.02, 0.01, 0.002), Vec3::NEG_Z, 8.0, stone());
    let outcome = impact(
        &body,
        std::slice::from_ref(&hit),
        &FractureConfig::default(),
    )
    .expect("an outcome");
    let Outcome::Broke(fracture) = outcome else {
        panic!("the plate held");
    };
    let portions = fracture.portions(&body, |_, _| true);
    let mut owner = vec![None; body.asset().fracture().tets.len()];
    for (number, portion) in portions.iter().enumerate() {
        let portion = portion.as_ref().expect("every fragment was wanted");
        let elastic = frangible_bake::pieces::reanalysis(portion, 60, 4);
        // Some are too small for elements of their own.
        if let Ok(elastic) = elastic {
            let piece = body.piece(portion, elastic).expect("a piece");
            let (own, parents) = (piece.asset().fracture(), body.asset().fracture());
            assert!(Arc::ptr_eq(own, parents));
            check_walls(&piece, &fracture.fragments[number]);
        }
        for &e in portion.tets() {
            assert_eq!(owner[e as usize].replace(number), None, "tetrahedron {e}");
        }
    }
}

#[test]
fn blows_that_chip_small_pieces_have_impulses_and_velocities() {
    let kind = breakable(Shape::plate(0.2, 0.2, 0.004), "glass", 6_000.0, 40);
    let body = kind.body(3);
    let ball = Striker::ball(&Material::preset("stone").expect("a preset"), 0.01, 0.01);
    let hit = Contact::strike(
        Vec3::new(0.02, 0.01, 0.002),
        Vec3::NEG_Z,
        20.0,
        ball.clone(),
    );
    let config = FractureConfig::default();
    let outcome = impact(&body, std::slice::from_ref(&hit), &config).expect("an outcome");
    let Outcome::Broke(fracture) = outcome else {
        panic!("the plate held");
    };
    let portions = fracture.portions(&body, |_, _| true);
    let (mut blows, mut breaks) = (0, 0);
    for (portion, fragment) in portions.iter().flatten().zip(&fracture.fragments) {
        let Ok(elastic) = reanalysis(portion, 60, 20) else {
            continue;
        };
        let piece = body.piece(portion, elastic).expect("a piece");
        let points = &fragment.mesh.positions;
        for &at in points.iter().step_by(points.len().div_ceil(12)) {
            let hit = Contact::strike(at, -at.normalize_or(Vec3::X), 40.0, ball.clone());
            let outcome = impact(&piece, std::slice::from_ref(&hit), &config).expect("an outcome");
            blows += 1;
            let contacts = &outcome.report().contacts;
            assert!(
                contacts.iter().all(|contact| contact.impulse.is_finite()),
                "{contacts:?}"
            );
            if let Outcome::Broke(again) = outcome {
                breaks += 1;
                for fragment in &again.fragments {
                    assert!(fragment.velocity.is_finite(), "{fragment:?}");
                    assert!(fragment.angular_velocity.is_finite(), "{fragment:?}");
                }
            }
        }
    }
    assert!(blows > 100 && breaks > 20, "{breaks} of {blows}");
}
