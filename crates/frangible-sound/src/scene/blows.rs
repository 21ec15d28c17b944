//! The sound of a blow: its force on the struck body and on the striker, and its cracks.

use std::ops::Range;
use std::sync::Arc;

use frangible::{Asset, ImpactReport};
use frangible_recording::{RecordedBlow, RecordedCrack};
use glam::Vec3;

use super::cast::{Cast, Sounding};
use super::nodes::{Nodes, carried};
use super::{dice, place, released};
use crate::error::SoundError;
use crate::pulse::SoundPulse;
use crate::strike::{CRACK_SHARE, CRACK_SPEED, Strike};
use crate::synth::Synth;

/// Distance from the floor below which a force comes from the floor, m.
const ON_FLOOR: f32 = 0.01;

/// Distance from a projectile's centre below which a force comes from it, in radii of it. A hammer's head is longer than wide.
const AT_PROJECTILE: f32 = 3.0;

/// Cracks of one blow that sound by themselves, the longest; the energy of all is shared among these.
const MOST_CRACKS: usize = 200;

/// Converts a blow on an object, `time` s after the first frame, to plain data: the report of the fracture model, and the numbers of
/// the pieces if it broke.
#[must_use]
pub fn recorded_blow(
    node: usize,
    asset: &Asset,
    report: &ImpactReport,
    time: f64,
    pieces: Range<usize>,
) -> RecordedBlow {
    let pulses = report
        .contacts
        .iter()
        .map(|contact| frangible_recording::RecordedPulse {
            point: contact.point,
            direction: contact.normal,
            time_step: report.time_step,
            force: contact.force.clone(),
        });
    let origin = asset.mass().centre;
    let crack = |cuts: &Vec<(u32, f64)>| RecordedCrack {
        places: (cuts.iter())
            .map(|&(tet, _)| asset.root().fracture().centroid(tet as usize).as_dvec3() - origin)
            .map(|place| place.as_vec3())
            .collect(),
        times: cuts.iter().map(|&(_, time)| time).collect(),
    };
    RecordedBlow {
        node,
        time,
        pieces,
        pulses: pulses.collect(),
        cracks: report.arrivals.iter().map(crack).collect(),
        fracture_energy: report.fracture_energy,
    }
}

/// Lets a blow be heard, and returns the number of dice that came loose.
pub(super) fn blows(
    synth: &mut Synth,
    nodes: &mut Nodes,
    cast: &dyn Cast,
    blow: &RecordedBlow,
) -> Result<u64, SoundError> {
    let (id, body) = nodes.ready(synth, cast, blow.node, blow.time)?;
    let pose = cast.pose(blow.node, blow.time);
    let mut pulses = Vec::new();
    for recorded in &blow.pulses {
        let pulse = Arc::new(SoundPulse {
            time_step: recorded.time_step,
            force: recorded.force.clone(),
        });
        let strike = Strike {
            pulse: Arc::clone(&pulse),
            push: nodes.push(blow.node, recorded.point, recorded.direction),
            direction: recorded.direction,
        };
        pulses.push((Arc::clone(&pulse), strike.push.clone()));
        synth.strike(blow.time, id, strike)?;
        let at = pose.rotation * recorded.point + pose.translation;
        let direction = pose.rotation * recorded.direction;
        answer(synth, nodes, cast, blow.time, [at, direction], pulse)?;
    }
    if blow.pieces.is_empty() || dice::are(cast, [blow.node]) {
        return Ok(0);
    }
    let times = blow.cracks.iter().flat_map(|crack| &crack.times);
    let apart = times.copied().fold(0.0, f64::max);
    synth.hush(blow.time + apart, id)?;
    if dice::are(cast, blow.pieces.clone()) {
        return dice::loose(synth, cast, blow);
    }
    let moving = released::velocities(&body, &pulses, apart);
    released::released(synth, nodes, cast, blow, &moving, apart)?;
    Ok(0)
}

/// Applies the force to its other side as well: the floor, or a projectile.
fn answer(
    synth: &mut Synth,
    nodes: &mut Nodes,
    cast: &dyn Cast,
    time: f64,
    [at, direction]: [Vec3; 2],
    pulse: Arc<SoundPulse>,
) -> Result<(), SoundError> {
    if cast
        .floor()
        .is_some_and(|height| (at.y - height).abs() < ON_FLOOR && direction.y > 0.5)
    {
        return synth.thump(time, place(at), pulse);
    }
    let mut nearest: Option<(usize, f32)> = None;
    for node in cast.balls(time) {
        let Sounding::Ball(_, radius, _) = cast.sounding(node) else {
            continue;
        };
        let away = (cast.pose(node, time).translation - at).length() / *radius as f32;
        if away < nearest.map_or(AT_PROJECTILE, |(_, away)| away) {
            nearest = Some((node, away));
        }
    }
    let Some((node, _)) = nearest else {
        return Ok(());
    };
    let (id, _) = nodes.ready(synth, cast, node, time)?;
    let own = cast.pose(node, time).rotation.inverse() * -direction;
    let strike = Strike {
        pulse,
        push: Vec::new(),
        direction: own,
    };
    synth.strike(time, id, strike)
}

/// Lets the cracks be heard, on both their sides where they parted the body.
pub(super) fn cracks(
    synth: &mut Synth,
    nodes: &mut Nodes,
    cast: &dyn Cast,
    blow: &RecordedBlow,
) -> Result<(), SoundError> {
    let mut cracks: Vec<&RecordedCrack> = (blow.cracks.iter())
        .filter(|c| !c.places.is_empty())
        .collect();
    cracks.sort_by_key(|crack| std::cmp::Reverse(crack.places.len()));
    cracks.truncate(MOST_CRACKS);
    let all: usize = cracks.iter().map(|crack| crack.places.len()).sum();
    let speed = CRACK_SPEED * cast.sounding(blow.node).material().rayleigh_speed();
    for crack in cracks {
        let share = crack.places.len() as f64 / all as f64;
        let energy = CRACK_SHARE * blow.fracture_energy * share;
        let (low, high) = crack
            .places
            .iter()
            .fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(low, high), &p| {
                (low.min(p), high.max(p))
            });
        let duration = (f64::from((high - low).length()) / speed).max(5e-6);
        let middle = crack.places.len() / 2;
        let (at, time) = (crack.places[middle], blow.time + crack.times[0]);
        let sides = sides(cast, blow, at);
        for &(node, local) in &sides {
            let (id, body) = nodes.ready(synth, cast, node, time)?;
            let push = nodes.push_any(node, local);
            let each = energy / sides.len() as f64;
            if let Some(strike) = Strike::crack(&body, push, duration, each) {
                synth.strike(time, id, strike)?;
            }
        }
    }
    Ok(())
}

/// The nodes on both sides of a crack at a place of the body, and where it is in them: the body itself, or the two nearest of its pieces.
fn sides(cast: &dyn Cast, blow: &RecordedBlow, at: Vec3) -> Vec<(usize, Vec3)> {
    if blow.pieces.is_empty() {
        return vec![(blow.node, at)];
    }
    let parent = cast.pose(blow.node, blow.time);
    let mut near: Vec<(f32, usize, Vec3)> = (blow.pieces.clone())
        .map(|piece| {
            let local = carried(at, &parent, &cast.pose(piece, blow.time));
            (cast.distance(piece, local), piece, local)
        })
        .collect();
    near.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    near.iter()
        .take(2)
        .map(|&(_, piece, local)| (piece, local))
        .collect()
}
