//! Properties of every blow: energy, momentum, what the modes left out give, and that no input makes nonsense. Beside closed forms
//! blows stand in `frangible-lab verify` (cases `blow` and `near-field`).

mod hostile;
mod left_out;

use std::sync::OnceLock;

use frangible::glam::{DVec3, Vec3};
use frangible::internals::blow::Blow;
use frangible::internals::contact::SharedMass;
use frangible::internals::near_field::PlateTheory;
use frangible::internals::stress::largest_eigenvalue;
use frangible::{Asset, Body, Breakable, Contact, FractureConfig, Material, Striker, impact};
use frangible_bake::{BakeSpec, Shape, bake};

fn material(name: &str) -> Material {
    let mut material = Material::preset(name).unwrap();
    // Every tetrahedron is a weak point: stresses are looked at everywhere.
    material.weak_point_density = 1e15;
    material
}

fn baked(shape: Shape, material: Material, modes: usize, elements: f64) -> Asset {
    let spec = BakeSpec {
        modes,
        analysis: Some(shape.size_for(elements).unwrap()),
        fracture: Some(shape.size_for(9000.0).unwrap()),
        ..BakeSpec::new("body", shape, material)
    };
    bake(&spec).unwrap()
}

/// Modes of the brick and of the glass.
const MODES: usize = 400;

fn brick() -> &'static Asset {
    static BRICK: OnceLock<Asset> = OnceLock::new();
    BRICK.get_or_init(|| {
        baked(
            Shape::block([0.21, 0.1, 0.05]),
            material("brick"),
            MODES,
            1500.0,
        )
    })
}

fn glass() -> &'static Asset {
    static GLASS: OnceLock<Asset> = OnceLock::new();
    GLASS.get_or_init(|| baked(Shape::drinking_glass(), material("glass"), MODES, 1800.0))
}

/// A body that follows this number of its modes through time.
fn following(asset: &Asset, modes: usize) -> Body {
    let mut asset = asset.clone();
    asset.parts_mut().modes.residual_modes = asset.modes().count() - modes;
    Breakable::uniform(asset).unwrap().body(1)
}

fn config(residual: bool, near_field: Option<PlateTheory>) -> FractureConfig {
    let mut config = FractureConfig::default();
    (config.residual, config.near_field) = (residual, near_field);
    config
}

fn on_stone(point: Vec3, normal: Vec3, speed: f32) -> Contact {
    Contact::strike(
        point,
        normal.normalize(),
        speed,
        Striker::fixed(&Material::preset("stone").unwrap()),
    )
}

/// Largest tension over time at places of the body, Pa.
fn peak(body: &Body, blow: &Blow, config: &FractureConfig, tets: &[u32]) -> f32 {
    let steps = blow.reports()[0].force.len();
    let stride = (steps / 24).max(1);
    let mut most = 0.0_f32;
    for step in (0..steps).step_by(stride) {
        for &tet in tets {
            most = most.max(largest_eigenvalue(&blow.stress(body, tet, step, config)));
        }
    }
    most
}

/// The weak tetrahedra between two distances from a place, every `each`-th.
fn around(body: &Body, place: Vec3, distances: [f32; 2], each: usize) -> Vec<u32> {
    let mesh = body.asset().fracture();
    let distance = |&e: &u32| mesh.centroid(e as usize).distance(place);
    let inside = |e: &u32| (distances[0]..distances[1]).contains(&distance(e));
    let tets = body.weak_tets().iter().copied().filter(inside);
    tets.step_by(each).collect()
}

