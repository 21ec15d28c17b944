//! Radial cracks of a thin plate that a small steel projectile hits: their number as a function of the speed.

use frangible::internals::impact_traced;
use frangible::{Breakable, Contact, FractureConfig, Material};
use rayon::prelude::*;
use serde::Serialize;
use serde_json::{Value, json};

use super::bodies::{breakable, clamped};
use super::fit::PowerLaw;
use super::pattern::CrackPattern;
use super::variants::{DEFAULT, VARIANTS, Variant};
use crate::Result;

/// Side of the square plate, m.
const SIDE: f64 = 0.1;
/// The thickness that is compared with the measured counts, m.
const MEASURED_THICKNESS: f64 = 1e-3;
/// Radius of the circle on which cracks are counted, m: ten thicknesses of the plate whose counts are published.
const RADIUS: f64 = 0.01;
/// Radii of the circles that are compared with each other, m: from among the rings of a hard blow to where arms end.
const CIRCLES: [f64; 4] = [RADIUS, 0.02, 0.03, 0.04];
/// Lengths are summed between these distances from the middle, m: outside the crushed zone, off the clamped edge.
const RING: [f64; 2] = [0.005, 0.045];
/// Height of the plane on which cracks are counted, in thicknesses above the middle: no layer of nodes lies there.
const SECTION: f64 = 0.13;

/// 1 mm PMMA: mean counts at 70 and 280 km/h, m/s and cracks (A. Grant, Science News, 26 April 2013).
const MEASURED: [(f64, f64); 2] = [(70.0 / 3.6, 4.0), (280.0 / 3.6, 8.0)];

/// Plan of the computation.
#[derive(Clone, Debug, Serialize)]
pub struct StarPlan {
    /// Thicknesses of the plates, m.
    #[serde(rename = "thicknesses_m")]
    pub thicknesses: Vec<f64>,
    /// Speeds of the projectile, m/s.
    #[serde(rename = "speeds_m_s")]
    pub speeds: Vec<f64>,
    /// Plates per speed, seeds 1 and up.
    pub seeds: u64,
    /// Speeds at which the variants are computed, of `speeds`; none leaves the variants out.
    #[serde(rename = "variant_speeds_m_s")]
    pub variant_speeds: Vec<f64>,
    /// Edge of the fracture mesh, m.
    #[serde(rename = "edge_m")]
    pub edge: f64,
    /// Edge of the analysis mesh, m.
    #[serde(rename = "analysis_edge_m")]
    pub analysis_edge: f64,
    /// Vibration modes.
    pub modes: usize,
}

/// One plate and the projectile's effect on it.
#[derive(Clone, Debug)]
pub struct StarImpact {
    /// Speed of the projectile, m/s.
    pub speed: f64,
    /// Seed of the plate.
    pub seed: u64,
    /// Radial cracks that cross the circle on which they are counted.
    pub radial: f64,
    /// Length of radial and of all cracks, m.
    pub lengths: [f64; 2],
    /// The cracks.
    pub pattern: CrackPattern,
}

/// Plates of one thickness, computed one way.
#[derive(Clone, Debug)]
pub struct StarRun {
    /// Thickness of the plates, m.
    pub thickness: f64,
    /// Difference from the default model.
    pub variant: &'static str,
    /// The impacts, ordered by speed and then by seed.
    pub impacts: Vec<StarImpact>,
    /// N = k v^p through the mean counts of the speeds at which the plates have at least one radial crack on average.
    pub law: Option<PowerLaw>,
}

/// Mean count at a speed.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Count {
    /// Speed of the projectile, m/s.
    #[serde(rename = "speed_m_s")]
    pub speed: f64,
    /// Mean over the seeds.
    pub mean: f64,
    /// Standard error of the mean.
    pub error: f64,
}

/// Results for stars.
#[derive(Clone, Debug)]
pub struct Stars {
    /// Plan of the computation.
    pub plan: StarPlan,
    /// The default model, one run per thickness.
    pub runs: Vec<StarRun>,
    /// The measured thickness, computed in other ways.
    pub variants: Vec<StarRun>,
}

impl StarPlan {
    /// The plan of the published page.
    #[must_use]
    pub fn full() -> Self {
        Self {
            thicknesses: vec![0.5e-3, MEASURED_THICKNESS, 3e-3],
            speeds: vec![10.0, 14.0, 20.0, 28.0, 40.0, 56.0, 80.0, 113.0],
            seeds: 16,
            variant_speeds: vec![20.0, 40.0, 56.0, 80.0],
            edge: 1e-3,
            analysis_edge: SIDE / 16.0,
            modes: 100,
        }
    }

