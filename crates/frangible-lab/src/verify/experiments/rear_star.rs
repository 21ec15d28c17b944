//! Plates of window glass that a very small ball hits: which of them crack from the rear face.
//!
//! Ball and McKenzie fired a hardened steel ball of 3 mm at circular plates of float glass, 3 to 12 mm thick and clamped at a radius of
//! 65 mm, at 10 to 50 m/s. They saw rings and cones about the contact, crushed zones, median, radial and lateral cracks, *and in some
//! cases star cracks from the rear face* (A. Ball, H. W. McKenzie, J. Phys. IV 4 (1994) C8-783, read in its abstract, which gives no counts).
//! The model has the last of these: in a wall cracks stand upright and start at flaws, and none starts under the contact itself.

use std::f64::consts::PI;

use frangible::internals::impact_traced;
use frangible::{FractureConfig, Material};
use rayon::prelude::*;
use serde::Serialize;

use super::blow::{Projectile, STEEL_DENSITY};
use super::bodies::{breakable, clamped};
use super::pattern::CrackPattern;
use crate::Result;

/// Radius of the clamp in the experiment, m. Waves do not come back from it before the ball has left: a square of the same area serves.
const CLAMP: f64 = 0.065;
/// Diameter of the ball, m.
const BALL: f64 = 3e-3;
/// Circle on which arms are counted, m.
const RADIUS: f64 = 6e-3;

/// Plan of the computation.
#[derive(Clone, Debug, Serialize)]
pub struct RearStarPlan {
    /// Thicknesses of the plates, m.
    #[serde(rename = "thicknesses_m")]
    pub thicknesses: Vec<f64>,
    /// Speeds of the ball, m/s.
    #[serde(rename = "speeds_m_s")]
    pub speeds: Vec<f64>,
    /// Plates per thickness and speed, seeds 1 and up.
    pub seeds: u64,
    /// Edge of the fracture mesh, m.
    #[serde(rename = "edge_m")]
    pub edge: f64,
    /// Edge of the analysis mesh, m.
    #[serde(rename = "analysis_edge_m")]
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
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct RearStar {
    /// Thickness of the plates, m.
    pub thickness_m: f64,
    /// Speed of the ball, m/s.
    pub speed_m_s: f64,
    /// Share of the plates that cracked.
    pub cracked: f64,
    /// Arms of those that cracked, the mean.
    pub arms: f64,
    /// Largest force of the blow, N.
    pub force_n: f64,
    /// Largest tension that a weak point of any of the plates met, Pa.
    pub tension_pa: f64,
}

/// Results for rear stars.
#[derive(Clone, Debug, Serialize)]
pub struct RearStars {
    /// Plan of the computation.
    pub plan: RearStarPlan,
    /// Results for each thickness, and in it for each speed.
    pub results: Vec<Vec<RearStar>>,
}

fn side() -> f64 {
    CLAMP * PI.sqrt()
}

impl RearStars {
    /// Computes all plates, side by side.
    ///
    /// # Errors
    /// An error of the bake or of the impact.
    pub fn compute(plan: RearStarPlan) -> Result<Self> {
        let (steel, glass) = (Material::preset("steel")?, Material::preset("glass")?);
        let ball = Projectile {
            mass: STEEL_DENSITY * PI / 6.0 * BALL.powi(3),
            radius: 0.5 * BALL,
        };
        let mut config = FractureConfig::default();
        // Without bounds every weak point is looked at, so that the largest tension is known; the cracks are the same.
        config.culling = false;
        let mut results = Vec::new();
        for &thickness in &plan.thicknesses {
            let edges = [plan.analysis_edge, plan.edge];
            let spec = clamped(side(), thickness, glass.clone(), edges, plan.modes);
            let plate = breakable(&spec)?;
            let mut at_speeds = Vec::new();
            for &speed in &plan.speeds {
                let contact = ball.contact(&steel, thickness, speed);
                let strike = |seed: u64| {
                    let (outcome, trace) =
                        impact_traced(&plate.body(seed), std::slice::from_ref(&contact), &config)?;
                    // Just under the middle: a star from the rear face goes through it.
                    let pattern = CrackPattern::of(plate.asset(), &trace, -0.13 * thickness);
                    let report = outcome.report();
                    let arms = pattern.crossings(RADIUS, plan.edge) as f64;
                    let force = report.contacts.first().map_or(0.0, |c| c.peak_force);
                    Ok((report.cracks > 0, arms, force, report.peak_stress))
                };
                let struck: Result<Vec<_>> = (1..=plan.seeds).into_par_iter().map(strike).collect();
                let struck = struck?;
                let cracked = struck.iter().filter(|s| s.0).count() as f64;
                let plates = struck.len().max(1) as f64;
                at_speeds.push(RearStar {
                    thickness_m: thickness,
                    speed_m_s: speed,
                    cracked: cracked / plates,
                    arms: struck.iter().map(|s| s.1).sum::<f64>() / cracked.max(1.0),
                    force_n: struck.iter().map(|s| s.2).fold(0.0, f64::max),
                    tension_pa: struck.iter().map(|s| s.3).fold(0.0, f64::max),
                });
            }
            results.push(at_speeds);
        }
        Ok(Self { plan, results })
    }
}
