//! Contact durations against closed forms, and what a contact must not hold.

use frangible::glam::Vec3;
use frangible::{Contact, Material, Striker, contact};

fn relative(a: f64, b: f64) -> f64 {
    (a / b - 1.0).abs()
}

/// Two steel spheres: 1/m* = 1/m₁ + 1/m₂, 1/R* = 1/R₁ + 1/R₂, 1/E* = Σ (1−ν²)/E.
#[test]
fn two_steel_spheres_touch_as_long_as_hertz_says() {
    let steel = Material::preset("steel").unwrap();
    let (r1, r2, speed) = (0.010_f64, 0.025_f64, 3.0_f64);
    let mass = |r: f64| steel.density * 4.0 / 3.0 * std::f64::consts::PI * r.powi(3);
    let m = 1.0 / (1.0 / mass(r1) + 1.0 / mass(r2));
    let r = 1.0 / (1.0 / r1 + 1.0 / r2);
    let e = steel.youngs_modulus / (2.0 * (1.0 - steel.poisson_ratio.powi(2)));
    let modulus = 1.0 / (2.0 / steel.contact_modulus());
    assert!(relative(modulus, e) < 1e-14);
    let given = contact::hertz_duration(m, modulus, r, speed);
    let expected = 2.868 * (m * m / (e * e * r * speed)).powf(0.2);
    assert!(
        relative(given, expected) < 1e-12,
        "{given} s, not {expected} s"
    );

    // The constant itself, from Hertz' law F = 4/3 E* √R* δ^(3/2) integrated in time.
    let k = 4.0 / 3.0 * e * r.sqrt();
    let deepest = (1.25 * m * speed * speed / k).powf(0.4);
    let dt = given / 200_000.0;
    let (mut depth, mut rate, mut time) = (0.0_f64, speed, 0.0_f64);
    let force = |depth: f64| -k * depth.max(0.0).powf(1.5) / m;
    let mut largest = 0.0_f64;
    while depth >= 0.0 {
        rate += 0.5 * dt * force(depth);
        depth += dt * rate;
        rate += 0.5 * dt * force(depth);
        time += dt;
        largest = largest.max(depth);
    }
    assert!(relative(largest, deepest) < 1e-4);
    // 2.868 with E* as here (Johnson, Contact Mechanics, Eq. 11.24: 2.87).
    assert!(
        relative(time, given) < 1e-3,
        "{time} s integrated, {given} s given"
    );
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
    Contact {
        point: Vec3::new(0.1, 0.0, 0.0),
        normal: Vec3::NEG_X,
        impulse: 0.2,
        friction: Vec3::new(0.0, 0.1, 0.0),
        approach_speed: 4.0,
        striker: Striker {
            contact_modulus: 2e11,
            inverse_effective_mass: 10.0,
            curvature_radius: 0.01,
            restitution: 0.5,
            modal_duration: 0.0,
        },
    }
}

#[test]
fn a_sound_contact_is_accepted_even_from_a_rigid_flat_immovable_striker() {
    sound().validate().unwrap();
    let striker = Striker::rigid();
    Contact {
        striker,
        impulse: 0.0,
        approach_speed: 0.0,
        ..sound()
    }
    .validate()
    .unwrap();
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
