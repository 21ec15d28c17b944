//! What parts of the view model outside of the session ask of it.

use std::sync::Arc;

use frangible_export::View;

use super::Session;
use crate::analysis::Analysis;
use crate::command::{Mark, Subject};

impl Session {
    pub(crate) fn is_marked(&self, mark: Mark) -> bool {
        self.marks.contains(&mark)
    }

    pub(crate) fn subject(&self) -> Subject {
        self.subject
    }

    pub(crate) fn analysis(&self) -> Option<&Arc<Analysis>> {
        self.analysis.as_ref()
    }

    pub(crate) fn scrubbed(&self) -> f64 {
        self.scrub
    }

    pub(crate) fn exaggerated(&self) -> f64 {
        self.exaggeration
    }

    /// The mode that is looked at, from 0.
    pub(crate) fn mode_of(&self, analysis: &Analysis) -> usize {
        self.mode.clamp(1, analysis.asset.modes.count().max(1)) - 1
    }

    /// From where films are seen.
    pub(crate) fn film_view(&self) -> View {
        self.look_from.unwrap_or(self.home)
    }
}
