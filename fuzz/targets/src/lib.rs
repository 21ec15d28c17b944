//! Hostile bytes for the readers of files, for blows, worlds and scenes that run, and for the functions for C. Each target is a function that panics
//! if the input that its bytes describe is neither refused nor sound.
//!
//! The programs of the folder above give them libFuzzer's bytes; `tests/replay.rs` gives them the files of `fuzz/corpus`.

mod bodies;
mod body_state;
mod c_interface;
mod draw;
mod impact;
mod readers;
mod run_scene;
mod world;

pub use body_state::body_state;
pub use c_interface::c_interface;
pub use impact::{impact, impact_small};
pub use readers::{read_asset, read_gltf, read_obj, read_ply, read_scene, read_stl, read_tets};
pub use run_scene::run_scene;
pub use world::{world, world_small};

/// The text that the bytes begin with.
fn text(bytes: &[u8]) -> &str {
    bytes.utf8_chunks().next().map_or("", |chunk| chunk.valid())
}
