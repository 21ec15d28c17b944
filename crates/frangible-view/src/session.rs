//! The view model: a scene, its commands and its displayed state, without a window or a clock.
//!
//! Its user passes commands ([`Session::apply`], `obey.rs`), lets it collect results from other threads ([`Session::poll`], `collect.rs`), and reads
//! its state ([`Session::shown`], `look.rs`). Each other module implements one kind of command: loading scenes (`start.rs`), steps and throws
//! (`play.rs`), knobs (`turn.rs`), and so on.

mod collect;
mod grab;
mod heard;
mod look;
mod obey;
mod play;
mod start;
mod swing;
mod told;
mod turn;

use std::path::PathBuf;
use std::sync::Arc;

use frangible_rapier::StepTimings;
use frangible_recording::View;
use frangible_scenes::{BakedBody, LiveScene, Reel, SavedScene, Scene, SceneError};

use crate::analysis::Analysis;
use crate::baking::Shelf;
use crate::blow::Blow;
use crate::command::{BallSpec, Command, HammerSpec, Mark, Subject, Tool};
use crate::edges::Skins;
use crate::error::ViewError;
use crate::film::KEPT;
use crate::host::Host;
use crate::jobs::Job;
use crate::knobs::Settings;
use crate::mesher::Mesher;
use crate::picture::Picture;
use crate::shown::{Compared, Focus};
use crate::times::Laps;

/// A running scene and its displayed state. The same commands give bit-identical scenes.
pub struct Session {
    /// Instead of the disk and the bake, where there is neither.
    pub(crate) host: Option<Box<dyn Host>>,
    scene: Option<Scene>,
    live: Option<LiveScene>,
    shelf: Shelf,
    /// Knobs as they are, and as the scene has them.
    settings: Option<[Settings; 2]>,
    /// Knobs when the scene was set up.
    built: Option<Settings>,
    ball: BallSpec,
    hammer: HammerSpec,
    tool: Tool,
    paused: bool,
    slow_motion: f64,
    steps: u64,
    starts: u64,
    /// Steps that a command still wants, or a time it wants to come to, s.
    owed: u32,
    owed_until: f64,
    recent: Option<SavedScene>,
    undo: Vec<(SavedScene, Option<Arc<Blow>>, u64)>,
    blow: Option<Arc<Blow>>,
    break_step: StepTimings,
    analysis: Option<Arc<Analysis>>,
    compared: Option<Arc<Compared>>,
    bake_job: Option<Job<Result<Vec<BakedBody>, SceneError>>>,
    /// True if the last impact is to be taken again when the bake is done, and the scene is to go on as it is.
    hits_again: bool,
    analysis_job: Option<Job<Result<Analysis, frangible::InputError>>>,
    again_job: Option<Job<Result<turn::Again, ViewError>>>,
    subject: Subject,
    scrub: f64,
    exaggeration: f64,
    explode: f64,
    marks: Vec<Mark>,
    mode: usize,
    selection: Option<usize>,
    grip: Option<grab::Grip>,
    home: View,
    focus: Focus,
    log: Vec<Command>,
    commands: u64,
    message: Option<(String, bool)>,
    mesher: Mesher,
    skins: Skins,
    picture: Arc<Picture>,
    largest_color: Option<f64>,
    stale: bool,
    publishing: Laps,
    pub(crate) reel: Reel,
    pub(crate) film_job: Option<Job<Result<PathBuf, ViewError>>>,
    look_from: Option<View>,
    heard: Option<heard::Heard>,
}

impl Default for Session {
    fn default() -> Self {
        Self::new()
    }
}

impl Session {
    /// A session without a scene; its clock runs.
    #[must_use]
    pub fn new() -> Self {
        Self {
            host: None,
            scene: None,
            live: None,
            shelf: Shelf::default(),
            settings: None,
            built: None,
            ball: BallSpec::default(),
            hammer: HammerSpec::default(),
            tool: Tool::default(),
            paused: false,
            slow_motion: 1.0,
            steps: 0,
            starts: 0,
            owed: 0,
            owed_until: 0.0,
            recent: None,
            undo: Vec::new(),
            blow: None,
            break_step: StepTimings::default(),
            analysis: None,
            compared: None,
            bake_job: None,
            hits_again: false,
            analysis_job: None,
            again_job: None,
            subject: Subject::World,
            scrub: 0.0,
            exaggeration: 1.0,
            explode: 0.0,
            marks: vec![Mark::Impulse],
            mode: 1,
            selection: None,
            grip: None,
            home: View::default(),
            focus: Focus::default(),
            log: Vec::new(),
            commands: 0,
            message: None,
            mesher: Mesher::default(),
            skins: Skins::default(),
            picture: Arc::default(),
            largest_color: None,
            stale: true,
            publishing: Laps::default(),
            reel: Reel::keeping(KEPT),
            film_job: None,
            look_from: None,
            heard: None,
        }
    }

    /// A session without a scene whose bodies and files come from a host instead of a bake and the disk. Files are saved to the host.
    #[must_use]
    pub fn in_host(host: Box<dyn Host>) -> Self {
        let mut session = Self::new();
        session.host = Some(host);
        session
    }

    /// The scene that runs.
    fn running(&mut self) -> Result<&mut LiveScene, ViewError> {
        self.live.as_mut().ok_or_else(|| {
            ViewError::NotNow("no scene is loaded; load one and wait until it is baked".into())
        })
    }

    /// The last contact that mattered.
    fn last_blow(&self) -> Result<&Arc<Blow>, ViewError> {
        self.blow.as_ref().ok_or_else(|| {
            ViewError::NotNow("there has been no contact yet; throw or drop something first".into())
        })
    }

    pub(crate) fn say(&mut self, what: String) {
        self.message = Some((what, false));
    }

    pub(crate) fn complain(&mut self, error: &ViewError) {
        self.message = Some((error.to_string(), true));
    }
}
