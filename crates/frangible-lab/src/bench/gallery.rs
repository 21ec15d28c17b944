//! The bodies of the gallery, each under the blow that breaks it first in its scene: whole breaks beside the project's goals.

use std::collections::BTreeMap;
use std::hint::black_box;
use std::sync::Arc;
use std::time::Instant;

use frangible::internals::{StageTimings, Threads};
use frangible::{Body, Breakable, Contact, FractureConfig, Outcome, impact, would_break};
use frangible_scenes::{FirstBreak, bake, breakable, first_break, scene};
use serde_json::{Value, json};

use crate::Result;
use crate::bench::stats::Times;

/// Goal of a whole break, s: solids that shatter have a longer one.
const WALL: f64 = 0.020;
const SOLID: f64 = 0.050;

/// A scene, and the goal of its break, s.
pub type Subject = (&'static str, f64);

/// The scenes, in the order of the table.
pub const SUBJECTS: [Subject; 9] = [
    ("glass", WALL),
    ("pane", WALL),
    ("plate", WALL),
    ("bowl", WALL),
    ("chocolate", WALL),
    ("piggy-bank", SOLID),
    ("brick", SOLID),
    ("rabbit", SOLID),
    ("hammer", SOLID),
];

/// Body for the questions whether it would break.
const ASKED: &str = "glass";

/// Speeds, m/s, from and to, that it is asked about, and the goal of the median, s.
const QUESTIONS: [([f64; 2], f64); 2] = [([0.5, 1.0], 0.001), ([1.0, 2.0], 0.005)];

/// Number of bodies that are asked, which differ in their weak points.
const SEEDS: u64 = 20;

/// Number of speeds of each range.
const SPEEDS: usize = 8;

/// The scenes of these names, all of them where there are none.
///
/// # Errors
/// A name that is no scene of the table.
pub fn chosen(names: &[String]) -> Result<Vec<Subject>> {
    if names.is_empty() {
        return Ok(SUBJECTS.to_vec());
    }
    let find = |name: &String| {
        let known = SUBJECTS.iter().find(|s| s.0 == name).copied();
        let names = SUBJECTS.map(|s| s.0).join(", ");
        known.ok_or_else(|| {
            format!("`{name}` is not a body of the gallery's table; the bodies are {names}").into()
        })
    };
    names.iter().map(find).collect()
}

/// Breaks each body so many times, after one time that does not count.
///
/// # Errors
/// A scene that cannot be baked or played, or in which nothing breaks.
pub fn measure(subjects: &[Subject], runs: usize) -> Result<Value> {
    let (mut rows, mut asked) = (Vec::new(), Vec::new());
    for &(scene, goal) in subjects {
        let found = Blow::of(scene)?;
        rows.push(found.row(scene, goal, runs.max(1))?);
        if scene == ASKED {
            for (speeds, goal) in QUESTIONS {
                asked.push(found.questions(speeds, goal)?);
            }
        }
    }
    Ok(json!({ "breaks": rows, "questions": asked }))
}

/// The first blow of a scene that breaks something.
struct Blow {
    first: FirstBreak,
    /// The body anew, twice: neither uses data that the scene or the other one has prepared.
    breakables: [Breakable; 2],
}

impl Blow {
    fn of(name: &str) -> Result<Self> {
        let scene = scene(name)?;
        let baked = bake(&scene)?;
        let first = first_break(&scene, &baked, &mut |_| {})?;
        let nothing = || crate::Error::from(format!("nothing breaks in the scene `{name}`"));
        let mut first = first.ok_or_else(nothing)?;
        first.config.threads = Threads::default();
        let spec = scene.bodies.iter().find(|body| body.name == first.name);
        let spec = spec.ok_or_else(nothing)?;
        let anew = || breakable(spec, &Arc::clone(first.body.asset()));
        let breakables = [anew()?, anew()?];
        Ok(Self { first, breakables })
    }

    fn row(&self, scene: &str, goal: f64, runs: usize) -> Result<Value> {
        let FirstBreak {
            body,
            contacts,
            config,
            ..
        } = &self.first;
        let [cold, new] = self.breakables.each_ref().map(|b| b.body(body.seed()));
        let (cold, _) = timed(&cold, contacts, config)?;
        new.prepare_for_blows(config);
        let (first, _) = timed(&new, contacts, config)?;
        let (mut whole, mut stages) = (Vec::new(), vec![Vec::new(); 6]);
        let mut last = None;
        for _ in 0..runs {
            let (time, outcome) = timed(&new, contacts, config)?;
            whole.push(time);
            for (all, time) in stages.iter_mut().zip(by_stage(&outcome.report().timings)) {
                all.push(time);
            }
            last = Some(outcome);
        }
        let pieces = match &last {
            Some(Outcome::Broke(fracture)) => fracture.fragments.len(),
            _ => 1,
        };
        let report = last.as_ref().map(Outcome::report).ok_or("no run")?;
        let stages = STAGES
            .iter()
            .zip(stages)
            .map(|(name, s)| (*name, Times::new(s).median()));
        Ok(json!({
            "scene": scene,
            "weak_points": report.weak_points,
            "modes": new.asset().modes().followed(),
            "steps": report.time_steps,
            "cracks": report.cracks,
            "cut": report.arrivals.iter().map(Vec::len).sum::<usize>(),
            "pieces": pieces,
            "runs": runs,
            "cold_s": cold,
            "first_s": first,
            "whole_s": Times::new(whole).median(),
            "goal_s": goal,
            "stages_s": stages.collect::<BTreeMap<_, _>>(),
        }))
    }

    /// Asks bodies of other seeds if the blow would break them at other speeds.
    fn questions(&self, [from, to]: [f64; 2], goal: f64) -> Result<Value> {
        let contacts = &self.first.contacts;
        let fastest = contacts.iter().map(|c| f64::from(c.approach_speed));
        let fastest = fastest.fold(f64::MIN_POSITIVE, f64::max);
        let (mut times, mut breaks) = (Vec::new(), 0);
        for seed in 1..=SEEDS {
            let body = self.breakables[1].body(seed);
            for k in 0..SPEEDS {
                let speed = from + (to - from) * (k as f64 + 0.5) / SPEEDS as f64;
                let slower = |contact: &Contact| {
                    let mut contact = contact.clone();
                    let factor = (speed / fastest) as f32;
                    contact.approach_speed *= factor;
                    contact.impulse *= factor;
                    contact.friction *= factor;
                    contact
                };
                let contacts: Vec<Contact> = contacts.iter().map(slower).collect();
                let start = Instant::now();
                let answer = would_break(&body, black_box(&contacts), &self.first.config)?;
                times.push(start.elapsed().as_secs_f64());
                breaks += usize::from(answer);
            }
        }
        let times = Times::new(times);
        Ok(json!({
            "speeds_m_s": [from, to],
            "questions": times.count(),
            "breaks": breaks,
            "median_s": times.median(),
            "longest_s": times.quantile(1.0),
            "goal_s": goal,
        }))
    }
}

fn timed(body: &Body, contacts: &[Contact], config: &FractureConfig) -> Result<(f64, Outcome)> {
    let start = Instant::now();
    let outcome = impact(body, black_box(contacts), config)?;
    Ok((start.elapsed().as_secs_f64(), outcome))
}

/// Stages of a break, in the order of [`by_stage`].
const STAGES: [&str; 6] = ["blow", "stress", "cracks", "labels", "fragments", "drawing"];

fn by_stage(timings: &StageTimings) -> [f64; 6] {
    let t = timings;
    [
        t.response,
        t.stress,
        t.cracks,
        t.labels,
        t.fragments,
        t.drawing,
    ]
}
