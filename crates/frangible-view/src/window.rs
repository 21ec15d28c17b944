//! The window: draws what the session shows, and turns mouse, keys and panels into commands.

mod director;
mod input;
mod panels;
mod pictures;
mod shade;

use std::panic::{self, AssertUnwindSafe};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, Instant};

use frangible::glam::Vec2;
use frangible_draw::kiss3d::window::{CanvasSetup, NumSamples, Window};
use frangible_draw::{DrawError, LiveStage, Place, StillCamera, has_adapter, is_software};
use frangible_export::View;

use crate::camera::Orbit;
use crate::command::{Command, Target, Tool};
use crate::error::ViewError;
use crate::script::Script;
use crate::shown::Shown;
use crate::times::thread_time;
use crate::worker::Worker;

use director::Director;
use input::Hands;
use panels::Panels;
use shade::Shade;

/// How to open the window.
#[derive(Clone, Debug)]
pub struct WindowOptions {
    /// What to load first.
    pub first: Command,
    /// Commands to give instead of a person's; the clock stands then, and the window closes at the end.
    pub script: Option<Script>,
    /// Folder for files saved with keys and buttons.
    pub folder: PathBuf,
    /// Width and height, pixels.
    pub size: [u32; 2],
}

/// Opens the window and stays until it is closed.
///
/// # Errors
/// No display or no graphics driver; in a script, the first command that failed.
pub fn run(options: WindowOptions) -> Result<(), ViewError> {
    let display = |name| std::env::var_os(name).is_some_and(|value| !value.is_empty());
    if cfg!(target_os = "linux") && !display("DISPLAY") && !display("WAYLAND_DISPLAY") {
        return Err(ViewError::NoDisplay);
    }
    // The adapter is asked for afterwards: on the way to it some drivers visit the display, and one without other guests
    // may be shut for a moment when they leave.
    let mut window = match open(options.size) {
        Ok(window) => window,
        Err(_) if !has_adapter() => return Err(DrawError::NoAdapter.into()),
        Err(error) => return Err(error),
    };
    if is_software() {
        // Smooth edges take such a driver most of the time.
        window.set_samples(NumSamples::One);
    }
    let mut viewer = Viewer::new(options);
    let result = pollster::block_on(viewer.live(&mut window));
    // What is on the stage belongs to the window.
    drop(viewer);
    drop(window);
    result
}

/// The window system's refusals are panics; they are turned into an error, and not printed as well.
fn open([width, height]: [u32; 2]) -> Result<Window, ViewError> {
    let setup = CanvasSetup {
        samples: NumSamples::Four,
        ..CanvasSetup::default()
    };
    let open = || pollster::block_on(Window::new_with_setup("Frangible", width, height, setup));
    let hook = panic::take_hook();
    panic::set_hook(Box::new(|_| {}));
    let opened = panic::catch_unwind(AssertUnwindSafe(open));
    panic::set_hook(hook);
    opened.map_err(|payload| {
        let text = payload.downcast_ref::<String>().cloned();
        let text = text.or_else(|| payload.downcast_ref::<&str>().map(ToString::to_string));
        ViewError::Window(text.unwrap_or_default())
    })
}

/// How long to wait where there is nothing new to draw.
const REST: Duration = Duration::from_millis(12);

/// How long frames are drawn after the last news: panels fade, and hints come after half a second.
const LIVELY: Duration = Duration::from_millis(1200);

/// Of frames with nothing new one in so many is drawn.
const SELDOM: u32 = 40;

/// Everything the window needs.
struct Viewer {
    stage: Option<LiveStage>,
    worker: Worker,
    orbit: Orbit,
    panels: Panels,
    hands: Hands,
    director: Director,
    shade: Shade,
    /// Version of the picture that is on the stage.
    drawn: u64,
    /// Version of the shadow that is on the floor.
    shaded: u64,
    /// Number of the scene that the stage was lit for.
    starts: u64,
    /// Number of what the camera was turned to.
    focus: u64,
    /// When anything changed last, and how often nothing new was drawn since.
    still: (Instant, u32),
    /// Commands, picture and shadow of the last frame.
    news: (u64, u64, u64),
    quit: bool,
}

