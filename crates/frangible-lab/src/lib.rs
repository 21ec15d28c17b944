//! Validation and benchmarks of `frangible`. Not needed at run time, and not published.
//!
//! The program `frangible-lab` measures and writes the numbers as JSON into `docs/data`. The pages in `docs` are written by hand and quote these
//! files; `tools/plot.py` draws them.
//!
//! - [`verify`]: the physics, compared with closed-form solutions, published experiments and full analyses;
//! - [`figures`]: the numbers behind the figures of the paper on which the model is based;
//! - [`bench`](mod@bench): times, memory and instruction counts;
//! - [`reference`](mod@reference): a literal implementation of the paper's algorithms, with which the pipeline must agree;
//! - [`real_breaks`](mod@real_breaks): counts of cracks and pieces, for the comparison with descriptions of real breaks;
//! - [`sound`]: the sound of struck and broken bodies, compared with closed-form solutions and published spectra;
//! - [`compare`](mod@compare): other fracture methods, given the same impact;
//! - [`gpu`]: crack initiation of many impacts on a graphics card;
//! - [`data`] and [`page`]: the JSON files, and their quotation in pages.

pub mod bench;
pub mod compare;
pub mod data;
pub mod figures;
pub mod gpu;
pub mod page;
pub mod real_breaks;
pub mod reference;
pub mod sound;
pub mod verify;

/// Any error of a measurement, with a message that names its cause.
pub type Error = Box<dyn std::error::Error + Send + Sync>;

/// Result of a measurement.
pub type Result<T> = std::result::Result<T, Error>;

/// Receives the share of a measurement that is done, 0..=1, from any thread.
pub type Progress<'a> = &'a (dyn Fn(f64) + Sync);
