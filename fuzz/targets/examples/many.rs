//! Gives a target many inputs without the fuzzer: `many TARGET INPUTS SEED [FOLDER]`. Each is a seed file of the target's corpus, or of the folder, with
//! some bytes changed, put in, cut out or joined with those of another. An input that breaks the target is written to `many-TARGET-NUMBER`.
//!
//! The fuzzer looks for inputs that reach new code; this only changes those that are known, but needs neither its build nor a C++ compiler.

use std::error::Error;
use std::fs;
use std::panic::catch_unwind;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Longest input, bytes.
const LONGEST: usize = 2048;

/// SplitMix64.
struct Lots(u64);

impl Lots {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    fn below(&mut self, count: usize) -> usize {
        (self.next() % count.max(1) as u64) as usize
    }
}

fn changed(lots: &mut Lots, seeds: &[Vec<u8>]) -> Vec<u8> {
    let mut bytes = seeds[lots.below(seeds.len())].clone();
    for _ in 0..=lots.below(12) {
        let at = lots.below(bytes.len());
        match lots.below(6) {
            0 | 1 if !bytes.is_empty() => bytes[at] = lots.next() as u8,
            2 if !bytes.is_empty() => bytes[at] ^= 1 << lots.below(8),
            3 => {
                let more = (0..=lots.below(32)).map(|_| lots.next() as u8);
                bytes.splice(at..at, more.collect::<Vec<_>>());
            }
            4 => {
                let end = (at + lots.below(16)).min(bytes.len());
                bytes.drain(at..end);
            }
            _ => {
                let other = &seeds[lots.below(seeds.len())];
                bytes.truncate(at);
                bytes.extend(&other[at.min(other.len())..]);
            }
        }
    }
    bytes.truncate(LONGEST);
    bytes
}

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let usage = "usage: many TARGET INPUTS SEED [FOLDER]";
    let [name, inputs, seed, folder @ ..] = &arguments[..] else {
        return Err(usage.into());
    };
    let target: fn(&[u8]) = match name.as_str() {
        "impact_small" => frangible_fuzz_targets::impact_small,
        "world_small" => frangible_fuzz_targets::world_small,
        "impact" => frangible_fuzz_targets::impact,
        "world" => frangible_fuzz_targets::world,
        _ => return Err(format!("no target `{name}`; {usage}").into()),
    };
    let own = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../corpus")
        .join(name);
    let folder = folder.first().map_or(own, PathBuf::from);
    let mut files: Vec<PathBuf> = fs::read_dir(&folder)?
        .map(|entry| Ok(entry?.path()))
        .collect::<Result<_, std::io::Error>>()?;
    files.sort();
    let seeds: Vec<Vec<u8>> = files.iter().map(fs::read).collect::<Result<_, _>>()?;
    let mut lots = Lots(seed.parse()?);
    let (inputs, start, mut found) = (inputs.parse::<u64>()?, Instant::now(), 0);
    for number in 0..inputs {
        let bytes = changed(&mut lots, &seeds);
        if catch_unwind(|| target(&bytes)).is_err() {
            let path = format!("many-{name}-{seed}-{number}");
            fs::write(&path, &bytes)?;
            found += 1;
            println!("{path} breaks the target");
        }
        if number % 1_000 == 999 {
            let rate = (number + 1) as f64 / start.elapsed().as_secs_f64();
            println!(
                "{} inputs, {rate:.0} in a second, {found} found",
                number + 1
            );
        }
    }
    println!(
        "{inputs} inputs in {:.0} s, {found} found",
        start.elapsed().as_secs_f64()
    );
    Ok(())
}
