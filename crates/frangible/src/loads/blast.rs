//! Blast load: a pressure pulse on the surface from a distant explosion.

use glam::Vec3;

use crate::asset::{Asset, each_row};
use crate::body::Body;
use crate::config::FractureConfig;
use crate::contact::{self, Load, pulse_lasts};
use crate::cracking::{Cracking, Moves};
use crate::error::{InputError, finite, positive};
use crate::impact::pieces;
use crate::mesh::SurfacePoint;
use crate::motion::{self, Residual};
use crate::outcome::{ImpactReport, LookedAt, Outcome};

/// A pressure pulse that spreads from a point.
///
/// Its impulse per area decays as 1/distance, like that of an explosion at moderate distance. It acts along the normal of surfaces
/// that face the point, reduced by the cosine of the angle of incidence.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Blast {
    /// Centre of the explosion, m, body frame.
    pub origin: Vec3,
    /// Impulse per area at 1 m, Pa·s. One kilogram of TNT gives about 200 Pa·s.
    pub impulse: f32,
    /// Duration of the half-sine pulse, s. One kilogram of TNT at a few metres gives about 2 ms.
    pub duration: f32,
}

/// Least distance at which a part of the surface counts, m: a pressure does not grow without end.
const NEAREST: f32 = 0.01;

/// Computes the outcome of a blast on a body. The pulse acts on the whole facing surface at once.
///
/// # Errors
/// A value is not finite, or the impulse or duration is not positive; the errors of [`FractureConfig::validate`].
pub fn blast(body: &Body, blast: &Blast, config: &FractureConfig) -> Result<Outcome, InputError> {
    finite("a blast's origin", blast.origin)?;
    positive(
        "a blast's impulse per area",
        f64::from(blast.impulse),
        "Pa·s",
    )?;
    positive("a blast's duration", f64::from(blast.duration), "s")?;
    pulse_lasts("a blast's duration (s)", blast.duration)?;
    config.validate()?;
    let asset = &*body.asset;
    let load = Load {
        touches: Vec::new(),
        modal_impulse: modal_impulse(asset, blast),
    };
    let pulse = contact::pulse(asset, &load, f64::from(blast.duration), config);
    let followed = asset.modes.followed();
    let (swing, still) = load.modal_impulse.split_at(followed);
    let mut motion = motion::respond(&asset.modes, &asset.material, swing, &pulse);
    if config.residual {
        // The modes left out follow the half-sine of unit impulse.
        let force = (1..=pulse.contact_steps).map(|step| {
            let t = step as f64 * pulse.time_step;
            (pulse.amplitude * libm::sin(pulse.frequency() * t)) as f32
        });
        let residual = Residual::shape(asset, still).map(|shape| Residual {
            shape,
            force: force.collect(),
        });
        motion.complement.residuals.extend(residual);
    }
    let mut report = ImpactReport::of(body);
    report.looked_at = LookedAt::Amplitudes;
    report.contact_duration = pulse.duration;
    report.unadjusted_duration = pulse.duration;
    report.time_step = pulse.time_step;
    report.time_steps = motion.steps();
    let cracked = Cracking {
        body,
        config,
        budget: motion.peak_strain_energy,
        moves: Moves::Given(motion),
        // A blast presses everywhere, far below any strength.
        pressed: Vec::new(),
        time_step: pulse.time_step,
    }
    .run(0, report, &mut None);
    Ok(pieces(body, cracked))
}

/// Impulses of the lit triangles on the nodes of the analysis mesh, N·s.
fn nodal_impulse(asset: &Asset, blast: &Blast) -> Vec<Vec3> {
    let positions = asset.surface_positions();
    let mut nodal = vec![Vec3::ZERO; asset.analysis.nodes.len()];
    for (t, triangle) in asset.surface.triangles.iter().enumerate() {
        let [a, b, c] = triangle.map(|v| positions[v as usize]);
        let area = 0.5 * (b - a).cross(c - a);
        let away = (a + b + c) / 3.0 - blast.origin;
        let distance = away.length().max(NEAREST);
        let facing = -area.dot(away) / distance;
        if facing <= 0.0 {
            continue;
        }
        let push = -area.normalize_or_zero() * (facing * blast.impulse / distance);
        let place = SurfacePoint {
            triangle: t as u32,
            weights: [1.0 / 3.0; 3],
            position: Vec3::ZERO,
        };
        each_row(asset, &place, |node, weight| nodal[node] += push * weight);
    }
    nodal
}

/// Σ over the lit triangles of φ_i · impulse: first on the nodes of the analysis mesh, then one product with the shapes.
fn modal_impulse(asset: &Asset, blast: &Blast) -> Vec<f64> {
    let nodal = nodal_impulse(asset, blast);
    let mut sums = vec![0.0; asset.modes.count()];
    for (node, push) in nodal.iter().enumerate().filter(|(_, p)| **p != Vec3::ZERO) {
        asset
            .modes
            .add_push(node, push.to_array().map(f64::from), &mut sums);
    }
    sums
}
