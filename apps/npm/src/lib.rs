//! Bodies that break for physical reasons, for JavaScript.
//!
//! [`plain`] is what the package can do, in plain numbers; it is the same on every machine. In a browser or in Node the module `bindings`
//! gives it to the package's script, which is what its users meet: `package/index.d.ts` tells how.

#[cfg(target_arch = "wasm32")]
pub mod bindings;
pub mod plain;
#[cfg(target_arch = "wasm32")]
mod start;
