//! Films and path-traced stills, rendered off-screen on a separate thread.

#[cfg(all(feature = "window", not(target_arch = "wasm32")))]
mod shoot;

use std::path::Path;
use std::time::Duration;

use crate::command::{FilmKind, FilmOptions};
use crate::error::ViewError;
use crate::jobs::{Job, Teller};
use crate::session::Session;

/// Seconds that are kept for films.
pub(crate) const KEPT: f64 = 20.0;

#[cfg(all(feature = "window", not(target_arch = "wasm32")))]
use shoot::shoot;

#[cfg(not(all(feature = "window", not(target_arch = "wasm32"))))]
fn shoot(
    _: FilmKind,
    _: &FilmOptions,
    _: (&frangible_recording::Recording, &frangible_recording::View),
    path: &Path,
    _: &Teller,
) -> Result<(), ViewError> {
    Err(ViewError::NotNow(format!(
        "`{}` cannot be drawn: this program was built without a renderer for films",
        path.display()
    )))
}

impl Session {
    /// Begins to make a film of the last seconds, or a still of the current scene.
    pub(crate) fn begin_film(
        &mut self,
        kind: FilmKind,
        path: &Path,
        options: &FilmOptions,
    ) -> Result<(), ViewError> {
        if self.film_job.is_some() {
            return Err(ViewError::NotNow(
                "another film is being made; wait for it, or cancel it with `cancel-save`".into(),
            ));
        }
        options.check()?;
        let view = self.film_view();
        let live = self.live().ok_or_else(|| {
            ViewError::NotNow("no scene is loaded; load one and wait until it is baked".into())
        })?;
        let recording = match kind {
            FilmKind::Still => live.recording(view),
            _ => self
                .reel
                .recording(live, options.seconds, options.rate, view),
        };
        let (options, path) = (options.clone(), path.to_path_buf());
        self.film_job = Some(Job::start(move |teller: &Teller| {
            shoot(kind, &options, (&recording, &view), &path, teller).map(|()| path)
        }));
        Ok(())
    }

    pub(crate) fn poll_film(&mut self, wait: Option<Duration>) -> bool {
        let given_up = self.film_job.as_ref().is_some_and(Job::is_cancelled);
        let Some(result) = Job::collect(&mut self.film_job, wait) else {
            return false;
        };
        match result {
            Err(_) if given_up => self.say("the film was cancelled".into()),
            Ok(path) => self.say(format!("wrote {}", path.display())),
            Err(error) => self.complain(&error),
        }
        true
    }
}

/// Drivers do not like it when a program ends while they draw.
impl Drop for Session {
    fn drop(&mut self) {
        if let Some(job) = &self.film_job {
            job.cancel();
            let _ = job.wait(Duration::from_secs(60));
        }
    }
}
