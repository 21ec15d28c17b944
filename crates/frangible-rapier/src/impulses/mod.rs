//! Impulses and energies of a blow between bodies and pieces: the blow's own in place of the engine's, and what cracks cost.

pub(crate) mod blows;
pub(crate) mod exchange;
pub(crate) mod motion;
pub(crate) mod plain;
pub(crate) mod settle;
pub(crate) mod through;
