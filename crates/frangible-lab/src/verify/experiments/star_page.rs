//! Part of the page on the radial cracks.

use std::fmt::Write;

use super::page::{Figure, apart, per_cent, with_error};
use super::star::{CIRCLES, Count, RADIUS, RING, SIDE, StarRun, Stars};
use super::variants::{DEFAULT, LENGTH, WIDTH};
use crate::page::table;
use crate::plot::{Axis, Chart, Marker, Panel, Panels, Series};

/// Published exponent of the speed.
const EXPONENT: f64 = 0.5;
/// 1 mm PMMA: mean counts at 70 and 280 km/h; single plates photographed. m/s and cracks.
const MEANS: [(f64, f64); 2] = [(70.0 / 3.6, 4.0), (280.0 / 3.6, 8.0)];
const PHOTOGRAPHS: [(f64, f64); 2] = [(22.2, 4.0), (56.7, 8.0)];

fn millimetres(thickness: f64) -> String {
    format!("{} mm", 1e3 * thickness)
}

pub(crate) fn figures(stars: &Stars) -> Vec<Figure> {
    let mut figures = Vec::new();
    for run in &stars.runs {
        if let Some(law) = run.law {
            figures.push(Figure {
                name: format!(
                    "star, {}: exponent p of the speed",
                    millimetres(run.thickness)
                ),
                value: law.exponent,
                error: law.exponent_error,
                published: Some(EXPONENT),
            });
        }
    }
    for (run, speed, measured) in compared(stars) {
        let count = interpolated(&run.counts(), speed);
        figures.push(Figure {
            name: format!(
                "star, {}: cracks at {speed:.1} m/s",
                millimetres(run.thickness)
            ),
            value: count.mean,
            error: count.error,
            published: Some(measured),
        });
    }
    for run in stars.measured().into_iter().chain(&stars.variants) {
        if let Some(share) = run.radial_share() {
            figures.push(Figure {
                name: format!(
                    "star, 1 mm, {}: radial share of the crack length",
                    run.variant
                ),
                value: share,
                error: 0.0,
                published: None,
            });
        }
    }
    figures
}

/// The run and each measured mean.
fn compared(stars: &Stars) -> impl Iterator<Item = (&StarRun, f64, f64)> {
    let run = stars.measured().into_iter();
    run.flat_map(|run| MEANS.map(|(speed, cracks)| (run, speed, cracks)))
}

/// The count at a speed between two computed ones, linear in its logarithm; at the ends, theirs.
fn interpolated(counts: &[Count], speed: f64) -> Count {
    let none = Count {
        speed,
        mean: 0.0,
        error: 0.0,
    };
    let after = counts.iter().position(|c| c.speed >= speed);
    match after {
        None => counts.last().map_or(none, |c| Count { speed, ..*c }),
        Some(0) => Count { speed, ..counts[0] },
        Some(i) => {
            let (a, b) = (counts[i - 1], counts[i]);
            let share = (speed / a.speed).ln() / (b.speed / a.speed).ln();
            Count {
                speed,
                mean: a.mean + share * (b.mean - a.mean),
                error: ((1.0 - share) * a.error).hypot(share * b.error),
            }
        }
    }
}

pub(crate) fn text(stars: &Stars, folder: &str) -> String {
    let mut text = String::from("## Star cracks in a thin plate\n\n");
    text += &set_up(stars);
    text += "\n\n";
    text += &counts(stars);
    let _ = write!(
        text,
        "\n![Radial cracks against speed]({folder}/star-law.png)\n\nMean number of radial cracks against the speed of the projectile, with \
         what was measured on 1 mm plates.\n\n"
    );
    text += &outcome(stars);
    text += circles(stars).trim_end();
    if !stars.variants.is_empty() {
        let _ = write!(
            text,
            "\n\n### Star or rings\n\n{}\n\n![Crack patterns]({folder}/star-patterns.png)\n\nCracks of the 1 mm plate, seed 1, on a plane \
             just above its middle, with the circle on which they are counted. Above: the default model. Below: cracks at once.\n\n\
             ### What the count depends on\n\n{}",
            star_or_rings(stars),
            variants(stars)
        );
    }
    text + REFERENCES
}

