//! Which method serves which piece, and when.

use std::sync::{Arc, Mutex, PoisonError};

use frangible::Body;
use frangible::piece::{Elastic, PieceModel, Portion};

use crate::{PieceError, ProxyLibrary, parent_modes, quasi_static, reanalysis};

/// How to find the stress in a piece.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Method {
    /// The modes of the stored shape that it resembles most, scaled ([`ProxyLibrary`]).
    ModalProxy,
    /// Its parent's modes on its own elements ([`parent_modes`](crate::parent_modes())).
    ParentModes,
    /// Linear elasticity without inertia ([`quasi_static`](crate::quasi_static())).
    QuasiStatic,
    /// A small modal analysis of its own ([`reanalysis`](crate::reanalysis())); [`Method::ParentModes`] until it is ready.
    Reanalysis,
    /// By size: see [`Pieces::method_for`].
    #[default]
    Auto,
}

/// Finds how pieces vibrate, by one of four methods.
#[derive(Debug)]
#[non_exhaustive]
pub struct Pieces {
    /// The method.
    pub method: Method,
    /// Quadratic elements of a piece, about. Default 300: frequencies within a few per cent.
    pub elements: usize,
    /// Modes of a piece at most. Default 30.
    pub modes: usize,
    libraries: Mutex<Vec<Arc<ProxyLibrary>>>,
}

impl Default for Pieces {
    fn default() -> Self {
        Self::new(Method::default())
    }
}

impl Pieces {
    /// By this method.
    #[must_use]
    pub fn new(method: Method) -> Self {
        Self {
            method,
            elements: 300,
            modes: 30,
            libraries: Mutex::default(),
        }
    }

    /// The method that serves a piece of so many uncut tetrahedra, in the end. Here [`Method::Auto`] decides: a piece of fewer than 150 tetrahedra
    /// is stiff and rings above what a blow excites, so that statics will do; any other gets its own modes.
    #[must_use]
    pub fn method_for(&self, tets: usize) -> Method {
        match self.method {
            Method::Auto if tets < 150 => Method::QuasiStatic,
            Method::Auto => Method::Reanalysis,
            method => method,
        }
    }

    /// How a piece of `parent` vibrates, by one method and at once.
    ///
    /// # Errors
    /// A piece that has no elements, or whose matrices cannot be solved.
    pub fn elastic(
        &self,
        method: Method,
        portion: &Arc<Portion>,
        parent: &Body,
    ) -> Result<Elastic, PieceError> {
        match method {
            Method::ModalProxy => self.library(portion)?.fitted(portion),
            Method::ParentModes => parent_modes(portion, parent),
            Method::QuasiStatic => quasi_static(portion, self.elements),
            Method::Reanalysis => reanalysis(portion, self.elements, self.modes),
            Method::Auto => self.elastic(self.method_for(portion.tets().len()), portion, parent),
        }
    }

    /// The stored shapes for the piece's Poisson's ratio, baked when the first piece of that ratio asks; others wait for it.
    fn library(&self, portion: &Portion) -> Result<Arc<ProxyLibrary>, PieceError> {
        let ratio = portion.root().material.poisson_ratio;
        let known = self.libraries.lock();
        // What a panic may have left behind is whole: libraries are pushed when they are done.
        let mut known = known.unwrap_or_else(PoisonError::into_inner);
        if let Some(library) = known
            .iter()
            .find(|l| (l.poisson_ratio() - ratio).abs() < 1e-9)
        {
            return Ok(Arc::clone(library));
        }
        let library = Arc::new(ProxyLibrary::new(ratio, self.modes)?);
        known.push(Arc::clone(&library));
        Ok(library)
    }
}

impl PieceModel for Pieces {
    fn at_once(&self, portion: &Arc<Portion>, parent: &Body) -> Option<Elastic> {
        let method = match self.method_for(portion.tets().len()) {
            Method::Reanalysis => Method::ParentModes,
            method => method,
        };
        told(self.elastic(method, portion, parent))
    }

    fn later(&self, portion: &Arc<Portion>) -> Option<Elastic> {
        match self.method_for(portion.tets().len()) {
            Method::Reanalysis => told(reanalysis(portion, self.elements, self.modes)),
            _ => None,
        }
    }
}

fn told(elastic: Result<Elastic, PieceError>) -> Option<Elastic> {
    elastic
        .inspect_err(|e| log::warn!("a piece does not break again: {e}"))
        .ok()
}
