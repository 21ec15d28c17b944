//! The sound of sliding and rolling.
//!
//! The roughness of both surfaces excites sliding bodies with noise, and rolling ones less, since rolling resistance dissipates less power
//! than friction. The power of the noise is a fraction of the dissipated power, and its spectrum is white up to the frequency v over the
//! grain length, above which the contact averages out the roughness. This follows the model of scraping by van den Doel, Kry and Pai
//! (FoleyAutomatic, SIGGRAPH 2001): the power of the force is proportional to that of friction, and the spectrum scales with the speed.
//! Their profile is fractal; a spectrum that is white below a cut-off is the simplest case.

use std::f64::consts::FRAC_PI_2;
use std::sync::Arc;

use frangible_recording::RecordedSlide;
use glam::Vec3;

use super::cast::Cast;
use super::nodes::Nodes;
use super::touching::drawn_share;
use crate::error::SoundError;
use crate::of_asset::HIGHEST;
use crate::pulse::SoundPulse;
use crate::strike::Strike;
use crate::synth::Synth;

/// Share of the power lost to friction in sliding, and to the resistance to rolling, which becomes vibration. The rest is
/// heat. No figure for shards on stone was found; the power goes with this number, and 1e-3 makes a shard of 20 g that slides at 1 m/s about as
/// loud as speech. One number for both, an estimate.
const FRICTION_SHARE: f64 = 1e-3;

/// Length over which the heights of a surface forget each other, m: 10 to 100 µm on ground and worn surfaces. An estimate.
const GRAIN: f64 = 5e-5;

/// Time between two values of the noise, s.
const STEP: f64 = 1.0 / 48_000.0;

/// Lets a slide be heard by both that slide.
pub(super) fn slides(
    synth: &mut Synth,
    nodes: &mut Nodes,
    cast: &dyn Cast,
    slide: &RecordedSlide,
) -> Result<(), SoundError> {
    let pulse = Arc::new(noise(slide));
    let mut sides = Vec::new();
    let (mut given, mut lowest) = (0.0, HIGHEST);
    for (node, sign) in [(Some(slide.nodes.0), 1.0), (slide.nodes.1, -1.0)] {
        let Some(node) = node else { continue };
        let (id, body) = nodes.ready(synth, cast, node, slide.time)?;
        let pose = cast.pose(node, slide.time);
        let back = pose.rotation.normalize().inverse();
        let point = back * (slide.point - pose.translation);
        let strike = Strike {
            pulse: Arc::clone(&pulse),
            push: nodes.push(node, point, back * (slide.normal * sign)),
            direction: Vec3::ZERO,
        };
        given += strike.energy(&body);
        lowest = body
            .modes
            .first()
            .map_or(lowest, |m| lowest.min(m.frequency));
        sides.push((id, strike));
    }
    let energy = FRICTION_SHARE * slide.power * slide.duration * heard(slide.speed, lowest);
    let scale = (energy / given).sqrt();
    if given <= 0.0 || !scale.is_finite() {
        return Ok(());
    }
    let force = pulse.force.iter().map(|f| f * scale as f32).collect();
    let pulse = Arc::new(SoundPulse {
        force,
        time_step: STEP,
    });
    for (id, strike) in sides {
        let pulse = Arc::clone(&pulse);
        synth.strike(slide.time, id, Strike { pulse, ..strike })?;
    }
    Ok(())
}

/// Share of the noise between the lowest mode, Hz, and the highest that is heard: its power falls as 1/(1 + (f/f_c)²) above f_c = v/grain.
fn heard(speed: f64, lowest: f64) -> f64 {
    let cut = speed / GRAIN;
    ((HIGHEST / cut).atan() - (lowest / cut).atan()).max(0.0) / FRAC_PI_2
}

/// Noise of the size of one newton, the same for the same slide.
fn noise(slide: &RecordedSlide) -> SoundPulse {
    let count = (slide.duration / STEP).round().max(1.0) as u64;
    let keep = (-std::f64::consts::TAU * slide.speed / GRAIN * STEP).exp();
    let key = [slide.time.to_bits(), slide.point.x.to_bits().into()];
    let mut value = 0.0;
    let force = (0..count).map(|k| {
        let drawn = 2.0 * drawn_share([key[0], key[1], k]) - 1.0;
        value = keep * value + (1.0 - keep) * drawn;
        value as f32
    });
    SoundPulse {
        time_step: STEP,
        force: force.collect(),
    }
}
