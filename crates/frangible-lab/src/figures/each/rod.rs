//! Fig. 3: the contact duration of a rod that falls in several ways.

use crate::plot::{Axis, Chart, Marker, Series};
use frangible::glam::{Quat, Vec3};
use frangible::internals::DurationModel;
use frangible::internals::contact::{contact_duration, modal_load, most_excited_mode};
use frangible::{Asset, Body, Breakable, Contact, Striker};
use frangible_bake::Shape;
use frangible_bake::mode_field::{mode_on_fracture_mesh, von_mises};
use frangible_draw::{ModeCell, ModeSheetOptions, mode_sheet};

use crate::figures::FigureError;
use crate::figures::bodies::{MODES, baked};
use crate::figures::draw::{below, beside, chart};
use crate::figures::figure::{Claim, Figure, Findings, Picture, Table};
use crate::figures::workshop::Workshop;

pub(crate) const FIGURE: Figure = Figure {
    name: "fig3",
    title: "Fig. 3: contact duration of a rod that falls in different configurations",
    shows: "a rod falling in different configurations: \"depending on the initial position of the rod, the most excited mode is different, and so is \
            the estimated contact duration.\"",
    compute,
};

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

/// Response of the rod to a landing.
struct Answer {
    /// The most excited mode, from 0.
    mode: usize,
    /// Its frequency, Hz.
    frequency: f64,
    /// Duration of the contact, s, with that mode and by Hertz.
    modal: f64,
    hertz: f64,
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

    fn answer(self, body: &Body) -> Answer {
        let load = modal_load(body, &[self.contact(body.asset())]);
        let modes = body.asset().modes();
        let shape = &load.touches[0].modal_shape;
        let mode = most_excited_mode(body.asset(), shape).unwrap_or(0);
        let duration = |model| contact_duration(body.asset(), &load, model);
        Answer {
            mode,
            frequency: modes.frequency(mode),
            modal: duration(DurationModel::ModalHertz),
            hertz: duration(DurationModel::Hertz),
        }
    }

