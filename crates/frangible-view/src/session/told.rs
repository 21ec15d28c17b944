//! Answers of a session: its contents and its state.

use std::sync::Arc;

use frangible_recording::View;
use frangible_scenes::LiveScene;

use super::Session;
use crate::analysis::Analysis;
use crate::blow::Blow;
use crate::command::{Command, Mark, Subject};
use crate::methods::Methods;

impl Session {
    /// Returns true if the clock should run: there is a scene, and nobody stopped it.
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

    /// The last impact by several methods, once that was asked for.
    #[must_use]
    pub fn methods(&self) -> Option<&Arc<Methods>> {
        self.methods.as_ref()
    }

    /// Commands since the scene was loaded: a script that does the same again.
    #[must_use]
    pub fn log(&self) -> &[Command] {
        &self.log
    }

    pub(crate) fn is_marked(&self, mark: Mark) -> bool {
        self.marks.contains(&mark)
    }

    pub(crate) fn subject(&self) -> Subject {
        self.subject
    }

    /// Course of the last contact, moment by moment, once that was asked for.
    #[must_use]
    pub fn analysis(&self) -> Option<&Arc<Analysis>> {
        self.analysis.as_ref()
    }

    pub(crate) fn scrubbed(&self) -> f64 {
        self.scrub
    }

    pub(crate) fn exaggerated(&self) -> f64 {
        self.exaggeration
    }

    /// Mode to look at, from 0.
    pub(crate) fn mode_of(&self, analysis: &Analysis) -> usize {
        self.mode.clamp(1, analysis.asset.modes.count().max(1)) - 1
    }

    /// View of films.
    pub(crate) fn film_view(&self) -> View {
        self.look_from.unwrap_or(self.home)
    }
}
