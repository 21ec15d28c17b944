//! Two equal bodies that meet and both vibrate under one force.

use frangible::glam::Vec3;
use frangible::internals::blow::Blow;
use frangible::{Contact, FractureConfig, Material, Striker};
use frangible_bake::{BakeError, Shape};

use super::blow::force_at;
use crate::verify::blows::probe::{blow, material, solid};
use crate::verify::blows::strike;
use crate::verify::case::Findings;
use crate::verify::check::{Check, check, checks};

const ST_VENANT: &str = "B. de Saint-Venant (1883); waves in a rod, d'Alembert";
const HERTZ: &str = "H. Hertz (1882); Johnson, Contact Mechanics, §11.4";

pub(super) fn compute() -> Result<Findings, BakeError> {
    let mut checks = rods()?;
    checks.extend(blocks()?);
    Ok(checks.into())
}

/// A body that another one like it meets at a point, on a curvature of this radius, m, at a speed, m/s; and its mass, kg.
fn meeting(
    shape: Shape,
    (edge, modes): (f64, usize),
    (point, normal): (Vec3, Vec3),
    radius: f64,
    speed: f64,
) -> Result<(Blow, f64), BakeError> {
    let body = solid(shape, &glass(), edge, modes)?;
    let config = FractureConfig::default();
    let mut contact = Contact::strike(point, normal, speed as f32, Striker::rigid());
    contact.striker = Striker::flexible(&body, &contact, &config)?;
    contact.striker.curvature_radius = radius as f32;
    let mass = body.asset().mass().mass;
    Ok((blow(&body, contact, &config)?, mass))
}

fn glass() -> Material {
    material(70e9, 0.23, 2500.0)
}

/// Hertz' spring between two flat bodies of glass, one of them curved, N/m^1.5.
fn spring(radius: f64) -> f64 {
    4.0 / 3.0 * 0.5 * glass().contact_modulus() * radius.sqrt()
}

fn rods() -> Result<Vec<Check>, BakeError> {
    const LENGTH: f64 = 0.4;
    const SIDE: f64 = 4e-3;
    const SPEED: f64 = 4.0;
    const RADIUS: f64 = 2e-3;
    let end = Vec3::new(-0.5 * LENGTH as f32, 0.0, 0.0);
    let rod = Shape::rod(LENGTH, SIDE);
    let (found, mass) = meeting(rod, (0.002, 240), (end, Vec3::X), RADIUS, SPEED)?;
    let celerity = (glass().youngs_modulus / glass().density).sqrt();
    let impedance = glass().density * celerity * SIDE * SIDE;
    let echo = 2.0 * LENGTH / celerity;
    // Both ends give way: half the impedance, under something that nothing slows down.
    let law = strike::Striker {
        mass: 1e9,
        stiffness: spring(RADIUS),
        speed: SPEED,
    };
    let exact = law.against(0.5 * impedance, echo, 4000.0 * law.time() / echo);
    let report = &found.reports()[0];
    let mut checks: Vec<Check> = [0.1, 0.2, 0.4, 0.6, 0.8, 0.95]
        .map(|share| {
            let name = format!("rods end to end: force after {share} of the way there and back");
            let time = share * echo;
            // The ends' lateral inertia delays the rise.
            let tolerance = if share < 0.15 { 0.07 } else { 0.02 };
            let pair = [force_at(&found, time), exact.at(time)];
            check(name, "N", pair, tolerance, ST_VENANT)
        })
        .into();
    let impulse = report.impulse / (mass * SPEED);
    checks.extend(checks![
        "rods end to end: impulse, in momenta of one rod", "", impulse => 1.0, 0.005, ST_VENANT;
        "rods end to end: duration", "s", report.duration => exact.duration(), 0.05, ST_VENANT;
    ]);
    Ok(checks)
}

fn blocks() -> Result<Vec<Check>, BakeError> {
    const SIDE: f64 = 0.05;
    const SPEED: f64 = 0.1;
    const RADIUS: f64 = 0.5e-3;
    let top = Vec3::new(0.0, 0.0, 0.5 * SIDE as f32);
    let block = Shape::block([SIDE; 3]);
    let (found, mass) = meeting(block, (0.01, 60), (top, Vec3::NEG_Z), RADIUS, SPEED)?;
    let report = &found.reports()[0];
    // ½ m v² = 2/5 K δ^2.5 with half the mass of one; 2.9432 δ/v.
    let deepest = (1.25 * 0.5 * mass * SPEED * SPEED / spring(RADIUS)).powf(0.4);
    let duration = 2.9432 * deepest / SPEED;
    let peak = spring(RADIUS) * deepest.powf(1.5);
    Ok(checks![
        "blocks: duration", "s", report.duration => duration, 0.01, HERTZ;
        "blocks: peak force", "N", report.peak_force => peak, 0.01, HERTZ;
        "blocks: restitution", "", report.departure_speed / SPEED => 1.0, 0.01, HERTZ;
    ])
}
