//! Plates of window glass that a very small ball hits: which of them crack from the rear face.
//!
//! Ball and McKenzie fired a hardened steel ball of 3 mm at circular plates of float glass, 3 to 12 mm thick and clamped at a radius of
//! 65 mm, at 10 to 50 m/s. They saw rings and cones about the contact, crushed zones, median, radial and lateral cracks, *and in some
//! cases star cracks from the rear face* (A. Ball, H. W. McKenzie, J. Phys. IV 4 (1994) C8-783, read in its abstract, which gives no counts).
//! The model has the last of these: in a wall cracks stand upright and start at flaws, and none starts under the contact itself.

use std::f64::consts::PI;
use std::fmt::Write;

use frangible::FractureConfig;
use frangible::internals::impact_traced;
use rayon::prelude::*;

use super::blow::{Projectile, STEEL_DENSITY};
use super::bodies::{breakable, clamped, preset};
use super::page::Figure;
use super::pattern::CrackPattern;
use super::progress::{Counter, Hear};
use crate::page::table;
use crate::verify::VerifyError;

/// Name in errors.
const NAME: &str = "rear star";
/// Radius of the clamp in the experiment, m. Waves do not come back from it before the ball has left: a square of the same area serves.
const CLAMP: f64 = 0.065;
/// Diameter of the ball, m.
const BALL: f64 = 3e-3;
/// Circle on which arms are counted, m.
const RADIUS: f64 = 6e-3;

/// Plan of the computation.
#[derive(Clone, Debug)]
pub struct RearStarPlan {
    /// Thicknesses of the plates, m.
    pub thicknesses: Vec<f64>,
    /// Speeds of the ball, m/s.
    pub speeds: Vec<f64>,
    /// Plates per thickness and speed, seeds 1 and up.
    pub seeds: u64,
    /// Edge of the fracture mesh, m.
    pub edge: f64,
    /// Edge of the analysis mesh, m.
    pub analysis_edge: f64,
    /// Vibration modes.
    pub modes: usize,
}

impl RearStarPlan {
    /// The plan of the published page.
    #[must_use]
    pub fn full() -> Self {
        Self {
            thicknesses: vec![3e-3, 4e-3, 6e-3, 8e-3, 12e-3],
            speeds: vec![10.0, 20.0, 30.0, 40.0, 50.0],
            seeds: 10,
            edge: 1.5e-3,
            analysis_edge: side() / 16.0,
            modes: 100,
        }
    }

    /// Two plates on a coarse mesh: to see that everything runs.
    #[must_use]
    pub fn tiny() -> Self {
        Self {
            thicknesses: vec![3e-3],
            speeds: vec![10.0, 50.0],
            seeds: 1,
            edge: 6e-3,
            analysis_edge: side() / 8.0,
            modes: 20,
        }
    }
}

/// Effect of a ball on plates of one thickness at one speed.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RearStar {
    /// Thickness of the plates, m.
    pub thickness: f64,
    /// Speed of the ball, m/s.
    pub speed: f64,
    /// Share of the plates that cracked.
    pub cracked: f64,
    /// Arms of those that cracked, the mean.
    pub arms: f64,
    /// Largest force of the blow, N.
    pub force: f64,
    /// Largest tension that a weak point of any of the plates met, Pa.
    pub tension: f64,
}

/// Results for rear stars.
#[derive(Clone, Debug)]
pub struct RearStars {
    /// Plan of the computation.
    pub plan: RearStarPlan,
    /// Results for each thickness and speed, in that order.
    pub results: Vec<RearStar>,
}

fn side() -> f64 {
    CLAMP * PI.sqrt()
}

impl RearStars {
    /// Computes all plates, side by side.
    ///
    /// # Errors
    /// An error of the bake or of the impact.
    pub fn compute(plan: RearStarPlan, hear: Hear<'_>) -> Result<Self, VerifyError> {
        let (steel, glass) = (preset("steel")?, preset("glass")?);
        let ball = Projectile {
            mass: STEEL_DENSITY * PI / 6.0 * BALL.powi(3),
            radius: 0.5 * BALL,
        };
        let blows = plan.thicknesses.len() * plan.speeds.len() * plan.seeds as usize;
        let counter = Counter::new(blows, hear);
        let mut config = FractureConfig::default();
        // Without bounds every weak point is looked at, so that the largest tension is known; the cracks are the same.
        config.culling = false;
        let mut results = Vec::new();
        for &thickness in &plan.thicknesses {
            let edges = [plan.analysis_edge, plan.edge];
            let spec = clamped(side(), thickness, glass.clone(), edges, plan.modes);
            let plate = breakable(NAME, &spec)?;
            for &speed in &plan.speeds {
                let contact = ball.contact(&steel, thickness, speed);
                let strike = |seed: u64| {
                    let (outcome, trace) =
                        impact_traced(&plate.body(seed), std::slice::from_ref(&contact), &config)
                            .map_err(|source| VerifyError::Impact { case: NAME, source })?;
                    // Just under the middle: a star from the rear face goes through it.
                    let pattern = CrackPattern::of(plate.asset(), &trace, -0.13 * thickness);
                    let report = outcome.report();
                    let arms = pattern.crossings(RADIUS, plan.edge) as f64;
                    let force = report.contacts.first().map_or(0.0, |c| c.peak_force);
                    counter.count();
                    Ok((report.cracks > 0, arms, force, report.peak_stress))
                };
                let struck: Result<Vec<_>, VerifyError> =
                    (1..=plan.seeds).into_par_iter().map(strike).collect();
                let struck = struck?;
                let cracked = struck.iter().filter(|s| s.0).count() as f64;
                let plates = struck.len().max(1) as f64;
                results.push(RearStar {
                    thickness,
                    speed,
                    cracked: cracked / plates,
                    arms: struck.iter().map(|s| s.1).sum::<f64>() / cracked.max(1.0),
                    force: struck.iter().map(|s| s.2).fold(0.0, f64::max),
                    tension: struck.iter().map(|s| s.3).fold(0.0, f64::max),
                });
            }
        }
        Ok(Self { plan, results })
    }

