//! Fig. 5: the stress in the slab over the contact.

use crate::plot::{Axis, Chart, Marker, Series};
use frangible::glam::Vec3;
use frangible::internals::Model;
use frangible::internals::contact::{
    Pulse, admissible_duration, approach_energy, contact_duration, modal_load, pulse,
};
use frangible::internals::modal::{Motion, respond};
use frangible::internals::stress::{Symmetric3, largest_eigenvalue};
use frangible::{Asset, Body, Breakable, FractureConfig};
use frangible_bake::mode_field::mode_on_fracture_mesh;
use frangible_draw::{ModeCell, ModeSheetOptions, mode_sheet};

use crate::figures::FigureError;
use crate::figures::bodies::{SLAB, SLAB_BALL, slab_blow};
use crate::figures::draw::{below, chart};
use crate::figures::figure::{Claim, Figure, Findings, Picture, Table};
use crate::figures::statistics::models;
use crate::figures::workshop::Workshop;

pub(crate) const FIGURE: Figure = Figure {
    name: "fig5",
    title: "Fig. 5: the contact force model on a stiff slab",
    shows: "a slab hit in its middle at successive times, its colour proportional to the largest principal tension: a half-sine force is applied at \
            discrete times Δt for the contact duration t_d.",
    compute,
};

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

/// The slab's outside, and the stress of a unit of each mode there.
struct Faces {
    points: Vec<Vec3>,
    triangles: Vec<[u32; 3]>,
    /// Per mode and point, Pa per unit amplitude.
    stresses: Vec<Vec<Symmetric3>>,
}

