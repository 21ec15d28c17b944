//! A scene whose bodies are of kinds that a program made, in the place of what its description says.

use frangible_bake::weakness::{Patch, Zone};
use frangible_scenes::{BakedBody, LiveScene, SceneError, bake, breakable, scene};

/// Time of the first break, s, and its masses, kg.
fn first_break(mut live: LiveScene) -> (f64, Vec<f64>) {
    while live.time() < 1.0 {
        live.step().unwrap();
        if let Some(event) = live.world().breaks().first() {
            let fragments = event.fracture.fragments.iter();
            return (live.time(), fragments.map(|f| f.mass.mass).collect());
        }
    }
    panic!("nothing breaks");
}

#[test]
fn a_weak_kind_breaks_as_a_described_weakness_does() {
    let mut plain = scene("five-blows").unwrap();
    plain.bodies[0].modes = 20;
    plain.bodies[0].resolution = Some(2500);
    plain.pieces.generations = 0;
    let mut weak = plain.clone();
    let everywhere = Zone::Sphere {
        centre: frangible::glam::Vec3::ZERO,
        radius: 1.0,
    };
    weak.bodies[0].weakness = vec![Patch::of_strength(everywhere, 0.3)];
    let baked: Vec<BakedBody> = bake(&plain).unwrap();
    let kinds = [breakable(&weak.bodies[0], &baked[0].asset).unwrap()];
    let described = first_break(LiveScene::new(&weak, &baked).unwrap());
    let given = first_break(LiveScene::of_kinds(&plain, &kinds).unwrap());
    assert_eq!(described, given);
    assert_ne!(given, first_break(LiveScene::new(&plain, &baked).unwrap()));
    assert!(matches!(
        LiveScene::of_kinds(&plain, &[]),
        Err(SceneError::BakedBodies {
            wanted: 1,
            given: 0
        })
    ));
}
