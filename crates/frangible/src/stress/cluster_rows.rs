//! Rows of the stress at a body's weak points, cluster by cluster, as a body keeps them; cracks fill them in.

use std::sync::OnceLock;

use super::{Coarse, Frame, RowPoint, Rows, Sizes};

/// Rows of points, and of flaws with a size.
#[derive(Debug, Default)]
pub(crate) struct WeakRows(pub(crate) [OnceLock<Option<LawRows>>; 2]);

/// Rows of the clusters.
#[derive(Debug)]
pub(crate) struct LawRows {
    pub(crate) modes: usize,
    pub(crate) clusters: Vec<OnceLock<ClusterRows>>,
}

/// Rows of one cluster.
#[derive(Debug)]
pub(crate) struct ClusterRows {
    /// Its weak points, in their order, where nothing presses.
    pub(crate) points: Vec<RowPoint>,
    /// Their frames: each look reads them all, so that they lie side by side.
    pub(crate) frames: Vec<Frame>,
    pub(crate) rows: Rows,
    pub(crate) coarse: OnceLock<Option<Coarse>>,
    /// Bounds of the rows where no few shapes do.
    pub(crate) sizes: OnceLock<Sizes>,
    pub(crate) opposite: OnceLock<OppositeRows>,
}

/// Rows of the mirror images of a cluster's weak points behind the middle of the walls that they are in.
#[derive(Debug)]
pub(crate) struct OppositeRows {
    pub(crate) rows: Rows,
    /// Each point's image, and its first row; none of a point in no wall.
    pub(crate) images: Vec<Option<(RowPoint, usize)>>,
}
