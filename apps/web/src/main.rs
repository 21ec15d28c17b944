//! The viewer in a browser; `cargo xtask web` makes a page of it.

#[cfg(target_arch = "wasm32")]
mod bridge;
#[cfg(target_arch = "wasm32")]
mod console;
#[cfg(target_arch = "wasm32")]
mod host;
#[cfg(target_arch = "wasm32")]
mod page;
#[cfg(target_arch = "wasm32")]
mod session;

#[cfg(target_arch = "wasm32")]
fn main() {
    // One program for both: a worker has no document.
    let Some(bridge) = bridge::Bridge::find() else {
        return;
    };
    bridge.report_panics();
    console::start();
    // Every browser that runs the program has vectors: their instructions are in it, used or not.
    pulp_wasm_simd_flag::enable_simd128();
    match bridge.is_in_worker() {
        true => session::start(bridge),
        false => page::start(bridge),
    }
}

#[cfg(not(target_arch = "wasm32"))]
fn main() {
    println!("this program runs in a page: `cargo xtask web` makes it");
}
