//! One piece by all ways.

use std::sync::Arc;

use frangible::glam::Vec3;
use frangible::internals::{Elastic, Portion};
use frangible::{
    Asset, Body, Contact, FractureConfig, InputError, Material, Outcome, impact, would_break,
};
use frangible_bake::pieces::{PieceError, reanalysis};

use super::choose::{Broken, Chosen};
use super::impacts::{LEVELS, STRONGER, Stress, place, speed_for, stress};
use super::way::{REANALYSIS, WAYS, Ways};
use super::{TruthPlan, clock, impacts};
use crate::Result;

/// Frequencies that are compared.
pub(crate) const FREQUENCIES: usize = 5;

/// Places that are tried for each blow, and the share of the wanted stress that will do.
const DRAWS: usize = 4;
const ENOUGH: f64 = 0.4;

/// Share of the speed by which a blow is changed to see how sure its outcome is.
pub(crate) const NUDGE: f64 = 0.05;

/// Elements and modes of the analyses of a piece without its cracks and with them: many, since both lattices differ.
const SOFTENED: (usize, usize) = (900, 4);

/// A piece, its truth and the results of every way.
#[derive(Clone, Debug)]
pub struct PieceSample {
    /// Name of the body that it comes from.
    pub name: String,
    /// Its uncut tetrahedra.
    pub tets: usize,
    /// Its mass, kg.
    pub mass: f64,
    /// Diagonal of the box around it, m.
    pub size: f64,
    /// True if something still holds it.
    pub held: bool,
    /// The full analysis.
    pub truth: Reading,
    /// The blows, and the results of the full analysis for each.
    pub blows: Vec<Blow>,
    /// Results of each of [`WAYS`]; none if it refused the piece.
    pub ways: Vec<Option<Sample>>,
}

/// Measurements of an elastic body.
#[derive(Clone, Debug)]
pub struct Reading {
    /// Quadratic elements.
    pub elements: usize,
    /// First frequencies, Hz.
    pub frequencies: Vec<f64>,
    /// Time of one thread until the piece can be hit, s.
    pub ready: f64,
    /// Memory of the piece's own arrays, bytes.
    pub bytes: usize,
}

/// A blow on a piece.
#[derive(Clone, Copy, Debug)]
pub struct Blow {
    /// Speed, m/s.
    pub speed: f64,
    /// Largest share of a weak point's strength that the tension before any crack has.
    pub level: f64,
    /// True if it breaks the piece.
    pub breaks: bool,
    /// Outcome of a blow that is slower, and of one that is faster, by one part in twenty: true if it breaks the piece.
    pub nudged: [bool; 2],
    /// First frequency with the cracks over that without, for a piece that the blow cracks and does not break.
    pub softened: Option<f64>,
}

/// Results of a way for a piece, beside the truth.
#[derive(Clone, Debug)]
pub struct Sample {
    /// Measurements of its elastic body.
    pub reading: Reading,
    /// Results for each blow.
    pub blows: Vec<BlowSample>,
}

/// Results of a way for a blow.
#[derive(Clone, Copy, Debug)]
pub struct BlowSample {
    /// Largest tension over the truth's.
    pub stress: f64,
    /// Distance of the place of the largest tension from the truth's, in sizes of the piece; none without tension.
    pub apart: Option<f64>,
    /// True if it breaks the piece.
    pub breaks: bool,
}

/// A piece with an elastic body, brittle and too strong to crack.
struct Bodies {
    brittle: Body,
    strong: Body,
    reading: Reading,
}

impl Bodies {
    fn new(
        broken: &Broken,
        portion: &Arc<Portion>,
        find: impl FnOnce() -> std::result::Result<Elastic, PieceError>,
    ) -> std::result::Result<Self, PieceError> {
        let start = clock::now();
        let elastic = find()?;
        let brittle = broken.body.piece(portion, elastic)?;
        let ready = clock::now() - start;
        let asset = brittle.asset();
        let count = asset.modes().count().min(FREQUENCIES);
        let reading = Reading {
            elements: asset.analysis().elements.len(),
            frequencies: (0..count).map(|i| asset.modes().frequency(i)).collect(),
            ready,
            bytes: bytes(asset),
        };
        Ok(Self {
            strong: brittle.strengthened(STRONGER),
            brittle,
            reading,
        })
    }
}

/// Memory of a piece's own arrays, bytes: elements, modes, embedding, surface.
fn bytes(asset: &Asset) -> usize {
    let (analysis, surface) = (asset.analysis(), asset.surface());
    size_of_val(&*analysis.nodes)
        + size_of_val(&*analysis.elements)
        + size_of_val(&*analysis.barycentric_gradients)
        + size_of_val(&*asset.modes().eigenvalues)
        + size_of_val(&*asset.modes().shapes)
        + size_of_val(&*asset.embedding().nodes)
        + size_of_val(&*asset.embedding().tets)
        + size_of_val(&*surface.triangles)
        + size_of_val(&*surface.normals)
        + size_of_val(&*surface.tets)
        + size_of_val(&*surface.curvature_radius)
}

