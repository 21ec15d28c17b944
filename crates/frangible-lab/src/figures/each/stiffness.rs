//! Fig. 4: balls of different stiffness on a piggy bank.

use std::sync::Arc;

use crate::plot::{Axis, Chart, Marker, Series};
use frangible::glam::{Quat, Vec3};
use frangible::internals::contact::{contact_duration, modal_load};
use frangible::internals::{Force, rest};
use frangible::{Asset, Body, Breakable, Contact, FractureConfig, Outcome, Striker, impact};
use frangible_bake::Shape;
use image::RgbImage;
use rayon::prelude::*;

use crate::figures::FigureError;
use crate::figures::bodies::{MODES, baked};
use crate::figures::draw::{Look, Model, PieceColours, add_pieces, below, beside, chart};
use crate::figures::figure::{Claim, Figure, Findings, Picture, Table};
use crate::figures::statistics::{Damage, damage, models, pieces};
use crate::figures::workshop::Workshop;

pub(crate) const FIGURE: Figure = Figure {
    name: "fig4",
    title: "Fig. 4: a piggy bank hit by balls of different stiffness",
    shows: "above, without the contact force model, a quasi-static state from the impulse alone, which is the same for every ball; below, with it: a stiffer \
            ball gives a shorter contact and higher stresses; \"with a softer ball, the contact will last longer and the energy of the ball will be \
            damped without generating any fracture.\"",
    compute,
};

/// Mass, kg, radius, m, speed, m/s, and restitution of every ball, whatever it is made of: the impulse is the same.
const BALL: [f64; 4] = [0.5, 0.03, 25.0, 0.5];

/// Balls: contact modulus E/(1 − ν²), Pa; from rubber over concrete (the fourth) to steel.
const MODULI: [f64; 5] = [3.3e6, 1e8, 2.5e9, 3e10, 2.3e11];

