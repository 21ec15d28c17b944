//! Masses of the pieces of plates and solids.

use std::sync::Arc;

use frangible::glam::{DVec3, Vec3};
use frangible::{Contact, FractureConfig, Outcome, Striker, impact};
use frangible_bake::frangible_mesh::DistanceSolid;
use frangible_bake::{BakeSpec, Shape, SolidShape};
use rayon::prelude::*;

use super::blow::Projectile;
use super::bodies::{breakable, preset};
use super::fit::CutOffLaw;
use super::progress::{Counter, Hear};
use crate::verify::VerifyError;

/// Smallest piece that counts, in the crumb limit of the default model: at the limit itself small pieces have joined their
/// neighbours.
pub(crate) const LEAST: f64 = 2.0;

/// Plan of the computation.
#[derive(Clone, Debug)]
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
#[derive(Clone, Debug)]
pub struct MassRun {
    /// One word.
    pub name: &'static str,
    /// Description of the body and its break, Markdown.
    pub about: String,
    /// Masses of the pieces of each body that broke, in masses of the body, the largest first.
    pub masses: Vec<Vec<f64>>,
    /// Bodies that were hit.
    pub hit: u64,
    /// Law of all pieces but the largest of each body.
    pub law: Option<CutOffLaw>,
    /// Published exponents of such bodies.
    pub published: &'static [Published],
}

/// A published exponent.
#[derive(Clone, Copy, Debug)]
pub struct Published {
    /// τ.
    pub exponent: f64,
    /// Source of the exponent.
    pub source: &'static str,
}

const ASTROM_2: Published = Published {
    exponent: 1.5,
    source: "cracks that branch and merge in the plane, τ = (2D − 1)/D with D = 2 (Åström et al. 2004)",
};
const LINNA: Published = Published {
    exponent: 1.17,
    source: "a plate that breaks in space, computed (Linna, Åström and Timonen 2005)",
};
const ASTROM_3: Published = Published {
    exponent: 5.0 / 3.0,
    source: "cracks that branch and merge in space, τ = (2D − 1)/D with D = 3 (Åström et al. 2004)",
};

/// Results for masses.
#[derive(Clone, Debug)]
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
    pub fn compute(plan: MassPlan, hear: Hear<'_>) -> Result<Self, VerifyError> {
        let counter = Counter::new(2 * plan.seeds as usize, hear);
        let runs = vec![pane(&plan, &counter)?, ball(&plan, &counter)?];
        Ok(Self { plan, runs })
    }
}

/// The pane of the built-in scene `pane`, free, hit in its middle by its ball.
fn pane(plan: &MassPlan, counter: &Counter<'_>) -> Result<MassRun, VerifyError> {
    const SIDE: f64 = 0.4;
    const THICKNESS: f64 = 4e-3;
    const SPEED: f64 = 20.0;
    let (glass, steel) = (preset("glass")?, preset("steel")?);
    let striker = Projectile {
        mass: 0.13,
        radius: 0.0158,
    };
    let contact = striker.contact(&steel, THICKNESS, SPEED);
    let shape = Shape::plate(SIDE, SIDE, THICKNESS);
    let spec = BakeSpec {
        fracture: Some(wrong("plate", shape.size_for(plan.tets as f64))?),
        analysis: Some(wrong("plate", shape.size_for(1500.0))?),
        modes: plan.modes,
        ..BakeSpec::new("plate", shape, glass)
    };
    let about = format!(
        "a free pane of glass, {:.0} × {:.0} × {:.0} mm, hit in its middle by a steel ball of {:.0} g at {SPEED} m/s",
        1e3 * SIDE,
        1e3 * SIDE,
        1e3 * THICKNESS,
        1e3 * striker.mass
    );
    run(
        "plate",
        about,
        &spec,
        contact,
        plan,
        counter,
        &[ASTROM_2, LINNA],
    )
}

/// A ball of glass thrown on stone.
fn ball(plan: &MassPlan, counter: &Counter<'_>) -> Result<MassRun, VerifyError> {
    const RADIUS: f64 = 0.05;
    const SPEED: f64 = 30.0;
    let (glass, stone) = (preset("glass")?, preset("stone")?);
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
    let about = format!(
        "a solid ball of glass, {:.0} mm wide, thrown on a stone floor at {SPEED} m/s",
        2e3 * RADIUS
    );
    run("solid", about, &spec, contact, plan, counter, &[ASTROM_3])
}

fn wrong<T>(
    case: &'static str,
    result: Result<T, frangible_bake::BakeError>,
) -> Result<T, VerifyError> {
    result.map_err(|source| VerifyError::Bake { case, source })
}

fn run(
    name: &'static str,
    about: String,
    spec: &BakeSpec,
    contact: Contact,
    plan: &MassPlan,
    counter: &Counter<'_>,
    published: &'static [Published],
) -> Result<MassRun, VerifyError> {
    let breakable = breakable(name, spec)?;
    let config = FractureConfig::default();
    let whole = breakable.asset().mass().volume;
    let hit = |seed: u64| {
        let outcome = impact(
            &breakable.body(seed),
            std::slice::from_ref(&contact),
            &config,
        )
        .map_err(|source| VerifyError::Impact { case: name, source })?;
        counter.count();
        let share = |f: &frangible::Fragment| f.mass.volume / whole;
        Ok(match outcome {
            Outcome::Broke(fracture) => fracture.fragments.iter().map(share).collect(),
            _ => Vec::new(),
        })
    };
    let masses: Result<Vec<Vec<f64>>, VerifyError> =
        (1..=plan.seeds).into_par_iter().map(hit).collect();
    let masses: Vec<Vec<f64>> = masses?.into_iter().filter(|m| !m.is_empty()).collect();
    // The largest piece is what the others leave: it follows no law of its own.
    let small: Vec<Vec<f64>> = masses.iter().map(|m| m[1..].to_vec()).collect();
    Ok(MassRun {
        name,
        about,
        law: CutOffLaw::fit(&small, LEAST * config.crumb_share),
        masses,
        hit: plan.seeds,
        published,
    })
}
