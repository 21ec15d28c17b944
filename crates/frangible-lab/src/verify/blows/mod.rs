//! Blows beside closed forms: plates as series of all their modes, Zener's infinite plate and St Venant's rod.

pub(crate) mod plate;
pub(crate) mod probe;
pub(crate) mod strike;
