//! Physically based brittle fracture for JavaScript.
//!
//! [`plain`] implements the package with plain numbers, on every platform. In a browser or in Node the module `bindings` exports it to the script of
//! the package, which is the public interface, described by `package/index.d.ts`.

#[cfg(target_arch = "wasm32")]
pub mod bindings;
pub mod plain;
#[cfg(target_arch = "wasm32")]
mod start;
