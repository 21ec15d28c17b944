//! Dice of a tempered wall (beyond the paper): a network of cells in its mean plane, and prisms of them through its thickness.
//!
//! A crack that reaches the tension zone of a wall with enough stored energy forks until the wall is gone, in its plane and through all of its
//! thickness. [`Material`](crate::material::Material) says when, and how large the dice are in the mean. They are finer than the fracture mesh and do
//! not use it: `seeds.rs` scatters a point for each die about the place where the crack began, and `network.rs` makes prisms of the cells around
//! them.
//!
//! **Cells.** [`PlaneCells`](crate::mesh::PlaneCells) share all corners, do not overlap and leave nothing out, whatever the outline is, and three of them
//! meet at each corner, as where cracks fork. Voronoi cells are as regular, but have to be cut at the outline.
//!
//! **Clumps.** Dice interlock, and fall in clumps at first. A clump is all dice that lie nearest to a seed along the network, so it hangs together.
//! Its surface is closed and its inner cracks are drawn. A world may part it into smaller ones ([`Clump::part`]) down to single dice.
//!
//! The wall moves on as it did: the energy of its stress beyond that of the cracks goes into sound and heat here, and not into the dice.

mod clump;
mod network;
mod seeds;
mod surface;

use std::sync::Arc;

use glam::Vec3;

use crate::body::Body;
use crate::config::CRACK_SPEED;
use crate::fragment::Fragment;

pub use clump::Clump;
use network::Network;

/// A wall in clumps of dice.
pub(crate) struct Diced {
    pub(crate) fragments: Vec<Fragment>,
    pub(crate) clumps: Vec<Arc<Clump>>,
    /// Area of the cracks, m².
    pub(crate) crack_area: f64,
    /// Volume of the dice over that of the body, minus one.
    pub(crate) volume_error: f64,
}

/// Cuts the wall of a body into dice, from a place, m, frame of the fracture mesh, and a time, s, on. None where the body has no wall that dices.
pub(crate) fn dice(body: &Body, origin: Vec3, since: f64, clumps: usize) -> Option<Diced> {
    let (wall, asset) = (body.dicing_wall()?, &body.asset);
    let material = &asset.material;
    let mut network = Network::new(wall, origin.as_dvec3(), material.die_area(), body.seed())?;
    let volume = network.volume();
    network.density = asset.mass.mass / volume;
    (network.since, network.speed) = (since, CRACK_SPEED * material.rayleigh_speed());
    let crack_area = network.crack_area();
    let whole = Clump::whole(Arc::new(network), body.seed());
    let (fragments, clumps) = whole.part(clumps);
    Some(Diced {
        fragments,
        clumps,
        crack_area,
        volume_error: volume / asset.mass.volume - 1.0,
    })
}
