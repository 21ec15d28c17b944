//! Two equal bodies that meet and both vibrate under one force: rods beside St Venant's waves, blocks beside Hertz.

use frangible::glam::Vec3;
use frangible::internals::blow::Blow;
use frangible::{Body, Breakable, Contact, FractureConfig, Material, Striker};
use frangible_bake::{BakeSpec, MeshSize, Shape, bake};

const LENGTH: f64 = 0.4;
const SIDE: f64 = 4e-3;
const SPEED: f64 = 4.0;
const RADIUS: f64 = 2e-3;

/// Glass that rings for ever.
fn glass() -> Material {
    let mut glass = Material::preset("glass").unwrap();
    (glass.stiffness_damping, glass.mass_damping) = (0.0, 0.0);
    glass
}

/// A body of that glass, of tetrahedra of this edge, m, with so many modes.
fn body(shape: Shape, edge: f64, modes: usize) -> Body {
    let size = MeshSize { edge, layers: 0 };
    let spec = BakeSpec {
        modes,
        analysis: Some(size),
        fracture: Some(size),
        ..BakeSpec::new("body", shape, glass())
    };
    let (asset, _) = bake(&spec, &mut |_| {}).unwrap();
    Breakable::new(asset).unwrap().body(1)
}

/// Force of the wave that two rods send into each other behind Hertz' spring, N, at a time before the waves are back, s: each end gives way
/// at F/ρcA (St Venant 1883).
fn law(impedance: f64, stiffness: f64, time: f64) -> f64 {
    let (mut dent, step) = (0.0_f64, time / 20_000.0);
    let rate = |dent: f64| SPEED - 2.0 * stiffness * dent.max(0.0).powf(1.5) / impedance;
    for _ in 0..20_000 {
        dent += step * rate(dent + 0.5 * step * rate(dent));
    }
    stiffness * dent.powf(1.5)
}

#[test]
fn two_equal_rods_exchange_their_speeds() {
    let glass = glass();
    let rod = body(Shape::rod(LENGTH, SIDE), 0.002, 240);
    let config = FractureConfig::default();
    let end = Vec3::new(-0.5 * LENGTH as f32, 0.0, 0.0);
    let mut contact = Contact::new(end, Vec3::X, 0.0, SPEED as f32, Striker::rigid());
    contact.striker = Striker::flexible(&rod, &contact, &config).unwrap();
    contact.striker.curvature_radius = RADIUS as f32;
    let blow = Blow::new(&rod, &[contact], &config).unwrap().unwrap();
    let report = blow.reports()[0].clone();

    let celerity = (glass.youngs_modulus / glass.density).sqrt();
    let impedance = glass.density * celerity * SIDE * SIDE;
    let stiffness = 4.0 / 3.0 * 0.5 * glass.contact_modulus() * RADIUS.sqrt();
    let echo = 2.0 * LENGTH / celerity;
    let momentum = rod.asset().mass.mass * SPEED;
    println!(
        "impulse {:.4} of the momentum, duration {:.3} of the way there and back, vibration {:.4} of what was lost",
        report.impulse / momentum,
        report.duration / echo,
        (blow.energies()[0] + blow.strikers_energy()) / blow.energies()[1],
    );
    for share in [0.1, 0.2, 0.4, 0.6, 0.8, 0.95] {
        let time = share * echo;
        // The first number is the force at the end of the first step.
        let steps = time / blow.time_step() - 1.0;
        let force = |i: usize| f64::from(report.force[i]);
        let (i, rest) = (steps as usize, steps.fract());
        let found = force(i) + rest * (force(i + 1) - force(i));
        let expected = law(impedance, stiffness, time);
        println!(
            "after {share} of it {found:.1} N, by the law {expected:.1} N, ρ c A v/2 {:.1} N",
            0.5 * impedance * SPEED
        );
        // The ends' lateral inertia delays the rise and makes the plateau ripple.
        let tolerance = if share < 0.15 { 0.07 } else { 0.02 };
        assert!(
            (found / expected - 1.0).abs() < tolerance,
            "{share}: {found} {expected}"
        );
    }
    assert!((report.impulse / momentum - 1.0).abs() < 0.005);
    assert!((1.0..1.2).contains(&(report.duration / echo)));
}

#[test]
fn two_heavy_blocks_that_touch_softly_meet_as_hertz_says() {
    const SIDE: f64 = 0.05;
    let speed = 0.1;
    let glass = glass();
    let block = body(Shape::block([SIDE; 3]), 0.01, 60);
    let config = FractureConfig::default();
    let radius: f64 = 0.5e-3;
    let top = Vec3::new(0.0, 0.0, 0.5 * SIDE as f32);
    let mut contact = Contact::new(top, Vec3::NEG_Z, 0.0, speed, Striker::rigid());
    contact.striker = Striker::flexible(&block, &contact, &config).unwrap();
    contact.striker.curvature_radius = radius as f32;
    let blow = Blow::new(&block, &[contact], &config).unwrap().unwrap();
    let report = blow.reports()[0].clone();
    // All modes answer far faster than the contact lasts: ½ m v² = 2/5 K δ^2.5, with both moduli and half the mass.
    let (mass, speed) = (0.5 * block.asset().mass.mass, f64::from(speed));
    let stiffness = 4.0 / 3.0 * 0.5 * glass.contact_modulus() * radius.sqrt();
    let deepest = (1.25 * mass * speed * speed / stiffness).powf(0.4);
    let near = |found: f64, exact: f64| {
        println!("{found} beside {exact}");
        (found / exact - 1.0).abs() < 0.01
    };
    assert!(near(report.duration, 2.9432 * deepest / speed));
    assert!(near(report.peak_force, stiffness * deepest.powf(1.5)));
    assert!(near(report.departure_speed, speed));
}
