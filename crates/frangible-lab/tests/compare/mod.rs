//! Other fracture methods.

mod common;
mod division;
mod methods;
