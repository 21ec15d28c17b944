//! Bodies that break for physical reasons, for JavaScript.
//!
//! [`plain`] is the package's function in plain numbers; it is the same on every machine. In a browser or in Node the module `bindings` gives it to
//! the package's script, which is the users' interface: `package/index.d.ts` describes it.

#[cfg(target_arch = "wasm32")]
pub mod bindings;
pub mod plain;
#[cfg(target_arch = "wasm32")]
mod start;