const REFERENCES: &str = "\nReferences: the law N ∝ √speed and the experiment: N. Vandenberghe, R. Vermorel, E. Villermaux, Phys. Rev. Lett. 110, \
    174302 (2013), read in its abstract; mean counts on 1 mm plates, four at 70 km/h and eight at 280 km/h: A. Grant, Science News, 26 April \
    2013; four cracks at 22.2 m/s and eight at 56.7 m/s in photographs: Physics 6, 48 (2013); the projectile: Nature 497, 160 (2013), and New \
    Scientist, 2 May 2013.\n";

fn set_up(stars: &Stars) -> String {
    let plan = &stars.plan;
    format!(
        "A square plate of acrylic glass, {side:.0} × {side:.0} mm, clamped on its four sides, is hit in its middle by a steel \
         cylinder with a round nose, {width} mm wide and {length} mm long ({mass:.2} g). Material: the preset `pmma`; model: `FractureConfig::default()`. Mesh: {edge} mm elements, {modes} modes. \
         Plates per speed: {seeds}, which differ in their weak points.\n\n\
         *Nothing was fitted to the experiment.* What goes in are published properties of the material, some by way of a formula (where a crack forks, and \
         what pressure the contact withstands: the source text of the preset has both), and two numbers of the model that no \
         handbook gives: the density of weak points and the depth γ that feeds a crack. What comes out, the number \
         of cracks and its law, is a prediction.\n\n\
         *The blow* is integrated against the plate: projectile, Hertz' spring, modes, and the near field of the contact, whose wall oscillators \
         carry the energy away. When a star has cut the plate under the projectile, the force falls.\n\n\
         *Counting.* The cracks are cut by a plane parallel to the faces, just above the middle: one straight piece per tetrahedron. A crack \
         counts where a piece that runs within 45° of the radius crosses a circle about the impact; places less than one element apart on the \
         circle are one. The circle has {radius:.0} mm radius. Per speed the mean over the plates. A plate that holds has none.\n\n\
         *The experiment* fired steel projectiles 4 mm wide at plates of glass and acrylic glass. Two reports call them cylinders, one of these \
         bullet-shaped; none gives their length or mass, or tells how the plates were held. Bullets are two to four times as long as wide: here \
         it is three times, and the last rows of the last table are of twice, four times, and a ball.",
        side = 1e3 * SIDE,
        width = 1e3 * WIDTH,
        length = 1e3 * LENGTH,
        mass = 1e3 * DEFAULT.projectile().mass,
        edge = 1e3 * plan.edge,
        modes = plan.modes,
        seeds = plan.seeds,
        radius = 1e3 * RADIUS,
    )
}

fn counts(stars: &Stars) -> String {
    let mut head = vec!["speed (m/s)".to_string()];
    head.extend(stars.runs.iter().map(|r| millimetres(r.thickness)));
    let by_run: Vec<Vec<Count>> = stars.runs.iter().map(StarRun::counts).collect();
    let rows: Vec<Vec<String>> = stars
        .plan
        .speeds
        .iter()
        .enumerate()
        .map(|(i, speed)| {
            let cell =
                |counts: &Vec<Count>| format!("{:.1} ± {:.1}", counts[i].mean, counts[i].error);
            std::iter::once(speed.to_string())
                .chain(by_run.iter().map(cell))
                .collect()
        })
        .collect();
    format!(
        "Radial cracks, mean over the plates:\n\n{}",
        table(&head, &rows)
    )
}

