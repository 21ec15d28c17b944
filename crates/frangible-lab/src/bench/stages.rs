//! Single stages on a small body, for counting instructions.

use std::hint::black_box;

use frangible::glam::Vec3;
use frangible::internals::contact::{Load, Pulse, contact_duration, modal_load, pulse};
use frangible::internals::modal::{Motion, respond};
use frangible::internals::stress::{
    DisplacementBatch, Elasticity, largest_eigenvalue, largest_eigenvalue_bound,
};
use frangible::internals::{LookedAt, StageTimings};
use frangible::{
    Asset, Body, Breakable, Contact, FractureConfig, Material, Outcome, impact, would_break,
};
use frangible_bake::{BakeSpec, MeshSize, Shape, bake};

use crate::Result;
use crate::bench::subjects::steel_ball;

/// Speed of the ball for each [`Depth`], m/s.
const SPEEDS: [f64; 4] = [0.05, 1.0, 3.0, 15.0];

/// Steps of [`Bench::displacements`].
pub const STEPS: usize = 64;

/// Stage that a blow is meant to reach.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Depth {
    /// Refused by its impulse alone.
    Impulse,
    /// Refused by the amplitudes of the modes, or by clusters.
    Amplitudes,
    /// Stresses are computed, nothing breaks.
    Stresses,
    /// The body breaks.
    Break,
}

/// Bakes the small body: a pane of glass 300 × 200 × 6 mm, about 5 000 tetrahedra and 40 modes. No two sides are alike, so
/// that no two modes are of one frequency and a last bit decides nothing.
///
/// # Errors
/// None to be expected.
pub fn small_body() -> Result<Asset> {
    let shape = Shape::plate(0.3, 0.2, 0.006);
    let spec = BakeSpec {
        modes: 40,
        analysis: Some(MeshSize {
            edge: 0.025,
            layers: 1,
        }),
        fracture: Some(MeshSize {
            edge: 0.009,
            layers: 1,
        }),
        ..BakeSpec::new("pane", shape, Material::preset("glass")?)
    };
    Ok(bake(&spec)?)
}

/// The small body ready to be hit.
#[derive(Clone, Debug)]
pub struct Bench {
    /// The body.
    pub body: Body,
    /// Our model.
    pub ours: FractureConfig,
    /// The paper's.
    pub paper: FractureConfig,
    /// A blow for each [`Depth`].
    blows: [Contact; 4],
    load: Load,
    pulse: Pulse,
    motion: Motion,
}

impl Bench {
    /// Stages measured on the baked [`small_body`].
    ///
    /// # Errors
    /// An asset that the run time refuses.
    pub fn new(asset: Asset) -> Result<Self> {
        let body = Breakable::uniform(asset)?.body(1);
        let ours = FractureConfig::with_given_impulses();
        let paper = FractureConfig::as_in_the_paper();
        let hit = |speed: f64| {
            let at = Vec3::new(0.04, 0.02, 0.003);
            Ok::<_, crate::Error>(Contact::collision(
                body.asset(),
                at,
                Vec3::NEG_Z,
                speed,
                steel_ball(0.05)?,
            ))
        };
        let blows = [
            hit(SPEEDS[0])?,
            hit(SPEEDS[1])?,
            hit(SPEEDS[2])?,
            hit(SPEEDS[3])?,
        ];
        let load = modal_load(&body, &blows[3..]);
        let asset = body.asset();
        let duration = contact_duration(asset, &load, ours.duration);
        let pulse = pulse(asset, &load, duration, &ours);
        let motion = respond(asset.modes(), asset.material(), &load.modal_impulse, &pulse);
        Ok(Self {
            body,
            ours,
            paper,
            blows,
            load,
            pulse,
            motion,
        })
    }

    /// Checks that each blow reaches its stage.
    ///
    /// # Errors
    /// The first that does not: its speed wants to be chosen anew.
    pub fn check(&self) -> Result<()> {
        use Depth::{Amplitudes, Break, Impulse, Stresses};
        for depth in [Impulse, Amplitudes, Stresses, Break] {
            let outcome = impact(&self.body, &[self.blow(depth)], &self.ours)?;
            let came_to = match (&outcome, outcome.report().looked_at) {
                (Outcome::Broke(_), _) => Break,
                (_, LookedAt::Sizes | LookedAt::Impulses) => Impulse,
                (_, LookedAt::Amplitudes) => Amplitudes,
                _ => Stresses,
            };
            if came_to != depth {
                return Err(crate::Error::from(format!(
                    "the blow for {depth:?} came to {came_to:?}; change its speed in stages.rs"
                )));
            }
        }
        Ok(())
    }

    /// The blow that comes to this.
    #[must_use]
    pub fn blow(&self, depth: Depth) -> Contact {
        self.blows[depth as usize].clone()
    }

    /// The response of all modes to the blow that breaks.
    #[must_use]
    pub fn response(&self) -> Motion {
        let asset = self.body.asset();
        respond(
            asset.modes(),
            asset.material(),
            &self.load.modal_impulse,
            &self.pulse,
        )
    }

    /// u = Φ q at the first [`STEPS`] steps.
    pub fn displacements(&self) {
        let asset = self.body.asset();
        let mut batch = DisplacementBatch::new(asset);
        for step in 0..self.motion.steps().min(STEPS) {
            batch.seek(&self.motion, step);
            batch.fill(asset);
            black_box(&batch);
        }
    }

    /// Displacements of the middle step, for [`Bench::stresses`].
    #[must_use]
    pub fn middle(&self) -> (DisplacementBatch, usize) {
        let step = self.motion.steps() / 2;
        let mut batch = DisplacementBatch::new(self.body.asset());
        batch.seek(&self.motion, step);
        batch.fill(self.body.asset());
        (batch, step)
    }

    /// The largest principal tension at the weak elements at one step, Pa.
    #[must_use]
    pub fn stresses(&self, (batch, step): &mut (DisplacementBatch, usize)) -> f32 {
        let asset = self.body.asset();
        let elasticity = Elasticity::new(asset.material());
        let mut peak = 0.0_f32;
        for &e in self.body.weak_tets() {
            let gradient = batch.gradient(asset, &asset.embedding().tets[e as usize], *step);
            let stress = elasticity.state(gradient).stress;
            if largest_eigenvalue_bound(&stress) > peak {
                peak = peak.max(largest_eigenvalue(&stress));
            }
        }
        peak
    }

    /// Returns true if a blow breaks the body, in our model.
    #[must_use]
    pub fn asked(&self, depth: Depth) -> bool {
        would_break(&self.body, &[self.blow(depth)], &self.ours).unwrap_or_default()
    }

    /// The blow that breaks, fragments and all; times of its stages.
    #[must_use]
    pub fn broken(&self, config: &FractureConfig) -> StageTimings {
        let outcome = impact(&self.body, &[self.blow(Depth::Break)], config);
        outcome.map_or_else(|_| StageTimings::default(), |o| o.report().timings)
    }
}
