//! Methods of computing the modes of pieces.

/// Method of computing the modes of a piece.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Method {
    /// The parent's modes on the piece's own elements ([`parent_modes`](crate::pieces::parent_modes())).
    ParentModes,
    /// A small modal analysis of the piece ([`reanalysis`](crate::pieces::reanalysis())); [`Method::ParentModes`] until it is ready.
    Reanalysis,
    /// The most accurate method in measurements: see [`Pieces::method_for`](crate::pieces::Pieces::method_for).
    #[default]
    Auto,
}
