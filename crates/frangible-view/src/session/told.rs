//! Accessors for the contents and state of a session.

use std::sync::Arc;

use frangible_recording::View;
use frangible_scenes::LiveScene;

use super::Session;
use crate::analysis::Analysis;
use crate::blow::Blow;
use crate::command::{Command, Mark, Subject};

impl Session {
    /// Returns true if there is a scene and the simulation is not paused.
    #[must_use]
    pub fn is_running(&self) -> bool {
        self.live.is_some() && !self.paused
    }

    /// Returns the simulated seconds per second of real time.
    #[must_use]
    pub fn slow_motion(&self) -> f64 {
        self.slow_motion
    }

    /// Returns the simulated time, s.
    #[must_use]
    pub fn time(&self) -> f64 {
        self.live.as_ref().map_or(0.0, LiveScene::time)
    }

    /// Returns the running scene.
    #[must_use]
    pub fn live(&self) -> Option<&LiveScene> {
        self.live.as_ref()
    }

    /// Returns the last significant contact: the last break, or the hardest impact that a body withstood.
    #[must_use]
    pub fn blow(&self) -> Option<&Arc<Blow>> {
        self.blow.as_ref()
    }

    /// Returns the commands since the scene was loaded, a script that reproduces the session.
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

    /// Returns the time series of the last contact, once requested.
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
        self.mode.clamp(1, analysis.asset.modes().count().max(1)) - 1
    }

    /// View of films.
    pub(crate) fn film_view(&self) -> View {
        self.look_from.unwrap_or(self.home)
    }
}
