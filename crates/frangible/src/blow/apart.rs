//! Rigid motions of parted pieces at the end of a blow.

use glam::DVec3;

/// Motions of groups of nodes at the end of a blow, relative to the rigid motion of the body.
pub(crate) struct Apart {
    /// Group of each node of the fracture mesh; 0 is the reference.
    pub(crate) of_node: Vec<u32>,
    /// Motion of each group but the reference, whose own follows from those of the others.
    pub(crate) motions: Vec<GroupMotion>,
    /// If true, the body has supports and its reference group stands still.
    pub(crate) held: bool,
}

/// Rigid motion of a group of nodes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct GroupMotion {
    /// Centre of mass, m, frame of the fracture mesh.
    pub(crate) centre: DVec3,
    /// Velocity of the centre, m/s.
    pub(crate) velocity: DVec3,
    /// Angular velocity, rad/s.
    pub(crate) angular: DVec3,
}
