//! Glondu, Marchal, Dumont, *Real-Time Simulation of Brittle Fracture Using Modal Analysis*, IEEE TVCG 2012, cited as
//! `[G12]`, word for word: the oracle that `frangible` is compared with.
//!
//! Everything in f64, one number at a time: at every step the displacements of all nodes, at every weak element the stress, and no bound that saves
//! work. It shares no code with the pipeline, only plain input (the arrays of an asset, contacts, weak points), the free surface (`Skin`), the noise
//! function and the random generator.
//!
//! | `[G12]` | here |
//! |---|---|
//! | Alg. 1, lines 2-14 | [`fracture`] (`initiation.rs`, lines marked) |
//! | Eq. 1, 2; most excited mode; longest of two bodies, shortest of several contacts (§4.1) | `contact.rs`: `touch`, `contact_duration`, `Force::new`; [`Duration`] |
//! | Eq. 3 (§4.2) | `contact.rs`: `time_step`; [`TimeStep`] |
//! | Eq. 4, 5 (§4.3) | `contact.rs`: `Force::{frequency, amplitude}` |
//! | "analytically compute the damped deformation wave" (§4.4, appendix) | `modes.rs`: `forced`; `body.rs`: `displacements` |
//! | Green-Lagrange strain, Hooke, principal stress (§4.4) | `stress.rs`; of our model at free surfaces `skin.rs` |
//! | where a crack starts (§4.4) | `initiation.rs`: `weak_elements`, `nearest_weak`; [`Initiation`] |
//! | Eq. 6-8 | `surface.rs`: `Surface::{s, bump}` |
//! | Eq. 9, 10 (§5.2.1) | `surface.rs`: `Surface::new` |
//! | crossed elements (§5.2.2) | `propagation.rs`: `crossing` |
//! | Eq. 11, 12, the stopping criterion (§5.2.3) | `propagation.rs`: `add`, `propagate`; [`EnergyTest`] |
//! | §5.2.4, Alg. 2 lines 1-15 | `propagation.rs`: `propagate` (lines marked) |
//! | node marks, flood fill (§6.1, 6.2) | `fragments.rs`; [`Marks`] |
//!
//! Not here: the triangles of §6.3, which `frangible` replaces by an exact partition with tests of its own.
//!
//! [`Options`] has an option for each passage whose print cannot be what was meant; the defaults are what `FractureConfig::as_in_the_paper` computes.
//! What the paper leaves open follows `frangible`: neighbours by rising number, cracks of one step by falling stress, Hooke's energy density ½ σ : ε,
//! and roughness in metres that passes through the start.
//!
//! [`agreement::compare`] finds the first difference between the pipeline and the reference, and how near the reference's own test was.

pub mod agreement;
pub mod bodies;
mod body;
mod contact;
mod fragments;
mod initiation;
mod modes;
mod options;
mod propagation;
mod skin;
mod stress;
mod surface;

pub use body::{Field, ReferenceError};
pub use initiation::{Break, StartTest, first_crack, fracture};
pub use options::{Duration, EnergyTest, Initiation, Marks, Options, Strain, TimeStep};
pub use propagation::{Crack, Element, Visit};
