//! Throughput of refused contacts, and the longest time of one.

use std::f32::consts::TAU;
use std::time::Instant;

use frangible::glam::Vec3;
use frangible::internals::LookedAt;
use frangible::{
    Asset, Body, Breakable, Contact, FractureConfig, Material, Outcome, Striker, impact,
    would_break,
};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};
use serde::Serialize;
use serde_json::{Value, json};

use crate::Result;
use crate::bench::cache::Cache;
use crate::bench::stats::{Spread, Times};
use crate::bench::subjects::{MODES, PIG_GROWN, PIG_TETS, solid, steel_ball};

/// Contacts of the game-like distribution.
const GAME: usize = 2000;
/// Speeds of the game-like distribution, m/s: things that are put down, roll and nudge each other; 0.3 m/s is a fall of 5 mm.
const GAME_SPEEDS: [f64; 2] = [0.01, 0.3];
/// Speeds among which contacts for each class are looked for, m/s.
const ALL_SPEEDS: [f64; 2] = [0.01, 6.0];
/// Contacts tried for the classes.
const TRIED: usize = 300;
/// Different contacts of a class at most.
const KEPT: usize = 400;
/// A class is timed for about so long, s, but for each of its contacts at least once.
const BUDGET: f64 = 1.0;
/// Contacts that a class keeps however long one takes.
const FEWEST: usize = 20;
/// Most calls of a class.
const MOST_CALLS: usize = 400_000;

/// Stage at which a contact is refused, or its effect.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Class {
    /// Refused by the size of its impulse, its place and its duration: one number.
    Size,
    /// Refused by a bound of the amplitude to which its impulse moves each mode.
    Impulse,
    /// Refused by the amplitudes of the modes: at every step the bound of the whole body stays below the strength.
    Amplitudes,
    /// Refused by clusters: at some step the bound of the whole body passes the strength, that of no cluster does.
    Clusters,
    /// Stresses at weak points are computed, and stay below the strength.
    LookedAt,
    /// Cracks run that part nothing.
    Cracked,
    /// It breaks.
    Breaks,
}

impl Class {
    /// All classes, from the cheapest.
    pub const ALL: [Self; 7] = [
        Self::Size,
        Self::Impulse,
        Self::Amplitudes,
        Self::Clusters,
        Self::LookedAt,
        Self::Cracked,
        Self::Breaks,
    ];
}

/// A class, timed.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Timed {
    /// Different contacts.
    pub contacts: usize,
    /// Calls of `would_break` a second on one core; no clock read between them.
    pub per_second: f64,
    /// Single calls, s; each includes the time for reading the clock.
    pub latency: Spread,
}

/// Bakes the body, or reads it, and times the contacts.
///
/// # Errors
/// A body that does not bake, or whose file cannot be read.
pub fn measure(cache: &Cache) -> Result<Value> {
    let geometry = || Ok((solid("piggy_bank", PIG_GROWN, PIG_TETS)?, None, None));
    let baked = cache.body("porcelain-pig", MODES, "porcelain", geometry)?;
    let body = Breakable::uniform(baked.asset)?.body(1);
    let config = FractureConfig::default();
    let game = Source::new(&body, GAME_SPEEDS, 1)?.take(GAME);
    let mut game_counts = [0; Class::ALL.len()];
    for contact in &game {
        game_counts[class(&body, contact, &config)? as usize] += 1;
    }
    let game_timed = time(&body, &game, &config)?;
    let mut found: [Vec<Contact>; Class::ALL.len()] = Default::default();
    for contact in &Source::new(&body, ALL_SPEEDS, 2)?.take(TRIED) {
        let kind = &mut found[class(&body, contact, &config)? as usize];
        if kind.len() < KEPT {
            kind.push(contact.clone());
        }
    }
    let mut classes = Vec::new();
    for (kind, contacts) in Class::ALL.into_iter().zip(&found) {
        if !contacts.is_empty() {
            classes.push(json!({ "class": kind, "timed": time(&body, contacts, &config)? }));
        }
    }
    let shares = Class::ALL.map(|kind| f64::from(game_counts[kind as usize]) / GAME as f64);
    let shares = Class::ALL.into_iter().zip(shares);
    let asset = body.asset();
    Ok(json!({
        "tets": asset.fracture().tets.len(),
        "nodes": asset.fracture().positions.len(),
        "weak_points": body.weak_tets().len(),
        "modes": asset.modes().count(),
        "clock_s": clock_cost(),
        "game": game_timed,
        "game_shares": shares.map(|(class, share)| json!({ "class": class, "share": share })).collect::<Vec<_>>(),
        "classes": classes,
    }))
}

