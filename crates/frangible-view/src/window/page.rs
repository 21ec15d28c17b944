//! The window as a part of a page in a browser.

use std::pin::Pin;
use std::sync::Arc;

use frangible_draw::has_storage_buffers;
use frangible_draw::kiss3d::window::Window;

use crate::command::Command;
use crate::error::ViewError;
use crate::shown::Shown;
use crate::worker::{Remote, Worker};

use super::Viewer;
use super::director::Director;
use super::panels::Panels;
use super::shade::Shade;

/// The page around the window.
pub trait Page {
    /// Commands that the page gives.
    fn commands(&self) -> Vec<Command>;

    /// Takes the current state, `done` if all commands are done, and the number of frames that were drawn.
    fn show(&self, shown: &Arc<Shown>, done: bool, frames: u64);

    /// Waits until the browser draws again.
    fn next_frame(&self) -> Pin<Box<dyn Future<Output = ()>>>;
}

/// Options of a window in a page.
pub struct PageOptions {
    /// Command that loads the first scene.
    pub first: Command,
    /// Names of the scenes that can be chosen.
    pub scenes: Vec<String>,
    /// If true, scenes run by the clock of the page; else only by [`Command::Step`].
    pub by_clock: bool,
    /// The session, which runs elsewhere.
    pub session: Box<dyn Remote>,
    /// The page.
    pub page: Box<dyn Page>,
}

/// Shows a page's window (`frangible_draw::open_canvas`) for as long as the page lives. The session runs elsewhere, so that nothing it does
/// makes the page wait.
///
/// # Errors
/// The session has ended.
pub async fn run_in_page(window: &mut Window, options: PageOptions) -> Result<(), ViewError> {
    let mut worker = Worker::start_there(options.session);
    worker.send(options.first);
    let panels = Panels::in_page(options.scenes);
    let mut viewer = Viewer::of(worker, panels, Director::new(None), Shade::start(true));
    viewer.page = Some(options.page);
    viewer.hurries = !options.by_clock;
    viewer.fine_marks = has_storage_buffers();
    viewer.live(window).await
}

impl Viewer {
    pub(super) fn hear_page(&mut self, window: &mut Window) {
        let commands = self.page.as_ref().map(|page| page.commands());
        for command in commands.into_iter().flatten() {
            self.give(command, window);
        }
    }

    pub(super) fn tell_page(&self, shown: &Arc<Shown>, done: bool) {
        if let Some(page) = &self.page {
            page.show(shown, done, self.frames);
        }
    }
}

/// Reason that a page cannot carry out a command.
pub(super) fn not_here(command: &Command) -> String {
    match command {
        Command::Film(..) => {
            "the web page cannot make films or stills; use `frangible view`".into()
        }
        Command::Screenshot(_) => "use the browser to take a screenshot".into(),
        _ => format!("`{command}` is not available on the web page"),
    }
}
