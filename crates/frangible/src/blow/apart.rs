//! How pieces that have parted move once the blow is over.

use glam::DVec3;

/// How groups of nodes move against the rigid motion of the whole body, once the blow is over.
pub(crate) struct Apart {
    /// Group of each node of the fracture mesh; 0 is the reference.
    pub(crate) of_node: Vec<u32>,
    /// The motion of each group but the reference, whose own follows from those of the others.
    pub(crate) motions: Vec<GroupMotion>,
    /// Whether the reference is held, and so stands still.
    pub(crate) held: bool,
}

/// The rigid motion of a group of nodes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct GroupMotion {
    /// Centre of mass, m, frame of the fracture mesh.
    pub(crate) centre: DVec3,
    /// m/s.
    pub(crate) velocity: DVec3,
    /// rad/s.
    pub(crate) angular: DVec3,
}
