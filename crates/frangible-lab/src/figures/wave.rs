//! Fig. 5: the stress in the slab over the contact.

use std::collections::BTreeSet;

use frangible::glam::Vec3;
use frangible::internals::Model;
use frangible::internals::contact::{
    Pulse, admissible_duration, approach_energy, contact_duration, modal_load, pulse,
};
use frangible::internals::modal::{Motion, respond};
use frangible::internals::stress::{Symmetric3, largest_eigenvalue};
use frangible::{Asset, Body, Breakable, FractureConfig};
use frangible_bake::mode_field::mode_on_fracture_mesh;
use serde_json::{Value, json};

use super::bodies::{slab, slab_blow};
use super::statistics::models;
use crate::Result;

/// Instants drawn, shares of the contact duration.
const INSTANTS: [f64; 6] = [0.15, 0.3, 0.5, 0.75, 1.0, 1.4];

/// Samples of the chart.
const SAMPLES: usize = 48;

/// The vibration of the slab under one model's pulse.
struct Wave {
    pulse: Pulse,
    motion: Motion,
}

impl Wave {
    /// Largest principal tension at the nodes of the upper and lower faces at a step, Pa.
    fn tensions(&self, faces: &Faces, step: usize) -> Vec<f32> {
        let q = self.motion.at(step);
        let nodes = faces.points.len();
        let mut sums = vec![Symmetric3::default(); nodes];
        for (&q, field) in q.iter().zip(&faces.stresses) {
            for (sum, s) in sums.iter_mut().zip(field) {
                for k in 0..3 {
                    sum.diagonal[k] += q * s.diagonal[k];
                    sum.off[k] += q * s.off[k];
                }
            }
        }
        sums.iter().map(|s| principal(s).max(0.0)).collect()
    }

    fn step_at(&self, time: f64) -> usize {
        let step = (time / self.pulse.time_step).round().max(1.0) as usize - 1;
        step.min(self.motion.steps() - 1)
    }
}

/// Largest eigenvalue in MPa meanwhile: the cube of Pa may overflow.
fn principal(stress: &Symmetric3) -> f32 {
    1e6 * largest_eigenvalue(&Symmetric3 {
        diagonal: stress.diagonal.map(|s| 1e-6 * s),
        off: stress.off.map(|s| 1e-6 * s),
    })
}

/// Nodes of the slab's outside, and the stress of a unit of each mode there.
struct Faces {
    points: Vec<Vec3>,
    /// Per mode and point, Pa per unit amplitude.
    stresses: Vec<Vec<Symmetric3>>,
}

impl Faces {
    fn new(slab: &Asset) -> Self {
        let nodes: BTreeSet<u32> = slab.surface().triangles.iter().flatten().copied().collect();
        let of_mode = |mode: usize| {
            let field = mode_on_fracture_mesh(slab, mode);
            nodes.iter().map(|&v| field.stresses[v as usize]).collect()
        };
        Self {
            points: nodes
                .iter()
                .map(|&v| slab.fracture().positions[v as usize])
                .collect(),
            stresses: (0..slab.modes().count()).map(of_mode).collect(),
        }
    }

    /// Mean distance from the middle, weighted with the squared tension, m.
    fn spread(&self, tensions: &[f32]) -> f64 {
        let (mut sum, mut weights) = (0.0, 0.0);
        for (p, &s) in self.points.iter().zip(tensions) {
            let weight = f64::from(s) * f64::from(s);
            sum += weight * f64::from(p.truncate().length());
            weights += weight;
        }
        sum / weights.max(f64::MIN_POSITIVE)
    }
}

/// Largest tension over time in both models, and how far it has spread at some instants.
pub(super) fn compute() -> Result<Value> {
    let slab = slab()?;
    let faces = Faces::new(&slab);
    let contact = slab_blow(&slab)?;
    let body = Breakable::uniform(slab)?.body(1);
    let rows = models().map(|(model, config)| {
        let wave = wave(&body, contact.clone(), &config);
        let curve = curve(&wave, &faces);
        let peak = curve
            .iter()
            .copied()
            .fold([0.0; 2], |m, p| if p[1] > m[1] { p } else { m });
        let spread = INSTANTS.map(|share| {
            let step = wave.step_at(share * wave.pulse.duration);
            let tensions = faces.spread(&wave.tensions(&faces, step));
            json!({ "time_s": (step + 1) as f64 * wave.pulse.time_step, "spread_m": tensions })
        });
        json!({
            "model": model,
            "duration_s": wave.pulse.duration,
            "time_step_s": wave.pulse.time_step,
            "steps_in_contact": wave.pulse.contact_steps,
            "peak_pa": peak[1],
            "peak_at_s": peak[0],
            "curve": curve,
            "spread": spread,
        })
    });
    Ok(json!(rows))
}

fn wave(body: &Body, contact: frangible::Contact, config: &FractureConfig) -> Wave {
    let contacts = [contact];
    let load = modal_load(body, &contacts);
    let asset = body.asset();
    let mut duration = contact_duration(asset, &load, config.duration);
    if config.admissible_duration {
        duration = admissible_duration(asset, &load, approach_energy(&contacts), duration);
    }
    // Beyond the contact in both models, to show the time after it.
    let mut config = config.clone();
    config.model = Model::Ours;
    let pulse = pulse(asset, &load, duration, &config);
    Wave {
        motion: respond(asset.modes(), asset.material(), &load.modal_impulse, &pulse),
        pulse,
    }
}

/// Time, s, and largest tension, Pa.
fn curve(wave: &Wave, faces: &Faces) -> Vec<[f64; 2]> {
    let steps = wave.motion.steps();
    let last = wave.step_at(1.6 * wave.pulse.duration).min(steps - 1);
    let mut curve = vec![[0.0; 2]];
    for i in 1..=SAMPLES {
        let step = (last * i / SAMPLES).max(1);
        let most = wave.tensions(faces, step).into_iter().fold(0.0, f32::max);
        curve.push([(step + 1) as f64 * wave.pulse.time_step, f64::from(most)]);
    }
    curve
}
