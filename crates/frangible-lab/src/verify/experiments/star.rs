//! Radial cracks of a thin plate that a small steel projectile hits: their number as a function of the speed.

use frangible::internals::impact_traced;
use frangible::{Breakable, Contact, FractureConfig, InputError, Material};
use rayon::prelude::*;

use super::bodies::{breakable, clamped, preset};
use super::fit::PowerLaw;
use super::pattern::CrackPattern;
use super::progress::{Counter, Hear};
use super::variants::{DEFAULT, VARIANTS, Variant};
use crate::verify::VerifyError;

/// Name in errors.
const NAME: &str = "star";
/// Side of the square plate, m.
pub(crate) const SIDE: f64 = 0.1;
/// The thickness that is compared with the measured counts, m.
pub(crate) const MEASURED_THICKNESS: f64 = 1e-3;
/// Radius of the circle on which cracks are counted, m: ten thicknesses of the plate whose counts are published.
pub(crate) const RADIUS: f64 = 0.01;
/// Radii of the circles that are compared with each other, m: from among the rings of a hard blow to where arms end.
pub(crate) const CIRCLES: [f64; 4] = [RADIUS, 0.02, 0.03, 0.04];
/// Lengths are summed between these distances from the middle, m: outside the crushed zone, off the clamped edge.
pub(crate) const RING: [f64; 2] = [0.005, 0.045];
/// Height of the plane on which cracks are counted, in thicknesses above the middle: no layer of nodes lies there.
const SECTION: f64 = 0.13;

/// Plan of the computation.
#[derive(Clone, Debug)]
pub struct StarPlan {
    /// Thicknesses of the plates, m.
    pub thicknesses: Vec<f64>,
    /// Speeds of the projectile, m/s.
    pub speeds: Vec<f64>,
    /// Plates per speed, seeds 1 and up.
    pub seeds: u64,
    /// Speeds at which the variants are computed, of `speeds`; none leaves the variants out.
    pub variant_speeds: Vec<f64>,
    /// Edge of the fracture mesh, m.
    pub edge: f64,
    /// Edge of the analysis mesh, m.
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
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Count {
    /// Speed of the projectile, m/s.
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
    pub(crate) fn new(thickness: f64, variant: &'static str, impacts: Vec<StarImpact>) -> Self {
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
    #[must_use]
    pub(crate) fn counted_at(&self, radius: f64, gap: f64) -> Self {
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
    pub fn compute(plan: StarPlan, hear: Hear<'_>) -> Result<Self, VerifyError> {
        let steel = preset("steel")?;
        let (pmma, glass) = (preset("pmma")?, preset("glass")?);
        let others = if plan.variant_speeds.is_empty() {
            0
        } else {
            VARIANTS.len()
        };
        let plates =
            plan.thicknesses.len() * plan.speeds.len() + others * plan.variant_speeds.len();
        let counter = Counter::new(plates * plan.seeds as usize, hear);
        let (mut runs, mut variants) = (Vec::new(), Vec::new());
        for &thickness in &plan.thicknesses {
            let baked = plate(&plan, thickness, pmma.clone())?;
            let run = |variant: Variant, baked: &Breakable, speeds: &[f64]| {
                let plate = variant.applied_to(baked, &glass).map_err(refused)?;
                let (projectile, config) = (variant.projectile(), variant.config());
                let blows: Vec<(f64, u64)> = speeds
                    .iter()
                    .flat_map(|&v| (1..=plan.seeds).map(move |seed| (v, seed)))
                    .collect();
                let hit = |&(speed, seed): &(f64, u64)| {
                    let contact = projectile.contact(&steel, thickness, speed);
                    let hit = strike(&plate, &plan, thickness, contact, &config, seed);
                    counter.count();
                    hit
                };
                let impacts: Result<Vec<StarImpact>, VerifyError> =
                    blows.par_iter().map(hit).collect();
                Ok::<_, VerifyError>(StarRun::new(thickness, variant.name, impacts?))
            };
            runs.push(run(DEFAULT, &baked, &plan.speeds)?);
            if thickness == MEASURED_THICKNESS && others > 0 {
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

/// A plate clamped all round.
fn plate(plan: &StarPlan, thickness: f64, material: Material) -> Result<Breakable, VerifyError> {
    let edges = [plan.analysis_edge, plan.edge];
    let spec = clamped(SIDE, thickness, material, edges, plan.modes);
    breakable(NAME, &spec)
}

fn strike(
    plate: &Breakable,
    plan: &StarPlan,
    thickness: f64,
    contact: Contact,
    config: &FractureConfig,
    seed: u64,
) -> Result<StarImpact, VerifyError> {
    let (_, trace) = impact_traced(&plate.body(seed), std::slice::from_ref(&contact), config)
        .map_err(refused)?;
    let pattern = CrackPattern::of(plate.asset(), &trace, SECTION * thickness);
    Ok(StarImpact {
        speed: f64::from(contact.approach_speed),
        seed,
        radial: pattern.crossings(RADIUS, plan.edge) as f64,
        lengths: pattern.lengths(RING[0], RING[1]),
        pattern,
    })
}

fn refused(source: InputError) -> VerifyError {
    VerifyError::Impact { case: NAME, source }
}