    /// Rotation of the rod when it lands.
    fn rotation(self) -> Quat {
        match self {
            Self::Leaning(degrees) => Quat::from_rotation_y(-(degrees as f32).to_radians()),
            Self::OnRail(_) => Quat::IDENTITY,
        }
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

fn compute(workshop: &mut Workshop<'_>) -> Result<Findings, FigureError> {
    workshop.tell("baking the rod", 0.0);
    let rod = baked("rod", Shape::rod(LENGTH, SIDE), MATERIAL, 8000.0, MODES)?;
    let body = Breakable::uniform(rod)?.body(1);
    workshop.tell("landings", 0.6);
    let angles = (0..=30).map(|i| 3.0 * f64::from(i));
    let leaning: Vec<(f64, Answer)> = angles
        .map(|a| (a, Landing::Leaning(a).answer(&body)))
        .collect();
    let places = (2..=25).map(|i| 0.02 * f64::from(i));
    let on_rail: Vec<(f64, Answer)> = places
        .map(|x| (x, Landing::OnRail(x).answer(&body)))
        .collect();
    let shown: Vec<(Landing, Answer)> = SHOWN
        .iter()
        .map(|&landing| (landing, landing.answer(&body)))
        .collect();

    workshop.tell("drawing", 0.8);
    let cells: Vec<ModeCell> = shown
        .iter()
        .map(|(l, a)| cell(body.asset(), *l, a))
        .collect();
    let options = ModeSheetOptions {
        cell_width: 247,
        cell_height: 260,
        columns: 4,
        look_from: Vec3::new(0.15, -1.0, 0.25),
        up: Vec3::Z,
        legend: vec!["Most excited mode; colour: von Mises stress over its largest".into()],
    };
    let strips = mode_sheet(&cells, &options)?.into();
    let charts = [
        duration_chart("rod on its end", "angle to the floor, degrees", &leaning),
        duration_chart(
            "level rod on a rail",
            "place of the rail, share of the length",
            &on_rail,
        ),
    ];
    let charts = charts.map(|c| chart(&c, 498, 360));
    let image = below(&[strips, beside(&charts)]);
    Ok(Findings {
        picture: Picture {
            image,
            caption: "the most excited mode of four falls, and duration against angle and place"
                .into(),
        },
        text: text(&shown),
        claims: claims(&leaning, &on_rail),
        tables: vec![table(&shown)],
    })
}

fn text(shown: &[(Landing, Answer)]) -> String {
    let modal = |i: usize| 1e6 * shown[i].1.modal;
    format!(
        "A rod of 300 × 20 × 20 mm (E and ρ of `{MATERIAL}`) lands at {SPEED:.0} m/s on a rigid floor, on the middle of an end face, its axis at an \
         angle; or level on a rail. Above: the mode that each of four landings moves most. Below: the duration by the paper's Eq. 2, with \
         consistent dimensions, and by Hertz' Eq. 1, which knows no modes. On its end the rod is hit along its axis and answers stiffly ({:.0} µs); \
         leaning, it bends ({:.0} µs). On a rail in its middle it bends as a whole ({:.0} µs); where that mode has its node, another takes over \
         ({:.0} µs). The steps are changes of the most excited mode.",
        modal(0),
        modal(1),
        modal(2),
        modal(3)
    )
}

fn claims(leaning: &[(f64, Answer)], on_rail: &[(f64, Answer)]) -> Vec<Claim> {
    let all = || leaning.iter().chain(on_rail).map(|(_, answer)| answer);
    let mut modes: Vec<usize> = all().map(|a| a.mode).collect();
    modes.sort_unstable();
    modes.dedup();
    let shortest = all().map(|a| a.modal).fold(f64::INFINITY, f64::min);
    let longest = all().map(|a| a.modal).fold(0.0, f64::max);
    // Of neighbours, a change of mode against none.
    let (mut with, mut without) = (0.0_f64, 0.0_f64);
    for list in [leaning, on_rail] {
        for pair in list.windows(2) {
            let (a, b) = (&pair[0].1, &pair[1].1);
            let jump = (a.modal / b.modal).ln().abs();
            if a.frequency == b.frequency {
                without = without.max(jump);
            } else {
                with = with.max(jump);
            }
        }
    }
    vec![
        Claim::new(
            "the most excited mode depends on how the rod falls (at least two modes)",
            format!("{} modes", modes.len()),
            modes.len() >= 2,
        ),
        Claim::new(
            "so does the estimated duration (longest over shortest at least 1.5)",
            format!(
                "{:.0} to {:.0} µs, {:.1} times",
                1e6 * shortest,
                1e6 * longest,
                longest / shortest
            ),
            longest > 1.5 * shortest,
        ),
        Claim::new(
            "it is the mode that sets it (largest step with a change of mode, over that without)",
            format!(
                "{:.0} % against {:.1} %",
                100.0 * with.exp_m1(),
                100.0 * without.exp_m1()
            ),
            with > without,
        ),
    ]
}

fn table(shown: &[(Landing, Answer)]) -> Table {
    let mut table = Table::new([
        "landing",
        "most excited mode",
        "frequency",
        "duration, Eq. 2",
        "duration, Hertz",
    ]);
    for (landing, answer) in shown {
        table.row([
            landing.name(),
            (answer.mode + 1).to_string(),
            format!("{:.0} Hz", answer.frequency),
            format!("{:.0} µs", 1e6 * answer.modal),
            format!("{:.0} µs", 1e6 * answer.hertz),
        ]);
    }
    table
}

fn duration_chart(title: &str, x: &str, answers: &[(f64, Answer)]) -> Chart {
    let series = |name: &str, marker, of: fn(&Answer) -> f64| Series {
        name: name.into(),
        points: answers.iter().map(|(x, a)| (*x, 1e3 * of(a))).collect(),
        marker,
        line: true,
    };
    Chart {
        title: title.into(),
        x: Axis::linear(x),
        y: Axis::linear("contact duration, ms").including(1.1),
        series: vec![
            series("Eq. 2, modal", Marker::Disc, |a| a.modal),
            series("Eq. 1, Hertz", Marker::Square, |a| a.hertz),
        ],
    }
}

/// Largest displacement as drawn, m.
const DRAWN: f32 = 0.035;

fn cell(rod: &Asset, landing: Landing, answer: &Answer) -> ModeCell {
    let field = mode_on_fracture_mesh(rod, answer.mode);
    let largest = field.largest_displacement().max(f32::MIN_POSITIVE);
    let rotation = landing.rotation();
    let positions = rod.fracture().positions.iter().zip(&field.displacements);
    let stresses: Vec<f32> = field.stresses.iter().map(von_mises).collect();
    let most = stresses.iter().copied().fold(f32::MIN_POSITIVE, f32::max);
    ModeCell {
        positions: positions
            .map(|(&p, &u)| rotation * (p + u * (DRAWN / largest)))
            .collect(),
        triangles: rod.surface().triangles.clone(),
        values: stresses.iter().map(|s| s / most).collect(),
        caption: landing.name(),
        note: format!(
            "mode {}, {:.1} kHz, {:.0} µs",
            answer.mode + 1,
            1e-3 * answer.frequency,
            1e6 * answer.modal
        ),
    }
}
