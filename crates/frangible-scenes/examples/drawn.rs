//! Measures where pieces lie at the end of scenes, as they are drawn: `drawn SCENE …`, all built-in scenes, or with `drawn made SEEDS [FIRST]` bodies of so
//! many seeds, from the first on. A measuring tool.
//!
//! A piece is off if a vertex lies deeper in the floor or in another piece, or if all of it is farther from both, than 0.5 % of its body's longest
//! side or 0.5 mm, whichever is more. Beside that: bodies and pieces whose surface has sides without exactly two faces, and the largest difference
//! of the volume in a drawn surface from the piece's own.

use std::error::Error;

use frangible_scenes::{Run, SCENE_NAMES, bake, play, scene};

#[path = "../tests/common/drawn.rs"]
mod drawn;

#[path = "../tests/common/made.rs"]
mod made;

use drawn::{Lie, closed, lies};

fn main() -> Result<(), Box<dyn Error>> {
    let asked: Vec<String> = std::env::args().skip(1).collect();
    println!(
        "| scene | at rest | off | in the floor, mm | in another, mm | apart, mm | drawn | open | volume off, % | of all, % |"
    );
    println!("|---|---|---|---|---|---|---|---|---|---|");
    if let [word, seeds, first @ ..] = &asked[..]
        && word == "made"
    {
        let first: u64 = first.first().map_or(Ok(0), |first| first.parse())?;
        for seed in first..first + seeds.parse::<u64>()? {
            let (scene, bodies) = made::made(seed)?;
            report(&play(&scene, &bodies, &mut |_| {})?);
        }
        return Ok(());
    }
    let wanted = |name: &&&str| asked.is_empty() || asked.iter().any(|a| a == **name);
    for name in SCENE_NAMES.iter().filter(wanted) {
        let scene = scene(name)?;
        let bodies = bake(&scene)?;
        report(&play(&scene, &bodies, &mut |_| {})?);
    }
    Ok(())
}

fn report(run: &Run) {
    let lies = lies(&run.recording);
    let off: Vec<&Lie> = lies.iter().filter(|lie| !lie.is_true()).collect();
    let most = |f: fn(&Lie) -> f64| 1e3 * lies.iter().map(f).fold(0.0, f64::max);
    let closed = closed(&run.recording);
    let open: Vec<_> = closed.iter().filter(|c| c.open_sides > 0).collect();
    let volume_off = closed.iter().map(|c| c.volume_off).fold(0.0, f64::max);
    let volume: f64 = closed.iter().map(|c| c.volume).sum();
    let off_in_all: f64 = closed.iter().map(|c| c.volume * c.volume_off).sum();
    println!(
        "| {} | {} | {} | {:.2} | {:.2} | {:.2} | {} | {} | {:.3} | {:.3} |",
        run.recording.name,
        lies.len(),
        off.len(),
        most(|lie| lie.in_floor),
        most(|lie| lie.in_other.0),
        most(|lie| lie.apart),
        closed.len(),
        open.len(),
        100.0 * volume_off,
        100.0 * off_in_all / volume,
    );
    for c in closed
        .iter()
        .filter(|c| c.open_sides > 0 || c.volume_off > 5e-3)
    {
        eprintln!(
            "{}: {} sides are open, the volume is off by {:.3} %",
            c.name,
            c.open_sides,
            100.0 * c.volume_off
        );
    }
    off.into_iter().for_each(|lie| eprintln!("{lie}"));
}
