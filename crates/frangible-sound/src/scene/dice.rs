//! The sound of tempered glass: dice that come loose, and clumps of dice that land.
//!
//! Nothing of it rings. A clump holds by nothing but its shape, and the modes of a die (7 mm: 400 kHz) are far above the range of hearing. Dice are
//! pushed, one by one, and that is heard.
//!
//! **Coming loose.** A crack through the wall releases `G = 0.296 σ_m² h / E'` per area (Horvay; see the material). At half of Rayleigh's speed half of
//! it reaches the tip (Freund, J. Mech. Phys. Solids 20 (1972) 141), and the other half leaves as waves. They are as short as the wall is thick, so
//! they are motion of single dice: in equal parts of their six ways to move as rigid bodies. That leaves nothing for friction between the faces of the
//! cracks and is the most that it can be. The wall is still closed then, so that a die that moves across it is a piston among others, of random sign.
//!
//! **Landing.** What meets a clump stops it die by die. Each die that comes to rest gives the momentum that it had, so that their number follows from the
//! impulse of the rigid bodies; they arrive in the order of their distance, each when it has fallen that far at the speed of the clump.

use std::f64::consts::TAU;
use std::sync::Arc;

use frangible::Material;
use frangible::internals::outcome::Clump;
use frangible_recording::{RecordedBlow, RecordedTouch};
use glam::Vec3;

use super::cast::{Cast, Sounding};
use super::nodes::Nodes;
use super::place;
use super::touches::{Side, hertz, side};
use super::touching::drawn_share;
use crate::error::SoundError;
use crate::pulse::SoundPulse;
use crate::strike::Strike;
use crate::synth::Synth;

/// Energy that a crack through a tempered wall releases per area, over σ_m² h / E'.
const RELEASED: f64 = 0.296;
/// Part of it that leaves as waves: the speed of the crack over Rayleigh's.
const WAVES: f64 = 0.5;
/// Part of a die's energy that moves it across the wall: one of six ways.
const ACROSS: f64 = 1.0 / 6.0;

/// Shortest pulse of a die, in samples: a shorter one would be folded back into the range of hearing. Its spectrum falls by 3 dB up to 12 kHz.
const SHORTEST: f64 = 2.5;
/// Values of a train of pulses for each sample.
const FINE: f64 = 2.0;

/// A cube that is hit off its centre turns: with d as the distance of the force from the centre, it gives way by 1 + 6 (d/a)² as much as its mass, at
/// most by 1 + this.
const TURNS: f64 = 1.5;
/// Slowest landing, m/s, and gravity, m/s².
const SLOWEST: f64 = 0.02;
const GRAVITY: f64 = 9.81;

/// Returns true if one of some nodes is a clump of dice.
pub(super) fn are(cast: &dyn Cast, nodes: impl IntoIterator<Item = usize>) -> bool {
    let mut nodes = nodes.into_iter();
    nodes.any(|node| matches!(cast.sounding(node), Sounding::Dice(..)))
}

/// Speed across the wall that a die gets when it comes loose, m/s: its root mean square.
fn recoil(material: &Material, mass: f64) -> f64 {
    let area = material.die_area();
    let thickness = mass / (material.density * area);
    let released = RELEASED * material.middle_tension().powi(2) * thickness;
    // Half of the sides of a hexagon: each is shared by two dice.
    let sides = 3.0 * (area / (1.5 * 3.0_f64.sqrt())).sqrt() * thickness;
    let waves = WAVES * released / material.contact_modulus() * sides;
    (2.0 * ACROSS * waves / mass).sqrt()
}

/// Lets the dice of a wall be heard that the front of the cracks passes, clump by clump, and returns their number. Clumps that part later were loose
/// before.
pub(super) fn loose(
    synth: &mut Synth,
    cast: &dyn Cast,
    blow: &RecordedBlow,
) -> Result<u64, SoundError> {
    let mut count = 0;
    for node in blow.pieces.clone() {
        let Sounding::Dice(material, mass, clump) = cast.sounding(node) else {
            continue;
        };
        if clump.generation() > 1 {
            continue;
        }
        let mass = mass / clump.count().max(1) as f64;
        let volume = mass / material.density;
        let thickness = volume / material.die_area();
        // Evenly from −√3 to √3, whose mean square is 1.
        let size = 3.0_f64.sqrt() * recoil(material, mass) * volume / thickness;
        let grains = (0..).zip(clump.times()).map(|(die, time)| {
            let drawn = drawn_share([node as u64, die, 1]);
            (time, size * (2.0 * drawn - 1.0))
        });
        let rate = synth.config().rate;
        let first = clump.times().into_iter().fold(f64::INFINITY, f64::min);
        let train = train(rate, 0.0, grains.map(|(time, size)| (time - first, size)));
        let at = place(cast.pose(node, blow.time).translation);
        synth.piston(blow.time + first, at, Arc::new(train))?;
        count += clump.count() as u64;
    }
    Ok(count)
}

