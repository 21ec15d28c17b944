//! No text makes the reader of scene files panic, and what it accepts is sound.
#![no_main]

use std::path::Path;

use libfuzzer_sys::fuzz_target;

fuzz_target!(|text: &str| {
    if let Ok(scene) = frangible_scenes::parse_scene(text, Path::new("")) {
        scene.validate().expect("a scene that was accepted");
        // Written and read again it may fail only where its paths or texts cannot be written.
        let _ =
            frangible_scenes::parse_scene(&frangible_scenes::scene_to_toml(&scene), Path::new(""));
    }
});
