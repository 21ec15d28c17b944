//! Crack initiation of many impacts at once on a GPU.
//!
//! A blow well above the first bound of [`frangible::impact()`] costs the CPU a product `u = Φ q` per time step and a
//! stress per weak tetrahedron. Those are the paper's candidates for the GPU (`[G12 §4]`), and they are what is done
//! here, for all impacts of a batch, of bodies of any kinds. Per kind of body there are two chains of dispatches. The
//! first computes the modal response and a stress bound per time step, which comes back and says which steps need a
//! look. The second computes for those the bounds of clusters of tetrahedra, displacements, strains and largest principal
//! stresses, and per impact their peak and the first that passes the strength. Only that comes back.
//!
//! ```no_run
//! use frangible_lab::gpu::{Gpu, Impact};
//! # fn f(kind: frangible::Breakable, contacts: Vec<frangible::Contact>) -> Result<(), Box<dyn std::error::Error>> {
//! let gpu = Gpu::new()?;
//! let loaded = gpu.load(&kind)?;
//! let bodies: Vec<_> = (0..100).map(|seed| kind.body(seed)).collect();
//! let impacts: Vec<Impact> = bodies.iter().map(|body| Impact::new(&loaded, body, &contacts)).collect();
//! let outcomes = gpu.impacts(&impacts, &frangible::FractureConfig::with_given_impulses())?;
//! # Ok(()) }
//! ```
//!
//! # Division of work
//! The GPU computes in `f32` with roundings of its own, and so it decides only clear cases: an impact whose stress stays below 0.999 of the strength
//! at every weak point held. All others go on to the CPU, from the first time step in doubt, or from the first of all where the stress bound passes
//! fifty times the strength. So the cracks and the pieces are those of [`frangible::impact()`], bit for bit, on any GPU; stresses and margins in the
//! report of a body that held are the GPU's. A body with cracks from earlier impacts goes to the CPU, and so does every impact where flaws have a
//! size ([`FractureConfig::sized_flaws`](frangible::FractureConfig::sized_flaws)).
//!
//! # Accuracy
//! The response uses the recurrence of the CPU, stepped in `f32` from a state computed in `f64` every 64 steps; the measured error is 4e-6 of a
//! mode's largest amplitude, and the test allows 2e-5. Stress is evaluated at the same points as on the CPU
//! ([`Body::weak_place`](frangible::Body::weak_place)), by the same laws: inside, beside free surfaces, at edges, not at
//! flaws under a contact. Peak stresses of 120 impacts on three bodies differed by at most 6e-5 of the strength. Inside,
//! where two principal tensions are equal and `f32` cannot tell them apart, 2.4e-4 was met. 1e-3 is left to the CPU.
//!
//! # Requirements
//! Only WebGPU's default limits: 8 storage buffers per stage, bindings of 128 MiB, 256 invocations; no optional features and no atomics.
//! Software adapters (Mesa's lavapipe, Windows' WARP) work too.
//! They are useful only for tests: they are slower than the CPU for any batch size.

mod clock;
mod device;
mod error;
mod impacts;
mod initiation;
mod loaded;
mod passes;
mod response;
mod run;
mod scratch;
mod wave;

pub use clock::PassTime;
pub use device::Gpu;
pub use error::GpuError;
pub use impacts::{Impact, Verdict};
pub use initiation::{DOUBT, Exceedance, Initiation, LIST, initiation_on_cpu};
pub use loaded::Loaded;
