//! Blows that are integrated against the body, beside closed forms.

use std::f64::consts::PI;

use frangible::glam::Vec3;
use frangible::internals::blow::Blow;
use frangible::internals::near_field::PlateTheory;
use frangible::{Asset, Contact, FractureConfig, Material, Striker};
use frangible_bake::{BakeError, Shape};

use crate::verify::blows::probe::{BALL, PLATE, ball, blow, body, material, solid, wide_plate};
use crate::verify::blows::strike::{self, Strike};
use crate::verify::case::Findings;
use crate::verify::check::{Check, check, checks};

const ZENER: &str = "C. Zener, Phys. Rev. 59, 669 (1941)";
const HERTZ: &str = "H. Hertz (1882); Johnson, Contact Mechanics, §11.4";
const ST_VENANT: &str = "B. de Saint-Venant (1883); waves in a rod, d'Alembert";

/// λ and Zener's restitution of the tables.
const RESTITUTION: [(f64, f64); 5] = [
    (0.1, 0.843),
    (0.25, 0.658),
    (0.5, 0.437),
    (1.0, 0.184),
    (2.0, 0.021),
];

pub(super) fn compute() -> Result<Findings, BakeError> {
    let plate = wide_plate()?;
    let mut checks = zener(&plate)?;
    checks.extend(restitution(&plate)?);
    checks.extend(block()?);
    checks.extend(rod()?);
    checks.extend(energy(&plate)?);
    Ok(checks.into())
}

/// Hertz' spring between a steel ball and a flat body of this material, N/m^1.5.
pub(crate) fn spring(material: &Material, radius: f64) -> f64 {
    let steel = Material::preset("steel").expect("steel is a preset");
    let modulus = 1.0 / (1.0 / material.contact_modulus() + 1.0 / steel.contact_modulus());
    4.0 / 3.0 * modulus * radius.sqrt()
}

/// Force at a time after the first touch, N.
pub(crate) fn force_at(blow: &Blow, t: f64) -> f64 {
    let force = &blow.reports()[0].force;
    let strike = Strike {
        step: blow.time_step(),
        force: force.iter().map(|&f| f64::from(f)).collect(),
        restitution: 0.0,
    };
    strike.at(t)
}

pub(crate) fn thin() -> FractureConfig {
    let mut config = FractureConfig::default();
    config.near_field = Some(PlateTheory::Kirchhoff);
    config
}

/// The ball of the tables at 20 m/s: force at some times, N, computed and Zener's.
pub(crate) fn force_on_plate(
    plate: &Asset,
    config: &FractureConfig,
    times: &[f64],
) -> Result<(Vec<[f64; 2]>, [f64; 2]), BakeError> {
    let (mass, radius) = (BALL[0], BALL[1]);
    let striker = strike::Striker {
        mass,
        stiffness: spring(plate.material(), radius),
        speed: 20.0,
    };
    let exact = striker.against(PLATE.dashpot(), f64::INFINITY, 400.0);
    let found = blow(&body(plate.clone())?, ball([0.0; 2], 20.0, BALL), config)?;
    let rows = times.iter().map(|&t| [force_at(&found, t), exact.at(t)]);
    Ok((
        rows.collect(),
        [found.reports()[0].peak_force, exact.peak()],
    ))
}

fn zener(plate: &Asset) -> Result<Vec<Check>, BakeError> {
    let times = [10e-6, 30e-6, 60e-6, 100e-6];
    let (rows, peak) = force_on_plate(plate, &thin(), &times)?;
    let mut checks = checks!["4 mm at 20 m/s: peak force", "N", peak[0] => peak[1], 0.03, ZENER;];
    checks.extend(times.iter().zip(rows).map(|(&t, pair)| {
        // 5 % of the last are 1 % of the peak.
        let tolerance = if t < 80e-6 { 0.03 } else { 0.06 };
        let name = format!("4 mm at 20 m/s: force after {:.0} µs", 1e6 * t);
        check(name, "N", pair, tolerance, ZENER)
    }));
    Ok(checks)
}

/// Restitution of a ball whose λ on the plate is this: computed and Zener's law.
pub(crate) fn restitution_at(
    plate: &Asset,
    inelasticity: f64,
    config: &FractureConfig,
) -> Result<[f64; 2], BakeError> {
    const SPEED: f64 = 1.0;
    let of = |radius: f64| strike::Striker {
        mass: 7850.0 * 4.0 / 3.0 * PI * radius.powi(3),
        stiffness: spring(plate.material(), radius),
        speed: SPEED,
    };
    let dashpot = PLATE.dashpot();
    let radius = crate::verify::models::root(
        |r| of(r).mass / (dashpot * of(r).time()) - inelasticity,
        1e-5,
        1e-2,
    );
    let exact = of(radius).against(dashpot, f64::INFINITY, 400.0);
    let found = blow(
        &body(plate.clone())?,
        ball([0.0; 2], SPEED, [of(radius).mass, radius]),
        config,
    )?;
    Ok([
        found.reports()[0].departure_speed / SPEED,
        exact.restitution,
    ])
}

