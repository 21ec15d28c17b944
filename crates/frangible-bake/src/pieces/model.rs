//! Choice of the method of computing the modes of a piece.

use std::sync::Arc;

use frangible::Body;
use frangible::internals::piece::{Elastic, PieceModel, Portion};

use crate::pieces::method::Method;
use crate::pieces::{PieceError, parent_modes, reanalysis};

/// Time that a thread takes for the parent's modes, and again for modes of the piece's own, for each tetrahedron, s: the median of
/// `docs/recursive.md`, rounded up.
const PER_TET: f64 = 12e-6;

/// Time that a thread takes in addition for modes of the piece's own, for each element, s: the median there, 0.25 ms, times what portable sums
/// take longer, rounded up.
const PER_ELEMENT: f64 = 0.4e-3;

/// Computes the modes of pieces by one of two methods.
#[derive(Debug)]
#[non_exhaustive]
pub struct Pieces {
    /// The method.
    pub method: Method,
    /// Approximate number of quadratic elements of a piece. Default `None`: chosen by size, see [`Pieces::elements_for`].
    pub elements: Option<usize>,
    /// Largest number of modes of a piece. Default 30.
    pub modes: usize,
}

impl Default for Pieces {
    fn default() -> Self {
        Self::new(Method::default())
    }
}

impl Pieces {
    /// Creates a model with this method.
    #[must_use]
    pub fn new(method: Method) -> Self {
        Self {
            method,
            elements: None,
            modes: 30,
        }
    }

    /// Returns the final method for a piece. [`Method::Auto`] computes every piece's own modes: in measurements on fragments of all
    /// scenes (`docs/recursive.md`), no method of similar speed was correct more often.
    #[must_use]
    pub fn method_for(&self) -> Method {
        match self.method {
            Method::Auto => Method::Reanalysis,
            method => method,
        }
    }

    /// Returns the approximate number of quadratic elements for a piece with `tets` uncut tetrahedra: [`Pieces::elements`] if set;
    /// otherwise 300 up to 2000 tetrahedra, then growing with the square root of their number up to 1000. The walls of a large piece
    /// bend more often along its length; with 300 elements its frequencies would be 10 % too high in the median.
    #[must_use]
    pub fn elements_for(&self, tets: usize) -> usize {
        let by_size = || {
            let growth = (tets as f64 / 2000.0).sqrt().clamp(1.0, 10.0 / 3.0);
            (300.0 * growth).round() as usize
        };
        self.elements.unwrap_or_else(by_size)
    }

    /// Computes the modes of a piece of `parent` with `method`, synchronously.
    ///
    /// # Errors
    /// The piece has no elements, or its matrices cannot be solved.
    pub fn elastic(
        &self,
        method: Method,
        portion: &Arc<Portion>,
        parent: &Body,
    ) -> Result<Elastic, PieceError> {
        match method {
            Method::ParentModes => parent_modes(portion, parent),
            Method::Reanalysis => {
                let elements = self.elements_for(portion.tets().len());
                reanalysis(portion, elements, self.modes)
            }
            Method::Auto => self.elastic(self.method_for(), portion, parent),
        }
    }
}

impl PieceModel for Pieces {
    fn at_once(&self, portion: &Arc<Portion>, parent: &Body) -> Option<Elastic> {
        let method = match self.method_for() {
            Method::Reanalysis => Method::ParentModes,
            method => method,
        };
        told(self.elastic(method, portion, parent))
    }

    fn later(&self, portion: &Arc<Portion>) -> Option<Elastic> {
        match self.method_for() {
            Method::Reanalysis => {
                let elements = self.elements_for(portion.tets().len());
                told(reanalysis(portion, elements, self.modes))
            }
            _ => None,
        }
    }

    fn expected_times(&self, tets: usize) -> [f64; 2] {
        let parents = PER_TET * tets as f64;
        match self.method_for() {
            Method::Reanalysis => {
                let elements = self.elements_for(tets) as f64;
                [parents, parents + PER_ELEMENT * elements]
            }
            _ => [parents, 0.0],
        }
    }
}

fn told(elastic: Result<Elastic, PieceError>) -> Option<Elastic> {
    elastic
        .inspect_err(|e| log::warn!("a piece cannot break again: {e}"))
        .ok()
}
