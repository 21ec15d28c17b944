//! The bodies of the gallery, each under the blow that breaks it first in its scene: whole breaks beside the project's goals.

use std::hint::black_box;
use std::sync::Arc;
use std::time::Instant;

use frangible::internals::StageTimings;
use frangible::{Body, Breakable, Contact, FractureConfig, Outcome, impact, would_break};
use frangible_scenes::{FirstBreak, bake, breakable, first_break, scene};
use serde::Serialize;

use crate::Result;
use crate::bench::stats::Times;

/// A scene, and the goal of the whole break, s: solids that shatter have a longer one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Subject {
    /// Name of the scene.
    pub scene: &'static str,
    /// Goal of the whole break, s.
    pub goal: f64,
}

const WALL: f64 = 0.020;
const SOLID: f64 = 0.050;

/// The scenes, in the order of the table.
pub const SUBJECTS: [Subject; 9] = [
    subject("glass", WALL),
    subject("pane", WALL),
    subject("plate", WALL),
    subject("bowl", WALL),
    subject("chocolate", WALL),
    subject("piggy-bank", SOLID),
    subject("brick", SOLID),
    subject("rabbit", SOLID),
    subject("hammer", SOLID),
];

/// Body for the questions whether it would break.
const ASKED: &str = "glass";

/// Speeds, m/s, from and to, that it is asked about, and the goal of the median, s.
const QUESTIONS: [([f64; 2], f64); 2] = [([0.5, 1.0], 0.001), ([1.0, 2.0], 0.005)];

/// Number of bodies that are asked, which differ in their weak points.
const SEEDS: u64 = 20;

/// Number of speeds of each range.
const SPEEDS: usize = 8;

const fn subject(scene: &'static str, goal: f64) -> Subject {
    Subject { scene, goal }
}

/// Measurements of a body.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Row {
    /// Name of the scene.
    pub scene: String,
    /// Weak points.
    pub points: usize,
    /// Modes that the break follows.
    pub modes: usize,
    /// Time steps.
    pub steps: usize,
    /// Cracks that started.
    pub cracks: usize,
    /// Tetrahedra that cracks cut.
    pub cut: usize,
    /// Pieces.
    pub pieces: usize,
    /// Warm runs.
    pub runs: usize,
    /// The first break of a body just made from its file, s.
    pub cold: f64,
    /// The first break of a body that was made ready for blows, as a game does while it loads, s.
    pub first: f64,
    /// The median of the breaks that follow, s.
    pub whole: f64,
    /// Its goal, s.
    pub goal: f64,
    /// Medians of response, stress, cracks, labels, fragments, drawing, s.
    pub stages: [f64; 6],
}

/// Times of questions.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Asked {
    /// Speeds from and to, m/s.
    pub speeds: [f64; 2],
    /// Questions.
    pub questions: usize,
    /// Number of questions with the answer yes.
    pub breaks: usize,
    /// Median, s.
    pub median: f64,
    /// The longest, s.
    pub longest: f64,
    /// The goal of the median, s.
    pub goal: f64,
}

/// All measurements.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Findings {
    /// A row for each body.
    pub rows: Vec<Row>,
    /// Questions about the glass; none where it was not chosen.
    pub asked: Vec<Asked>,
}

/// The scenes of these names, all of them where there are none.
///
/// # Errors
/// A name that is no scene of the table.
pub fn chosen(names: &[String]) -> Result<Vec<Subject>> {
    if names.is_empty() {
        return Ok(SUBJECTS.to_vec());
    }
    let find = |name: &String| {
        let known = SUBJECTS.iter().find(|s| s.scene == name);
        known.copied().ok_or_else(|| {
            let known: Vec<&str> = SUBJECTS.iter().map(|s| s.scene).collect();
            crate::Error::from(format!(
                "`{name}` is not a body of the gallery's table; the bodies are {}",
                known.join(", ")
            ))
        })
    };
    names.iter().map(find).collect()
}

/// Breaks each body so many times, after one time that does not count.
///
/// # Errors
/// A scene that cannot be baked or played, or in which nothing breaks.
pub fn measure(
    subjects: &[Subject],
    runs: usize,
    progress: &mut dyn FnMut(&str, f64),
) -> Result<Findings> {
    let (mut rows, mut asked) = (Vec::new(), Vec::new());
    for (i, subject) in subjects.iter().enumerate() {
        progress(subject.scene, i as f64 / subjects.len() as f64);
        let found = Blow::of(subject.scene)?;
        rows.push(found.row(*subject, runs.max(1))?);
        if subject.scene == ASKED {
            for (speeds, goal) in QUESTIONS {
                asked.push(found.questions(speeds, goal)?);
            }
        }
    }
    Ok(Findings { rows, asked })
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
        let first = first.ok_or_else(nothing)?;
        let spec = scene.bodies.iter().find(|body| body.name == first.name);
        let spec = spec.ok_or_else(nothing)?;
        let anew = || breakable(spec, &Arc::clone(first.body.asset()));
        let breakables = [anew()?, anew()?];
        Ok(Self { first, breakables })
    }

    fn row(&self, subject: Subject, runs: usize) -> Result<Row> {
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
        let report = last.as_ref().map(Outcome::report);
        let stages: Vec<f64> = stages.into_iter().map(|s| Times::new(s).median()).collect();
        Ok(Row {
            scene: subject.scene.into(),
            points: report.map_or(0, |r| r.weak_points),
            modes: new.asset().modes().followed(),
            steps: report.map_or(0, |r| r.time_steps),
            cracks: report.map_or(0, |r| r.cracks),
            cut: report.map_or(0, |r| r.arrivals.iter().map(Vec::len).sum()),
            pieces,
            runs,
            cold,
            first,
            whole: Times::new(whole).median(),
            goal: subject.goal,
            stages: std::array::from_fn(|i| stages[i]),
        })
    }

    /// Asks bodies of other seeds if the blow would break them at other speeds.
    fn questions(&self, [from, to]: [f64; 2], goal: f64) -> Result<Asked> {
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
        Ok(Asked {
            speeds: [from, to],
            questions: times.count(),
            breaks,
            median: times.median(),
            longest: times.quantile(1.0),
            goal,
        })
    }
}

fn timed(body: &Body, contacts: &[Contact], config: &FractureConfig) -> Result<(f64, Outcome)> {
    let start = Instant::now();
    let outcome = impact(body, black_box(contacts), config)?;
    Ok((start.elapsed().as_secs_f64(), outcome))
}

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