fn restitution(plate: &Asset) -> Result<Vec<Check>, BakeError> {
    let mut checks = Vec::new();
    for (inelasticity, published) in RESTITUTION {
        let [found, exact] = restitution_at(plate, inelasticity, &thin())?;
        for (what, value) in [("", found), (", law integrated", exact)] {
            // To the digits of the table; of the nearly swallowed ball a share of the speed is what counts.
            let name = format!(
                "restitution at λ = {inelasticity}{what}: speed kept more than Zener's {published}"
            );
            checks.push(check(name, "", [value - published, 0.0], 0.01, ZENER));
        }
    }
    Ok(checks)
}

fn block() -> Result<Vec<Check>, BakeError> {
    const SIDE: f64 = 0.05;
    const SPEED: f64 = 5.0;
    let glass = material(70e9, 0.23, 2500.0);
    let body = solid(Shape::block([SIDE; 3]), &glass, 0.01, 60)?;
    let radius: f64 = 0.5e-3;
    let mass = 7850.0 * 4.0 / 3.0 * PI * radius.powi(3);
    let k = spring(&glass, radius);
    let steel = Material::preset("steel").expect("steel is a preset");
    let contact = Contact::strike(
        Vec3::new(0.003, 0.004, 0.5 * SIDE as f32),
        Vec3::NEG_Z,
        SPEED as f32,
        Striker::ball(&steel, mass, radius),
    );
    let found = blow(&body, contact, &FractureConfig::default())?;
    let report = &found.reports()[0];
    // ½ m v² = 2/5 K δ^2.5; 2.9432 δ/v.
    let deepest = (1.25 * mass * SPEED * SPEED / k).powf(0.4);
    Ok(checks![
        "heavy block: duration", "s", report.duration => 2.9432 * deepest / SPEED, 0.01, HERTZ;
        "heavy block: peak force", "N", report.peak_force => k * deepest.powf(1.5), 0.01, HERTZ;
        "heavy block: restitution", "", report.departure_speed / SPEED => 1.0, 0.01, HERTZ;
    ])
}

fn rod() -> Result<Vec<Check>, BakeError> {
    const LENGTH: f64 = 0.4;
    const SIDE: f64 = 4e-3;
    const SPEED: f64 = 4.0;
    let glass = material(70e9, 0.23, 2500.0);
    let body = solid(Shape::rod(LENGTH, SIDE), &glass, 0.002, 240)?;
    let area = SIDE * SIDE;
    let celerity = (glass.youngs_modulus / glass.density).sqrt();
    let impedance = glass.density * celerity * area;
    let mass = glass.density * area * LENGTH;
    let radius: f64 = 2e-3;
    let stiffness = 4.0 / 3.0 * glass.contact_modulus() * radius.sqrt();
    let striker = Striker::rigid()
        .with_effective_mass(mass)
        .with_curvature_radius(radius);
    let contact = Contact::strike(
        Vec3::new(-0.5 * LENGTH as f32, 0.0, 0.0),
        Vec3::X,
        SPEED as f32,
        striker,
    );
    let found = blow(&body, contact, &FractureConfig::default())?;
    let law = strike::Striker {
        mass,
        stiffness,
        speed: SPEED,
    };
    let exact = law.against(impedance, 2.0 * LENGTH / celerity, 400.0);
    let report = &found.reports()[0];
    // The striker's own speed in the end, from the impulse that it gave.
    let restitution = report.impulse / (mass * SPEED) - 1.0;
    let mut checks = checks![
        "rod hit at its end: peak force", "N", report.peak_force => exact.peak(), 0.05, ST_VENANT;
        "rod hit at its end: duration", "s", report.duration => exact.duration(), 0.05, ST_VENANT;
        "rod hit at its end: share of the speed the striker leaves with", "", restitution => exact.restitution, 0.05, ST_VENANT;
    ];
    for share in [0.5, 1.0, 1.5] {
        let t = share * 2.0 * LENGTH / celerity;
        let name = format!("rod hit at its end: force after {share} times the way there and back");
        checks.push(check(
            name,
            "N",
            [force_at(&found, t), exact.at(t)],
            0.05,
            ST_VENANT,
        ));
    }
    Ok(checks)
}

/// Share of the striker's energy loss that modes and oscillators do not hold.
fn missing(plate: &Asset, substep: Option<f64>) -> Result<f64, BakeError> {
    let body = body(plate.clone())?;
    let found = Blow::with_substep(&body, &[ball([0.0; 2], 20.0, BALL)], &thin(), substep)?;
    let [held, lost] = found.map_or([f64::NAN; 2], |blow| blow.energies());
    Ok((held / lost - 1.0).abs())
}

fn energy(plate: &Asset) -> Result<Vec<Check>, BakeError> {
    const SOURCE: &str = "conservation of energy";
    let coarse = missing(plate, Some(200e-9))?;
    let fine = missing(plate, Some(100e-9))?;
    let (own, finest) = (missing(plate, None)?, missing(plate, Some(50e-9))?);
    Ok(checks![
        "energy missing, default substep", "", own => 0.0, 1e-4, SOURCE;
        "energy missing, substep of 50 ns", "", finest => 0.0, 1.5e-6, SOURCE;
        "energy missing, 200 ns over 100 ns", "", coarse / fine => 4.0, 0.2, SOURCE;
    ])
}