impl Viewer {
    fn new(options: WindowOptions) -> Self {
        let mut worker = Worker::start(options.script.is_none());
        if options.script.is_none() {
            worker.send(options.first);
        }
        Self {
            stage: None,
            worker,
            orbit: Orbit::new(View::default()),
            panels: Panels::new(options.folder, options.script.is_some()),
            hands: Hands::default(),
            director: Director::new(options.script),
            shade: Shade::start(),
            drawn: 0,
            shaded: 0,
            starts: u64::MAX,
            focus: 0,
            still: (Instant::now(), 0),
            news: (0, 0, 0),
            quit: false,
        }
    }

    async fn live(&mut self, window: &mut Window) -> Result<(), ViewError> {
        // A window that never drew panics when it is dropped, and a script may end before the first frame.
        self.set_stage(window, &self.worker.latest());
        let mut camera = self.camera(window);
        if let Some(stage) = &mut self.stage {
            window.render_3d(stage.scene(), &mut camera).await;
        }
        while !self.quit {
            let began = thread_time();
            let shown = self.worker.latest();
            self.set_stage(window, &shown);
            let said = self.hands.read(window);
            let done = self.worker.is_done(&shown);
            let drawn = done && self.is_drawn(&shown);
            if let Some(command) = self.director.next(&shown, done, drawn)? {
                self.give(command, window);
                continue;
            }
            if self.may_rest(&shown, done, !said.anything) {
                window.canvas_mut().poll_events();
                std::thread::sleep(REST);
                continue;
            }
            // From here on a frame is drawn: panels and strokes are drawn once for each.
            let words = self.words(window, &shown);
            for command in self.panels.draw(window, &shown, said, &words) {
                self.give(command, window);
            }
            if let Some(stage) = &self.stage {
                pictures::strokes(stage, window, &shown.picture);
            }
            let mut camera = self.camera(window);
            let own = thread_time().saturating_sub(began);
            let open = match &mut self.stage {
                Some(stage) => window.render_3d(stage.scene(), &mut camera).await,
                None => true,
            };
            self.director.frame_done();
            let draw_calls = self.stage.as_ref().map_or(0, LiveStage::draw_calls);
            let all = thread_time().saturating_sub(began);
            self.panels.times().note(window, draw_calls, [all, own]);
            if self.worker.is_dead() {
                return Err(ViewError::Worker);
            }
            if !open {
                return self.director.closed_early();
            }
        }
        Ok(())
    }

    /// Whether another frame would show nothing new. A script has no use for frames before everything is done.
    fn may_rest(&mut self, shown: &Shown, done: bool, quiet: bool) -> bool {
        let news = self.news != (shown.commands, shown.picture.version, self.shaded);
        self.news = (shown.commands, shown.picture.version, self.shaded);
        if self.director.has_script() && !done {
            return true;
        }
        if news || !quiet || !done || self.panels.plays() {
            self.still = (Instant::now(), 0);
        }
        self.still.1 += 1;
        self.still.0.elapsed() > LIVELY && !self.still.1.is_multiple_of(SELDOM)
    }

    /// Whether all there is to see is on the stage, with its shadow.
    fn is_drawn(&self, shown: &Shown) -> bool {
        let version = shown.picture.version;
        self.starts == shown.starts && self.drawn == version && self.shade.is_fine(version)
    }

    fn set_stage(&mut self, window: &mut Window, shown: &Arc<Shown>) {
        if self.stage.is_none() || self.starts != shown.starts {
            self.starts = shown.starts;
            self.orbit = Orbit::new(shown.home);
            // The old one first: two stages would share lights.
            self.stage = None;
            self.stage = Some(LiveStage::new(window, &shown.home));
            (self.drawn, self.shaded) = (u64::MAX, u64::MAX);
            self.shade.set_place(Place::of(&shown.home));
        }
        if self.focus != shown.focus.number {
            self.focus = shown.focus.number;
            match shown.focus.on {
                Some((middle, size)) => {
                    let aspect = self.panels.free_aspect(window);
                    self.orbit.focus_on(middle, size, aspect);
                }
                None => self.orbit.go_home(),
            }
        }
        let Some(stage) = &mut self.stage else { return };
        if self.drawn != shown.picture.version {
            self.drawn = shown.picture.version;
            pictures::put(stage, &shown.picture);
        }
        self.shade.want(&shown.picture);
        if let Some((version, shadow)) = self.shade.latest()
            && version != self.shaded
        {
            self.shaded = version;
            stage.lay_floor(shadow.as_deref());
        }
    }

