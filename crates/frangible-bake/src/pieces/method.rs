//! Names of the methods.

/// Method by which the modes of a piece are found.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Method {
    /// Its parent's modes on its own elements ([`parent_modes`](crate::pieces::parent_modes())).
    ParentModes,
    /// A small modal analysis of its own ([`reanalysis`](crate::pieces::reanalysis())); [`Method::ParentModes`] until it is ready.
    Reanalysis,
    /// The method that was measured to be best: see [`Pieces::method_for`](crate::pieces::Pieces::method_for).
    #[default]
    Auto,
}
