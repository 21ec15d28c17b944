//! Many bodies: breaks after the step within a budget, on any number of threads, and the work that is spared.

use std::sync::Arc;

use crate::common::baked::{block, shelf};
use crate::common::{at, body, box_asset, relative, slicer};
use frangible::glam::Vec3;
use frangible::internals::{Force, LookedAt, is_harmless, rest, rest_margin_at_least};
use frangible::{Contact, FractureConfig, Outcome, Striker, impact};
use frangible_rapier::rapier3d::dynamics::{RigidBodyBuilder, RigidBodyHandle};
use frangible_rapier::rapier3d::geometry::ShapeType;
use frangible_rapier::rapier3d::math::Vector;
use frangible_rapier::{
    Ball, BreakableWorld, Breaking, ColliderDetail, SurfaceProperties, WorldConfig,
};

const HALF: Vec3 = Vec3::new(0.1, 0.1, 0.004);
const CELLS: [usize; 3] = [3, 3, 1];
const TETS: usize = 6 * 9;

fn world(breaking: Breaking, change: impl Fn(&mut WorldConfig)) -> BreakableWorld {
    let mut config = WorldConfig::default();
    config.gravity = Vector::ZERO;
    config.breaking = breaking;
    config.record_held = true;
    change(&mut config);
    let mut world = BreakableWorld::new(config).unwrap();
    world.set_break_function(slicer(HALF, [3, 3, 1], 0.0, 0.01));
    world
}

/// Panes in a row and a ball on its way to each: all are hit in one step.
fn firing_squad(world: &mut BreakableWorld, count: usize) -> Vec<RigidBodyHandle> {
    let asset = box_asset(HALF, CELLS);
    (0..count)
        .map(|i| {
            let x = 0.5 * i as f32;
            let pane = world
                .insert(
                    body(&asset),
                    RigidBodyBuilder::dynamic().pose(at(x, 0.0, 0.0)),
                )
                .unwrap();
            let ball = Ball {
                mass: 0.2,
                radius: 0.02,
            };
            let pose = at(x + 0.03, 0.02, -0.2);
            let fast = Vector::new(0.0, 0.0, 6.0);
            let steel = SurfaceProperties::STEEL;
            world.insert_ball(ball, steel, pose, fast).unwrap();
            pane
        })
        .collect()
}

/// Steps and what broke in each, until all is quiet.
fn breaks(world: &mut BreakableWorld, steps: usize) -> Vec<(u64, Vec<RigidBodyHandle>)> {
    let mut all = Vec::new();
    for _ in 0..steps {
        let events = world.step().unwrap();
        if let Some(first) = events.first() {
            all.push((first.step, events.iter().map(|e| e.parent).collect()));
        }
    }
    all
}

#[test]
fn a_budget_spreads_breaks_over_steps_in_the_order_of_the_blows() {
    let breaking = Breaking::AfterStep {
        budget: 2 * TETS,
        delay: 0,
    };
    let mut world = world(breaking, |_| {});
    let panes = firing_squad(&mut world, 5);
    let mut seen = Vec::new();
    for _ in 0..60 {
        let parents: Vec<_> = world.step().unwrap().iter().map(|e| e.parent).collect();
        if parents.is_empty() {
            continue;
        }
        seen.extend(parents.iter().copied());
        let waiting: Vec<_> = world.waiting().collect();
        assert_eq!(waiting, panes[seen.len()..], "the others wait, in order");
        for &handle in &waiting {
            assert!(world.breakable(handle).is_some(), "and are whole");
            let speed = world.physics.bodies[handle].linvel().length();
            assert!(speed > 0.1, "and move as what was hit: {speed} m/s");
        }
        assert!(parents.len() <= 2);
    }
    assert_eq!(seen, panes);
    assert_eq!((world.snapshots(), world.undone_steps()), (0, 0));
}

#[test]
fn at_least_one_body_breaks_per_step_however_small_the_budget() {
    let breaking = Breaking::AfterStep {
        budget: 1,
        delay: 0,
    };
    let mut world = world(breaking, |_| {});
    let panes = firing_squad(&mut world, 3);
    let all = breaks(&mut world, 60);
    let first = all[0].0;
    let expected: Vec<_> = panes
        .iter()
        .zip(first..)
        .map(|(&p, s)| (s, vec![p]))
        .collect();
    assert_eq!(all, expected);
}

