//! Benchmarks of `frangible`.
//!
//! - [`table1`]: the bodies of Table 1 of Glondu, Marchal, Dumont 2012 (`[G12]`), with the paper's model and ours, compared with the
//!   paper's times and with a literal implementation of its algorithms;
//! - [`contacts`]: rate and worst-case time of rejected contacts;
//! - [`roofline`]: operations and bytes of the initiation, compared with the measured peaks of the machine;
//! - [`haptic`]: time per tick of a 1 kHz haptic loop;
//! - [`shop`]: frame times of a scene with a thousand breakable objects;
//! - [`again`]: frame times of scenes with pieces that break again;
//! - [`gallery`]: whole breaks of the gallery's bodies, compared with the project's goals;
//! - [`gpu`]: batches of impacts on the CPU and on a GPU;
//! - [`memory`]: size of bodies in files and in memory;
//! - [`stages`]: single stages on a small body, for `cargo bench` and for counting instructions.
//!
//! [`page`] writes the sections of `docs/performance.md`.

pub mod again;
pub mod cache;
pub mod contacts;
mod error;
mod fingerprint;
pub mod gallery;
pub mod gpu;
mod grid;
pub mod haptic;
pub mod machine;
pub mod memory;
pub mod page;
pub mod roofline;
pub mod shop;
pub mod stages;
pub mod stats;
pub mod subjects;
pub mod table1;

pub use error::BenchError;
pub use fingerprint::Fingerprint;
