//! How fast `frangible` is.
//!
//! - [`table1`]: the bodies of Table 1 of Glondu, Marchal, Dumont 2012 (`[G12]`), in the paper's model and in ours, beside the
//!   paper's times and those of the paper's algorithms word for word;
//! - [`contacts`]: how many contacts a second are refused, and how long one takes at worst;
//! - [`roofline`]: operations and bytes of the initiation against the machine's measured peaks;
//! - [`stages`]: single stages on a small body, for `cargo bench` and for counting instructions.
//!
//! [`page`] makes `docs/performance.md` of the first two.

pub mod cache;
pub mod contacts;
mod error;
mod grid;
pub mod machine;
pub mod page;
pub mod roofline;
pub mod stages;
pub mod stats;
pub mod subjects;
pub mod table1;

pub use error::BenchError;
