//! Start-up code of both modules of the package.

use wasm_bindgen::prelude::wasm_bindgen;

/// Called once, when the module is there.
#[wasm_bindgen(start)]
pub(crate) fn start() {
    // A panic names itself instead of being an unreachable instruction.
    std::panic::set_hook(Box::new(|panic| {
        wasm_bindgen::throw_str(&panic.to_string())
    }));
}
