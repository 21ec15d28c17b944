//! Benchmarks of `frangible`.
//!
//! - [`table1`]: the bodies of Table 1 of Glondu, Marchal, Dumont 2012 (`[G12]`), with the paper's model and ours, compared with the
//!   paper's times and with a literal implementation of its algorithms;
//! - [`contacts`]: rate and worst-case time of rejected contacts;
//! - [`again`]: frame times of scenes with pieces that break again;
//! - [`gallery`]: whole breaks of the gallery's bodies, compared with the project's goals;
//! - [`roofline`]: speed of the initiation as a share of what the machine can do;
//! - [`stages`]: single stages on a small body, for counting instructions.
//!
//! A haptic loop, a shop of a thousand breakable things, batches on a GPU and the size of bodies in memory are examples
//! of this crate.

pub mod again;
pub mod cache;
pub mod contacts;
mod fingerprint;
pub mod gallery;
mod grid;
pub mod machine;
pub mod roofline;
pub mod stages;
pub mod stats;
pub mod subjects;
pub mod table1;

pub use fingerprint::Fingerprint;