    /// Two speeds and one seed on a coarse mesh: to see that everything runs.
    #[must_use]
    pub fn tiny() -> Self {
        Self {
            thicknesses: vec![MEASURED_THICKNESS],
            speeds: vec![40.0, 113.0],
            seeds: 1,
            variant_speeds: vec![113.0],
            edge: 5e-3,
            analysis_edge: SIDE / 8.0,
            modes: 20,
        }
    }
}

impl StarRun {
    fn new(thickness: f64, variant: &'static str, impacts: Vec<StarImpact>) -> Self {
        let mut run = Self {
            thickness,
            variant,
            impacts,
            law: None,
        };
        let points: Vec<(f64, f64)> = run
            .counts()
            .iter()
            .filter(|c| c.mean >= 1.0)
            .map(|c| (c.speed, c.mean))
            .collect();
        run.law = PowerLaw::fit(&points);
        run
    }

    /// Mean counts, speed after speed.
    #[must_use]
    pub fn counts(&self) -> Vec<Count> {
        let at_one_speed = |a: &StarImpact, b: &StarImpact| a.speed == b.speed;
        self.impacts.chunk_by(at_one_speed).map(count).collect()
    }

    /// These plates with their radial cracks counted on a circle of this radius, m; `gap` as for [`CrackPattern::crossings`].
    fn counted_at(&self, radius: f64, gap: f64) -> Self {
        let again = |impact: &StarImpact| StarImpact {
            radial: impact.pattern.crossings(radius, gap) as f64,
            ..impact.clone()
        };
        let impacts = self.impacts.iter().map(again).collect();
        Self::new(self.thickness, self.variant, impacts)
    }

    /// Share of the cracks' length that runs within 45° of the radius, of all plates together; `None` without cracks.
    #[must_use]
    pub fn radial_share(&self) -> Option<f64> {
        let sum = |i: usize| self.impacts.iter().map(|m| m.lengths[i]).sum::<f64>();
        (sum(1) > 0.0).then(|| sum(0) / sum(1))
    }
}

fn count(impacts: &[StarImpact]) -> Count {
    let n = impacts.len() as f64;
    let mean = impacts.iter().map(|m| m.radial).sum::<f64>() / n;
    let scatter: f64 = impacts.iter().map(|m| (m.radial - mean).powi(2)).sum();
    Count {
        speed: impacts[0].speed,
        mean,
        error: if n > 1.0 {
            (scatter / (n - 1.0) / n).sqrt()
        } else {
            0.0
        },
    }
}

impl Stars {
    /// Computes all plates, side by side.
    ///
    /// # Errors
    /// An error of the bake or of the impact.
    pub fn compute(plan: StarPlan) -> Result<Self> {
        let steel = Material::preset("steel")?;
        let (pmma, glass) = (Material::preset("pmma")?, Material::preset("glass")?);
        let (mut runs, mut variants) = (Vec::new(), Vec::new());
        for &thickness in &plan.thicknesses {
            let baked = plate(&plan, thickness, pmma.clone())?;
            let run = |variant: Variant, baked: &Breakable, speeds: &[f64]| {
                let plate = variant.applied_to(baked, &glass)?;
                let (projectile, config) = (variant.projectile(), variant.config());
                let blows: Vec<(f64, u64)> = speeds
                    .iter()
                    .flat_map(|&v| (1..=plan.seeds).map(move |seed| (v, seed)))
                    .collect();
                let hit = |&(speed, seed): &(f64, u64)| {
                    let contact = projectile.contact(&steel, thickness, speed);
                    strike(&plate, &plan, thickness, contact, &config, seed)
                };
                let impacts: Result<Vec<StarImpact>> = blows.par_iter().map(hit).collect();
                Ok::<_, crate::Error>(StarRun::new(thickness, variant.name, impacts?))
            };
            runs.push(run(DEFAULT, &baked, &plan.speeds)?);
            if thickness == MEASURED_THICKNESS && !plan.variant_speeds.is_empty() {
                for variant in VARIANTS {
                    let own = variant.material(&pmma).map(|m| plate(&plan, thickness, m));
                    let own = own.transpose()?;
                    let baked = own.as_ref().unwrap_or(&baked);
                    variants.push(run(variant, baked, &plan.variant_speeds)?);
                }
            }
        }
        Ok(Self {
            plan,
            runs,
            variants,
        })
    }

    /// The run of the default model that is compared with the measured counts.
    #[must_use]
    pub fn measured(&self) -> Option<&StarRun> {
        self.runs.iter().find(|r| r.thickness == MEASURED_THICKNESS)
    }
}

