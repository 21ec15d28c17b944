//! A body that swings back against its striker.

use std::path::Path;

use glam::Vec3;
use pulp::NullaryFnOnce;

use super::bank::BankState;
use super::contacts::Contacts;
use super::integrate::Run;
use super::plan::Plan;
use crate::asset::Asset;
use crate::body::{Body, Breakable};
use crate::config::FractureConfig;
use crate::contact::{Contact, Striker};
use crate::material::Material;

/// A pane of glass of 0.2 × 0.2 m, 4 mm thick, that nothing damps or crushes.
fn pane() -> Body {
    let bodies = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/bodies");
    let mut asset = Asset::load(bodies.join("pane.frangible")).unwrap();
    asset.material.stiffness_damping = 0.0;
    asset.material.mass_damping = 0.0;
    asset.material.crushing_pressure = f64::INFINITY;
    Breakable::new(asset).unwrap().body(1)
}

/// A steel ball of 130 g falls on the pane.
fn plan(body: &Body, [x, y]: [f32; 2], near_field: bool) -> Plan {
    let steel = Material::preset("steel").unwrap();
    let ball = Striker::ball(&steel, 0.13, 0.0158);
    let contact = Contact::new(Vec3::new(x, y, 0.002), Vec3::NEG_Z, 0.0, 4.0, ball);
    let mut config = FractureConfig::default();
    if !near_field {
        config.near_field = None;
    }
    Plan::new(body, &[contact], &config, None).unwrap()
}

fn run(plan: &Plan) -> Run<'_> {
    Run {
        plan,
        known: &[],
        softer: &[],
        instant: false,
        returns: true,
    }
}

fn ends_of_touches(forces: &[f64]) -> usize {
    let ends = |pair: &[f64]| pair[0] > 0.0 && pair[1] == 0.0;
    forces.windows(2).filter(|pair| ends(pair)).count()
}

/// A substep, whatever has parted.
fn substep(plan: &Plan, state: &mut BankState, contacts: &mut Contacts<'_>) {
    plan.fine.coast(state, &plan.pushes(), &contacts.forces);
    contacts.foresee(state);
    contacts.solve(0.0);
    contacts.grow();
    plan.fine.grow(state, &plan.pushes(), &contacts.growth);
    contacts.advance();
}

#[test]
fn a_pane_that_swings_back_hits_the_ball_as_substeps_without_a_pause_find() {
    let body = pane();
    for place in [[0.01, 0.005], [0.06, -0.03], [0.09, 0.09]] {
        let plan = plan(&body, place, false);
        let record = run(&plan).call();
        assert!(ends_of_touches(&record.forces) >= 3);
        let most = record.forces.iter().copied().fold(0.0, f64::max);
        let mut state = BankState::rest(plan.oscillators.len());
        let mut contacts = Contacts::new(&plan);
        for &force in &record.forces {
            substep(&plan, &mut state, &mut contacts);
            let off = (contacts.forces[0] - force).abs();
            assert!(off < 1e-6 * most, "{off} of {most} N");
        }
        // To the end of what is looked at nothing touches any more.
        let speed = contacts.speeds[0];
        let over = record.forces.len() as f64 * contacts.dt;
        for _ in 0..((run(&plan).window(0..plan.modes, &state) - over) / contacts.dt) as usize {
            substep(&plan, &mut state, &mut contacts);
        }
        assert_eq!(contacts.speeds[0], speed);
    }
}

#[test]
fn what_the_ball_loses_by_several_touches_rings_or_has_left() {
    let body = pane();
    for place in [[0.01, 0.005], [0.06, -0.03], [0.09, 0.09]] {
        let plan = plan(&body, place, true);
        let record = run(&plan).call();
        let touches = ends_of_touches(&record.forces);
        assert!(touches >= 3);
        let mass = 1.0 / plan.inverse_mass[0];
        let lost = 0.5 * mass * (16.0 - record.speeds[0].powi(2));
        let missing = record.energy_at_parting / lost - 1.0;
        println!("{place:?}: {touches} touches, missing {missing:e}");
        assert!(missing.abs() < 1e-3, "{missing}");
    }
}
