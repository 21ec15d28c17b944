//! Physically based brittle fracture for JavaScript.
//!
//! [`plain`], [`drawn`] and [`hulls`] implement the package with plain numbers, on every platform. In a browser or in Node the module `bindings` exports
//! them to the script of the package, which is the public interface, described by `package/index.d.ts`.

#[cfg(target_arch = "wasm32")]
pub mod bindings;
pub mod drawn;
pub mod hulls;
#[cfg(target_arch = "wasm32")]
mod looks;
pub mod plain;
#[cfg(target_arch = "wasm32")]
mod start;
