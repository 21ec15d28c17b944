//! Physically based brittle fracture for C and C++.
//!
//! The exported functions have the prefix `frangible_`. `include/frangible.h` declares them; `cargo xtask c` makes that header from this crate with
//! cbindgen, and installs it with the libraries.
//!
//! This is the only crate of the repository with `unsafe` code. [`memory`] reads and writes through the pointers of a caller, and nothing else does.
//! Handles are numbers in a [`registry`], not pointers, so no handle, freed or invented, is ever dereferenced. [`entry`] catches panics.
//!
//! # Safety
//! The contract of every exported function: a pointer is null, or points to what the function's documentation says, in memory that is valid for the
//! call and that no other thread changes meanwhile. A null or misaligned pointer, a wrong `size`, and every number are checked, and give an error.

mod arrays;
mod blow;
mod body;
mod breakable;
mod entry;
mod looks;
mod memory;
mod outcome;
mod registry;
mod types;
#[doc(hidden)]
pub mod wild;

pub use blow::*;
pub use body::*;
pub use breakable::*;
pub use entry::{frangible_error_text, frangible_status};
pub use looks::*;
pub use outcome::*;
pub use registry::frangible_live_handles;
pub use types::*;