/// Stiffnesses that are drawn: as rubber, concrete and steel.
const DRAWN: [(usize, &str); 3] = [(0, "soft"), (3, "medium"), (4, "stiff")];

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
fn quasi_static(body: &Body, contact: &Contact) -> Result<Outcome, FigureError> {
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

/// One ball in one model.
struct Hit {
    modulus: f64,
    /// Duration of the contact, s.
    duration: f64,
    outcome: Outcome,
    damage: Damage,
}

fn compute(workshop: &mut Workshop<'_>) -> Result<Findings, FigureError> {
    workshop.tell("baking the piggy bank", 0.0);
    let shape = Shape::ready("piggy_bank").ok_or(FigureError::Nothing("no piggy bank"))?;
    let pig = baked("piggy bank", shape, "paper-piggy", 20_000.0, MODES)?;
    let body = Breakable::uniform(Arc::clone(&pig))?.body(1);
    let mut cells = Vec::new();
    let mut static_pieces = Vec::new();
    for (ball, word) in DRAWN {
        let outcome = quasi_static(&body, &contact(&pig, striker(MODULI[ball])))?;
        static_pieces.push(pieces(&outcome));
        cells.push(picture(&pig, &outcome, &format!("quasi-static, {word}"))?);
    }
    let mut rows = vec![beside(&cells)];
    let mut hits = Vec::new();
    for (m, (name, config)) in models().into_iter().enumerate() {
        workshop.tell(&format!("{name}, balls"), 0.2 + 0.35 * m as f64);
        let scanned = scan(&body, &config)?;
        let drawn = DRAWN.map(|(ball, word)| {
            picture(
                &pig,
                &scanned[ball].outcome,
                &format!(
                    "{}, {word}",
                    name.trim_start_matches("the ").trim_end_matches(" model")
                ),
            )
        });
        rows.push(beside(&drawn.into_iter().collect::<Result<Vec<_>, _>>()?));
        hits.push((name, scanned));
    }
    let charts = [duration_chart(&hits), area_chart(&hits)];
    rows.push(beside(&charts.map(|c| chart(&c, 498, 330))));
    Ok(Findings {
        picture: Picture {
            image: below(&rows),
            caption: "the piggy bank after a soft, a medium and a stiff ball: quasi-static, the paper's model, ours; duration and crack area".into(),
        },
        text: text(&hits, static_pieces[0]),
        claims: claims(&hits, &static_pieces),
        tables: vec![table(&hits)],
    })
}

/// Balls of all moduli in one model.
fn scan(body: &Body, config: &FractureConfig) -> Result<Vec<Hit>, FigureError> {
    let one = |&modulus: &f64| -> Result<Hit, FigureError> {
        let contact = contact(body.asset(), striker(modulus));
        let outcome = impact(body, std::slice::from_ref(&contact), config)?;
        let mut duration = outcome.report().contact_duration;
        if duration == 0.0 {
            // Refused by its impulse alone: nothing had to be computed.
            let load = modal_load(body, std::slice::from_ref(&contact));
            duration = contact_duration(body.asset(), &load, config.duration);
        }
        let damage = damage(&outcome);
        Ok(Hit {
            modulus,
            duration,
            outcome,
            damage,
        })
    };
    MODULI.par_iter().map(one).collect()
}

fn text(hits: &[(&str, Vec<Hit>)], static_pieces: usize) -> String {
    let [mass, radius, speed, _] = BALL;
    let durations = |i: usize| {
        format!(
            "{:.2} to {:.2} ms",
            1e3 * last(&hits[i].1).duration,
            1e3 * hits[i].1[0].duration
        )
    };
    format!(
        "A piggy bank of `paper-piggy` (0.75 kg), hit on its flank at {speed:.0} m/s by balls of {mass} kg and {:.0} mm radius that differ in stiffness alone: as \
         rubber, concrete and steel. All bring the same impulse. *Quasi-static*: the impulse over {:.2} ms as a steady force (`rest`), {static_pieces} pieces \
         whatever the ball. *The paper's model*: contacts of {}. *Ours*: {}; against the stiff balls it is lengthened until the vibration holds no more \
         energy than the ball brought. Pieces are pulled apart; seed 1.",
        1e3 * radius,
        1e3 * STEP,
        durations(0),
        durations(1)
    )
}

fn last(hits: &[Hit]) -> &Hit {
    &hits[hits.len() - 1]
}

fn claims(hits: &[(&str, Vec<Hit>)], static_pieces: &[usize]) -> Vec<Claim> {
    let same = static_pieces.windows(2).all(|w| w[0] == w[1]);
    let mut claims = vec![Claim::new(
        "without a contact model the ball's stiffness does not matter (the same pieces)",
        format!("{static_pieces:?} pieces"),
        same,
    )];
    for (name, hits) in hits {
        let falls = hits
            .windows(2)
            .all(|w| w[1].duration <= 1.05 * w[0].duration);
        let shown: Vec<String> = hits
            .iter()
            .map(|h| format!("{:.3}", 1e3 * h.duration))
            .collect();
        claims.push(Claim::new(
            format!("the stiffer the ball, the shorter the contact, {name} (from ball to ball never longer by more than 5 %, the step of our lengthening; less than half in all)"),
            format!("{} ms", shown.join(", ")),
            falls && last(hits).duration < 0.5 * hits[0].duration,
        ));
        let (soft, stiff) = (&hits[0].damage, &last(hits).damage);
        claims.push(Claim::new(
            format!("a stiff ball breaks it, the soft one leaves no crack, {name}"),
            format!(
                "{} pieces and {} cracks with the stiff, {} cracks with the soft ball",
                stiff.pieces, stiff.cracks, soft.cracks
            ),
            stiff.pieces >= 2.0 && soft.cracks == 0.0,
        ));
    }
    claims
}

fn table(hits: &[(&str, Vec<Hit>)]) -> Table {
    let mut table = Table::new([
        "model",
        "ball's E/(1 − ν²)",
        "contact duration",
        "cracks",
        "crack area, cm²",
        "pieces",
    ]);
    for (name, hits) in hits {
        for hit in hits {
            table.row([
                (*name).into(),
                format!("{:.1e} Pa", hit.modulus),
                format!("{:.3} ms", 1e3 * hit.duration),
                format!("{}", hit.damage.cracks),
                format!("{:.1}", 1e4 * hit.damage.area),
                format!("{}", hit.damage.pieces),
            ]);
        }
    }
    table
}

fn series(hits: &[(&str, Vec<Hit>)], of: fn(&Hit) -> f64) -> Vec<Series> {
    let markers = [Marker::Square, Marker::Disc];
    let one = |((name, hits), marker): (&(&str, Vec<Hit>), Marker)| Series {
        name: (*name).into(),
        points: hits.iter().map(|h| (h.modulus, of(h))).collect(),
        marker,
        line: true,
    };
    hits.iter().zip(markers).map(one).collect()
}

fn duration_chart(hits: &[(&str, Vec<Hit>)]) -> Chart {
    Chart {
        title: "contact duration".into(),
        x: Axis::log("stiffness of the ball, Pa"),
        y: Axis::log("duration, ms"),
        series: series(hits, |h| 1e3 * h.duration),
    }
}

fn area_chart(hits: &[(&str, Vec<Hit>)]) -> Chart {
    Chart {
        title: "crack area".into(),
        x: Axis::log("stiffness of the ball, Pa"),
        y: Axis::linear("crack area, square cm"),
        series: series(hits, |h| 1e4 * h.damage.area),
    }
}

const OUTSIDE: [f32; 4] = [0.60, 0.17, 0.16, 1.0];

fn picture(pig: &Asset, outcome: &Outcome, label: &str) -> Result<RgbImage, FigureError> {
    // Baked with z up and its flank towards +x, where the ball comes from.
    let turned = Quat::from_rotation_z(0.35);
    let mut model = Model::default();
    if let Outcome::Broke(fracture) = outcome {
        let colours = PieceColours {
            outside: OUTSIDE,
            inside: [0.80, 0.70, 0.60, 1.0],
        };
        add_pieces(&mut model, &fracture.fragments, 0.22, turned, colours);
    } else {
        for (triangle, normals) in pig.surface().triangles.iter().zip(&pig.surface().normals) {
            let corners = triangle.map(|v| turned * pig.fracture().positions[v as usize]);
            model.smooth(OUTSIDE, corners, normals.map(|n| turned * n));
        }
    }
    let points: Vec<Vec3> = pig
        .fracture()
        .positions
        .iter()
        .map(|&p| turned * p * 1.25)
        .collect();
    let look = Look {
        from: Vec3::new(1.0, 0.0, 0.25),
        up: Vec3::Z,
        width: 330,
        height: 240,
    };
    let held = pieces(outcome) == 1;
    let label = if held {
        format!("{label}: held")
    } else {
        format!("{label}: {} pieces", pieces(outcome))
    };
    Ok(look.at_points(&model, &points, &label)?)
}