    fn at(&self, thickness: f64, speed: f64) -> Option<&RearStar> {
        let mut results = self.results.iter();
        results.find(|r| r.thickness == thickness && r.speed == speed)
    }
}

pub(crate) fn figures(stars: &RearStars) -> Vec<Figure> {
    let figure = |r: &RearStar| Figure {
        name: format!(
            "rear star, {} mm at {} m/s: share of plates that crack",
            1e3 * r.thickness,
            r.speed
        ),
        value: r.cracked,
        error: (r.cracked * (1.0 - r.cracked) / stars.plan.seeds as f64).sqrt(),
        published: None,
    };
    stars.results.iter().map(figure).collect()
}

pub(crate) fn text(stars: &RearStars) -> String {
    let plan = &stars.plan;
    let mut head = vec!["thickness".to_string()];
    head.extend(plan.speeds.iter().map(|v| format!("{v} m/s")));
    let cell = |r: &RearStar| match r.cracked {
        0.0 => format!("0 % ({:.0} N, {:.0} MPa)", r.force, 1e-6 * r.tension),
        share => format!(
            "{:.0} %, {:.1} arms ({:.0} N)",
            100.0 * share,
            r.arms,
            r.force
        ),
    };
    let row = |&thickness: &f64| {
        let mut cells = vec![format!("{} mm", 1e3 * thickness)];
        let at = |&speed: &f64| stars.at(thickness, speed).map_or("–".into(), cell);
        cells.extend(plan.speeds.iter().map(at));
        cells
    };
    let rows: Vec<Vec<String>> = plan.thicknesses.iter().map(row).collect();
    let mut text = format!(
        "## Star cracks from the rear face of window glass\n\n\
         Square plates of glass of {side:.0} mm side, clamped on their four sides, are hit in the middle by a steel ball 3 mm wide. Material: the preset \
         `glass` with its scatter of strength; model: `FractureConfig::default()`. Mesh: {edge} mm elements, {modes} modes; {seeds} plates each, which \
         differ in their weak points.\n\n\
         *The experiment* (Ball and McKenzie 1994) had circular plates of float glass, 3 to 12 mm thick, clamped at a radius of 65 mm, and speeds of 10 \
         to 50 m/s; no wave comes back from the clamp while the ball touches, so a square of the same area serves. It saw rings, cones and crushed glass at the \
         contact, radial, median and lateral cracks, and in some cases star cracks from the rear face; the abstract, which is what was read, gives no \
         counts.\n\n\
         *What the model can show of it* is the star from the rear face: in a wall its cracks stand upright and start from flaws, and none starts under the contact, \
         where the surface is pressed together. Rings and cones are not in it.\n\n\
         Share of the plates with cracks, arms on a circle of {radius:.0} mm in the mean of those, largest force; where all plates hold, the \
         largest tension that a weak point of any of them met.\n\n{}\n",
        table(&head, &rows),
        side = 1e3 * side(),
        edge = 1e3 * plan.edge,
        modes = plan.modes,
        seeds = plan.seeds,
        radius = 1e3 * RADIUS,
    );
    let some = stars.results.iter().filter(|r| r.cracked > 0.0).count();
    let all = stars.results.len();
    let verdict = match some {
        0 => "No plate cracks: against the experiment, where some did.",
        n if n == all => "Plates crack in every case: more than the experiment's \"some\".",
        _ => "Some plates crack and some do not, as in the experiment.",
    };
    let _ = writeln!(text, "{verdict}");
    let mut thinner = true;
    for pair in plan.thicknesses.windows(2) {
        for &speed in &plan.speeds {
            if let (Some(a), Some(b)) = (stars.at(pair[0], speed), stars.at(pair[1], speed)) {
                thinner &= a.cracked >= b.cracked;
            }
        }
    }
    let faster = stars
        .results
        .chunk_by(|a, b| a.thickness == b.thickness)
        .all(|run| run.windows(2).all(|w| w[0].cracked <= w[1].cracked));
    let faster = if faster {
        "No faster ball cracks fewer plates"
    } else {
        "Some faster balls crack fewer plates"
    };
    let thinner = if thinner {
        "no thinner plate cracks less often"
    } else {
        "some thinner plates crack less often"
    };
    let _ = writeln!(text, "{faster}, and {thinner}.");
    text
}
