//! The view model: a scene, what is done with it, and what there is to see. It has no window and no clock.

mod grab;
mod heard;
mod look;
mod methods;
mod play;
mod start;
mod swing;
mod told;
mod turn;

use std::path::PathBuf;
use std::sync::Arc;
use std::time::Duration;

use frangible::FractureConfig;
use frangible_export::View;
use frangible_rapier::StepTimings;
use frangible_scenes::{BakedBody, LiveScene, Reel, SavedScene, Scene, SceneError, scene};

use crate::analysis::Analysis;
use crate::baking::{Shelf, scene_in};
use crate::blow::Blow;
use crate::command::{BallSpec, Command, HammerSpec, Mark, Subject, Tool};
use crate::edges::Skins;
use crate::error::ViewError;
use crate::film::KEPT;
use crate::host::Host;
use crate::jobs::Job;
use crate::knobs::Settings;
use crate::mesher::Mesher;
use crate::methods::Methods;
use crate::picture::Picture;
use crate::shown::{Compared, Focus};
use crate::times::Laps;

/// Slowest and fastest clock, simulated seconds per second.
const SLOW_MOTION: [f64; 2] = [1e-4, 4.0];

/// Pictures per simulated second.
const FRAME_RATE: f64 = 60.0;

/// A scene that runs, and how it is looked at. The same commands give the same scene, bit for bit.
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
    methods: Option<Arc<Methods>>,
    bake_job: Option<Job<Result<Vec<BakedBody>, SceneError>>>,
    analysis_job: Option<Job<Result<Analysis, frangible::InputError>>>,
    again_job: Option<Job<Result<turn::Again, ViewError>>>,
    methods_job: Option<methods::MethodsJob>,
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
            methods: None,
            bake_job: None,
            analysis_job: None,
            again_job: None,
            methods_job: None,
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

    /// As [`Session::new`]; bodies come from this host instead of a bake, and files go to it.
    #[must_use]
    pub fn in_host(host: Box<dyn Host>) -> Self {
        let mut session = Self::new();
        session.host = Some(host);
        session
    }

    /// Carries a command out, or begins to: bakes, analyses and second impacts go on elsewhere until
    /// [`Session::poll`] or [`Session::finish_jobs`] collects them; steps that [`Command::Step`] asks for are taken here.
    ///
    /// # Errors
    /// What stands in the way; nothing was done then.
    pub fn apply(&mut self, command: Command) -> Result<(), ViewError> {
        self.begin(command)?;
        while self.owes() {
            self.take_owed_step()?;
        }
        Ok(())
    }

    /// As [`Session::apply`], but steps are left to be taken one by one with [`Session::take_owed_step`].
    pub(crate) fn begin(&mut self, command: Command) -> Result<(), ViewError> {
        self.commands += 1;
        self.stale = true;
        self.message = None;
        let kept = command.is_deed().then(|| command.clone());
        let done = self.carry_out(command);
        match (&done, kept) {
            (Ok(()), Some(deed)) => self.write_down(deed),
            (Err(error), _) => self.message = Some((error.to_string(), true)),
            _ => {}
        }
        done
    }

    fn carry_out(&mut self, command: Command) -> Result<(), ViewError> {
        match command {
            Command::Volume(number) | Command::SlowMotion(number) if number.is_nan() => {
                return Err(ViewError::Command {
                    line: command.to_string(),
                    problem: "NaN is no number".into(),
                });
            }
            Command::Scene(name) => {
                let wanted = match &self.host {
                    Some(host) => host.scene(&name)?,
                    None => scene(&name)?,
                };
                self.load(wanted);
            }
            Command::Open(path) => self.load(scene_in(&path)?),
            Command::CancelBake => self.cancel_bake(),
            Command::Reset => self.reset()?,
            Command::Drop(height) => self.drop_from(height)?,
            Command::Pause => {
                self.paused = true;
                self.hush();
            }
            Command::Volume(volume) => self.set_volume(volume)?,
            Command::Sound(on) => self.set_muted(!on)?,
            Command::Run => self.paused = false,
            Command::Step(count) => {
                self.running()?;
                self.paused = true;
                self.owed = count;
            }
            Command::Frames(count) => {
                let now = self.running()?.time();
                self.paused = true;
                // To the end of a picture, whatever was before.
                let next = (now * FRAME_RATE + 1e-6).floor() + f64::from(count);
                self.owed_until = next / FRAME_RATE;
            }
            Command::SlowMotion(speed) => {
                self.slow_motion = speed.clamp(SLOW_MOTION[0], SLOW_MOTION[1]);
            }
            Command::Ball(ball) => self.choose_ball(ball)?,
            Command::Hammer(hammer) => self.choose_hammer(hammer)?,
            Command::Tool(tool) => self.tool = tool,
            Command::Throw { from, through } => self.throw(from, through)?,
            Command::Swing { from, through } => self.swing(from, through)?,
            Command::Grab { from, through } => self.grab(from, through)?,
            Command::Pull { from, through } => self.pull(from, through),
            Command::LetGo => self.grip = None,
            Command::Undo => self.undo_break()?,
            Command::Look(subject) => self.look(subject)?,
            Command::Scrub(share) => self.scrub = share.clamp(0.0, 1.0),
            Command::Exaggerate(factor) => self.exaggeration = factor.clamp(0.0, 1e6),
            Command::Explode(factor) => self.explode = factor.clamp(0.0, 10.0),
            Command::Show(mark, true) if !self.marks.contains(&mark) => self.marks.push(mark),
            Command::Show(_, true) => {}
            Command::Show(mark, false) => self.marks.retain(|&shown| shown != mark),
            Command::Mode(number) => self.mode = number.max(1),
            Command::Select { from, through } => self.select(from, through),
            Command::Knob(name, value) => self.turn(&name, value)?,
            Command::ResetKnob(name) => self.turn_back(&name)?,
            Command::ResetKnobs => self.turn_all_back()?,
            Command::Material(name) => self.choose_material(&name)?,
            Command::HitAgain => self.hit_again()?,
            Command::LookFrom { eye, target } => {
                let way = target - eye;
                if !way.is_finite() || way.length() < 1e-4 {
                    return Err(ViewError::NotNow(
                        "the camera must stand elsewhere than where it looks".into(),
                    ));
                }
                self.look_from = Some(View {
                    eye,
                    target,
                    ..self.home
                });
            }
            Command::Film(kind, path, options) => self.begin_film(kind, &path, &options)?,
            Command::CancelSave => {
                if let Some(job) = &self.film_job {
                    job.cancel();
                }
            }
            Command::CompareMethods(methods) => self.compare_methods(methods)?,
            Command::Save(target, path) => {
                self.write(target, &path)?;
                self.message = Some((format!("wrote {}", path.display()), false));
            }
            other => {
                return Err(ViewError::NotNow(format!(
                    "`{other}` is for a window, and there is none"
                )));
            }
        }
        Ok(())
    }

    /// The scene that runs.
    fn running(&mut self) -> Result<&mut LiveScene, ViewError> {
        self.live.as_mut().ok_or_else(|| {
            ViewError::NotNow("there is no scene yet; load one, and wait for its bake".into())
        })
    }

    /// The last contact that mattered.
    fn last_blow(&self) -> Result<&Arc<Blow>, ViewError> {
        self.blow.as_ref().ok_or_else(|| {
            ViewError::NotNow("nothing was hit yet; throw something, or let something fall".into())
        })
    }

    /// Keeps what a script needs to do the same again.
    fn write_down(&mut self, deed: Command) {
        match deed {
            Command::Scene(_) | Command::Open(_) => self.log.clear(),
            // What was before does not matter to what comes, but for what was chosen.
            Command::Reset | Command::Drop(_) => self.log.retain(|known| {
                !matches!(
                    known,
                    Command::Step(_)
                        | Command::Throw { .. }
                        | Command::Swing { .. }
                        | Command::Grab { .. }
                        | Command::Pull { .. }
                        | Command::LetGo
                        | Command::Undo
                )
            }),
            // Steps are written down as they are taken.
            Command::Step(_) => return,
            _ => {}
        }
        self.log.push(deed);
    }

    /// What was done since the scene was loaded: a script that does it again.
    #[must_use]
    pub fn log(&self) -> &[Command] {
        &self.log
    }

    /// Collects what was computed elsewhere; true if there was anything.
    pub fn poll(&mut self) -> bool {
        let any = self.poll_all(None);
        self.stale |= any;
        any
    }

    /// Waits until nothing goes on elsewhere.
    pub fn finish_jobs(&mut self) {
        let wait = Some(Duration::from_millis(200));
        while self.has_jobs() {
            let any = self.poll_all(wait);
            self.stale |= any;
        }
    }

    fn poll_all(&mut self, wait: Option<Duration>) -> bool {
        let first = self.poll_bake(wait) | self.poll_analysis(wait);
        first | self.poll_again(wait) | self.poll_methods(wait) | self.poll_film(wait)
    }

    fn has_jobs(&self) -> bool {
        self.bake_job.is_some()
            || self.analysis_job.is_some()
            || self.again_job.is_some()
            || self.film_job.is_some()
            || self.methods_job.is_some()
    }

    /// Whether a command's work still goes on.
    #[must_use]
    pub fn is_busy(&self) -> bool {
        self.owes() || self.has_jobs()
    }

    /// Whether the clock should run: there is a scene, and nobody stopped it.
    #[must_use]
    pub fn is_running(&self) -> bool {
        self.live.is_some() && !self.paused
    }

    /// Simulated seconds per second.
    #[must_use]
    pub fn slow_motion(&self) -> f64 {
        self.slow_motion
    }

    /// Simulated time, s.
    #[must_use]
    pub fn time(&self) -> f64 {
        self.live.as_ref().map_or(0.0, LiveScene::time)
    }

    /// The scene with the knobs as they are.
    pub(crate) fn scene_now(&self) -> Option<Scene> {
        self.wanted_scene()
    }

    /// The scene on the move.
    #[must_use]
    pub fn live(&self) -> Option<&LiveScene> {
        self.live.as_ref()
    }

    /// The last contact that mattered: the last break, or the hardest that something withstood.
    #[must_use]
    pub fn blow(&self) -> Option<&Arc<Blow>> {
        self.blow.as_ref()
    }

    pub(crate) fn say(&mut self, what: String) {
        self.message = Some((what, false));
    }

    /// The last impact by several methods, once that was asked for.
    #[must_use]
    pub fn methods(&self) -> Option<&Arc<Methods>> {
        self.methods.as_ref()
    }

    pub(crate) fn complain(&mut self, error: &ViewError) {
        self.message = Some((error.to_string(), true));
    }
}

/// The scene's own knobs.
fn settings_of(scene: &Scene, baked: Option<&BakedBody>) -> Option<Settings> {
    let body = scene.bodies.first()?;
    let came_baked = matches!(body.source, frangible_scenes::BodySource::Asset(_));
    let material = match baked {
        Some(baked) if came_baked => baked.asset.material.clone(),
        _ => body.material.clone(),
    };
    let modes = match baked {
        Some(baked) if came_baked => baked.asset.modes.count(),
        _ => body.modes,
    };
    Some(Settings {
        material,
        fracture: scene.fracture.clone(),
        modes,
        seed: scene.seed,
        printed_coefficient: printed_coefficient(&scene.fracture),
    })
}

/// c of Eq. 2 as printed, where that model is in use; else one of the right order for a hand-sized thing.
fn printed_coefficient(fracture: &FractureConfig) -> f64 {
    match fracture.duration {
        frangible::internals::DurationModel::AsPrinted { c } => c,
        _ => 0.01,
    }
}
