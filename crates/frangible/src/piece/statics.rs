//! Pieces that answer a push at once: quasi-static stress, without modes.

use std::fmt;
use std::sync::Arc;

use glam::Vec3;

use crate::asset::Asset;
use crate::body::{Body, Prepared};
use crate::config::FractureConfig;
use crate::contact::{self, Contact, each_row};
use crate::error::InputError;
use crate::impact::{Cracking, pieces, report_on};
use crate::modal::{ModalBasis, Motion};
use crate::outcome::{ImpactReport, LookedAt, Outcome};
use crate::trace::CrackTrace;

/// Linear elasticity of a piece, factored once.
pub trait Statics: fmt::Debug + Send + Sync {
    /// Displacement of every node, m, under forces on some, N, `3 * node + axis`. Of a free piece the forces are balanced by
    /// its own inertia first: they lose what moves it as a rigid body.
    fn displacement(&self, forces: &[f64]) -> Vec<f64>;

    /// Forces on the nodes, N, that its weight puts on a held piece; gravity in m/s².
    fn weight(&self, gravity: Vec3) -> Vec<f64>;

    /// Memory of what it keeps, bytes.
    fn bytes(&self) -> usize;
}

/// Steps over half the pulse: the load grows, and cracks that it starts have time to run.
const STEPS: usize = 32;

/// An impact on a body without modes: the force of the pulse at its peak, put on slowly.
pub(crate) fn static_impact(
    body: &Body,
    statics: &Arc<dyn Statics>,
    contacts: &[Contact],
    config: &FractureConfig,
    trace: &mut Option<CrackTrace>,
) -> Result<Outcome, InputError> {
    contacts.iter().try_for_each(Contact::validate)?;
    config.validate()?;
    let mut report = report_on(body);
    report.approach_energy = contact::approach_energy(contacts);
    let load = contact::modal_load(body, contacts.iter().filter(|c| c.impulse > 0.0));
    if load.touches.is_empty() {
        return Ok(Outcome::Held {
            margin: f64::INFINITY,
            report,
            state: None,
        });
    }
    // Without modes any model is Hertz'.
    let duration = contact::contact_duration(&body.asset, &load, config.duration);
    report.unadjusted_duration = duration;
    report.contact_duration = duration;
    let peak = std::f64::consts::PI / (2.0 * duration);
    let pushes = load.touches.iter().map(|touch| {
        let push = touch.contact.push() * peak as f32;
        (touch.contact.point, push)
    });
    let (forces, pressed) = forces(body, pushes);
    Ok(static_load(
        body, statics, &forces, &pressed, duration, config, report, trace,
    ))
}

/// What forces on the nodes do that grow over half of `duration`, s. `pressed`: surface triangles under them.
pub(crate) fn static_load(
    body: &Body,
    statics: &Arc<dyn Statics>,
    forces: &[f64],
    pressed: &[u32],
    duration: f64,
    config: &FractureConfig,
    mut report: ImpactReport,
    trace: &mut Option<CrackTrace>,
) -> Outcome {
    let displacement = statics.displacement(forces);
    let energy = 0.5
        * forces
            .iter()
            .zip(&displacement)
            .map(|(f, u)| f * u)
            .sum::<f64>();
    report.looked_at = LookedAt::Amplitudes;
    // The displacement as the only mode of a body of its own: all else is as ever.
    let mut asset = Asset::clone(&body.asset);
    asset.modes = ModalBasis {
        eigenvalues: vec![1.0],
        shapes: displacement.iter().map(|&u| u as f32).collect(),
        peak_stress: Vec::new(),
        ..ModalBasis::default()
    };
    let portion = asset.portion.clone();
    let prepared = match &portion {
        Some(portion) => Arc::new(Prepared::of_piece(&mut asset, portion)),
        None => Arc::clone(&body.prepared),
    };
    let mut loaded = body.clone();
    loaded.statics = None;
    loaded.asset = Arc::new(asset);
    loaded.prepared = prepared;
    let time_step = 0.5 * duration / STEPS as f64;
    let grows = (1..=STEPS).map(|i| (std::f32::consts::FRAC_PI_2 * i as f32 / STEPS as f32).sin());
    let amplitudes: Vec<f32> = grows.collect();
    report.time_step = time_step;
    report.time_steps = amplitudes.len();
    let motion = Motion::new(amplitudes, 1, energy, energy);
    let cracked = Cracking {
        body: &loaded,
        config,
        motion,
        pressed: pressed.to_vec(),
        time_step,
        budget: energy,
        blow: None,
    }
    .run(0, report, trace);
    pieces(&loaded, cracked)
}

/// Forces on the nodes, N, from forces on points of the surface, and the surface triangles that they press on.
pub(crate) fn forces(
    body: &Body,
    pushes: impl Iterator<Item = (Vec3, Vec3)>,
) -> (Vec<f64>, Vec<u32>) {
    let mut forces = vec![0.0; 3 * body.asset.analysis.nodes.len()];
    let mut pressed = Vec::new();
    for (point, push) in pushes {
        let at = body.prepared.surface.closest(point);
        pressed.push(at.triangle);
        each_row(&body.asset, &at, |node, weight| {
            for axis in 0..3 {
                forces[3 * node + axis] += f64::from(push[axis] * weight);
            }
        });
    }
    (forces, pressed)
}
