//! Impacts whose beginning of cracks is looked for ahead.

use frangible::glam::Vec3;
use frangible::internals::stress::{DisplacementBatch, Elasticity, largest_eigenvalue};
use frangible::internals::{Onset, OnsetSearch, Stage, Vibration};
use frangible::{Body, Breakable, Contact, FractureConfig, Material, Outcome, Striker, impact};
use frangible_bake::{BakeSpec, MeshSize, Shape, bake};

/// A pane of glass 300 × 200 × 6 mm, 40 modes.
fn pane() -> Body {
    let spec = BakeSpec {
        modes: 40,
        analysis: Some(MeshSize {
            edge: 0.025,
            layers: 1,
        }),
        fracture: Some(MeshSize {
            edge: 0.012,
            layers: 1,
        }),
        ..BakeSpec::new(
            "pane",
            Shape::plate(0.3, 0.2, 0.006),
            Material::preset("glass").unwrap(),
        )
    };
    let asset = bake(&spec, &mut |_| {}).unwrap().0;
    Breakable::new(asset).unwrap().body(1)
}

/// A steel ball of 50 g on the pane, from above.
fn blow(body: &Body, speed: f64) -> Contact {
    let steel = Material::preset("steel").unwrap();
    Contact::collision(
        body.asset(),
        Vec3::new(0.04, 0.02, 0.003),
        Vec3::NEG_Z,
        speed,
        Striker::ball(&steel, 0.05, 0.0115),
    )
}

fn begun(body: &Body, contact: Contact, config: &FractureConfig) -> Vibration {
    match Vibration::begin(body, std::slice::from_ref(&contact), config).unwrap() {
        Stage::Vibrates(vibration) => vibration,
        Stage::Held(_) => panic!("refused at once"),
    }
}

/// The first step at which any weak point's stress passes its strength, by looking at all of them at all steps.
fn first_by_looking_at_all(
    body: &Body,
    vibration: &Vibration,
    config: &FractureConfig,
) -> Option<usize> {
    let asset = &**body.asset();
    let motion = vibration.motion(body);
    let elasticity = Elasticity::new(&asset.material).with_green_lagrange(config.green_lagrange);
    let mut displacement = DisplacementBatch::new(asset);
    (0..motion.steps()).find(|&step| {
        displacement.seek(&motion, step);
        body.weak_tets().iter().any(|&tet| {
            let (point, law) = body.weak_place(tet, config, &vibration.pressed);
            let gradient = displacement.gradient(asset, point, step);
            largest_eigenvalue(&elasticity.state_by(gradient, law).stress) > body.strength(tet)
        })
    })
}

#[test]
fn the_onset_is_the_first_step_at_which_any_weak_point_passes_its_strength() {
    let body = pane();
    let config = FractureConfig::with_given_impulses();
    // Soft blows are refused before their vibration begins, unless that is off.
    let mut unrefused = FractureConfig::with_given_impulses();
    unrefused.culling = false;
    let (mut never, mut at) = (0, 0);
    for speed in [0.8, 1.6, 2.4, 3.2, 4.0, 6.0, 12.0] {
        let vibration = begun(&body, blow(&body, speed), &unrefused);
        let expected = first_by_looking_at_all(&body, &vibration, &config);
        let mut at_once = OnsetSearch::new(&body, vibration.clone());
        match (at_once.look(&body, &config, usize::MAX), expected) {
            (Onset::Never, None) => never += 1,
            (Onset::At(found), Some(step)) if found == step => at += 1,
            other => panic!("{speed} m/s: {other:?}"),
        }
        let mut by_and_by = OnsetSearch::new(&body, vibration);
        let mut before = 0;
        while let Onset::NotBefore(step) = by_and_by.look(&body, &config, 1) {
            assert!(step >= before, "{step} after {before}");
            before = step;
        }
        assert_eq!(by_and_by.onset(), at_once.onset(), "{speed} m/s");
    }
    assert!(never > 1 && at > 1, "{never} {at}");
}

#[test]
fn from_its_onset_on_an_impact_ends_as_a_whole_one_does() {
    let body = pane();
    let config = FractureConfig::with_given_impulses();
    let contact = blow(&body, 12.0);
    let Outcome::Broke(whole) = impact(&body, std::slice::from_ref(&contact), &config).unwrap()
    else {
        panic!("it held");
    };
    for looks in [0, 1, usize::MAX] {
        let mut search = OnsetSearch::new(&body, begun(&body, contact.clone(), &config));
        search.look(&body, &config, looks);
        let (vibration, first_step) = search.into_impact();
        let Outcome::Broke(parts) = vibration.end(&body, &config, first_step) else {
            panic!("it held from step {first_step} on");
        };
        assert_eq!(parts.fragments.len(), whole.fragments.len());
        for (a, b) in parts.fragments.iter().zip(&whole.fragments) {
            assert_eq!(a.mesh.positions, b.mesh.positions);
            assert_eq!(a.mesh.triangles, b.mesh.triangles);
        }
    }
}

#[test]
fn old_cracks_leave_the_question_open() {
    let mut body = pane();
    let config = FractureConfig::with_given_impulses();
    // A blow that cracks without parting, among rising ones.
    let state = (10..80).find_map(|k| {
        let outcome = impact(&body, &[blow(&body, 0.1 * f64::from(k))], &config).unwrap();
        match outcome {
            Outcome::Held { state, .. } => state,
            _ => None,
        }
    });
    let state = state.expect("some blow cracks the pane without parting it");
    let mut unrefused = FractureConfig::with_given_impulses();
    unrefused.culling = false;
    let answer = |body: &Body| {
        OnsetSearch::new(body, begun(body, blow(body, 1.6), &unrefused)).look(body, &config, 9)
    };
    assert_eq!(answer(&body), Onset::Never);
    body.set_state(*state).unwrap();
    assert_eq!(answer(&body), Onset::NotBefore(0));
}
