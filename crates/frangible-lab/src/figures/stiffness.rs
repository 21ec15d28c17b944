//! Fig. 4: balls of different stiffness on a piggy bank.

use std::sync::Arc;

use frangible::glam::Vec3;
use frangible::internals::contact::{contact_duration, modal_load};
use frangible::internals::{Force, rest};
use frangible::{Asset, Body, Breakable, Contact, FractureConfig, Outcome, Striker, impact};
use frangible_bake::Shape;
use rayon::prelude::*;
use serde_json::{Value, json};

use super::bodies::{MODES, baked};
use super::statistics::{damage, models, pieces};
use crate::Result;

/// Mass, kg, radius, m, speed, m/s, and restitution of every ball, whatever it is made of: the impulse is the same.
const BALL: [f64; 4] = [0.5, 0.03, 25.0, 0.5];

/// Balls: contact modulus E/(1 − ν²), Pa; from rubber over concrete (the fourth) to steel.
const MODULI: [f64; 5] = [3.3e6, 1e8, 2.5e9, 3e10, 2.3e11];

/// Time step whose force stands for the impulse in the quasi-static approach, s. The paper does not name its own.
const STEP: f64 = 5e-5;

fn striker(modulus: f64) -> Striker {
    let [mass, radius, _, restitution] = BALL;
    Striker::rigid()
        .with_contact_modulus(modulus)
        .with_effective_mass(mass)
        .with_curvature_radius(radius)
        .with_restitution(restitution)
}

fn contact(pig: &Asset, striker: Striker) -> Contact {
    let flank = pig.fracture().positions.iter().copied();
    let point = flank
        .max_by(|a, b| a.x.total_cmp(&b.x))
        .unwrap_or(Vec3::ZERO);
    Contact::collision(pig, point, Vec3::NEG_X, BALL[2], striker)
}

/// The state under the impulse spread over a step, the same modes and cracks `[G12 Fig. 4, top]`.
fn quasi_static(body: &Body, contact: &Contact) -> Result<Outcome> {
    let force = Force {
        point: contact.point,
        force: contact.whole_impulse() / STEP as f32,
    };
    Ok(rest(
        body,
        &[force],
        Vec3::ZERO,
        &FractureConfig::as_in_the_paper(),
    )?)
}

/// The balls without a contact model, in the paper's and in ours.
pub(super) fn compute() -> Result<Value> {
    let shape = Shape::ready("piggy_bank").ok_or("no piggy bank")?;
    let pig = baked("piggy bank", shape, "paper-piggy", 20_000.0, MODES)?;
    let body = Breakable::uniform(Arc::clone(&pig))?.body(1);
    let still = |&modulus: &f64| {
        Ok(pieces(&quasi_static(
            &body,
            &contact(&pig, striker(modulus)),
        )?))
    };
    let still: Result<Vec<usize>> = MODULI.iter().map(still).collect();
    let mut rows = Vec::new();
    for (model, config) in models() {
        let hit = |&modulus: &f64| hit(&body, model, modulus, &config);
        rows.extend(MODULI.par_iter().map(hit).collect::<Result<Vec<_>>>()?);
    }
    Ok(json!({ "quasi_static_pieces": still?, "balls": rows }))
}

/// One ball in one model.
fn hit(body: &Body, model: &str, modulus: f64, config: &FractureConfig) -> Result<Value> {
    let contact = [contact(body.asset(), striker(modulus))];
    let outcome = impact(body, &contact, config)?;
    let mut duration = outcome.report().contact_duration;
    if duration == 0.0 {
        // Refused by its impulse alone: nothing had to be computed.
        let load = modal_load(body, &contact);
        duration = contact_duration(body.asset(), &load, config.duration);
    }
    Ok(
        json!({ "model": model, "modulus_pa": modulus, "duration_s": duration, "damage": damage(&outcome) }),
    )
}
