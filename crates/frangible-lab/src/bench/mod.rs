//! Benchmarks of `frangible`.
//!
//! - [`table1`]: the bodies of Table 1 of Glondu, Marchal, Dumont 2012 (`[G12]`), in the paper's model and in ours, beside the
//!   paper's times and those of the paper's algorithms word for word;
//! - [`contacts`]: how many contacts a second are refused, and how long one takes at worst;
//! - [`roofline`]: operations and bytes of the initiation against the machine's measured peaks;
//! - [`haptic`]: a loop of 1 kHz that feels a body, and how long its ticks take;
//! - [`shop`]: a thousand breakable things and a bull, and how long frames take;
//! - [`again`]: scenes whose pieces break again, played as a game does, and how long frames take;
//! - [`gallery`]: whole breaks of the gallery's bodies beside the project's goals;
//! - [`gpu`]: batches of impacts on the CPU and on a GPU;
//! - [`memory`]: what a body takes in a file and in memory;
//! - [`stages`]: single stages on a small body, for `cargo bench` and for counting instructions.
//!
//! [`page`] makes the sections of `docs/performance.md` of them.

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
