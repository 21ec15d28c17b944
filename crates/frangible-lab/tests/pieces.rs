//! A small run of the comparison of ways to find how pieces vibrate: a finer way is nearer to the truth, the data has the results, and threads
//! change nothing but times.

use std::sync::Arc;

use frangible::glam::Vec3;
use frangible::{Breakable, Contact, FractureConfig, Material, Outcome, Striker, impact};
use frangible_bake::{BakeSpec, Shape, bake};
use frangible_lab::verify::pieces::{Broken, PieceSample, Truth, TruthPlan, WAYS};

fn broken() -> Broken {
    let shape = Shape::plate(0.2, 0.15, 0.005);
    let spec = BakeSpec {
        modes: 40,
        fracture: Some(shape.size_for(8000.0).expect("a size")),
        ..BakeSpec::new("plate", shape, Material::preset("glass").expect("glass"))
    };
    let asset = bake(&spec).expect("a plate");
    let body = Breakable::uniform(Arc::new(asset)).expect("a body").body(3);
    let steel = Material::preset("steel").expect("steel");
    let ball = Striker::ball(&steel, 0.2, 0.018);
    let at = Vec3::new(0.03, 0.01, 0.0025);
    let hit = Contact::collision(body.asset(), at, Vec3::NEG_Z, 5.0, ball);
    match impact(
        &body,
        std::slice::from_ref(&hit),
        &FractureConfig::default(),
    )
    .expect("an outcome")
    {
        Outcome::Broke(fracture) => Broken::new("plate", body, *fracture),
        _ => panic!("the plate held"),
    }
}

/// Median error of the pieces' frequencies, as the page has it: one odd piece of four must not decide.
fn frequency_error(pieces: &[PieceSample], way: usize) -> f64 {
    let errors = pieces.iter().flat_map(|p| {
        let own = p.ways[way]
            .as_ref()
            .expect("served")
            .reading
            .frequencies
            .iter();
        own.zip(&p.truth.frequencies)
            .map(|(f, t)| (f / t - 1.0).abs())
    });
    let mut errors: Vec<f64> = errors.collect();
    errors.sort_by(f64::total_cmp);
    errors[errors.len() / 2]
}

/// All results that must not depend on threads.
fn bits(truth: &Truth) -> Vec<u64> {
    let of = |p: &PieceSample| {
        let mut bits = vec![p.tets as u64];
        bits.extend(p.truth.frequencies.iter().map(|f| f.to_bits()));
        bits.extend(p.blows.iter().map(|b| b.level.to_bits()));
        for way in p.ways.iter().flatten() {
            bits.extend(way.reading.frequencies.iter().map(|f| f.to_bits()));
            bits.extend(way.blows.iter().map(|b| b.stress.to_bits()));
            bits.extend(way.blows.iter().map(|b| u64::from(b.breaks)));
        }
        bits
    };
    truth.pieces.iter().flat_map(of).collect()
}

#[test]
fn finer_ways_are_nearer_to_the_truth_on_any_number_of_threads() {
    let broken = [broken()];
    let truth = Truth::compute(TruthPlan::tiny(), &broken, &|_| {}).expect("a comparison");
    assert_eq!(truth.pieces.len(), TruthPlan::tiny().fragments);
    assert!(truth.refused.is_empty(), "{:?}", truth.refused);
    assert!(truth.pieces.is_sorted_by_key(|p| p.tets));
    let named = |name: &str| {
        let found = WAYS.iter().position(|w| w.name.contains(name));
        frequency_error(&truth.pieces, found.expect("a way of that name"))
    };
    let (coarse, fine, parent) = (named("150"), named("600"), named("parent"));
    println!("median errors of frequency: {fine:.4} {coarse:.4} {parent:.4}");
    assert!(
        fine < 0.02 && fine < coarse && coarse < parent,
        "{fine} {coarse} {parent}"
    );
    let blows: Vec<_> = truth.pieces.iter().flat_map(|p| &p.blows).collect();
    assert!(blows.len() >= 9, "{}", blows.len());
    // Speeds are set so that some blows stay below the strength, and some do not.
    assert!(blows.iter().any(|b| b.level < 0.8) && blows.iter().any(|b| b.level > 1.5));

    let data = truth.data();
    for list in ["ways", "by_size", "by_level", "rebaked"] {
        assert!(
            data[list].as_array().is_some_and(|rows| !rows.is_empty()),
            "{list}"
        );
    }
    assert_eq!(data["pieces"], truth.pieces.len());

    let alone = TruthPlan {
        threads: 1,
        baked: 0,
        ..TruthPlan::tiny()
    };
    let alone = Truth::compute(alone, &broken, &|_| {}).expect("a comparison");
    assert_eq!(bits(&alone), bits(&truth));
}
