//! No call of the library for C panics, or writes where it fails, whatever its arguments are.

/// Makes the calls that the bytes describe.
pub fn c_interface(data: &[u8]) {
    let pane = include_bytes!("../../../crates/frangible/tests/bodies/pane.frangible");
    frangible_c::wild::wild(pane, data);
}
