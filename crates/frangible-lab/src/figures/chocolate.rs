//! Fig. 13: a thick filled body thrown on a wall.

use std::sync::Arc;

use frangible::glam::Vec3;
use frangible::internals::mesh::NO_NEIGHBOUR;
use frangible::internals::{CrackTrace, impact_traced};
use frangible::{Asset, Breakable, Contact, FractureConfig, Material, Outcome, Striker};
use frangible_bake::Shape;
use serde_json::{Value, json};

use super::bodies::{MODES, baked};
use super::statistics::pieces;
use crate::Result;

/// Speeds that are tried, m/s: the first of them, and the factor between one and the next.
const SLOWEST: f64 = 2.0;
const FASTEST: f64 = 400.0;
const FACTOR: f64 = 1.12;

/// Share of the volume that the largest piece is to stay below: ears come off sooner.
const LARGEST: f64 = 0.9;

/// A break against the wall.
struct Thrown {
    rabbit: Arc<Asset>,
    speed: f64,
    outcome: Outcome,
    trace: CrackTrace,
}

/// The rabbit in the paper's model and in ours.
pub(super) fn compute() -> Result<Value> {
    let models = [
        (
            "the paper's model",
            "paper-rabbit",
            FractureConfig::as_in_the_paper(),
        ),
        ("ours", "chocolate", FractureConfig::default()),
    ];
    let rows = models.into_iter().map(|(model, material, config)| {
        let shape = Shape::ready("rabbit").ok_or("no rabbit")?;
        let t = throw(baked("rabbit", shape, material, 19_000.0, MODES)?, &config)?;
        let (inside, all) = inside(&t);
        Ok(json!({
            "model": model,
            "material": material,
            "tets": t.rabbit.fracture().tets.len(),
            "speed_m_s": t.speed,
            "pieces": pieces(&t.outcome),
            "largest": largest(&t.outcome),
            "cracks": t.outcome.report().cracks,
            "cut": all,
            "cut_inside": inside,
        }))
    });
    rows.collect()
}

fn throw(rabbit: Arc<Asset>, config: &FractureConfig) -> Result<Thrown> {
    let kind = Breakable::uniform(Arc::clone(&rabbit))?;
    let stone = Striker::fixed(&Material::preset("stone")?);
    let mut speed = SLOWEST;
    while speed < FASTEST {
        let (outcome, trace) = impact_traced(
            &kind.body(1),
            &[contact(&rabbit, speed, stone.clone())],
            config,
        )?;
        if largest(&outcome) < LARGEST {
            return Ok(Thrown {
                rabbit,
                speed,
                outcome,
                trace,
            });
        }
        speed *= FACTOR;
    }
    Err("no throw breaks the rabbit".into())
}

/// Its side, +x, meets the wall.
fn contact(rabbit: &Asset, speed: f64, wall: Striker) -> Contact {
    let all = rabbit.fracture().positions.iter().copied();
    let point = all.max_by(|a, b| a.x.total_cmp(&b.x)).unwrap_or(Vec3::ZERO);
    Contact::collision(rabbit, point, Vec3::NEG_X, speed, wall)
}

/// Cut elements without a face on the outside, and all of them.
fn inside(thrown: &Thrown) -> (usize, usize) {
    let neighbours = &thrown.rabbit.fracture().neighbours;
    let cut = || thrown.trace.cracks.iter().flatten();
    let deep = cut().filter(|e| !neighbours[e.tet as usize].contains(&NO_NEIGHBOUR));
    (deep.count(), cut().count())
}

/// Share of the volume in the largest piece.
fn largest(outcome: &Outcome) -> f64 {
    let Outcome::Broke(fracture) = outcome else {
        return 1.0;
    };
    let volumes = || fracture.fragments.iter().map(|f| f.mass.volume);
    volumes().fold(0.0, f64::max) / volumes().sum::<f64>()
}
