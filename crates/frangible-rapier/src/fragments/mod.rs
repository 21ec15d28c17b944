//! What becomes of a body that broke: fragments in its place, their joints, and those that break again.

pub(crate) mod debris;
pub(crate) mod joints;
pub(crate) mod pieces;
pub(crate) mod replace;
pub(crate) mod rest;
pub(crate) mod siblings;
