//! Fragments in the place of a body that broke: their joints, those that break again, and those that rest.

pub(crate) mod clumps;
pub(crate) mod debris;
pub(crate) mod film;
pub(crate) mod joints;
pub(crate) mod loosen;
pub(crate) mod pieces;
pub(crate) mod replace;
pub(crate) mod rest;
pub(crate) mod rubble;
pub(crate) mod siblings;