#[test]
fn several_contacts_at_once_keep_energy_and_momentum() {
    // Two balls on a brick that floats, at different places, speeds and directions. Without damping all that they lose is in its flight,
    // its turning and its modes, as long as nothing is crushed.
    let mut asset = brick().clone();
    asset.parts_mut().material.stiffness_damping = 0.0;
    asset.parts_mut().material.mass_damping = 0.0;
    asset.parts_mut().material.crushing_pressure = f64::INFINITY;
    let mass = asset.mass();
    let body = Breakable::uniform(asset).unwrap().body(1);
    let steel = Material::preset("steel").unwrap();
    let balls = [(0.05, 0.012, 4.0), (0.02, 0.01, 9.0)];
    let places = [
        (Vec3::new(0.07, 0.01, 0.025), Vec3::NEG_Z),
        (Vec3::new(-0.02, -0.05, 0.01), Vec3::Y),
    ];
    let contacts: Vec<Contact> = balls
        .iter()
        .zip(places)
        .map(|(&(m, r, v), (point, normal))| {
            Contact::strike(point, normal, v, Striker::ball(&steel, m, r))
        })
        .collect();
    let missing = |substep: f64| {
        let blow = Blow::with_substep(&body, &contacts, &config(true, None), Some(substep))
            .unwrap()
            .unwrap();
        let reports = blow.reports();
        let (mut momentum, mut turning) = (DVec3::ZERO, DVec3::ZERO);
        let (mut before, mut after) = (0.0, 0.0);
        for (report, &(m, _, v)) in reports.iter().zip(&balls) {
            let push = report.impulse * report.normal.as_dvec3();
            momentum += push;
            turning += report.point.as_dvec3().cross(push);
            let v = f64::from(v);
            before += 0.5 * m * v * v;
            after += 0.5 * m * (v - report.impulse / m).powi(2);
        }
        let flight = momentum.length_squared() / (2.0 * mass.mass)
            + 0.5 * turning.dot(mass.inertia.inverse() * turning);
        // The speeds at which the strikers leave follow from the momentum too.
        for (report, &(m, _, v)) in reports.iter().zip(&balls) {
            let arm = report.point.as_dvec3();
            let body = momentum / mass.mass + (mass.inertia.inverse() * turning).cross(arm);
            let leaves = body.dot(report.normal.as_dvec3()) - (f64::from(v) - report.impulse / m);
            assert!(
                (leaves - report.departure_speed).abs() < 1e-6 * f64::from(v),
                "{leaves} {}",
                report.departure_speed
            );
        }
        let rings = blow.energies()[0];
        assert!(reports.iter().all(|r| r.impulse > 0.0));
        println!(
            "substep {substep}: {before} before; {after} balls, {flight} flight, {rings} modes: missing {:e}",
            (after + flight + rings) / before - 1.0
        );
        ((after + flight + rings) / before - 1.0).abs()
    };
    // Finer ones reach the rounding of the contacts' f32.
    let (coarse, fine) = (missing(4e-6), missing(2e-6));
    assert!(missing(0.5e-6) < 3e-6);
    // With the square of the substep, or faster where errors of the two contacts cancel.
    assert!(coarse / fine > 3.0, "{coarse} {fine}");
}

#[test]
fn a_body_that_strikes_at_four_points_brings_its_energy_once() {
    let body = Breakable::uniform(brick().clone()).unwrap().body(1);
    let (mass, inertia, speed) = (1.5_f32, 0.02_f32, 2.0_f32);
    let contacts = |share: bool| {
        [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)].map(|(a, b)| {
            let point = Vec3::new(0.08 * a, 0.03 * b, 0.025);
            let normal = Vec3::NEG_Z;
            let turn = point.cross(normal);
            let shared = SharedMass {
                body: 7,
                velocity: normal / mass.sqrt(),
                spin: turn / inertia.sqrt(),
            };
            let mut striker = Striker::ball(&Material::preset("steel").unwrap(), 1.0, 0.01);
            striker.inverse_effective_mass = 1.0 / mass + turn.length_squared() / inertia;
            striker.shared = share.then_some(shared);
            Contact::strike(point, normal, speed, striker)
        })
    };
    let mut config = FractureConfig::default();
    config.culling = false;
    let found = |share: bool| {
        let outcome = impact(&body, &contacts(share), &config).unwrap();
        let report = outcome.report();
        let impulse: f64 = report.contacts.iter().map(|c| c.impulse).sum();
        (report.approach_energy, report.peak_strain_energy, impulse)
    };
    let own = brick().mass().mass;
    let reduced = 1.0 / (1.0 / own + 1.0 / f64::from(mass));
    let energy = 0.5 * reduced * f64::from(speed).powi(2);
    let (approach, strain, impulse) = found(true);
    assert!(
        (approach / energy - 1.0).abs() < 1e-3,
        "{approach} {energy}"
    );
    assert!(strain <= approach && impulse <= 2.0 * reduced * f64::from(speed));
    // As four bodies they would bring more.
    assert!(found(false).0 > 1.2 * energy);
}
