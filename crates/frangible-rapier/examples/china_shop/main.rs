//! A bull in a china shop: a thousand breakable things, a ball of 400 kg, frame times.
//!
//! `cargo run --release -p frangible-rapier --example china_shop -- [inside|after|after8000,8] [runs] [seconds]`: breaks inside the
//! step as scenes do by default, or after it with this budget and delay.
//!
//! Every run gives the same bits, so a frame's time is its least over the runs, and percentiles are over frames.

mod crockery;
mod shop;

use std::hash::{DefaultHasher, Hash, Hasher};
use std::time::Instant;

use frangible_rapier::{BreakableWorld, Breaking, ColliderDetail, WorldConfig};

/// Frames per second, and physics steps per frame.
const FRAME_RATE: f32 = 60.0;
const STEPS: usize = 1;
/// Frames for the things to come to rest before the bull comes.
const SETTLE: usize = 90;

/// Times of a frame, s.
#[derive(Clone, Copy, Default)]
struct Frame {
    all: f64,
    rigid: f64,
    parts: [f64; 7],
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let asked: Vec<String> = std::env::args().skip(1).collect();
    let number =
        |i: usize, default: usize| asked.get(i).and_then(|a| a.parse().ok()).unwrap_or(default);
    let (runs, seconds) = (number(1, 5), number(2, 4));
    let kinds = crockery::bake_all()?;
    for kind in &kinds {
        let asset = kind.breakable.asset();
        println!(
            "{}: {} tetrahedra, {} modes, {} convex cells, {:.2} kg, {:.2} MB shared",
            asset.name,
            asset.fracture.tets.len(),
            asset.modes.count(),
            asset.cells.len(),
            asset.mass.mass,
            crockery::bytes(kind) as f64 / 1e6
        );
    }
    let mut best: Vec<Frame> = Vec::new();
    let mut first = None;
    for run in 0..runs {
        let (frames, print) = play(
            &kinds,
            asked.first().map_or("after", |s| s),
            seconds,
            run == 0,
        )?;
        let known = *first.get_or_insert(print);
        println!(
            "run {run}: fingerprint {print:016x}{}",
            if known == print { "" } else { " DIFFERS" }
        );
        if best.is_empty() {
            best = frames;
        } else {
            for (best, frame) in best.iter_mut().zip(frames) {
                best.all = best.all.min(frame.all);
                best.rigid = best.rigid.min(frame.rigid);
                for (b, f) in best.parts.iter_mut().zip(frame.parts) {
                    *b = b.min(f);
                }
            }
        }
    }
    table(&best);
    Ok(())
}

fn config(mode: &str) -> WorldConfig {
    let mut config = WorldConfig::default();
    config.dt = 1.0 / (FRAME_RATE * STEPS as f32);
    if mode.starts_with("after") {
        let number = |i: usize| {
            mode[5..]
                .split(',')
                .nth(i)
                .and_then(|n| n.parse().ok())
                .unwrap_or([8000, 8][i])
        };
        config.fracture.samples_per_period = 4.0;
        config.breaking = Breaking::AfterStep {
            budget: number(0),
            delay: number(1),
        };
        config.whole_collider = ColliderDetail {
            parts: 1,
            // With half as many a foot has too few corners to stand on, and bottles fall over.
            hull_points: 64,
        };
        config.fragment_collider = ColliderDetail {
            parts: 4,
            hull_points: 24,
        };
        config.hull_volume_ratio = 3.0;
        config.debris_mass = 3e-3;
        config.dust_mass = 1e-3;
        config.fracture.crumb_share = 5e-3;
        config.impact_speed = 1.0;
    }
    config
}

