//! Radial cracks of a thin plate that a small steel projectile hits: how many, at which speed.

use std::f64::consts::PI;
use std::sync::Arc;

use frangible::internals::{CrackTiming, Fields, impact_traced};
use frangible::{Breakable, FractureConfig, Material};
use frangible_bake::{BakeSpec, MeshSize, Region, Shape, Support, bake};
use rayon::prelude::*;

use super::blow::Projectile;
use super::fit::PowerLaw;
use super::pattern::CrackPattern;
use super::progress::{Counter, Hear};
use crate::verify::VerifyError;

/// Name in errors.
const NAME: &str = "star";
/// Side of the square plate, m.
pub(crate) const SIDE: f64 = 0.1;
/// The thickness that is compared with the measured counts, m.
pub(crate) const MEASURED_THICKNESS: f64 = 1e-3;
/// Circle on which cracks are counted, m: ten thicknesses of the plate whose counts are published.
pub(crate) const RADII: [f64; 1] = [0.01];
/// Lengths are summed between these distances from the middle, m: outside the crushed zone, off the clamped edge.
pub(crate) const RING: [f64; 2] = [0.005, 0.045];
/// Height of the plane on which cracks are looked at, in thicknesses above the middle: no layer of nodes lies there.
const SECTION: f64 = 0.13;
/// Width of the projectile, m.
pub(crate) const WIDTH: f64 = 4e-3;
/// Length of the projectile, m. Reports of the experiment call it a cylinder, one a bullet-shaped one, and give its width alone;
/// bullets are two to four times as long as wide, and both ends of that range are among the variants.
pub(crate) const LENGTH: f64 = 3.0 * WIDTH;
/// Density of steel, kg/m³.
const STEEL_DENSITY: f64 = 7800.0;

/// What to compute.
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

/// The default model, or how a computation differs from it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Variant {
    pub(crate) name: &'static str,
    instant: bool,
    green_lagrange: bool,
    strength: f64,
    weak_points: f64,
    branching: bool,
    scatter: bool,
    /// What hits the plate.
    shape: Shot,
}

/// The shape of a projectile.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Shot {
    /// A ball.
    Ball,
    /// A cylinder with half a ball as its nose, of this length, m.
    Bullet(f64),
}

const DEFAULT: Variant = Variant {
    name: "default",
    instant: false,
    green_lagrange: false,
    strength: 1.0,
    weak_points: 1.0,
    branching: true,
    scatter: true,
    shape: Shot::Bullet(LENGTH),
};

const VARIANTS: [Variant; 10] = [
    Variant {
        name: "cracks at once, no release (`CrackTiming::Instant`)",
        instant: true,
        ..DEFAULT
    },
    Variant {
        name: "cracks do not fork (`branching`)",
        branching: false,
        ..DEFAULT
    },
    Variant {
        name: "every weak point as strong as the others, R_c",
        scatter: false,
        ..DEFAULT
    },
    Variant {
        name: "Green and Lagrange's strain of the linear modes (`green_lagrange`, the paper's)",
        green_lagrange: true,
        ..DEFAULT
    },
    Variant {
        name: "strength × 1.3, what a sphere's impact was found to need more than a slow test",
        strength: 1.3,
        ..DEFAULT
    },
    Variant {
        name: "strength ÷ 1.5",
        strength: 1.0 / 1.5,
        ..DEFAULT
    },
    Variant {
        name: "weak points × 4",
        weak_points: 4.0,
        ..DEFAULT
    },
    Variant {
        name: "projectile 8 mm long (0.72 g)",
        shape: Shot::Bullet(2.0 * WIDTH),
        ..DEFAULT
    },
    Variant {
        name: "projectile 16 mm long (1.50 g)",
        shape: Shot::Bullet(4.0 * WIDTH),
        ..DEFAULT
    },
    Variant {
        name: "a ball (0.26 g)",
        shape: Shot::Ball,
        ..DEFAULT
    },
];