#[test]
fn a_delay_puts_every_break_off_by_so_many_steps() {
    let after = |delay| {
        let breaking = Breaking::AfterStep {
            budget: usize::MAX,
            delay,
        };
        let mut world = world(breaking, |_| {});
        firing_squad(&mut world, 3);
        breaks(&mut world, 60)
    };
    let (at_once, later) = (after(0), after(7));
    assert_eq!((at_once.len(), later.len()), (1, 1));
    assert_eq!(later[0].0, at_once[0].0 + 7);
    assert_eq!(later[0].1, at_once[0].1);
}

#[test]
fn no_more_is_under_way_than_the_budget_allows_in_the_time_of_the_delay() {
    let breaking = Breaking::AfterStep {
        budget: TETS / 2,
        delay: 6,
    };
    let mut world = world(breaking, |_| {});
    let panes = firing_squad(&mut world, 6);
    let all = breaks(&mut world, 60);
    let order: Vec<_> = all
        .iter()
        .flat_map(|(_, parents)| parents.clone())
        .collect();
    assert_eq!(order, panes, "all break, in the order of the blows");
    // Three are under way at once: one begins in each of three steps, and the next three when those are done.
    let first = all[0].0;
    let steps: Vec<u64> = all.iter().map(|(step, _)| step - first).collect();
    assert_eq!(steps, [0, 1, 2, 7, 8, 9]);
}

#[test]
fn momentum_stays_and_energy_never_rises_when_bodies_break_after_the_step() {
    for delay in [0, 5] {
        let breaking = Breaking::AfterStep { budget: 1, delay };
        let mut world = world(breaking, |_| {});
        firing_squad(&mut world, 3);
        let (momentum, spin) = (world.momentum(), world.angular_momentum());
        let mut broke = 0;
        for _ in 0..60 {
            world.step().unwrap();
            broke += world.breaks().len();
            for event in world.breaks() {
                assert!(event.kinetic_after <= event.kinetic_before * (1.0 + 1e-6));
                assert!(event.energy_paid > 0.0, "the cracks are paid for");
            }
            let drift = relative(momentum, world.momentum());
            assert!(drift < 1e-4, "momentum changed by {drift}");
            let drift = relative(spin, world.angular_momentum());
            assert!(drift < 0.02, "angular momentum changed by {drift}");
        }
        assert_eq!(broke, 3);
    }
}

#[test]
fn any_number_of_threads_gives_the_same_bits() {
    let ways = [
        Breaking::InsideStep,
        Breaking::AfterStep {
            budget: usize::MAX,
            delay: 0,
        },
        Breaking::AfterStep {
            budget: 2 * TETS,
            delay: 3,
        },
    ];
    for breaking in ways {
        let run = || {
            let mut world = world(breaking, |_| {});
            // Real fractures, some milliseconds each.
            world.set_break_function(impact);
            for i in 0..6 {
                let pose = at(0.0, 0.3 * i as f32, 0.0);
                let speed = Vector::new(0.0, 0.0, -6.0);
                let spin = Vector::new(0.3, 0.1 * i as f32, 0.2);
                world
                    .insert(
                        body(block()),
                        RigidBodyBuilder::dynamic()
                            .pose(pose)
                            .linvel(speed)
                            .angvel(spin),
                    )
                    .unwrap();
            }
            let wall = Vector::new(5.0, 5.0, 0.1);
            let pose = at(0.0, 0.0, -0.2);
            world
                .insert_fixed_box(wall, pose, SurfaceProperties::STONE)
                .unwrap();
            let mut broke = 0;
            for _ in 0..40 {
                broke += world.step().unwrap().len();
            }
            let bits: Vec<[u32; 6]> = world
                .physics
                .bodies
                .iter()
                .map(|(_, b)| {
                    let (p, v) = (b.translation(), b.linvel());
                    [p.x, p.y, p.z, v.x, v.y, v.z].map(f32::to_bits)
                })
                .collect();
            (broke, bits)
        };
        let threads = |n: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(n).build();
            pool.unwrap().install(run)
        };
        let one = threads(1);
        assert!(one.0 > 1, "several bodies break: {}", one.0);
        assert!(one == threads(2) && one == threads(4), "{breaking:?}");
    }
}