fn outcome(stars: &Stars) -> String {
    let mut text = String::from(
        "Fit of N = k v^p by least squares of the logarithms, to the speeds at which a plate has one radial crack or more on average; \
         published: p = 1/2.\n\n",
    );
    for run in &stars.runs {
        let what = millimetres(run.thickness);
        let _ = match run.law {
            Some(law) => writeln!(
                text,
                "- {what}: p = {}, {} 1/2 ({} speeds), k = {:.2}.",
                with_error(law.exponent, law.exponent_error),
                apart(law.exponent, law.exponent_error, EXPONENT),
                law.points,
                law.factor
            ),
            None => writeln!(
                text,
                "- {what}: fewer than three speeds with a crack, no fit."
            ),
        };
    }
    for (run, speed, measured) in compared(stars) {
        let count = interpolated(&run.counts(), speed);
        let _ = writeln!(
            text,
            "- {} at {speed:.1} m/s: {:.1} ± {:.1} cracks, measured {measured}: {:.2} times as many.",
            millimetres(run.thickness),
            count.mean,
            count.error,
            count.mean / measured
        );
    }
    let holds = |run: &StarRun| {
        let counts = run.counts();
        let first = counts.iter().find(|c| c.mean >= 1.0)?;
        Some(format!(
            "{} from {} m/s",
            millimetres(run.thickness),
            first.speed
        ))
    };
    let first: Vec<String> = stars.runs.iter().filter_map(holds).collect();
    if first.is_empty() {
        text += "\nNo plate cracks at any of these speeds.";
    } else {
        let _ = write!(text, "\nRadial cracks appear: {}.", first.join(", "));
    }
    text
}

/// The exponent of the speed with its error, or a dash where too few speeds have cracks.
fn exponent(run: &StarRun) -> String {
    let law = run.law;
    law.map_or_else(|| "–".into(), |l| with_error(l.exponent, l.exponent_error))
}

/// Table of the counts at other circles.
fn circles(stars: &Stars) -> String {
    let Some(run) = stars.measured() else {
        return String::new();
    };
    let mut head = vec!["1 mm plate, circle of".to_string()];
    head.extend(stars.plan.speeds.iter().map(|v| format!("{v} m/s")));
    head.push("p".into());
    head.extend(MEANS.map(|(speed, cracks)| format!("{speed:.1} m/s, to {cracks}")));
    let row = |radius: f64| {
        let run = run.counted_at(radius, stars.plan.edge);
        let counts = run.counts();
        let mut cells = vec![millimetres(radius)];
        cells.extend(counts.iter().map(|c| format!("{:.1}", c.mean)));
        cells.push(exponent(&run));
        cells.extend(MEANS.map(|(speed, cracks)| {
            let count = interpolated(&counts, speed);
            format!("{:.2} ± {:.2}", count.mean / cracks, count.error / cracks)
        }));
        cells
    };
    format!(
        "\n\n### Where they are counted\n\nThe reports of the experiment do not say at what distance its cracks were counted. The first circle lies among the rings and the short \
         cracks of a hard blow, the last ones beyond the ends of some arms. The last two columns are how many times as many there are as were measured.\n\n{}",
        table(&head, &CIRCLES.map(row))
    )
}

fn star_or_rings(stars: &Stars) -> String {
    let speeds: Vec<String> = stars
        .plan
        .variant_speeds
        .iter()
        .map(f64::to_string)
        .collect();
    let share = stars
        .measured()
        .and_then(|run| at_variant_speeds(stars, run).radial_share());
    let instant = stars.variants.first().and_then(StarRun::radial_share);
    let verdict = match (share, instant) {
        (Some(default), Some(instant)) => verdict(default, instant),
        _ => String::new(),
    };
    format!(
        "Share of the crack length between {:.0} and {:.0} mm from the impact that runs within 45° of the radius; a star has 100 %, rings 0, lines \
         without a preference 50 %. The 1 mm plate at {} m/s: default model {}, the paper's cracks, which run at once and do not \
         feel each other (`Model::Paper`), {}.{verdict}",
        1e3 * RING[0],
        1e3 * RING[1],
        speeds.join(", "),
        per_cent(share),
        per_cent(instant),
    )
}

/// A sentence on the meaning of the radial shares of the default model and of cracks at once.
fn verdict(default: f64, instant: f64) -> String {
    // Name of one of them, and of both where they are alike.
    let like = |share: f64| match share {
        s if s > 0.6 => ["a star more than rings", "stars more than rings"],
        s if s < 0.4 => ["rings more than a star", "rings more than stars"],
        _ => [
            "neither star nor rings",
            "something between stars and rings",
        ],
    };
    let ([default, both], [instant, _]) = (like(default), like(instant));
    if default == instant {
        format!(" Both are {both}.")
    } else {
        format!(" That is {default}, against {instant}.")
    }
}