fn diagonal(positions: &[Vec3]) -> f64 {
    let low = positions.iter().fold(Vec3::INFINITY, |a, &p| a.min(p));
    let high = positions.iter().fold(Vec3::NEG_INFINITY, |a, &p| a.max(p));
    f64::from(low.distance(high))
}

/// Measures one piece. Returns the reason if its full analysis was refused.
pub(crate) fn measure(
    plan: &TruthPlan,
    ways: &Ways,
    broken: &Broken,
    chosen: &Chosen,
    number: usize,
) -> Result<std::result::Result<PieceSample, String>> {
    let portion = &chosen.portion;
    let full = || reanalysis(portion, plan.elements, plan.modes);
    let truth = match Bodies::new(broken, portion, full) {
        Ok(truth) => truth,
        Err(error) => return Ok(Err(format!("{}: {error}", broken.name))),
    };
    let materials = [Material::preset("stone")?, Material::preset("steel")?];
    let size = diagonal(portion.surface_positions());
    // The trial body sets the speeds; the truth gives the outcomes.
    let trial = Bodies::new(broken, portion, || {
        ways.elastic(REANALYSIS, portion, &broken.body)
    });
    let trial = trial.as_ref().unwrap_or(&truth);
    let mut blows: Vec<(Contact, Stress, Blow)> = Vec::new();
    for (k, level) in LEVELS.into_iter().enumerate() {
        // Where a piece is held, or hit on a tip, no blow reaches the level.
        for draw in 0..DRAWS {
            let at = place(&truth.brittle, number, k + LEVELS.len() * draw);
            let speed = speed_for(&trial.strong, at, level, &materials)?;
            let contact = impacts::contact(&truth.brittle, at, speed, &materials);
            let found = stress(&truth.strong, &contact)?;
            let Some(found) = found.filter(|s| s.level > ENOUGH * level) else {
                continue;
            };
            let (breaks, softened) = blow(&truth.brittle, &contact)?;
            let nudged = nudged(&truth.brittle, at, speed, &materials)?;
            let level = found.level;
            blows.push((
                contact,
                found,
                Blow {
                    speed,
                    level,
                    breaks,
                    nudged,
                    softened,
                },
            ));
            break;
        }
    }
    let sample = |way: usize| -> Result<Option<Sample>> {
        let find = || ways.elastic(way, portion, &broken.body);
        let Ok(bodies) = Bodies::new(broken, portion, find) else {
            return Ok(None);
        };
        let config = FractureConfig::default();
        let blows = blows.iter().map(|(contact, truth, _)| {
            let own = stress(&bodies.strong, contact)?;
            Ok(BlowSample {
                stress: own.map_or(0.0, |own| own.peak / truth.peak),
                apart: own.map(|own| f64::from(truth.place.distance(own.place)) / size),
                breaks: would_break(&bodies.brittle, std::slice::from_ref(contact), &config)?,
            })
        });
        let blows = blows.collect::<Result<_>>()?;
        Ok(Some(Sample {
            reading: bodies.reading,
            blows,
        }))
    };
    let mut samples: Vec<Option<Sample>> = Vec::with_capacity(WAYS.len());
    for way in 0..WAYS.len() {
        let same = ways.same_as(way, portion.tets().len());
        samples.push(match same {
            Some(same) => samples[same].clone(),
            None => sample(way)?,
        });
    }
    Ok(Ok(PieceSample {
        name: broken.name.clone(),
        tets: portion.tets().len(),
        mass: portion.mass().mass,
        size,
        held: !portion.supported().is_empty(),
        ways: samples,
        blows: blows.into_iter().map(|b| b.2).collect(),
        truth: truth.reading,
    }))
}

/// Outcome of a blow that is a little slower, and of one that is a little faster: true if it breaks the piece.
fn nudged(
    piece: &Body,
    at: (Vec3, Vec3),
    speed: f64,
    materials: &[Material; 2],
) -> std::result::Result<[bool; 2], InputError> {
    let config = FractureConfig::default();
    let hit = |factor: f64| {
        let contact = impacts::contact(piece, at, factor * speed, materials);
        would_break(piece, std::slice::from_ref(&contact), &config)
    };
    Ok([hit(1.0 - NUDGE)?, hit(1.0 + NUDGE)?])
}

/// Returns true if a blow breaks a piece. If it only cracks, also returns the first frequency with the cracks over that without.
fn blow(piece: &Body, contact: &Contact) -> std::result::Result<(bool, Option<f64>), InputError> {
    let config = FractureConfig::default();
    let state = match impact(piece, std::slice::from_ref(contact), &config)? {
        Outcome::Broke(_) => return Ok((true, None)),
        Outcome::Held { state, .. } => state,
        _ => None,
    };
    let Some(state) = state else {
        return Ok((false, None));
    };
    let mut cracked = piece.clone();
    let first = |body: &Body| {
        let portion = Arc::new(Portion::of_cracked(body, &config).ok()?);
        let elastic = reanalysis(&portion, SOFTENED.0, SOFTENED.1).ok()?;
        Some(elastic.modes.frequency(0))
    };
    let before = first(piece);
    cracked.set_state(*state)?;
    let softened = first(&cracked)
        .zip(before)
        .map(|(after, before)| after / before);
    Ok((false, softened))
}
