//! State that figures share: bodies that are baked once, and the progress.

use std::sync::Arc;

use frangible::Asset;

use crate::figures::FigureError;
use crate::figures::bodies;

/// Baked bodies and progress of one run.
pub(crate) struct Workshop<'a> {
    tell: &'a mut dyn FnMut(&str, f64),
    figures: usize,
    finished: usize,
    name: &'static str,
    slab: Option<Arc<Asset>>,
}

impl<'a> Workshop<'a> {
    pub(crate) fn new(tell: &'a mut dyn FnMut(&str, f64), figures: usize) -> Self {
        Self {
            tell,
            figures,
            finished: 0,
            name: "",
            slab: None,
        }
    }

    pub(crate) fn begin(&mut self, name: &'static str) {
        self.name = name;
        self.tell("", 0.0);
    }

    pub(crate) fn end(&mut self) {
        self.finished += 1;
    }

    /// Reports the current step, and the share of the figure that is done.
    pub(crate) fn tell(&mut self, what: &str, share: f64) {
        let all = (self.finished as f64 + share) / self.figures.max(1) as f64;
        (self.tell)(format!("{} {what}", self.name).trim_end(), all);
    }

    /// The slab of Figs. 5, 7 and 12.
    pub(crate) fn slab(&mut self) -> Result<Arc<Asset>, FigureError> {
        if self.slab.is_none() {
            self.tell("baking the slab", 0.0);
            self.slab = Some(bodies::slab()?);
        }
        self.slab.clone().ok_or(FigureError::Nothing("no slab"))
    }
}