/// Lets a clump be heard that meets something: the dice that are stopped, whose number it returns, and what they meet.
pub(super) fn lands(
    synth: &mut Synth,
    nodes: &mut Nodes,
    cast: &dyn Cast,
    floor: Option<&Material>,
    touch: &RecordedTouch,
) -> Result<u64, SoundError> {
    if touch.impulse <= 0.0 {
        return Ok(0);
    }
    let both = [(Some(touch.nodes.0), 1.0), (touch.nodes.1, -1.0)];
    let (mut sides, mut gives_way) = (Vec::<Side>::new(), 0.0);
    let mut grains: Option<Vec<f64>> = None;
    for (node, sign) in both {
        let Some(node) = node else { continue };
        let sounding = cast.sounding(node);
        gives_way += 1.0 / sounding.grain_mass();
        if let Sounding::Dice(_, _, clump) = sounding {
            let heights = heights(cast, node, clump, touch, sign);
            let fewer = grains.as_ref().is_none_or(|g| heights.len() < g.len());
            grains = if fewer { Some(heights) } else { grains };
        }
        sides.push(side(synth, nodes, cast, node, touch, sign)?);
    }
    let Some(mut heights) = grains else {
        return Ok(0);
    };
    let speed = touch.speed.max(SLOWEST);
    // The impulse that stops one die.
    let each = speed / gives_way;
    let count = (touch.impulse / each)
        .round()
        .clamp(1.0, heights.len() as f64);
    heights.truncate(count as usize);
    let own = both.map(|(node, _)| {
        node.map(|n| (cast.sounding(n).grain_mass(), cast.sounding(n).material()))
    });
    let duration = hertz(1.0 / gives_way, speed, own, floor);
    let key = [touch.time.to_bits(), touch.nodes.0 as u64];
    let stops = |die: u64| 1.0 / (1.0 + TURNS * drawn_share([key[0], key[1], die]));
    let all: f64 = (0..).zip(&heights).map(|(die, _)| stops(die)).sum();
    // A die that bounces back gives twice what it had; what is left of the impulse only carries a heap, and is silent.
    let impulse = touch.impulse.min(2.0 * count * each);
    let grains = (0..).zip(&heights).map(|(die, &height)| {
        let falls = (speed * speed + 2.0 * GRAVITY * height).sqrt();
        ((falls - speed) / GRAVITY, impulse * stops(die) / all)
    });
    let train = Arc::new(train(synth.config().rate, duration, grains));
    for side in sides {
        let strike = Strike {
            pulse: Arc::clone(&train),
            push: side.push,
            direction: side.direction,
        };
        synth.strike(touch.time, side.id, strike)?;
    }
    if touch.nodes.1.is_none() {
        synth.thump(touch.time, place(touch.point), train)?;
    }
    Ok(count as u64)
}

/// Heights of the dice of a clump over the lowest of them, m, towards what they meet, rising.
fn heights(
    cast: &dyn Cast,
    node: usize,
    clump: &Clump,
    touch: &RecordedTouch,
    sign: f32,
) -> Vec<f64> {
    let pose = cast.pose(node, touch.time);
    let up = pose.rotation.normalize().inverse() * (touch.normal * sign);
    let over = |p: &Vec3| f64::from(p.dot(up));
    let mut heights: Vec<f64> = clump.places().iter().map(over).collect();
    heights.sort_by(f64::total_cmp);
    let lowest = heights.first().copied().unwrap_or(0.0);
    heights.iter_mut().for_each(|height| *height -= lowest);
    heights
}

/// Pulses as one: each begins at a time, s, and has a size, the integral of its values. `duration`, s, is that of each, but no shorter than can be heard.
fn train(rate: f64, duration: f64, grains: impl Iterator<Item = (f64, f64)>) -> SoundPulse {
    let step = 1.0 / (FINE * rate);
    let steps = (duration.max(SHORTEST / rate) / step).ceil();
    let mut force = Vec::<f32>::new();
    for (time, size) in grains {
        // Value k is that at (k + 1) step. The values of 1 − cos on any grid of three and more add up to its integral.
        let first = (time / step).floor();
        let end = first as usize + steps as usize;
        if force.len() < end {
            force.resize(end, 0.0);
        }
        for k in 0..steps as usize {
            let share = ((first + k as f64 + 1.0) - time / step) / steps;
            if (0.0..1.0).contains(&share) {
                let value = size * (1.0 - (TAU * share).cos()) / (steps * step);
                force[first as usize + k] += value as f32;
            }
        }
    }
    SoundPulse {
        time_step: step,
        force,
    }
}