impl StarRun {
    fn data(&self) -> Value {
        json!({
            "variant": self.variant,
            "thickness_m": self.thickness,
            "counts": self.counts(),
            "law": self.law,
            "radial_share": self.radial_share(),
        })
    }

    /// Counts at the measured speeds, beside what was measured.
    fn beside_measured(&self) -> Value {
        let counts = self.counts();
        let rows = MEASURED.map(|(speed, measured)| {
            let Count { mean, error, .. } = interpolated(&counts, speed);
            json!({
                "speed_m_s": speed, "mean": mean, "error": error, "measured": measured,
                "ratio": mean / measured, "ratio_error": error / measured,
            })
        });
        json!(rows)
    }
}

impl Stars {
    /// The numbers: means for each run, the counts at other circles, and the variants.
    #[must_use]
    pub fn data(&self) -> Value {
        let plan = &self.plan;
        let counts: Vec<Vec<Count>> = self.runs.iter().map(StarRun::counts).collect();
        let at = |i: usize| counts.iter().map(|c| c[i]).collect::<Vec<_>>();
        let by_speed =
            (0..plan.speeds.len()).map(|i| json!({ "speed_m_s": plan.speeds[i], "runs": at(i) }));
        let mut data = json!({
            "plan": plan,
            "runs": self.runs.iter().map(StarRun::data).collect::<Vec<_>>(),
            "by_speed": by_speed.collect::<Vec<_>>(),
        });
        let Some(default) = self.measured() else {
            return data;
        };
        let circle = |radius: f64| {
            let run = default.counted_at(radius, plan.edge);
            let mut row = run.data();
            row["radius_m"] = json!(radius);
            row["beside_measured"] = run.beside_measured();
            row
        };
        data["beside_measured"] = default.beside_measured();
        data["circles"] = json!(CIRCLES.map(circle));
        let of_variants = |m: &&StarImpact| plan.variant_speeds.contains(&m.speed);
        let impacts = default.impacts.iter().filter(of_variants).cloned();
        let same_speeds = StarRun::new(default.thickness, default.variant, impacts.collect());
        let variants: Vec<&StarRun> = std::iter::once(&same_speeds)
            .chain(&self.variants)
            .collect();
        data["variants"] = json!(variants.iter().map(|run| run.data()).collect::<Vec<_>>());
        data
    }

    /// The cracks of the first plates, mm, of the default model and the first variant: megabytes, only for the picture.
    #[must_use]
    pub fn patterns(&self) -> Value {
        let lines = |run: &StarRun, speed: f64| {
            let impacts = run.impacts.iter();
            let mut first = impacts.filter(|m| m.speed == speed && m.seed == 1);
            let lines = first.next().map(|m| m.pattern.millimetres());
            json!({ "variant": run.variant, "speed_m_s": speed, "lines_mm": lines })
        };
        let drawn = self.measured().into_iter().chain(self.variants.first());
        let speeds = &self.plan.variant_speeds;
        let drawn = drawn.flat_map(|run| speeds.iter().map(|&speed| lines(run, speed)));
        drawn.collect()
    }
}

/// The count at a speed between two computed ones, linear in its logarithm; at the ends, theirs.
fn interpolated(counts: &[Count], speed: f64) -> Count {
    let after = counts.iter().position(|c| c.speed >= speed);
    let after = after.unwrap_or(counts.len() - 1).max(1);
    let (a, b) = (counts[after - 1], counts[after]);
    let share = ((speed / a.speed).ln() / (b.speed / a.speed).ln()).clamp(0.0, 1.0);
    Count {
        speed,
        mean: a.mean + share * (b.mean - a.mean),
        error: ((1.0 - share) * a.error).hypot(share * b.error),
    }
}

/// A plate clamped all round.
fn plate(plan: &StarPlan, thickness: f64, material: Material) -> Result<Breakable> {
    let edges = [plan.analysis_edge, plan.edge];
    let spec = clamped(SIDE, thickness, material, edges, plan.modes);
    breakable(&spec)
}

fn strike(
    plate: &Breakable,
    plan: &StarPlan,
    thickness: f64,
    contact: Contact,
    config: &FractureConfig,
    seed: u64,
) -> Result<StarImpact> {
    let (_, trace) = impact_traced(&plate.body(seed), std::slice::from_ref(&contact), config)?;
    let pattern = CrackPattern::of(plate.asset(), &trace, SECTION * thickness);
    Ok(StarImpact {
        speed: f64::from(contact.approach_speed),
        seed,
        radial: pattern.crossings(RADIUS, plan.edge) as f64,
        lengths: pattern.lengths(RING[0], RING[1]),
        pattern,
    })
}