    /// Carries out what is for the window, and passes on the rest.
    fn give(&mut self, command: Command, window: &mut Window) {
        let degrees = |angle: f32| angle.to_radians();
        match command.clone() {
            Command::Orbit(right, up) => self.orbit.turn_by(degrees(right), degrees(up)),
            Command::Pan(right, up) => self.orbit.pan_by(right, up),
            Command::Zoom(factor) => self.orbit.zoom_by(factor),
            Command::Home => self.orbit.go_home(),
            Command::Click(x, y) => {
                let ray = self.ray(window, x, y);
                let (from, through) = (ray.origin, ray.origin + ray.direction);
                self.pass_on(match self.worker.latest().tool {
                    Tool::Ball => Command::Throw { from, through },
                    Tool::Hammer => Command::Swing { from, through },
                });
            }
            Command::Pick(x, y) => {
                let ray = self.ray(window, x, y);
                self.pass_on(Command::Select {
                    from: ray.origin,
                    through: ray.origin + ray.direction,
                });
            }
            Command::GrabAt(x, y) => {
                let ray = self.ray(window, x, y);
                self.pass_on(Command::Grab {
                    from: ray.origin,
                    through: ray.origin + ray.direction,
                });
            }
            Command::PullTo(x, y) => {
                let ray = self.ray(window, x, y);
                self.pass_on(Command::Pull {
                    from: ray.origin,
                    through: ray.origin + ray.direction,
                });
            }
            Command::LookFrom { eye, target } => {
                let home = self.orbit.home();
                self.orbit.stand(View {
                    eye,
                    target,
                    ..home
                });
                self.pass_on(command);
            }
            Command::Film(..) => {
                // Films are seen as the window is.
                let View { eye, target, .. } = self.orbit.view();
                self.pass_on(Command::LookFrom { eye, target });
                self.pass_on(command);
            }
            Command::Panel(name, open) => self.panels.set_open(&name, open),
            Command::Dark(dark) => self.panels.set_dark(dark),
            Command::Save(Target::Times, path) => {
                let saved = self.panels.times().save(&self.worker.latest(), &path);
                self.say_saved(&path, saved);
            }
            Command::Screenshot(path) => {
                let saved = pictures::save(window, &path);
                self.say_saved(&path, saved);
            }
            Command::Quit => self.quit = true,
            other => self.pass_on(other),
        }
    }

    fn say_saved(&mut self, path: &Path, saved: Result<(), ViewError>) {
        self.panels.tell(match &saved {
            Ok(()) => format!("wrote {}", path.display()),
            Err(error) => error.to_string(),
        });
        self.director.done(saved);
    }

    fn pass_on(&mut self, command: Command) {
        self.panels.hush();
        // A thread that is gone is noticed in the loop.
        self.worker.send(command);
    }

    fn ray(&self, window: &Window, x: f32, y: f32) -> crate::camera::Ray {
        let shift = self.panels.shift(window);
        self.orbit.ray(Vec2::new(x, y), aspect(window), shift)
    }

    /// The picture's labels, and where they stand in the window, shares of its size.
    fn words(&self, window: &Window, shown: &Shown) -> Vec<(Vec2, String)> {
        let shift = self.panels.shift(window);
        let words = shown.picture.labels.iter().filter_map(|label| {
            let place = self.orbit.place(label.at, aspect(window), shift)?;
            Some((place, label.text.clone()))
        });
        words.collect()
    }

    fn camera(&self, window: &mut Window) -> StillCamera {
        let view = self.orbit.view();
        let view = match &self.stage {
            Some(stage) => stage.look(window, &view),
            None => view,
        };
        StillCamera::new(&view, aspect(window)).shifted(self.panels.shift(window))
    }
}

fn aspect(window: &Window) -> f32 {
    window.width() as f32 / window.height().max(1) as f32
}
