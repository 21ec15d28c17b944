//! Bodies that are inserted into the world: breakable bodies, balls, floors, walls of bricks; their colliders and masses.

pub(crate) mod collider;
pub(crate) mod dispatch;
pub(crate) mod floor;
pub(crate) mod insert;
pub(crate) mod mass;
pub(crate) mod mortar;
pub(crate) mod polyhedra;
pub(crate) mod rigid;
