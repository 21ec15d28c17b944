//! The session's program in a browser: physics and bakes, without anything that draws. It runs in two kinds of workers of the page: one has
//! the session, and others, which come and go, bake for it.

#[cfg(target_arch = "wasm32")]
mod baker;
#[cfg(target_arch = "wasm32")]
mod desk;
#[cfg(target_arch = "wasm32")]
mod folder;

#[cfg(target_arch = "wasm32")]
fn main() {
    let Some(bridge) = frangible_web::Bridge::begin() else {
        return;
    };
    match bridge.get("bakes").is_truthy() {
        true => baker::start(),
        false => desk::start(bridge),
    }
}

#[cfg(not(target_arch = "wasm32"))]
fn main() {
    println!("this program runs only in a web page; `cargo xtask web` builds the page");
}