fn play(
    kinds: &[crockery::Kind],
    mode: &str,
    seconds: usize,
    talk: bool,
) -> Result<(Vec<Frame>, u64), Box<dyn std::error::Error>> {
    let before = resident();
    let shop::Shop { mut world, things } = shop::furnish(kinds, config(mode), 7)?;
    let mut settling = Vec::new();
    for _ in 0..SETTLE {
        settling.push(frame(&mut world)?.0);
    }
    if talk {
        println!(
            "before the bull: {} things, {} bodies asleep of {}, {} broken",
            things.len(),
            asleep(&world),
            world.physics.bodies.len(),
            things.len() - world.breakables().count()
        );
        // The bake leaves free memory behind: the first shops fill it.
        let mut shops = Vec::new();
        let mut used = Vec::new();
        for _ in 0..7 {
            shops.push(shop::furnish(kinds, config(mode), 7)?);
            used.push(resident());
        }
        let shop = (used[6] - used[2]) / 4.0;
        let per_thing = shop * 1024.0 / things.len() as f64;
        println!("memory: {shop:.1} MB for a shop, {per_thing:.1} kB per thing");
        println!("frame times while all is awake:");
        table(&settling[2..20]);
    }
    let bull = shop::let_in(&mut world)?;
    let mut frames = Vec::new();
    let (mut breaks, mut pieces) = (0, 0);
    for i in 0..seconds * FRAME_RATE as usize {
        let (times, broke, made) = frame(&mut world)?;
        frames.push(times);
        breaks += broke;
        pieces += made;
        if talk && i % 20 == 19 {
            println!(
                "{:.2} s: bull at {:.2} m, {:.1} m/s, {} wait, {breaks} broken into {pieces}, {} bodies, {} awake, {} pairs, {:.1} ms, of it Rapier {:.1} ms",
                (i + 1) as f32 / FRAME_RATE,
                world.physics.bodies[bull].translation().z,
                world.physics.bodies[bull].linvel().z,
                world.waiting().count(),
                world.physics.bodies.len(),
                world.physics.bodies.len() - asleep(&world),
                world.physics.narrow_phase.contact_pairs().count(),
                1e3 * times.all,
                1e3 * times.rigid
            );
        }
    }
    if talk {
        let now = resident() - before;
        println!("memory in the end: {now:.1} MB more than before the shop was furnished");
    }
    Ok((frames, fingerprint(&world)))
}

fn asleep(world: &BreakableWorld) -> usize {
    let bodies = world.physics.bodies.iter();
    bodies
        .filter(|(_, b)| b.is_sleeping() || b.is_fixed())
        .count()
}

fn frame(world: &mut BreakableWorld) -> Result<(Frame, usize, usize), Box<dyn std::error::Error>> {
    let mut sum = Frame::default();
    let (mut breaks, mut pieces) = (0, 0);
    for _ in 0..STEPS {
        let start = Instant::now();
        let events = world.step()?;
        breaks += events.len();
        pieces += events.iter().map(|e| e.fragments.len()).sum::<usize>();
        sum.all += start.elapsed().as_secs_f64();
        let t = world.timings();
        sum.rigid += t.rigid;
        for (sum, part) in sum.parts.iter_mut().zip([
            t.undone,
            t.copies,
            t.contacts,
            t.fracture,
            t.fragments,
            t.loads,
            t.upkeep,
        ]) {
            *sum += part;
        }
    }
    Ok((sum, breaks, pieces))
}

fn fingerprint(world: &BreakableWorld) -> u64 {
    let mut hash = DefaultHasher::new();
    for (_, body) in world.physics.bodies.iter() {
        let (p, v) = (body.position(), body.linvel());
        for x in [p.translation.to_array(), v.to_array()].concat() {
            x.to_bits().hash(&mut hash);
        }
    }
    hash.finish()
}

fn table(frames: &[Frame]) {
    println!(
        "{:>12} {:>8} {:>8} {:>8} {:>8}",
        "ms", "median", "p99", "worst", "mean"
    );
    let row = |name: &str, of: &dyn Fn(&Frame) -> f64| {
        let mut times: Vec<f64> = frames.iter().map(|f| 1e3 * of(f)).collect();
        times.sort_by(f64::total_cmp);
        let at = |share: f64| times[((times.len() - 1) as f64 * share).ceil() as usize];
        let mean = times.iter().sum::<f64>() / times.len() as f64;
        println!(
            "{name:>12} {:8.2} {:8.2} {:8.2} {mean:8.2}",
            at(0.5),
            at(0.99),
            at(1.0)
        );
    };
    row("frame", &|f| f.all);
    row("Rapier", &|f| f.rigid);
    row("ours", &|f| f.all - f.rigid);
    for (i, name) in [
        "undone",
        "copies",
        "contacts",
        "fracture",
        "fragments",
        "loads",
        "upkeep",
    ]
    .iter()
    .enumerate()
    {
        row(name, &|f| f.parts[i]);
    }
}

/// Memory of this process, MB; 0 where the system does not tell.
fn resident() -> f64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find(|l| l.starts_with("VmRSS:"));
    let kilobytes = line.and_then(|l| l.split_whitespace().nth(1)?.parse::<f64>().ok());
    kilobytes.unwrap_or(0.0) / 1024.0
}
