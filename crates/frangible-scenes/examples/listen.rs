//! Plays built-in scenes, writes what they sound like, and tells how loud and how long that is.
//!
//!     cargo run --release -p frangible-scenes --example listen -- target/sound glass plate

use std::error::Error;
use std::path::PathBuf;

use frangible_export::write_atomically;
use frangible_scenes::{SCENE_NAMES, bake, play, scene, sound, sound_config};

fn main() -> Result<(), Box<dyn Error>> {
    let mut words = std::env::args().skip(1);
    let folder = PathBuf::from(words.next().ok_or("name a folder for the WAV files")?);
    std::fs::create_dir_all(&folder)?;
    let named: Vec<String> = words.collect();
    let all = SCENE_NAMES.map(String::from).to_vec();
    for name in if named.is_empty() { all } else { named } {
        let scene = scene(&name)?;
        let baked = bake(&scene, &mut |_| {})?;
        let run = play(&scene, &baked, &mut |_| {})?;
        let config = sound_config(&run, &scene);
        let heard = sound(&run, &scene, &config)?;
        write_atomically(&folder.join(format!("{name}.wav")), &heard.wav()?)?;
        let recording = &run.recording;
        let first = recording.blows.first().map_or(f64::NAN, |blow| blow.time);
        let cracks: usize = recording.blows.iter().map(|blow| blow.cracks.len()).sum();
        println!(
            "{name}: {} pieces, {:.1} s, loudest {:.1} dB, first blow at {first:.4} s, {} blows, {cracks} cracks, {} touches, {} slides; {:.2} s to make ready, {:.2} s of \
             synthesis; {:?}",
            run.breaks.iter().map(|b| b.masses.len()).sum::<usize>(),
            heard.duration(),
            heard.peak_level(),
            recording.blows.len(),
            recording.touches.len(),
            recording.slides.len(),
            heard.seconds[0],
            heard.seconds[1],
            heard.report
        );
    }
    Ok(())
}
