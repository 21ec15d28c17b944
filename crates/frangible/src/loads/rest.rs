//! Resting contacts: quasi-static stress from the same modes `[G12 §7.3.3]`.
//!
//! A force that changes slowly against the body's vibration moves mode i to q_i = φ_i(b) · f / λ_i. The weight of a free
//! body needs no term: a force spread as the mass is lies in the span of its rigid motions, to which all modes are
//! orthogonal. A held body hangs from its supports, and its weight bends it.

use frangible_material::OutOfRange;
use glam::Vec3;

use crate::asset::each_row;
use crate::blow::SteadyNear;
use crate::body::Body;
use crate::config::FractureConfig;
use crate::cracking::{Cracked, Cracking, Moves};
use crate::error::{InputError, finite};
use crate::impact::pieces;
use crate::mesh::SurfacePoint;
use crate::motion::Motion;
use crate::outcome::{ImpactReport, LookedAt, Outcome};
use crate::refuse::{Pushes, harmless};

/// A force on the surface, body frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Force {
    /// Point of application, m; the nearest point of the surface is taken.
    pub point: Vec3,
    /// Force on this body, N.
    pub force: Vec3,
}

/// Largest elastic energy of a steady load, J, that of 200 tonnes of TNT: squares of stresses beyond leave single precision.
const MOST_ENERGY: f64 = 1e12;

/// Crack paths are followed over so many diagonals of the body: cracks that turn are longer than straight ones.
const DIAGONALS: f64 = 3.0;

/// Computes the outcome of static forces on a body: the contacts that it rests on, and the loads that rest on it.
///
/// `gravity` (m/s², body frame) is used for the weight of a supported body; it has no effect on a free body. In nearly all cases nothing
/// breaks, which takes microseconds and no allocation, so that the function can be called at every step. The energy ledger does not limit
/// the work of the load, since a weight continues to act as cracks open. The strength is reduced by static fatigue over
/// [`FractureConfig::load_duration`].
///
/// # Errors
/// A force, point or gravity that is not finite, or too large for single precision; the errors of [`FractureConfig::validate`].
pub fn rest(
    body: &Body,
    forces: &[Force],
    gravity: Vec3,
    config: &FractureConfig,
) -> Result<Outcome, InputError> {
    config.validate()?;
    finite("gravity", gravity)?;
    for force in forces {
        finite("a force's point", force.point)?;
        finite("a force", force.force)?;
    }
    let (asset, prepared) = (&*body.asset, &*body.prepared);
    let weight = |mode: usize| prepared.weight.get(mode).map_or(0.0, |w| w.dot(gravity));
    let compliance = |mode: usize| prepared.periods[mode] * prepared.periods[mode];
    let near_at = |(at, force): &(SurfacePoint, Vec3)| {
        let theory = config.near_field.filter(|_| !config.is_paper())?;
        SteadyNear::of(body, at, *force, theory)
    };
    let mut report = ImpactReport::of(body);
    let left = body
        .resistance
        .left_after(config.load_duration, report.strength);
    report.strength *= left;
    if config.culling {
        let pushes = forces.iter().map(|f| (f.point, f.force));
        let k = body.quadratic_modulus(config);
        let bound = Pushes::new(body, pushes).map(|pushes| {
            let near: f32 = pushes
                .places()
                .iter()
                .filter_map(near_at)
                .map(|n| n.bound())
                .sum();
            pushes.bound(body, k, |i, f| (f + weight(i)) * compliance(i)) + near
        });
        if let Some(bound) = bound.filter(|b| *b <= harmless(body, left)) {
            report.stress_bound = f64::from(bound);
            let margin = report.strength / f64::from(bound);
            return Ok(Outcome::Held {
                margin,
                report,
                state: None,
            });
        }
    }
    report.looked_at = LookedAt::Amplitudes;
    let tired = body.tired(config.load_duration);
    let body = tired.as_ref().unwrap_or(body);
    // The modes that a blow leaves to the residual vector serve a steady load as all others do.
    let modes = match config.residual {
        true => asset.modes.count(),
        false => asset.modes.followed(),
    };
    let mut amplitudes: Vec<f32> = (0..modes).map(weight).collect();
    let mut near: Vec<SteadyNear> = Vec::new();
    let mut pressed = Vec::with_capacity(forces.len());
    for force in forces {
        let at = prepared.surface.closest(force.point);
        pressed.push(at.triangle);
        near.extend(near_at(&(at, force.force)));
        each_row(asset, &at, |node, share| {
            let push = (force.force * share).to_array();
            asset.modes.add_push(node, push, &mut amplitudes);
        });
    }
    for (i, q) in amplitudes.iter_mut().enumerate() {
        *q *= compliance(i);
    }
    let energy = amplitudes.iter().zip(&asset.modes.eigenvalues);
    report.peak_strain_energy = energy
        .map(|(&q, l)| 0.5 * l * f64::from(q) * f64::from(q))
        .sum();
    OutOfRange::unless(
        report.peak_strain_energy <= MOST_ENERGY,
        "the elastic energy of static forces and gravity (J)",
        report.peak_strain_energy,
        "at most 1e12; give smaller forces or less gravity",
    )?;
    let (time_step, steps) = steps(body, config);
    report.time_step = time_step;
    report.time_steps = steps;
    let energy = report.peak_strain_energy;
    let run = |steps, report| {
        let mut motion = Motion::new(amplitudes.repeat(steps), modes, energy, energy);
        motion.complement.near = near.iter().map(SteadyNear::field).collect();
        Cracking {
            body,
            config,
            moves: Moves::Given(motion),
            pressed: pressed.clone(),
            time_step,
            budget: f64::INFINITY,
        }
        .run(0, report, &mut None)
    };
    if body.state().is_intact() {
        // The load does not change: where nothing starts at once, nothing ever does.
        let at_once = run(1, report.clone());
        if matches!(at_once, Cracked::Held(_, _, None)) {
            return Ok(pieces(body, at_once));
        }
    }
    Ok(pieces(body, run(steps, report)))
}

/// Time step, s, and number of steps in which a crack can cross the body: one mean edge per step.
fn steps(body: &Body, config: &FractureConfig) -> (f64, usize) {
    let Some(speed) = config.crack_speed() else {
        return (1.0, 1);
    };
    let positions = body.asset.surface_positions();
    let low = positions.iter().copied().fold(Vec3::INFINITY, Vec3::min);
    let high = positions
        .iter()
        .copied()
        .fold(Vec3::NEG_INFINITY, Vec3::max);
    let edge = f64::from(body.prepared.edge);
    let time_step = edge / (speed * body.asset.material.rayleigh_speed());
    let steps = (DIAGONALS * f64::from(low.distance(high)) / edge).ceil();
    (time_step, (steps as usize).clamp(1, 4096))
}