/// Draws contacts.
struct Source<'a> {
    asset: &'a Asset,
    speeds: [f64; 2],
    stone: Striker,
    rng: ChaCha8Rng,
}

impl<'a> Source<'a> {
    fn new(body: &'a Body, speeds: [f64; 2], seed: u64) -> Result<Self> {
        Ok(Self {
            asset: body.asset(),
            speeds,
            stone: Striker::fixed(&Material::preset("stone")?).with_restitution(0.5),
            rng: ChaCha8Rng::seed_from_u64(seed),
        })
    }

    fn take(mut self, count: usize) -> Vec<Contact> {
        (0..count).filter_map(|_| self.draw().ok()).collect()
    }

    /// A number in 0..1.
    fn uniform(&mut self) -> f64 {
        f64::from(self.rng.next_u32()) / (f64::from(u32::MAX) + 1.0)
    }

    fn draw(&mut self) -> Result<Contact> {
        let surface = self.asset.surface();
        let triangle = (self.uniform() * surface.triangles.len() as f64) as usize;
        let corner = surface.triangles[triangle][0] as usize;
        let inward = -surface.normals[triangle][0];
        let (around, tilt) = (TAU * self.uniform() as f32, self.uniform() as f32);
        let side = inward.any_orthonormal_vector();
        let aside = side * around.cos() + inward.cross(side) * around.sin();
        let [low, high] = self.speeds;
        let speed = low * (high / low).powf(self.uniform());
        let striker = if self.uniform() < 0.5 {
            steel_ball(0.02 + 0.2 * self.uniform())?
        } else {
            self.stone.clone()
        };
        let point: Vec3 = self.asset.fracture().positions[corner];
        Ok(Contact::collision(
            self.asset,
            point,
            inward + tilt * aside,
            speed,
            striker,
        ))
    }
}

fn class(body: &Body, contact: &Contact, config: &FractureConfig) -> Result<Class> {
    let outcome = impact(body, std::slice::from_ref(contact), config)?;
    let report = outcome.report();
    Ok(match (&outcome, report.looked_at) {
        (Outcome::Broke(_), _) => Class::Breaks,
        (_, LookedAt::Sizes) => Class::Size,
        (_, LookedAt::Impulses) => Class::Impulse,
        (_, LookedAt::Amplitudes) => Class::Amplitudes,
        (_, LookedAt::Clusters) => Class::Clusters,
        _ if report.cracks > 0 => Class::Cracked,
        _ => Class::LookedAt,
    })
}

/// Rate first, then single calls; `contacts` is not empty.
fn time(body: &Body, contacts: &[Contact], config: &FractureConfig) -> Result<Timed> {
    let clock = Instant::now();
    would_break(body, &contacts[..1], config)?;
    let fit = BUDGET / clock.elapsed().as_secs_f64();
    let contacts = &contacts[..contacts.len().min(FEWEST.max(fit as usize))];
    let round = || -> Result<f64> {
        let clock = Instant::now();
        for contact in contacts {
            std::hint::black_box(would_break(body, std::slice::from_ref(contact), config)?);
        }
        Ok(clock.elapsed().as_secs_f64())
    };
    let first = round()?.max(1e-9);
    let rounds = ((BUDGET / first) as usize).clamp(1, MOST_CALLS.div_ceil(contacts.len()));
    let mut times = Vec::with_capacity(rounds);
    for _ in 0..rounds {
        times.push(round()?);
    }
    let per_second = contacts.len() as f64 / Times::new(times).median();
    let mut single = Vec::with_capacity(rounds * contacts.len());
    for _ in 0..rounds {
        for contact in contacts {
            let clock = Instant::now();
            std::hint::black_box(would_break(body, std::slice::from_ref(contact), config)?);
            single.push(clock.elapsed().as_secs_f64());
        }
    }
    Ok(Timed {
        contacts: contacts.len(),
        per_second,
        latency: Times::new(single).spread(),
    })
}

/// Median of a call that does nothing, s.
fn clock_cost() -> f64 {
    let empty = (0..10_000).map(|_| Instant::now().elapsed().as_secs_f64());
    Times::new(empty.collect()).median()
}
