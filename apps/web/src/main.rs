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
    println!("this program runs only in a web page; `cargo xtask web` builds the page");
}
