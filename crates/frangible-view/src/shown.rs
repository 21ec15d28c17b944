//! State of a session, as displayed in a window.

use std::sync::Arc;

use frangible::glam::Vec3;
use frangible_rapier::{LoadCounts, StepTimings};
use frangible_recording::View;

use crate::blow::Blow;
use crate::command::{BallSpec, HammerSpec, Mark, Subject, Tool};
use crate::numbers::{BlowNumbers, ComparedNumbers, Course, KnobValues};
use crate::picture::Picture;
use crate::times::Spread;

/// Snapshot of a session's state, which can be drawn without blocking the session.
#[derive(Clone, Debug, Default)]
pub struct Shown {
    /// Commands carried out or refused so far.
    pub commands: u64,
    /// True while a command runs in the background.
    pub busy: bool,
    /// Name of the scene; empty before the first scene is loaded.
    pub scene: String,
    /// One-line description of the scene.
    pub summary: String,
    /// Number of scene set-ups so far; the camera may jump at each.
    pub starts: u64,
    /// Initial view of the scene.
    pub home: View,
    /// Part of the scene that the camera should frame.
    pub focus: Focus,
    /// Simulated time, s.
    pub time: f64,
    /// Steps taken.
    pub steps: u64,
    /// True if the simulation is paused.
    pub paused: bool,
    /// Simulated seconds per second of real time.
    pub slow_motion: f64,
    /// Volume, 0..=1, and true if it is muted; `None` without sound output.
    pub sound: Option<(f64, bool)>,
    /// Bodies that have not broken.
    pub whole: usize,
    /// Number of pieces.
    pub pieces: usize,
    /// Hash of the bits of all positions, velocities and masses; 0 without a scene.
    pub fingerprint: u64,
    /// Breaks that can be undone.
    pub undoable: usize,
    /// Ball to throw.
    pub ball: BallSpec,
    /// Hammer to swing.
    pub hammer: HammerSpec,
    /// Active tool of the mouse.
    pub tool: Tool,
    /// Progress of the running bake.
    pub bake: Option<BakeShown>,
    /// Progress of the film or still being rendered.
    pub filming: Option<BakeShown>,
    /// Length of the recorded footage, s.
    pub reel: f64,
    /// True while a contact is being analysed.
    pub analysing: bool,
    /// The last message, and true if it is an error.
    pub message: Option<(String, bool)>,
    /// Picture to draw.
    pub picture: Arc<Picture>,
    /// Subject of the view.
    pub subject: Subject,
    /// Displayed moment of the contact, as a fraction of its duration, 0..=1.
    pub scrub: f64,
    /// Magnification of displayed deformations.
    pub exaggeration: f64,
    /// Exploded view: displacement of each piece, as a fraction of its distance from its parent's centre.
    pub explode: f64,
    /// Visible marks.
    pub marks: Vec<Mark>,
    /// Displayed mode, from 1.
    pub mode: usize,
    /// Data of the last significant contact.
    pub blow: Option<BlowNumbers>,
    /// Time series of the last contact, once requested.
    pub course: Option<Arc<Course>>,
    /// Upper limit of the colour bar, Pa; its lower limit is 0.
    pub largest_color: Option<f64>,
    /// Selected object.
    pub selection: Option<Selection>,
    /// Two outcomes of one impact.
    pub compared: Option<ComparedNumbers>,
    /// Values of the knobs.
    pub knobs: Option<KnobValues>,
    /// True if a knob has been changed since the scene was set up.
    pub turned: bool,
    /// Counts of the contacts so far, by outcome.
    pub contacts: LoadCounts,
    /// Wall-clock times of the parts of the last break's step.
    pub break_step: StepTimings,
    /// CPU time of the session's thread for each recent picture, s, without simulation steps.
    pub publishing: Spread,
}

/// Target of the camera, which turns to it when `number` changes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Focus {
    /// Number of changes of the target so far.
    pub number: u64,
    /// Centre and half-extents (width, height) of the target, m; `None` for the whole scene from its initial view.
    pub on: Option<(Vec3, [f32; 2])>,
}

impl Shown {
    /// Returns true if a mark is visible.
    #[must_use]
    pub fn shows(&self, mark: Mark) -> bool {
        self.marks.contains(&mark)
    }
}

/// Progress of a background task.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BakeShown {
    /// Current stage.
    pub what: String,
    /// Completed fraction of the stage, 0..=1.
    pub share: f64,
}

/// A selected object.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Selection {
    /// Name of the object.
    pub name: String,
    /// Mass, kg.
    pub mass: f64,
    /// Volume, m³.
    pub volume: f64,
    /// Side lengths of its bounding box in the body frame, m, in descending order.
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
