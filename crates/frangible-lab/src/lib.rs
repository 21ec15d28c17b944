//! Validation and benchmarks of `frangible`. Not needed at run time, and not published.
//!
//! The program `frangible-lab` runs them and writes the pages in `docs`.
//!
//! - [`verify`]: the physics, compared with closed-form solutions, published experiments and full analyses;
//! - [`figures`]: the figures of the paper on which the model is based, with a verdict on each claim;
//! - [`bench`](mod@bench): times, memory and instruction counts;
//! - [`reference`](mod@reference): a literal implementation of the paper's algorithms, with which the pipeline must agree;
//! - [`sound`]: the sound of struck and broken bodies, compared with closed-form solutions and published spectra;
//! - [`page`] and [`plot`]: the tables and charts of these pages.

pub mod bench;
pub mod figures;
pub mod page;
pub mod plot;
pub mod reference;
pub mod sound;
pub mod verify;
