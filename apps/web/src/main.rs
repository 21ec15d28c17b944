//! The viewer's window in a browser; `cargo xtask web` makes a page of it and of the session's program.

#[cfg(target_arch = "wasm32")]
mod page;

#[cfg(target_arch = "wasm32")]
fn main() {
    if let Some(bridge) = frangible_web::Bridge::begin() {
        page::start(bridge);
    }
}

#[cfg(not(target_arch = "wasm32"))]
fn main() {
    println!("this program runs in a page: `cargo xtask web` makes it");
}
