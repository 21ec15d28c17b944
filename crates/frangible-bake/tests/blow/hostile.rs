//! Blows of any numbers on bodies of any shape.

use std::sync::Arc;

use frangible::glam::Vec3;
use frangible::internals::blow::Blow;
use frangible::internals::contact::SharedMass;
use frangible::{Asset, Breakable, Contact, FractureConfig, Material, Striker};
use frangible_bake::Shape;

use super::{around, baked, material, peak};

#[test]
fn no_input_makes_nonsense() {
    let asset = baked(Shape::plate(0.1, 0.1, 0.002), material("glass"), 30, 800.0);
    let body = Breakable::uniform(asset).unwrap().body(1);
    let config = FractureConfig::default();
    let steel = Material::preset("steel").unwrap();
    let top = Vec3::new(0.0, 0.0, 0.001);
    let ball = |mass: f64, radius: f64, speed: f32| {
        Contact::strike(top, Vec3::NEG_Z, speed, Striker::ball(&steel, mass, radius))
    };
    let tets = around(&body, top, [0.0, 0.2], 97);
    let sound = |name: &str, contacts: &[Contact]| {
        let Ok(blow) = Blow::new(&body, contacts, &config) else {
            return "refused";
        };
        let Some(blow) = blow else {
            return "nothing";
        };
        for report in blow.reports() {
            assert!(
                report.impulse.is_finite()
                    && report.peak_force.is_finite()
                    && report.departure_speed.is_finite()
                    && report.contact_radius.is_finite(),
                "{name}: {report:?}"
            );
            assert!(
                report.impulse >= 0.0 && report.peak_force >= 0.0,
                "{name}: {report:?}"
            );
        }
        let steps = blow.reports()[0].force.len();
        for step in (0..steps).step_by((steps / 8).max(1)) {
            for &tet in &tets {
                let s = blow.stress(&body, tet, step, &config);
                assert!(
                    s.diagonal.iter().chain(&s.off).all(|x| x.is_finite()),
                    "{name}: {s:?}"
                );
            }
        }
        "blow"
    };
    let rigid = |mass: f64| Striker::rigid().with_effective_mass(mass);
    // One body of these kilograms that strikes at two points, and answers each with a velocity that belongs to another mass.
    let at_two_points = |mass: f64, mass_between: f64| {
        [0.01, -0.01].map(|x: f32| {
            let mut contact = ball(mass, 0.01, 2.0);
            contact.point.x = x;
            contact.striker.shared = Some(SharedMass {
                body: 0,
                velocity: x.signum() * Vec3::X / (mass_between as f32).sqrt(),
                spin: Vec3::ZERO,
            });
            contact
        })
    };
    for (name, contacts, expected) in [
        (
            "a ball wider than the plate",
            vec![ball(1.0, 1e3, 2.0)],
            "blow",
        ),
        ("a point", vec![ball(1e-3, 1e-12, 2.0)], "blow"),
        (
            "a flat rigid striker",
            vec![Contact::strike(top, Vec3::NEG_Z, 1.0, rigid(0.1))],
            "blow",
        ),
        ("no speed", vec![ball(1.0, 0.01, 0.0)], "nothing"),
        ("hardly any speed", vec![ball(1.0, 0.01, 1e-30)], "blow"),
        ("much speed", vec![ball(1.0, 0.01, 1e9)], "blow"),
        ("hardly any mass", vec![ball(1e-30, 0.01, 3.0)], "blow"),
        ("no mass", vec![ball(0.0, 0.01, 3.0)], "refused"),
        (
            "speed that is not a number",
            vec![ball(1.0, 0.01, f32::NAN)],
            "refused",
        ),
        (
            "mass that is not a number",
            vec![ball(f64::NAN, 0.01, 1.0)],
            "refused",
        ),
        (
            "radius that is not a number",
            vec![ball(1.0, f64::NAN, 1.0)],
            "refused",
        ),
        ("radius of nothing", vec![ball(1.0, 0.0, 1.0)], "refused"),
        (
            "a script without force",
            vec![Contact::push(top, Vec3::ZERO, 1e-4)],
            "refused",
        ),
        (
            "a script",
            vec![Contact::push(top, Vec3::NEG_Z, 1e-4)],
            "blow",
        ),
        (
            "a short script",
            vec![Contact::push(top, 1e-3 * Vec3::NEG_Z, 1e-12)],
            "blow",
        ),
        (
            "a long script",
            vec![Contact::push(top, Vec3::NEG_Z, 0.05)],
            "blow",
        ),
        (
            "a script of endless length",
            vec![Contact::push(top, Vec3::NEG_Z, f32::INFINITY)],
            "refused",
        ),
        (
            "the same place twice",
            vec![ball(0.01, 0.01, 2.0); 2],
            "blow",
        ),
        (
            "a body that strikes at two points",
            at_two_points(0.1, 0.1).to_vec(),
            "blow",
        ),
        (
            "a body with less mass between its points than at each",
            at_two_points(0.1, 0.001).to_vec(),
            "refused",
        ),
        ("nothing at all", vec![], "nothing"),
    ] {
        let clock = std::time::Instant::now();
        let found = sound(name, &contacts);
        println!("{name}: {found} {:?}", clock.elapsed());
        assert_eq!(found, expected, "{name}");
    }
}

#[test]
fn a_wall_of_any_thickness_gives_no_nonsense() {
    let asset = baked(Shape::plate(0.1, 0.1, 0.002), material("glass"), 30, 800.0);
    let steel = Material::preset("steel").unwrap();
    let top = Vec3::new(0.0, 0.0, 0.001);
    let contact = Contact::strike(top, Vec3::NEG_Z, 3.0, Striker::ball(&steel, 0.01, 0.01));
    let with = |change: &dyn Fn(&mut Asset)| {
        let mut asset = asset.clone();
        change(&mut asset);
        Breakable::uniform(Arc::new(asset))
    };
    for bad in [0.0, -1.0, f32::NAN] {
        assert!(
            with(&|a| a.parts_mut().surface.walls.thickness.fill(bad)).is_err(),
            "{bad}"
        );
    }
    for thickness in [1e-12, 1e-6, 0.05, 1e3, 1e18] {
        let body = with(&|a| a.parts_mut().surface.walls.thickness.fill(thickness))
            .unwrap()
            .body(1);
        let config = FractureConfig::default();
        let blow = Blow::new(&body, std::slice::from_ref(&contact), &config)
            .unwrap()
            .unwrap();
        let report = &blow.reports()[0];
        assert!(
            report.impulse.is_finite() && report.impulse >= 0.0,
            "{thickness}: {report:?}"
        );
        let tets = around(&body, top, [0.0, 0.2], 97);
        assert!(
            peak(&body, &blow, &config, &tets).is_finite(),
            "{thickness}"
        );
    }
    for (what, change) in [
        (
            "an edge at the contact",
            Box::new(|a: &mut Asset| a.parts_mut().surface.walls.margin.fill(0.0))
                as Box<dyn Fn(&mut Asset)>,
        ),
        (
            "much curvature",
            Box::new(|a: &mut Asset| a.parts_mut().surface.walls.stiffening.fill(1e12)),
        ),
    ] {
        let body = with(&*change).unwrap().body(1);
        let config = FractureConfig::default();
        let blow = Blow::new(&body, std::slice::from_ref(&contact), &config)
            .unwrap()
            .unwrap();
        assert!(blow.reports()[0].impulse > 0.0, "{what}");
    }
}