impl Faces {
    fn new(slab: &Asset) -> Self {
        let mut place = vec![u32::MAX; slab.fracture().positions.len()];
        let mut nodes = Vec::new();
        let mut triangles = Vec::new();
        for triangle in &slab.surface().triangles {
            triangles.push(triangle.map(|v| {
                if place[v as usize] == u32::MAX {
                    place[v as usize] = nodes.len() as u32;
                    nodes.push(v as usize);
                }
                place[v as usize]
            }));
        }
        let of_mode = |mode: usize| {
            let field = mode_on_fracture_mesh(slab, mode);
            nodes.iter().map(|&v| field.stresses[v]).collect()
        };
        Self {
            points: nodes
                .iter()
                .map(|&v| slab.fracture().positions[v])
                .collect(),
            stresses: (0..slab.modes().count()).map(of_mode).collect(),
            triangles,
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

fn compute(workshop: &mut Workshop<'_>) -> Result<Findings, FigureError> {
    let slab = workshop.slab()?;
    workshop.tell("stresses of the modes", 0.3);
    let faces = Faces::new(&slab);
    let contact = slab_blow(&slab)?;
    let body = Breakable::uniform(slab)?.body(1);
    let waves = models().map(|(_, config)| wave(&body, contact.clone(), &config));
    let [paper, ours] = &waves;

    workshop.tell("stresses over time", 0.5);
    let curves = waves.each_ref().map(|wave| curve(wave, &faces));
    let duration = ours.pulse.duration;
    let instants: Vec<(f64, Vec<f32>)> = INSTANTS
        .iter()
        .map(|share| {
            let step = ours.step_at(share * duration);
            let time = (step + 1) as f64 * ours.pulse.time_step;
            (time, ours.tensions(&faces, step))
        })
        .collect();

    workshop.tell("drawing", 0.8);
    let image = below(&[
        maps(&faces, &instants, duration)?,
        chart(&time_chart(&waves, &curves), 1000, 400),
    ]);
    let peak = |curve: &[(f64, f64)]| {
        curve
            .iter()
            .copied()
            .fold((0.0, 0.0), |m, p| if p.1 > m.1 { p } else { m })
    };
    let [paper_peak, ours_peak] = curves.each_ref().map(|c| peak(c));
    let first = faces.spread(&instants[0].1);
    let end = faces.spread(&instants[4].1);
    let [mass, _, speed] = SLAB_BALL;
    let text = format!(
        "A slab of {:.0} × {:.0} × {:.0} mm of `paper-slab-high`, hit in its middle by a steel ball of {mass} kg at {speed:.0} m/s; no cracks. The maps show \
         the largest principal tension on the face away from the ball, under our pulse (Hertz, {:.0} µs): at first only around the hit, then a ring that runs \
         outwards, later the whole slab bends. The chart shows the largest tension anywhere on the outside. The paper's duration, that of the most \
         excited mode, is {:.1} ms: the slab swings once, slowly, and feels {:.0} MPa at most instead of {:.0} MPa.",
        1e3 * SLAB[0],
        1e3 * SLAB[1],
        1e3 * SLAB[2],
        1e6 * duration,
        1e3 * paper.pulse.duration,
        1e-6 * paper_peak.1,
        1e-6 * ours_peak.1,
    );
    let claims = vec![
        Claim::new(
            "the deformation starts at the impact and spreads (mean distance of the squared tension from the middle grows from the first map to t_d)",
            format!(
                "{:.0} mm at {:.0} µs, {:.0} mm at t_d",
                1e3 * first,
                1e6 * instants[0].0,
                1e3 * end
            ),
            end > 1.2 * first,
        ),
        Claim::new(
            "Δt and t_d follow from the modes and resolve the pulse (at least 16 steps within t_d)",
            format!(
                "{} steps of {:.2} µs; the paper's model {} of {:.1} µs",
                ours.pulse.contact_steps,
                1e6 * ours.pulse.time_step,
                paper.pulse.contact_steps,
                1e6 * paper.pulse.time_step
            ),
            ours.pulse.contact_steps >= 16 && paper.pulse.contact_steps >= 16,
        ),
        Claim::new(
            "the stress follows the force: it ends with the contact (the peak lies before t_d)",
            format!(
                "peak at {:.2} t_d; in the paper's model at {:.2} t_d",
                ours_peak.0 / duration,
                paper_peak.0 / paper.pulse.duration
            ),
            ours_peak.0 <= duration && paper_peak.0 <= paper.pulse.duration,
        ),
    ];
    let mut table = Table::new(["model", "t_d", "Δt", "steps in t_d", "peak tension", "at"]);
    for ((name, _), (wave, peak)) in models()
        .iter()
        .zip(waves.iter().zip([paper_peak, ours_peak]))
    {
        table.row([
            (*name).into(),
            format!("{:.0} µs", 1e6 * wave.pulse.duration),
            format!("{:.2} µs", 1e6 * wave.pulse.time_step),
            wave.pulse.contact_steps.to_string(),
            format!("{:.0} MPa", 1e-6 * peak.1),
            format!("{:.0} µs", 1e6 * peak.0),
        ]);
    }
    Ok(Findings {
        picture: Picture {
            image,
            caption: "maps of the tension at six instants, and the peak against time".into(),
        },
        text,
        claims,
        tables: vec![table],
    })
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
fn curve(wave: &Wave, faces: &Faces) -> Vec<(f64, f64)> {
    let steps = wave.motion.steps();
    let last = wave.step_at(1.6 * wave.pulse.duration).min(steps - 1);
    let mut curve = vec![(0.0, 0.0)];
    for i in 1..=SAMPLES {
        let step = (last * i / SAMPLES).max(1);
        let most = wave.tensions(faces, step).into_iter().fold(0.0, f32::max);
        curve.push(((step + 1) as f64 * wave.pulse.time_step, f64::from(most)));
    }
    curve
}

fn time_chart(waves: &[Wave; 2], curves: &[Vec<(f64, f64)>; 2]) -> Chart {
    let highest = curves[1].iter().map(|p| p.1).fold(0.0, f64::max);
    let mut series: Vec<Series> = Vec::new();
    for ((name, _), ((wave, curve), marker)) in models()
        .iter()
        .zip(waves.iter().zip(curves).zip([Marker::Square, Marker::Disc]))
    {
        series.push(Series {
            name: format!(
                "peak tension, {name} (t_d {:.2} ms)",
                1e3 * wave.pulse.duration
            ),
            points: curve
                .iter()
                .map(|(t, s)| (t / wave.pulse.duration, 1e-6 * s))
                .collect(),
            marker,
            line: true,
        });
    }
    series.push(Series {
        name: "force, to scale with the highest tension".into(),
        points: (0..=24)
            .map(|i| {
                let t = f64::from(i) / 24.0;
                (t, 1e-6 * highest * (std::f64::consts::PI * t).sin())
            })
            .collect(),
        marker: Marker::Diamond,
        line: true,
    });
    Chart {
        title: "largest tension on the slab".into(),
        x: Axis::linear("time over the contact duration t_d"),
        y: Axis::linear("tension, MPa").including(1.35e-6 * highest),
        series,
    }
}

fn maps(
    faces: &Faces,
    instants: &[(f64, Vec<f32>)],
    duration: f64,
) -> Result<image::RgbImage, FigureError> {
    let all = instants.iter().flat_map(|(_, tensions)| tensions);
    let most = all.copied().fold(f32::MIN_POSITIVE, f32::max);
    // The root shows parts far from the hit, too.
    let cells: Vec<ModeCell> = instants
        .iter()
        .map(|(time, tensions)| ModeCell {
            positions: faces.points.clone(),
            triangles: faces.triangles.clone(),
            values: tensions.iter().map(|s| (s / most).sqrt()).collect(),
            caption: format!("{:.2} t_d", time / duration),
            note: format!(
                "{:.0} µs, at most {:.0} MPa",
                1e6 * time,
                1e-6 * tensions.iter().copied().fold(0.0, f32::max)
            ),
        })
        .collect();
    let options = ModeSheetOptions {
        cell_width: 330,
        cell_height: 270,
        columns: 3,
        look_from: Vec3::new(0.15, -0.75, -1.0),
        up: Vec3::Y,
        legend: vec![format!(
            "Tension on the far face; colour: root of its share of {:.0} MPa",
            1e-6 * most
        )],
    };
    Ok(mode_sheet(&cells, &options)?.into())
}
