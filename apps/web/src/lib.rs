//! Code that the page's two programs share: the object of the page's scripts that they call, and the browser's console.

#[cfg(target_arch = "wasm32")]
mod bridge;
#[cfg(target_arch = "wasm32")]
mod console;

#[cfg(target_arch = "wasm32")]
pub use bridge::{Bridge, offer, said};
