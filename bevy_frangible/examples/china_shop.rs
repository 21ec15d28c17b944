//! A thousand breakable things on boards, and a ball thrown through them: frame times without drawing.
//!
//! `cargo run --release --example china_shop [THINGS] [inside] [again]` prints the median, the 99th percentile and the longest frame while the
//! things come to rest, while they stand, and while the ball is among them. Things break after the step and within a budget; with `inside`
//! they break inside the step. With `again` fragments break again.

use std::sync::Arc;
use std::time::{Duration, Instant};

use avian3d::prelude::*;
use bevy::mesh::MeshPlugin;
use bevy::prelude::*;
use bevy::time::TimeUpdateStrategy;
use bevy_frangible::frangible::Material;
use bevy_frangible::frangible::internals::PieceModel;
use bevy_frangible::prelude::*;
use frangible_bake::pieces::Pieces;
use frangible_bake::{BakeSpec, Shape, bake};

/// Frames per second, one step of physics each.
const RATE: f64 = 60.0;
/// Equal runs: of each frame the least time counts.
const RUNS: usize = 3;
/// Boards, one behind the other and one above the other, and things on each: along and across.
const RACKS: usize = 5;
const BOARDS: usize = 5;
const PLACES: [usize; 2] = [20, 2];
/// From rack to rack, board to board and thing to thing, m.
const RACK: f32 = 1.2;
const BOARD: f32 = 0.4;
const PLACE: f32 = 0.17;
/// A ball of steel, m and m/s. It has no weight, so that it is over the board all the way.
const RADIUS: f32 = 0.08;
const SPEED: f32 = 8.0;

/// How many things broke, and into how many pieces.
#[derive(Resource, Debug, Default, PartialEq)]
struct Count(usize, usize);

/// A kind of thing, and how far its centre of mass is above its foot, m.
fn baked(name: &str, shape: Shape) -> Result<(FrangibleAsset, f32), Box<dyn std::error::Error>> {
    let spec = BakeSpec {
        modes: 40,
        fracture: Some(shape.size_for(1500.0)?),
        analysis: Some(shape.size_for(1500.0)?),
        ..BakeSpec::new(name, shape, Material::preset("porcelain")?)
    };
    let (asset, _) = bake(&spec, &mut |_| {})?;
    let lowest = asset.fracture.positions.iter().map(|p| p.z);
    let foot = -lowest.fold(f32::INFINITY, f32::min);
    Ok((FrangibleAsset::new(asset)?, foot))
}

fn kinds() -> Result<Vec<(FrangibleAsset, f32)>, Box<dyn std::error::Error>> {
    Ok(vec![
        baked("bowl", Shape::bowl())?,
        baked("vase", Shape::vase())?,
        baked("glass", Shape::drinking_glass())?,
    ])
}

fn furnish(app: &mut App, kinds: &[(FrangibleAsset, f32)], things: usize) {
    let mut assets = app.world_mut().resource_mut::<Assets<FrangibleAsset>>();
    let kinds: Vec<_> = (kinds.iter())
        .map(|(asset, foot)| (assets.add(asset.clone()), foot))
        .collect();
    let size = Vec3::new(PLACES[0] as f32 * PLACE, 0.02, PLACES[1] as f32 * PLACE);
    let mut put = 0;
    for (rack, board) in (0..RACKS).flat_map(|r| (0..BOARDS).map(move |b| (r, b))) {
        let middle = Vec3::new(0.0, BOARD * board as f32, RACK * rack as f32);
        let under = Transform::from_translation(middle - Vec3::Y * (0.5 * size.y));
        let board_of_wood = Collider::cuboid(size.x, size.y, size.z);
        app.world_mut()
            .spawn((RigidBody::Static, board_of_wood, under));
        for (i, j) in (0..PLACES[0]).flat_map(|i| (0..PLACES[1]).map(move |j| (i, j))) {
            if put == things {
                return;
            }
            let (asset, foot) = &kinds[(3 * i + j + board + rack) % kinds.len()];
            let along = (i as f32 - 0.5 * (PLACES[0] - 1) as f32) * PLACE;
            let across = (j as f32 - 0.5 * (PLACES[1] - 1) as f32) * PLACE;
            let upright = Quat::from_rotation_x(-std::f32::consts::FRAC_PI_2);
            let at = middle + Vec3::new(along, **foot, across);
            app.world_mut().spawn((
                Breakable(asset.clone()),
                Seed(put as u64),
                Transform::from_translation(at).with_rotation(upright),
            ));
            put += 1;
        }
    }
}

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
fn shop(inside: bool, again: bool) -> App {
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
    .insert_resource(BreakAgain {
        model: again.then(|| Arc::new(Pieces::default()) as Arc<dyn PieceModel>),
        ..BreakAgain::default()
    })
    .insert_resource(match inside {
        true => Breaking::InsideStep,
        false => Breaking::for_games(),
    })
    .insert_resource(ColliderDetail {
        whole: (1, 32),
        hull_volume_ratio: 3.0,
        ..ColliderDetail::default()
    })
    .insert_resource(SubstepCount(4))
    .insert_resource(DebrisBudget {
        pieces: 500,
        dust_mass: 1e-3,
        ..DebrisBudget::default()
    })
    .init_resource::<Count>()
    .add_observer(|broke: On<Broke>, mut count: ResMut<Count>| {
        count.0 += 1;
        count.1 += broke.fragments.len();
    });
    app.finish();
    app.cleanup();
    app
}

/// Throws the ball along the third board of the second rack, from the left.
fn throw(app: &mut App) -> Result<(), Box<dyn std::error::Error>> {
    let steel = Material::preset("steel")?;
    let start = Vec3::new(-3.0, 2.0 * BOARD + 0.12, RACK + 0.5 * PLACE);
    app.world_mut().spawn((
        RigidBody::Dynamic,
        Collider::sphere(RADIUS),
        ColliderDensity(steel.density as f32),
        MadeOf(steel),
        SweptCcd::default(),
        // Else Avian lets it bounce off the board's edge, which it passes.
        SpeculativeMargin(0.02),
        GravityScale(0.0),
        Transform::from_translation(start),
        LinearVelocity(Vec3::X * SPEED),
    ));
    Ok(())
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let (mut things, mut inside, mut again) = (1000, false, false);
    for word in std::env::args().skip(1) {
        match word.as_str() {
            "inside" => inside = true,
            "again" => again = true,
            number => things = number.parse()?,
        }
    }
    let kinds = kinds()?;
    let names = ["loading", "settling", "standing", "the ball"];
    let mut best: Vec<Vec<f64>> = Vec::new();
    let mut count = Count::default();
    for run in 0..RUNS {
        let mut app = shop(inside, again);
        furnish(&mut app, &kinds, things);
        let mut times = vec![frames(&mut app, 1), frames(&mut app, 60)];
        for _ in 0..60 {
            app.update();
        }
        times.push(frames(&mut app, 240));
        throw(&mut app)?;
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