/// One plate and what the projectile did to it.
#[derive(Clone, Debug)]
pub struct StarImpact {
    /// Speed of the projectile, m/s.
    pub speed: f64,
    /// Seed of the plate.
    pub seed: u64,
    /// Radial cracks: the median over the circles.
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
    /// How it differs from the default model.
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

/// Everything that was computed of stars.
#[derive(Clone, Debug)]
pub struct Stars {
    /// What was to be computed.
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
    /// Mean counts, speed after speed.
    #[must_use]
    pub fn counts(&self) -> Vec<Count> {
        let at_one_speed = |a: &StarImpact, b: &StarImpact| a.speed == b.speed;
        self.impacts.chunk_by(at_one_speed).map(count).collect()
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

impl Shot {
    fn projectile(self) -> Projectile {
        let radius = 0.5 * WIDTH;
        let ball = 4.0 / 3.0 * PI * radius.powi(3);
        let volume = match self {
            Self::Ball => ball,
            Self::Bullet(length) => 0.5 * ball + PI * radius.powi(2) * (length - radius),
        };
        Projectile {
            mass: STEEL_DENSITY * volume,
            radius,
        }
    }
}

/// What hits the plate, unless a variant says otherwise.
pub(crate) fn projectile() -> Projectile {
    DEFAULT.shape.projectile()
}

impl Stars {
    /// Computes all plates, side by side.
    ///
    /// # Errors
    /// What the bake or the impact refused.
    pub fn compute(plan: StarPlan, hear: Hear<'_>) -> Result<Self, VerifyError> {
        let steel = preset("steel")?;
        let pmma = preset("pmma")?;
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
            let run = |variant: Variant, speeds: &[f64]| {
                let plate = changed(&baked, variant)?;
                let projectile = variant.shape.projectile();
                let blows: Vec<(f64, u64)> = speeds
                    .iter()
                    .flat_map(|&v| (1..=plan.seeds).map(move |seed| (v, seed)))
                    .collect();
                let hit = |&(speed, seed): &(f64, u64)| {
                    let contact = projectile.contact(&steel, thickness, speed);
                    let hit = strike(&plate, &plan, thickness, contact, variant, seed);
                    counter.count();
                    hit
                };
                let impacts: Result<Vec<StarImpact>, VerifyError> =
                    blows.par_iter().map(hit).collect();
                Ok::<_, VerifyError>(StarRun::new(thickness, variant.name, impacts?))
            };
            runs.push(run(DEFAULT, &plan.speeds)?);
            if thickness == MEASURED_THICKNESS && others > 0 {
                for variant in VARIANTS {
                    variants.push(run(variant, &plan.variant_speeds)?);
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
}

pub(crate) fn preset(name: &'static str) -> Result<Material, VerifyError> {
    Material::preset(name).map_err(|source| VerifyError::Material { name, source })
}

/// A square plate of this side and thickness, m, clamped on its four sides.
pub(crate) fn clamped(
    side: f64,
    thickness: f64,
    material: Material,
    [analysis, fracture]: [f64; 2],
    modes: usize,
) -> BakeSpec {
    let sides = [0, 1].into_iter().flat_map(|axis| {
        [Region::below(axis, 0.0), Region::above(axis, side)].map(Support::clamped)
    });
    let size = |edge, layers| Some(MeshSize { edge, layers });
    BakeSpec {
        analysis: size(analysis, 1),
        fracture: size(fracture, 0),
        modes,
        supports: sides.collect(),
        ..BakeSpec::new(NAME, Shape::plate(side, side, thickness), material)
    }
}

/// A plate clamped all round.
fn plate(plan: &StarPlan, thickness: f64, material: Material) -> Result<Breakable, VerifyError> {
    let edges = [plan.analysis_edge, plan.edge];
    let spec = clamped(SIDE, thickness, material, edges, plan.modes);
    breakable(NAME, &spec)
}

/// The plate of another strength or with more weak points: neither matters to its modes.
fn changed(plate: &Breakable, variant: Variant) -> Result<Breakable, VerifyError> {
    let mut asset = (**plate.asset()).clone();
    asset.material.strength *= variant.strength;
    asset.material.weak_point_density *= variant.weak_points;
    let fields = if variant.scatter {
        Fields::of_material(&asset.material)
    } else {
        Fields::default()
    };
    Breakable::new(asset)
        .and_then(|plate| plate.with_fields(fields))
        .map_err(|source| VerifyError::Impact { case: NAME, source })
}

pub(crate) fn breakable(case: &'static str, spec: &BakeSpec) -> Result<Breakable, VerifyError> {
    let (asset, _) =
        bake(spec, &mut |_| {}).map_err(|source| VerifyError::Bake { case, source })?;
    let fields = Fields::of_material(&asset.material);
    Breakable::new(Arc::new(asset))
        .and_then(|body| body.with_fields(fields))
        .map_err(|source| VerifyError::Impact { case, source })
}

fn strike(
    plate: &Breakable,
    plan: &StarPlan,
    thickness: f64,
    contact: frangible::Contact,
    variant: Variant,
    seed: u64,
) -> Result<StarImpact, VerifyError> {
    let mut config = FractureConfig::default();
    config.green_lagrange = variant.green_lagrange;
    config.branching = variant.branching;
    if variant.instant {
        config.timing = CrackTiming::Instant;
    }
    let (_, trace) = impact_traced(&plate.body(seed), std::slice::from_ref(&contact), &config)
        .map_err(|source| VerifyError::Impact { case: NAME, source })?;
    let pattern = CrackPattern::of(plate.asset(), &trace, SECTION * thickness);
    Ok(StarImpact {
        speed: f64::from(contact.approach_speed),
        seed,
        radial: pattern.radial_cracks(&RADII, plan.edge),
        lengths: pattern.lengths(RING[0], RING[1]),
        pattern,
    })
}
