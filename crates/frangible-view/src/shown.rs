//! State of a session as a window shows it.

use std::sync::Arc;

use frangible::glam::Vec3;
use frangible_compare::Method;
use frangible_rapier::{LoadCounts, StepTimings};
use frangible_recording::View;

use crate::blow::Blow;
use crate::command::{BallSpec, HammerSpec, Mark, Subject, Tool};
use crate::numbers::{BlowNumbers, ComparedNumbers, Course, KnobValues, OutcomeNumbers};
use crate::picture::Picture;
use crate::times::Spread;

/// A session's state at one moment, to be drawn without holding up the session.
#[derive(Clone, Debug, Default)]
pub struct Shown {
    /// Commands carried out or refused so far.
    pub commands: u64,
    /// True while a command's work goes on elsewhere.
    pub busy: bool,
    /// Name of the scene; empty before the first.
    pub scene: String,
    /// Description of the scene, in a line.
    pub summary: String,
    /// Number of times that a scene was set up; with each, the camera may be elsewhere.
    pub starts: u64,
    /// Initial view of the scene.
    pub home: View,
    /// Part of the scene that the camera should have in view now.
    pub focus: Focus,
    /// Simulated time, s.
    pub time: f64,
    /// Steps taken.
    pub steps: u64,
    /// True if the clock stands.
    pub paused: bool,
    /// Simulated seconds per second.
    pub slow_motion: f64,
    /// Volume, 0..=1, and true if it is muted; `None` if nobody listens.
    pub sound: Option<(f64, bool)>,
    /// Bodies that have not broken.
    pub whole: usize,
    /// Pieces there are.
    pub pieces: usize,
    /// Hash of the bits of all positions, motions and masses; 0 without a scene.
    pub fingerprint: u64,
    /// Breaks that can be undone.
    pub undoable: usize,
    /// Ball to throw.
    pub ball: BallSpec,
    /// Hammer to swing.
    pub hammer: HammerSpec,
    /// Tool that a click uses.
    pub tool: Tool,
    /// The bake that runs.
    pub bake: Option<BakeShown>,
    /// The film or still that is being made.
    pub filming: Option<BakeShown>,
    /// Seconds of film that are kept.
    pub reel: f64,
    /// True while a contact is being analysed.
    pub analysing: bool,
    /// The last message, and true if it is a complaint.
    pub message: Option<(String, bool)>,
    /// Picture to draw.
    pub picture: Arc<Picture>,
    /// Subject of the view.
    pub subject: Subject,
    /// Moment of the contact to look at, 0..=1.
    pub scrub: f64,
    /// Factor by which deformations are enlarged in the picture.
    pub exaggeration: f64,
    /// Spread of the drawn pieces, as a share of their distance from their parent's middle.
    pub explode: f64,
    /// Marks that are shown.
    pub marks: Vec<Mark>,
    /// Mode to look at, from 1.
    pub mode: usize,
    /// The last contact that mattered.
    pub blow: Option<BlowNumbers>,
    /// Course of the last contact over time, once that was asked for.
    pub course: Option<Arc<Course>>,
    /// Stress at the end of the colour bar, Pa; it begins at 0.
    pub largest_color: Option<f64>,
    /// Thing that is selected.
    pub selection: Option<Selection>,
    /// Two outcomes of one impact.
    pub compared: Option<ComparedNumbers>,
    /// The methods that the last impact is shown by, once that was asked for.
    pub chosen: Option<Vec<Method>>,
    /// Outcomes of those methods, as far as they have come.
    pub methods: Vec<OutcomeNumbers>,
    /// Positions of the knobs.
    pub knobs: Option<KnobValues>,
    /// True if the knobs were turned since the scene was set up.
    pub turned: bool,
    /// Counts of the contacts so far, by outcome.
    pub contacts: LoadCounts,
    /// Wall-clock times of the parts of the last break's step.
    pub break_step: StepTimings,
    /// Processor time of the session's thread for each of the last pictures, s; steps are not in it.
    pub publishing: Spread,
}

/// Something to have in view: the camera turns to it when the number is another.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Focus {
    /// Counts the changes.
    pub number: u64,
    /// Its middle and half its width and height, m; `None`: the scene, from where it was seen in the beginning.
    pub on: Option<(Vec3, [f32; 2])>,
}

impl Shown {
    /// Returns true if a mark is shown.
    #[must_use]
    pub fn shows(&self, mark: Mark) -> bool {
        self.marks.contains(&mark)
    }
}

/// A bake that runs.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BakeShown {
    /// Its stage.
    pub what: String,
    /// Share of the stage that is done, 0..=1.
    pub share: f64,
}

/// A thing that was clicked.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Selection {
    /// Name of the thing.
    pub name: String,
    /// Mass, kg.
    pub mass: f64,
    /// Volume, m³.
    pub volume: f64,
    /// Sides of the box around it along its own axes, m, falling.
    pub size: [f32; 3],
    /// Speed, m/s.
    pub speed: f32,
}

/// Two outcomes of one impact.
#[derive(Clone, Debug)]
pub struct Compared {
    /// The impact, and the same impact with the knobs as they are.
    pub blows: [Arc<Blow>; 2],
    /// Knobs that differ: label, both values, unit.
    pub differences: Vec<(String, [f64; 2], String)>,
}
