//! Contacts of Rapier, turned into an impact that the fracture understands.

pub(crate) mod contacts;
pub(crate) mod friction;
pub(crate) mod partner;
pub(crate) mod surface;
