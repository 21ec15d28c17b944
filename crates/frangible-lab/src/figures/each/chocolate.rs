//! Fig. 13: a thick filled body thrown on a wall.

use std::sync::Arc;

use frangible::glam::{Quat, Vec3};
use frangible::internals::mesh::NO_NEIGHBOUR;
use frangible::internals::{CrackTrace, impact_traced};
use frangible::{Asset, Breakable, Contact, FractureConfig, Material, Outcome, Striker};
use frangible_bake::Shape;
use image::RgbImage;

use crate::figures::FigureError;
use crate::figures::bodies::{MODES, baked};
use crate::figures::draw::{Look, Model, PieceColours, add_pieces, below, beside};
use crate::figures::figure::{Claim, Figure, Findings, Picture, Table};
use crate::figures::statistics::pieces;
use crate::figures::workshop::Workshop;

pub(crate) const FIGURE: Figure = Figure {
    name: "fig13",
    title: "Fig. 13: propagation of the fracture into a thick filled body",
    shows: "front, back and side view of a solid chocolate Stanford bunny thrown on a wall.",
    compute,
};

/// Speeds that are tried, m/s: the first of them, and the factor between one and the next.
const SLOWEST: f64 = 2.0;
const FASTEST: f64 = 400.0;
const FACTOR: f64 = 1.12;

/// Share of the volume that the largest piece is to stay below: ears come off sooner.
const LARGEST: f64 = 0.9;

/// A break against the wall.
struct Thrown {
    model: &'static str,
    material: &'static str,
    rabbit: Arc<Asset>,
    speed: f64,
    outcome: Outcome,
    trace: CrackTrace,
}

fn compute(workshop: &mut Workshop<'_>) -> Result<Findings, FigureError> {
    let mut thrown = Vec::new();
    for (i, (model, material, config)) in [
        (
            "the paper's model",
            "paper-rabbit",
            FractureConfig::as_in_the_paper(),
        ),
        ("ours", "chocolate", FractureConfig::default()),
    ]
    .into_iter()
    .enumerate()
    {
        workshop.tell(&format!("baking and throwing, {material}"), 0.5 * i as f64);
        let shape = Shape::ready("rabbit").ok_or(FigureError::Nothing("no rabbit"))?;
        let rabbit = baked("rabbit", shape, material, 19_000.0, MODES)?;
        thrown.push(throw(model, material, rabbit, &config)?);
    }
    workshop.tell("drawing", 0.9);
    let mut rows = Vec::new();
    for t in &thrown {
        let views = [("front", 0.0), ("back", 180.0), ("side", 90.0)];
        let cells = views.map(|(name, degrees)| picture(t, name, degrees));
        rows.push(beside(&cells.into_iter().collect::<Result<Vec<_>, _>>()?));
    }
    let mut table = Table::new([
        "model",
        "material",
        "speed",
        "pieces",
        "largest piece",
        "cracks",
        "cut elements inside",
    ]);
    let mut claims = Vec::new();
    for t in &thrown {
        let (inside, all) = inside(t);
        let share = inside as f64 / all.max(1) as f64;
        let largest = largest(&t.outcome);
        table.row([
            t.model.into(),
            format!("`{}`", t.material),
            format!("{:.1} m/s", t.speed),
            pieces(&t.outcome).to_string(),
            format!("{:.0} %", 100.0 * largest),
            t.outcome.report().cracks.to_string(),
            format!("{inside} of {all}"),
        ]);
        claims.push(Claim::new(
            format!("cracks go through the filled body, {} (more than half of the cut elements lie inside, in three pieces or more)", t.model),
            format!("{:.0} % inside, {} pieces", 100.0 * share, pieces(&t.outcome)),
            share > 0.5 && pieces(&t.outcome) >= 3,
        ));
    }
    Ok(Findings {
        picture: Picture {
            image: below(&rows),
            caption: "front, back and side of the broken rabbit, the paper's parameters and model above, real chocolate and ours below".into(),
        },
        text: format!(
            "A solid rabbit of {} tetrahedra, 150 mm high, thrown on a rigid wall with its side; the slowest throw, in steps of {:.0} %, after which the \
             largest piece is less than {:.0} % of it; pieces pulled apart, seed 1. Above, the paper's numbers: R_c is half of E, which takes \
             {:.0} m/s. Below, those of chocolate (R_c 1.5 MPa) in our model: {:.1} m/s.",
            thrown[0].rabbit.fracture().tets.len(),
            100.0 * (FACTOR - 1.0),
            100.0 * LARGEST,
            thrown[0].speed,
            thrown[1].speed
        ),
        claims,
        tables: vec![table],
    })
}

fn throw(
    model: &'static str,
    material: &'static str,
    rabbit: Arc<Asset>,
    config: &FractureConfig,
) -> Result<Thrown, FigureError> {
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
                model,
                material,
                rabbit,
                speed,
                outcome,
                trace,
            });
        }
        speed *= FACTOR;
    }
    Err(FigureError::Nothing("no throw breaks the rabbit"))
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

fn picture(thrown: &Thrown, name: &str, degrees: f32) -> Result<RgbImage, FigureError> {
    let turned = Quat::from_rotation_z(degrees.to_radians());
    let mut model = Model::default();
    if let Outcome::Broke(fracture) = &thrown.outcome {
        let colours = PieceColours {
            outside: [0.16, 0.07, 0.03, 1.0],
            inside: [0.45, 0.24, 0.13, 1.0],
        };
        add_pieces(&mut model, &fracture.fragments, 0.25, turned, colours);
    }
    let look = Look {
        from: Vec3::new(0.25, -1.0, 0.25),
        up: Vec3::Z,
        width: 330,
        height: 300,
    };
    Ok(look.at(&model, &format!("{}, {name}", thrown.model))?)
}
