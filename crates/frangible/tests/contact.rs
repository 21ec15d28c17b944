//! How contact durations go with what they depend on, and what a contact must not hold.

use frangible::glam::{Mat3, Vec3};
use frangible::internals::contact;
use frangible::{Contact, Material, Striker};

fn relative(a: f64, b: f64) -> f64 {
    (a / b - 1.0).abs()
}

#[test]
fn hertz_duration_goes_with_each_quantity_as_its_power() {
    let of =
        |f: [f64; 4]| contact::hertz_duration(0.1 * f[0], 3e10 * f[1], 0.01 * f[2], 2.0 * f[3]);
    let whole = of([1.0; 4]);
    for (i, power) in [0.4, -0.4, -0.2, -0.2].into_iter().enumerate() {
        for factor in [1e-3, 0.3, 2.0, 1e4] {
            let mut f = [1.0; 4];
            f[i] = factor;
            assert!(
                relative(of(f) / whole, f64::powf(factor, power)) < 1e-12,
                "quantity {i} times {factor}"
            );
        }
    }
}

#[test]
fn modal_duration_of_the_plate_in_the_theory_is_a_millisecond() {
    let eigenvalue = (std::f64::consts::TAU * 800.0).powi(2);
    let t = contact::modal_hertz_duration(eigenvalue, 0.02, 5.0);
    assert!((t - 1.0e-3).abs() < 0.05e-3, "{t} s");
    assert!((t * 800.0 - 0.83).abs() < 0.02, "{} of a period", t * 800.0);
    // The fifth root: λ^(-2/5), r^(1/5), v^(-1/5).
    let of = |l: f64, r: f64, v: f64| {
        contact::modal_hertz_duration(eigenvalue * l, 0.02 * r, 5.0 * v) / t
    };
    assert!(relative(of(32.0, 1.0, 1.0), 0.25) < 1e-12);
    assert!(relative(of(1.0, 32.0, 1.0), 2.0) < 1e-12);
    assert!(relative(of(1.0, 1.0, 32.0), 0.5) < 1e-12);
}

fn sound() -> Contact {
    let mut striker = Striker::rigid()
        .with_contact_modulus(2e11)
        .with_effective_mass(0.1)
        .with_curvature_radius(0.01)
        .with_restitution(0.5);
    striker.crushing_pressure = 5e9;
    Contact {
        point: Vec3::new(0.1, 0.0, 0.0),
        normal: Vec3::NEG_X,
        impulse: 0.2,
        friction: Vec3::new(0.0, 0.1, 0.0),
        approach_speed: 4.0,
        duration: 0.0,
        striker,
    }
}

#[test]
fn a_sound_contact_is_accepted_even_from_a_rigid_flat_immovable_striker() {
    sound().validate().unwrap();
    let striker = Striker::rigid();
    Contact {
        striker,
        impulse: 0.0,
        friction: Vec3::ZERO,
        approach_speed: 0.0,
        ..sound()
    }
    .validate()
    .unwrap();
}

#[test]
fn a_striking_body_resists_with_its_mass_and_its_inertia() {
    let steel = Material::preset("steel").unwrap();
    let (mass, inertia, arm) = (2.0, 0.5, 0.25);
    let turns = Mat3::from_diagonal(Vec3::splat(1.0 / inertia));
    let at = |arm: Vec3| Striker::body(&steel, 3, mass, turns, arm, Vec3::NEG_Z);
    let central = at(Vec3::NEG_Z).inverse_effective_mass;
    assert!((central - 0.5).abs() < 1e-6, "{central}");
    let sides = [arm, -arm].map(|x| at(Vec3::new(x, 0.0, -0.1)));
    let expected = 0.5 + arm * arm / inertia;
    for side in &sides {
        let found = side.inverse_effective_mass;
        assert!((found - expected).abs() < 1e-6, "{found}");
        let contact = Contact::strike(Vec3::ZERO, Vec3::NEG_Z, 1.0, side.clone());
        contact.validate().unwrap();
    }
    // A push on one side moves the other side by v · v' + ω · ω': the body turns away from it.
    let [one, other] = sides.map(|side| side.shared.unwrap());
    let between = one.velocity.dot(other.velocity) + one.spin.dot(other.spin);
    assert!(
        (between - (0.5 - arm * arm / inertia)).abs() < 1e-6,
        "{between}"
    );
}

#[test]
fn a_contact_that_cannot_be_used_is_refused_by_the_name_of_its_field() {
    type Spoil = fn(&mut Contact);
    let cases: [(&str, Spoil); 19] = [
        ("point", |c| c.point.y = f32::NAN),
        ("point", |c| c.point.z = f32::INFINITY),
        ("normal", |c| c.normal.x = f32::NAN),
        ("normal", |c| c.normal = Vec3::ZERO),
        ("impulse", |c| c.impulse = f32::NAN),
        ("impulse", |c| c.impulse = -1e-6),
        ("impulse", |c| c.impulse = f32::INFINITY),
        ("approach speed", |c| c.approach_speed = f32::NAN),
        ("approach speed", |c| c.approach_speed = -1.0),
        ("inverse effective mass", |c| {
            c.striker.inverse_effective_mass = f32::NAN;
        }),
        ("inverse effective mass", |c| {
            c.striker.inverse_effective_mass = -1.0;
        }),
        ("inverse effective mass", |c| {
            c.striker.inverse_effective_mass = f32::INFINITY;
        }),
        ("contact modulus", |c| c.striker.contact_modulus = f32::NAN),
        ("contact modulus", |c| c.striker.contact_modulus = 0.0),
        ("radius of curvature", |c| c.striker.curvature_radius = -0.1),
        ("radius of curvature", |c| {
            c.striker.curvature_radius = f32::NAN;
        }),
        ("restitution", |c| c.striker.restitution = f32::NAN),
        ("restitution", |c| c.striker.restitution = 1.1),
        ("restitution", |c| c.striker.restitution = -0.1),
    ];
    for (i, (name, spoil)) in cases.into_iter().enumerate() {
        let mut contact = sound();
        spoil(&mut contact);
        let message = contact
            .validate()
            .expect_err(&format!("case {i}, {name}"))
            .to_string();
        assert!(
            message.contains(name),
            "case {i} must name {name}: {message}"
        );
    }
}

#[test]
fn a_pulse_too_short_to_be_computed_is_refused() {
    let validated = |duration| {
        let contact = Contact {
            duration,
            ..sound()
        };
        contact.validate()
    };
    for duration in [f32::MIN_POSITIVE, 1e-45, 9e-13] {
        let error = validated(duration).unwrap_err().to_string();
        assert!(
            error.contains("duration") && error.contains("1e-12 or more"),
            "{error}"
        );
    }
    for duration in [0.0, 1e-12, 1e-3] {
        validated(duration).unwrap();
    }
}
