//! The ways that are compared.

use std::sync::Arc;

use frangible::Body;
use frangible::internals::{Elastic, Portion};
use frangible_bake::pieces::{Method, PieceError, Pieces};

/// A way to find how a piece vibrates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Way {
    /// Name in the tables.
    pub name: &'static str,
    /// The method; for [`Method::Auto`] the one that [`Pieces::method_for`] returns.
    pub method: Method,
    /// Quadratic elements and modes; none: those of [`Pieces::default`], by the piece's size.
    pub size: Option<(usize, usize)>,
}

/// All ways, in the order of the tables.
pub const WAYS: [Way; 6] = [
    Way {
        name: "parent's modes",
        method: Method::ParentModes,
        size: None,
    },
    Way {
        name: "reanalysis, 150 elements, 20 modes",
        method: Method::Reanalysis,
        size: Some((150, 20)),
    },
    Way {
        name: "reanalysis, 300 elements, 30 modes",
        method: Method::Reanalysis,
        size: Some((300, 30)),
    },
    Way {
        name: "reanalysis, 600 elements, 40 modes",
        method: Method::Reanalysis,
        size: Some((600, 40)),
    },
    Way {
        name: "reanalysis, 1500 elements, 80 modes",
        method: Method::Reanalysis,
        size: Some((1500, 80)),
    },
    Way {
        name: "auto",
        method: Method::Auto,
        size: None,
    },
];

/// Place of the way that sets the speeds of the blows.
pub(crate) const REANALYSIS: usize = 2;

/// The ways, ready to be asked.
pub(crate) struct Ways(Vec<Pieces>);

impl Ways {
    /// Makes all of [`WAYS`].
    pub(crate) fn new() -> Self {
        let ways = WAYS.map(|way| {
            let mut pieces = Pieces::new(way.method);
            if let Some((elements, modes)) = way.size {
                (pieces.elements, pieces.modes) = (Some(elements), modes);
            }
            pieces
        });
        Self(ways.into())
    }

    /// An earlier way that makes the same of a piece of so many tetrahedra.
    pub(crate) fn same_as(&self, way: usize, tets: usize) -> Option<usize> {
        let what = |i: usize| {
            let pieces = &self.0[i];
            let elements = pieces.elements_for(tets);
            (pieces.method_for(), elements, pieces.modes)
        };
        (0..way).find(|&i| what(i) == what(way))
    }

    /// Computes the elastic body that a way makes of a piece.
    pub(crate) fn elastic(
        &self,
        way: usize,
        portion: &Arc<Portion>,
        parent: &Body,
    ) -> Result<Elastic, PieceError> {
        self.0[way].elastic(WAYS[way].method, portion, parent)
    }
}
