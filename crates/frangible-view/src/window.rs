//! The window: draws what the session shows, and turns mouse, keys and panels into commands.
//!
//! The window opens before the graphics adapter is asked for: some drivers visit the display, and a display server without
//! guests resets itself.

#[cfg(not(target_family = "wasm"))]
mod desktop;
mod director;
mod input;
mod page;
mod panels;
mod pictures;
mod shade;
#[cfg(all(feature = "sound", not(target_family = "wasm")))]
mod speaker;

use std::path::Path;
use std::sync::Arc;
use std::time::Duration;

use web_time::Instant;

use frangible::glam::Vec2;
use frangible_draw::kiss3d::window::Window;
use frangible_draw::{LiveStage, Place, StillCamera};
use frangible_recording::View;

use crate::camera::Orbit;
use crate::command::{Command, Target, Tool};
use crate::error::ViewError;
use crate::shown::Shown;
use crate::times::thread_time;
use crate::worker::Worker;

use director::Director;
use input::Hands;
use panels::Panels;
use shade::Shade;

#[cfg(not(target_family = "wasm"))]
pub use desktop::{WindowOptions, run};
pub use page::{Page, PageOptions, run_in_page};

/// Waiting time if there is nothing new to draw.
const REST: Duration = Duration::from_millis(12);

/// Time for which frames are drawn after the last news: panels fade, and hints come after half a second.
const LIVELY: Duration = Duration::from_millis(1200);

/// While frames show nothing new, one in so many is drawn.
const SELDOM: u32 = 40;

/// State of the window.
struct Viewer {
    stage: Option<LiveStage>,
    worker: Worker,
    orbit: Orbit,
    panels: Panels,
    hands: Hands,
    director: Director,
    shade: Shade,
    /// The page around the window, in a browser.
    page: Option<Box<dyn Page>>,
    /// Plays for as long as it is kept.
    #[cfg(all(feature = "sound", not(target_family = "wasm")))]
    _speaker: Option<speaker::Speaker>,
    /// Version of the picture that is on the stage.
    drawn: u64,
    /// Version of the shadow that is on the floor.
    shaded: u64,
    /// Number of the scene that the stage was lit for.
    starts: u64,
    /// Number of the focus that the camera was turned to.
    focus: u64,
    /// Time of the last change, and number of frames since then.
    still: (Instant, u32),
    /// Commands, picture and shadow of the last frame.
    news: (u64, u64, u64),
    /// True if nobody looks on while commands are carried out: a script gives them.
    hurries: bool,
    /// True if points and wireframes can be drawn; in a browser with WebGL 2 they cannot.
    fine_marks: bool,
    /// Frames that were drawn.
    frames: u64,
    quit: bool,
}

impl Viewer {
    fn of(worker: Worker, panels: Panels, director: Director, shade: Shade) -> Self {
        Self {
            stage: None,
            worker,
            orbit: Orbit::new(View::default()),
            panels,
            hands: Hands::default(),
            director,
            shade,
            page: None,
            #[cfg(all(feature = "sound", not(target_family = "wasm")))]
            _speaker: None,
            drawn: 0,
            shaded: 0,
            starts: u64::MAX,
            focus: 0,
            still: (Instant::now(), 0),
            news: (0, 0, 0),
            hurries: false,
            fine_marks: true,
            frames: 0,
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
            self.hear_page(window);
            let began = thread_time();
            self.worker.advance();
            let shown = self.worker.latest();
            self.set_stage(window, &shown);
            let said = self.hands.read(window);
            let done = self.worker.is_done(&shown);
            let drawn = done && self.is_drawn(&shown);
            if let Some(command) = self.director.next(&shown, done, drawn)? {
                self.give(command, window);
                continue;
            }
            self.tell_page(&shown, done);
            if self.may_rest(&shown, done, !said.anything) {
                window.canvas_mut().poll_events();
                self.rest().await;
                continue;
            }
            // From here on a frame is drawn: panels and strokes are drawn once for each.
            let words = self.words(window, &shown);
            for command in self.panels.draw(window, &shown, said, &words) {
                self.give(command, window);
            }
            if let Some(stage) = &self.stage {
                pictures::strokes(stage, window, &shown.picture, self.fine_marks);
            }
            let mut camera = self.camera(window);
            let own = thread_time().saturating_sub(began);
            let open = match &mut self.stage {
                Some(stage) => window.render_3d(stage.scene(), &mut camera).await,
                None => true,
            };
            self.director.frame_done();
            self.frames += 1;
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

    async fn rest(&self) {
        match &self.page {
            Some(page) => page.next_frame().await,
            None => std::thread::sleep(REST),
        }
    }

    /// Returns true if another frame would show nothing new. Whoever only waits for the end has no use for frames before it.
    fn may_rest(&mut self, shown: &Shown, done: bool, quiet: bool) -> bool {
        let news = self.news != (shown.commands, shown.picture.version, self.shaded);
        self.news = (shown.commands, shown.picture.version, self.shaded);
        if self.hurries && !done {
            return true;
        }
        if news || !quiet || !done || self.panels.plays() {
            self.still = (Instant::now(), 0);
        }
        self.still.1 += 1;
        self.still.0.elapsed() > LIVELY && !self.still.1.is_multiple_of(SELDOM)
    }

    /// Returns true if the whole picture is on the stage, with its shadow.
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
            pictures::put(stage, &shown.picture, self.fine_marks);
        }
        self.shade.want(&shown.picture);
        if let Some((version, shadow)) = self.shade.latest()
            && version != self.shaded
        {
            self.shaded = version;
            stage.lay_floor(shadow.as_deref());
        }
    }

    /// Carries out a command for the window, and passes on any other.
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
            Command::Screenshot(_) | Command::Film(..) | Command::Quit if self.page.is_some() => {
                self.panels.tell(page::not_here(&command));
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
