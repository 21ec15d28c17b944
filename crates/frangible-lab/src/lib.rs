//! The evidence for `frangible`: nothing here is needed to break anything, and nothing here is published.
//!
//! The program `frangible-lab` runs it all and writes the pages in `docs`.
//!
//! - [`verify`]: the physics against closed forms, published experiments and full analyses;
//! - [`figures`]: the figures of the paper that the model is taken from, each claim with a verdict;
//! - [`bench`](mod@bench): times, memory, counted instructions;
//! - [`reference`](mod@reference): the paper's algorithms word for word, which the pipeline must agree with;
//! - [`sound`]: struck and broken bodies, heard and drawn, beside closed forms and published spectra;
//! - [`page`] and [`plot`]: the tables and the charts of all these pages.

pub mod bench;
pub mod figures;
pub mod page;
pub mod plot;
pub mod reference;
pub mod sound;
pub mod verify;