/// The run without the speeds that the variants leave out.
fn at_variant_speeds(stars: &Stars, run: &StarRun) -> StarRun {
    let kept = |speed: f64| stars.plan.variant_speeds.contains(&speed);
    let impacts = run
        .impacts
        .iter()
        .filter(|m| kept(m.speed))
        .cloned()
        .collect();
    StarRun::new(run.thickness, run.variant, impacts)
}

fn variants(stars: &Stars) -> String {
    let speeds = &stars.plan.variant_speeds;
    let mut head = vec!["1 mm plate".to_string()];
    head.extend(speeds.iter().map(|v| format!("{v} m/s")));
    head.extend(["p".into(), "radial share".into()]);
    let default = stars.measured().map(|run| at_variant_speeds(stars, run));
    let row = |run: &StarRun| {
        let mut cells = vec![run.variant.to_string()];
        cells.extend(
            run.counts()
                .iter()
                .map(|c| format!("{:.1} ± {:.1}", c.mean, c.error)),
        );
        cells.push(exponent(run));
        cells.push(per_cent(run.radial_share()));
        cells
    };
    let rows: Vec<Vec<String>> = default.iter().chain(&stars.variants).map(row).collect();
    format!(
        "The same plate with one thing changed at a time; p from these speeds alone, where three have a crack or more. To understand, not to \
         choose by: the default stays what the material's numbers make it.\n\n{}",
        table(&head, &rows)
    )
}

pub(crate) fn chart(stars: &Stars) -> Chart {
    let points = |run: &StarRun| run.counts().iter().map(|c| (c.speed, c.mean)).collect();
    let markers = [Marker::Square, Marker::Disc, Marker::Triangle];
    let mut series: Vec<Series> = stars
        .runs
        .iter()
        .zip(markers)
        .map(|(run, marker)| Series {
            name: format!("computed, {}", millimetres(run.thickness)),
            points: points(run),
            marker,
            line: true,
        })
        .collect();
    let measured = |name: &str, points: &[(f64, f64)]| Series {
        name: name.into(),
        points: points.to_vec(),
        marker: Marker::Diamond,
        line: false,
    };
    series.push(measured("measured, 1 mm, means", &MEANS));
    series.push(Series {
        name: "speed to the power 1/2".into(),
        points: [10.0, 113.0]
            .map(|v: f64| (v, MEANS[0].1 * (v / MEANS[0].0).powf(EXPONENT)))
            .into(),
        marker: Marker::Nothing,
        line: true,
    });
    series.push(measured("measured, 1 mm, photographs", &PHOTOGRAPHS));
    Chart {
        title: "Radial cracks of a PMMA plate hit by a steel bullet 4 mm wide".into(),
        x: Axis::log("speed of the projectile (m/s)"),
        y: Axis::log("radial cracks"),
        series,
    }
}

pub(crate) fn patterns(stars: &Stars) -> Panels {
    let speeds = &stars.plan.variant_speeds;
    let rows = [
        ("default", stars.measured()),
        ("at once", stars.variants.first()),
    ];
    let mut panels = Vec::new();
    for (name, run) in rows {
        for &speed in speeds {
            let impacts = run.map_or(&[][..], |r| &r.impacts);
            let lines = impacts.iter().find(|m| m.speed == speed && m.seed == 1);
            let pieces = lines.map_or(&[][..], |m| &m.pattern.pieces);
            panels.push(Panel {
                label: format!("{name}, {speed} m/s"),
                half: 0.5 * SIDE,
                lines: pieces.iter().map(|p| p.map(|v| v.to_array())).collect(),
                circles: vec![RADIUS],
            });
        }
    }
    Panels {
        title: "Cracks of a 1 mm PMMA plate".into(),
        columns: speeds.len().max(1),
        panels,
    }
}
