//! The figures of `[G12]`, Glondu, Marchal, Dumont, *Real-Time Simulation of Brittle Fracture Using Modal Analysis*, IEEE
//! TVCG 2012, computed anew.
//!
//! A [`Figure`] computes the content of one of the paper's figures, draws it, and compares the paper's claims with measurements: each [`Claim`] is a
//! number against a criterion, so that "agrees" is computed and not written. [`FIGURES`] lists them all, [`compute`] makes some of them, [`page`]
//! makes a page of their results.

mod bodies;
mod draw;
mod each;
mod error;
mod figure;
pub mod page;
mod statistics;
mod workshop;

pub use error::FigureError;
pub use figure::{Claim, FIGURES, Figure, Findings, Picture, Table, compute, figures_named};
