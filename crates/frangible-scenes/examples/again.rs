//! Breaks the body that breaks first in a scene by the same blow, over and over, for a profiler: `again SCENE SECONDS`, on one thread, or `again
//! SCENE SECONDS all`, on those that a world lends.

use std::error::Error;
use std::hint::black_box;
use std::time::{Duration, Instant};

use frangible::impact;
use frangible::internals::Threads;
use frangible_scenes::{bake, first_break, scene};

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [name, seconds, threads @ ..] = &arguments[..] else {
        return Err("usage: again SCENE SECONDS [all]".into());
    };
    let long = Duration::try_from_secs_f64(seconds.parse()?)?;
    let scene = scene(name)?;
    let baked = bake(&scene)?;
    let mut first = first_break(&scene, &baked, &mut |_| {})?
        .ok_or_else(|| format!("nothing breaks in the scene `{name}`"))?;
    if threads.is_empty() {
        first.config.threads = Threads::default();
    }
    first.body.prepare_for_blows(&first.config);
    let (clock, mut times, mut fastest) = (Instant::now(), 0_u32, Duration::MAX);
    while clock.elapsed() < long {
        let start = Instant::now();
        black_box(impact(
            &first.body,
            black_box(&first.contacts),
            &first.config,
        )?);
        times += 1;
        fastest = fastest.min(start.elapsed());
    }
    let each = clock.elapsed() / times.max(1);
    println!("{name}: {times} times, {each:.1?} each, the fastest {fastest:.1?}");
    Ok(())
}