#[test]
fn dust_has_no_collider_and_goes_after_a_second() {
    let mut world = world(Breaking::InsideStep, |config| config.dust_mass = 1.0);
    firing_squad(&mut world, 1);
    let fragments: Vec<_> = (0..60)
        .find_map(|_| world.step().unwrap().first().map(|e| e.fragments.clone()))
        .unwrap();
    assert_eq!(fragments.len(), 9);
    for &f in &fragments {
        assert!(world.physics.bodies[f].colliders().is_empty());
        assert!(world.physics.bodies[f].mass() > 0.0);
    }
    for _ in 0..250 {
        world.step().unwrap();
    }
    assert!(fragments.iter().all(|&f| !world.physics.bodies.contains(f)));
}

#[test]
fn a_collider_has_no_more_parts_than_asked_for() {
    for (parts, shape) in [
        (1, ShapeType::ConvexPolyhedron),
        (4, ShapeType::Compound),
        (usize::MAX, ShapeType::Compound),
    ] {
        let mut world = world(Breaking::InsideStep, |config| {
            let hull_points = 48;
            config.whole_collider = ColliderDetail { parts, hull_points };
        });
        let boxed = box_asset(HALF, CELLS);
        // A body that fills less of its bounds is no box, whatever its cells.
        let mut hollow = (*boxed).clone();
        hollow.parts_mut().mass.volume *= 0.9;
        let [pane, hollow] = [boxed, Arc::new(hollow)].map(|asset| {
            let handle = world.insert(
                body(&asset),
                RigidBodyBuilder::dynamic().pose(at(0.0, 0.0, 0.0)),
            );
            world.physics.bodies[handle.unwrap()].colliders()[0]
        });
        let found = world.physics.colliders[pane].shape();
        assert_eq!(found.shape_type(), ShapeType::Cuboid);
        assert!((found.compute_local_aabb().half_extents() - HALF).length() < 1e-6);
        let found = world.physics.colliders[hollow].shape();
        assert_eq!(found.shape_type(), shape);
        if let Some(compound) = found.as_compound() {
            assert_eq!(compound.shapes().len(), parts.min(9));
        }
        // Whatever the parts, they cover the pane.
        let bounds = found.compute_local_aabb();
        assert!((bounds.half_extents() - HALF).length() < 1e-6);
    }
}

#[test]
fn a_body_carries_what_the_quick_margin_says() {
    let gravity = Vec3::new(0.0, 0.0, -9.81);
    let config = FractureConfig::default();
    for (asset, held) in [(block(), 0.0), (shelf(), 9.81)] {
        let body = body(asset);
        let points = &asset.fracture().positions;
        for k in 0..40 {
            let force = |j: usize| {
                let number = |seed: usize| ((seed * 7919) % 1000) as f32 / 500.0 - 1.0;
                let i = 37 * k + 11 * j;
                Force {
                    point: points[(97 * i) % points.len()],
                    force: 5.0 * Vec3::new(number(i + 1), number(i + 2), number(3 * i + 3)),
                }
            };
            let forces = [force(0), force(1), force(2)];
            let total = forces.iter().map(|f| f.force.length()).sum();
            let quick = rest_margin_at_least(&body, total, held, config.load_duration);
            let Outcome::Held { margin, .. } = rest(&body, &forces, gravity, &config).unwrap()
            else {
                panic!("15 N broke it");
            };
            assert!(quick > 0.0 && quick <= margin, "{quick} against {margin}");
        }
    }
}

#[test]
fn what_is_called_harmless_is_refused_by_the_impact() {
    let body = body(block());
    let config = FractureConfig::default();
    let mut answers = [0, 0];
    for k in 0..30 {
        // The impulse of a blow that is integrated follows from its speed.
        let speed = 1e-4 * 1.6_f32.powi(k);
        let point = Vec3::new(0.05, 0.0, 0.0);
        let contact = Contact {
            impulse: speed,
            ..Contact::strike(point, -Vec3::X, speed, Striker::rigid())
        };
        let harmless = is_harmless(&body, std::slice::from_ref(&contact), &config);
        let report = impact(&body, std::slice::from_ref(&contact), &config)
            .unwrap()
            .report()
            .clone();
        assert_eq!(
            harmless,
            report.looked_at <= LookedAt::Impulses,
            "{speed} m/s"
        );
        answers[usize::from(harmless)] += 1;
    }
    assert!(answers[0] > 3 && answers[1] > 3, "{answers:?}");
}
