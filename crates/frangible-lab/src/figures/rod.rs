//! Fig. 3: the contact duration of a rod that falls in several ways.

use frangible::glam::Vec3;
use frangible::internals::DurationModel;
use frangible::internals::contact::{contact_duration, modal_load, most_excited_mode};
use frangible::{Asset, Body, Breakable, Contact, Striker};
use frangible_bake::Shape;
use serde_json::{Value, json};

use super::bodies::{MODES, baked};
use crate::Result;

/// Length and side, m, and speed of the fall, m/s.
const LENGTH: f64 = 0.3;
const SIDE: f64 = 0.02;
const SPEED: f64 = 4.0;

/// The rod's Young's modulus, density: the paper's slab; its other numbers do not matter here.
const MATERIAL: &str = "paper-slab";

/// Pose in which the rod lands.
#[derive(Clone, Copy)]
enum Landing {
    /// On the middle of an end face, its axis at this angle to the floor, degrees.
    Leaning(f64),
    /// Level, on a rail at this share of its length.
    OnRail(f64),
}

impl Landing {
    /// Blow in the body frame, by a rigid floor.
    fn contact(self, rod: &Asset) -> Contact {
        let half = 0.5 * LENGTH as f32;
        let (point, up) = match self {
            Self::Leaning(degrees) => {
                let (sin, cos) = (degrees as f32).to_radians().sin_cos();
                (Vec3::new(-half, 0.0, 0.0), Vec3::new(sin, 0.0, cos))
            }
            Self::OnRail(share) => {
                let x = (share as f32 - 0.5) * 2.0 * half;
                (Vec3::new(x, 0.0, -0.5 * SIDE as f32), Vec3::Z)
            }
        };
        Contact::collision(rod, point, up, SPEED, Striker::rigid())
    }

    /// The most excited mode, from 1, and the duration of the contact with that mode and by Hertz.
    fn answer(self, at: f64, body: &Body) -> Value {
        let load = modal_load(body, &[self.contact(body.asset())]);
        let modes = body.asset().modes();
        let shape = &load.touches[0].modal_shape;
        let mode = most_excited_mode(body.asset(), shape).unwrap_or(0);
        let duration = |model| contact_duration(body.asset(), &load, model);
        json!({
            "landing": self.name(),
            "at": at,
            "mode": mode + 1,
            "frequency_hz": modes.frequency(mode),
            "modal_s": duration(DurationModel::ModalHertz),
            "hertz_s": duration(DurationModel::Hertz),
        })
    }

    fn name(self) -> String {
        match self {
            Self::Leaning(degrees) => format!("falls at {degrees:.0}°"),
            Self::OnRail(share) => format!("on a rail, {:.0} %", 100.0 * share),
        }
    }
}

const SHOWN: [Landing; 4] = [
    Landing::Leaning(90.0),
    Landing::Leaning(30.0),
    Landing::OnRail(0.5),
    Landing::OnRail(0.22),
];

/// Landings at angles and on rails at places, and the four that the figure shows.
pub(super) fn compute() -> Result<Value> {
    let rod = baked("rod", Shape::rod(LENGTH, SIDE), MATERIAL, 8000.0, MODES)?;
    let body = Breakable::uniform(rod)?.body(1);
    let angles = (0..=30).map(|i| 3.0 * f64::from(i));
    let places = (2..=25).map(|i| 0.02 * f64::from(i));
    let leaning = angles.map(|at| Landing::Leaning(at).answer(at, &body));
    let on_rail = places.map(|at| Landing::OnRail(at).answer(at, &body));
    Ok(json!({
        "leaning": leaning.collect::<Vec<_>>(),
        "on_rail": on_rail.collect::<Vec<_>>(),
        "shown": SHOWN.map(|landing| landing.answer(0.0, &body)),
    }))
}
