//! Masses of the pieces of plates and solids.

use std::sync::Arc;

use frangible::glam::{DVec3, Vec3};
use frangible::{Contact, FractureConfig, Material, Outcome, Striker, impact};
use frangible_bake::frangible_mesh::DistanceSolid;
use frangible_bake::{BakeSpec, Shape, SolidShape};
use rayon::prelude::*;
use serde::Serialize;

use super::blow::Projectile;
use super::bodies::breakable;
use super::fit::CutOffLaw;
use crate::Result;

/// Smallest piece that counts, in the crumb limit of the default model: at the limit itself small pieces have joined their
/// neighbours.
pub(crate) const LEAST: f64 = 2.0;

/// Plan of the computation.
#[derive(Clone, Debug, Serialize)]
pub struct MassPlan {
    /// Bodies of each kind, seeds 1 and up.
    pub seeds: u64,
    /// Tetrahedra of the fracture mesh.
    pub tets: usize,
    /// Vibration modes.
    pub modes: usize,
}

impl MassPlan {
    /// The plan of the published page.
    #[must_use]
    pub const fn full() -> Self {
        Self {
            seeds: 100,
            tets: 25_000,
            modes: 50,
        }
    }

    /// A few bodies on a coarse mesh: to see that everything runs.
    #[must_use]
    pub const fn tiny() -> Self {
        Self {
            seeds: 3,
            tets: 2_000,
            modes: 12,
        }
    }
}

/// A kind of body, broken many times.
#[derive(Clone, Debug, Serialize)]
pub struct MassRun {
    /// One word.
    pub name: &'static str,
    /// Masses of the pieces of each body that broke, in masses of the body, the largest first.
    pub masses: Vec<Vec<f64>>,
    /// Bodies that were hit, and that broke.
    pub hit: u64,
    /// See [`Self::hit`].
    pub broke: usize,
    /// Number of pieces of the bodies that broke, the median.
    pub pieces: f64,
    /// Share of the largest piece, the median.
    pub largest: f64,
    /// Law of all pieces but the largest of each body.
    pub law: Option<CutOffLaw>,
    /// Published exponents τ of such bodies.
    pub published: &'static [f64],
}

/// Åström et al. 2004: cracks that branch and merge in D dimensions, τ = (2D − 1)/D with D = 2 and 3.
const ASTROM: [f64; 2] = [1.5, 5.0 / 3.0];
/// Linna, Åström and Timonen 2005: a plate that breaks in space.
const LINNA: f64 = 1.17;

/// Results for masses.
#[derive(Clone, Debug, Serialize)]
pub struct Masses {
    /// Plan of the computation.
    pub plan: MassPlan,
    /// A plate and a solid.
    pub runs: Vec<MassRun>,
}

impl Masses {
    /// Breaks all bodies, side by side.
    ///
    /// # Errors
    /// An error of the bake or of the impact.
    pub fn compute(plan: MassPlan) -> Result<Self> {
        let runs = vec![pane(&plan)?, ball(&plan)?];
        Ok(Self { plan, runs })
    }
}

/// The pane of the built-in scene `pane`, free, hit in its middle by its ball.
fn pane(plan: &MassPlan) -> Result<MassRun> {
    const SIDE: f64 = 0.4;
    const THICKNESS: f64 = 4e-3;
    const SPEED: f64 = 20.0;
    let (glass, steel) = (Material::preset("glass")?, Material::preset("steel")?);
    let striker = Projectile {
        mass: 0.13,
        radius: 0.0158,
    };
    let contact = striker.contact(&steel, THICKNESS, SPEED);
    let shape = Shape::plate(SIDE, SIDE, THICKNESS);
    let spec = BakeSpec {
        fracture: Some(shape.size_for(plan.tets as f64)?),
        analysis: Some(shape.size_for(1500.0)?),
        modes: plan.modes,
        ..BakeSpec::new("plate", shape, glass)
    };
    run("plate", &spec, contact, plan, &[ASTROM[0], LINNA])
}

/// A ball of glass thrown on stone.
fn ball(plan: &MassPlan) -> Result<MassRun> {
    const RADIUS: f64 = 0.05;
    const SPEED: f64 = 30.0;
    let (glass, stone) = (Material::preset("glass")?, Material::preset("stone")?);
    let mass = glass.density * 4.0 / 3.0 * std::f64::consts::PI * RADIUS.powi(3);
    let striker = Striker::fixed(&stone);
    let impulse = mass * SPEED;
    let lowest = Vec3::new(0.0, 0.0, -(RADIUS as f32));
    let contact = Contact {
        impulse: impulse as f32,
        ..Contact::strike(lowest, Vec3::Z, SPEED as f32, striker)
    };
    let shape = SolidShape {
        tets: plan.tets,
        ..SolidShape::new(Arc::new(DistanceSolid::sphere(DVec3::ZERO, RADIUS)))
    };
    let spec = BakeSpec {
        modes: plan.modes,
        ..BakeSpec::new("solid", Shape::Solid(shape), glass)
    };
    run("solid", &spec, contact, plan, &[ASTROM[1]])
}

fn run(
    name: &'static str,
    spec: &BakeSpec,
    contact: Contact,
    plan: &MassPlan,
    published: &'static [f64],
) -> Result<MassRun> {
    let breakable = breakable(spec)?;
    let config = FractureConfig::default();
    let whole = breakable.asset().mass().volume;
    let hit = |seed: u64| {
        let outcome = impact(
            &breakable.body(seed),
            std::slice::from_ref(&contact),
            &config,
        )?;
        let share = |f: &frangible::Fragment| f.mass.volume / whole;
        Ok(match outcome {
            Outcome::Broke(fracture) => fracture.fragments.iter().map(share).collect(),
            _ => Vec::new(),
        })
    };
    let masses: Result<Vec<Vec<f64>>> = (1..=plan.seeds).into_par_iter().map(hit).collect();
    let masses: Vec<Vec<f64>> = masses?.into_iter().filter(|m| !m.is_empty()).collect();
    // The largest piece is what the others leave: it follows no law of its own.
    let small: Vec<Vec<f64>> = masses.iter().map(|m| m[1..].to_vec()).collect();
    Ok(MassRun {
        name,
        broke: masses.len(),
        pieces: median(masses.iter().map(|m| m.len() as f64).collect()),
        largest: median(masses.iter().map(|m| m[0]).collect()),
        law: CutOffLaw::fit(&small, LEAST * config.crumb_share),
        masses,
        hit: plan.seeds,
        published,
    })
}

/// The middle of some numbers; of none, zero.
fn median(mut numbers: Vec<f64>) -> f64 {
    numbers.sort_by(f64::total_cmp);
    let at = |i: usize| numbers.get(i).copied().unwrap_or(0.0);
    0.5 * (at(numbers.len().saturating_sub(1) / 2) + at(numbers.len() / 2))
}
