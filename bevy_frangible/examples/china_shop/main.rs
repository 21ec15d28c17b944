//! A thousand breakable things on boards, and a ball thrown through them: frame times without drawing.
//!
//! `cargo run --release --example china_shop [THINGS] [inside] [again]` prints the median, the 99th percentile and the longest frame while the
//! things come to rest, while they stand, and while the ball is among them. Things break after the step and within a budget; with `inside`
//! they break inside the step. With `again` fragments break again. `cargo run --release -p drawn --bin china_shop` draws it.

mod shop;

use std::time::{Duration, Instant};

use avian3d::prelude::*;
use bevy::mesh::MeshPlugin;
use bevy::prelude::*;
use bevy::time::TimeUpdateStrategy;
use bevy_frangible::prelude::*;
use shop::{Rules, furnish, kinds, rules, throw};

/// Frames per second, one step of physics each.
const RATE: f64 = 60.0;
/// Equal runs: of each frame the least time counts.
const RUNS: usize = 3;
/// Number of things that broke, and number of their pieces.
#[derive(Resource, Debug, Default, PartialEq)]
struct Count(usize, usize);

/// Times of frames that begin 1/60 s apart where they can, as in a game, ms.
fn frames(app: &mut App, count: usize) -> Vec<f64> {
    let mut next = Instant::now();
    (0..count)
        .map(|_| {
            std::thread::sleep(next.saturating_duration_since(Instant::now()));
            let start = Instant::now();
            next = start.max(next) + Duration::from_secs_f64(1.0 / RATE);
            app.update();
            1e3 * start.elapsed().as_secs_f64()
        })
        .collect()
}

/// The shop, at 60 frames per second.
fn shop(way: Rules) -> App {
    let mut app = App::new();
    let step = Duration::from_secs_f64(1.0 / RATE);
    app.add_plugins((
        MinimalPlugins,
        AssetPlugin::default(),
        TransformPlugin,
        MeshPlugin,
    ))
    .add_plugins(PhysicsPlugins::default().with_collision_hooks::<FrangibleHooks>())
    .add_plugins(FrangiblePlugin::default())
    .insert_resource(TimeUpdateStrategy::ManualDuration(step))
    .insert_resource(Time::<Fixed>::from_duration(step))
    .init_resource::<Count>()
    .add_observer(|broke: On<Broke>, mut count: ResMut<Count>| {
        count.0 += 1;
        count.1 += broke.fragments.len();
    });
    rules(&mut app, way);
    app.finish();
    app.cleanup();
    app
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let (mut things, mut way) = (1000, Rules::default());
    for word in std::env::args().skip(1) {
        match word.as_str() {
            "inside" => way.inside = true,
            "again" => way.again = true,
            number => things = number.parse()?,
        }
    }
    let kinds = kinds()?;
    let names = ["loading", "settling", "standing", "the ball"];
    let mut best: Vec<Vec<f64>> = Vec::new();
    let mut count = Count::default();
    for run in 0..RUNS {
        let mut app = shop(way);
        furnish(app.world_mut(), &kinds, things);
        let mut times = vec![frames(&mut app, 1), frames(&mut app, 60)];
        for _ in 0..60 {
            app.update();
        }
        times.push(frames(&mut app, 240));
        throw(app.world_mut())?;
        times.push(frames(&mut app, 240));
        let now = std::mem::take(&mut *app.world_mut().resource_mut::<Count>());
        if run == 0 {
            (best, count) = (times, now);
            continue;
        }
        if now != count {
            return Err(format!("two runs differ: {now:?} and {count:?}").into());
        }
        for (best, time) in best.iter_mut().flatten().zip(times.into_iter().flatten()) {
            *best = best.min(time);
        }
    }
    for (name, times) in names.iter().zip(&mut best) {
        times.sort_by(f64::total_cmp);
        let at = |share: f64| times[((times.len() - 1) as f64 * share).round() as usize];
        let [median, high, longest] = [0.5, 0.99, 1.0].map(at);
        println!("{name:>10}: median {median:6.2} ms, p99 {high:6.2} ms, longest {longest:6.2} ms");
    }
    println!("{things} things; {} broke into {} pieces", count.0, count.1);
    Ok(())
}
