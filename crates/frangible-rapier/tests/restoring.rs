//! A state that is put back over a different one: the world goes on as it did from there.

use crate::common::{at, world};
use frangible_rapier::rapier3d::dynamics::{
    RigidBodyBuilder, RigidBodyHandle, SphericalJointBuilder,
};
use frangible_rapier::rapier3d::geometry::ColliderBuilder;
use frangible_rapier::rapier3d::math::{Pose, Vector};
use frangible_rapier::{BreakableWorld, SurfaceProperties};

/// Half extents of a wall across the way of a fast body, m.
const WALL: Vector = Vector::new(0.2, 0.2, 0.002);
/// Steps after which ends are compared.
const STEPS: usize = 12;

/// A ball of the game's own, and its collider, as Rapier makes them.
fn ball(world: &mut BreakableWorld, pose: Pose, linvel: Vector) -> RigidBodyHandle {
    let body = RigidBodyBuilder::dynamic().pose(pose).linvel(linvel);
    let collider = ColliderBuilder::ball(0.02).density(2500.0);
    world.physics.insert(body, collider).0
}

fn put_wall(world: &mut BreakableWorld) -> RigidBodyHandle {
    let stone = SurfaceProperties::STONE;
    let wall = world.insert_fixed_box(WALL, Pose::IDENTITY, stone);
    wall.unwrap()
}

fn steps(world: &mut BreakableWorld, count: usize) {
    for _ in 0..count {
        world.step().unwrap();
    }
}

/// Changes the world and lets it go on, and puts back the state from before; `look` is called in the end. The change is called with a world
/// that has seen a few steps.
fn end_after_going_back<T>(
    world: &mut BreakableWorld,
    change: impl FnOnce(&mut BreakableWorld),
    look: impl Fn(&BreakableWorld) -> T,
) -> [T; 2] {
    steps(world, 2);
    let saved = world.save();
    steps(world, STEPS);
    let undisturbed = look(world);
    world.restore(&saved);
    change(world);
    steps(world, 2);
    world.restore(&saved);
    steps(world, STEPS);
    [undisturbed, look(world)]
}

fn place(handle: RigidBodyHandle) -> impl Fn(&BreakableWorld) -> Vector {
    move |world| world.physics.bodies[handle].translation()
}

/// A world without gravity, and a ball that would be at the wall's place five steps later.
fn shot() -> (BreakableWorld, RigidBodyHandle) {
    let mut world = world(false);
    let way = 150.0 * world.physics.integration_parameters.dt;
    let start = at(0.01, 0.02, -4.5 * way);
    let ball = ball(&mut world, start, Vector::new(0.0, 0.0, 150.0));
    (world, ball)
}

#[test]
fn a_fixed_body_that_was_removed_since_stops_a_fast_one() {
    let (mut world, ball) = shot();
    let wall = put_wall(&mut world);
    let take_away = |world: &mut BreakableWorld| {
        world.physics.remove_body(wall).unwrap();
    };
    let [undisturbed, end] = end_after_going_back(&mut world, take_away, place(ball));
    assert!(undisturbed.z < 0.0, "the wall stops the ball");
    assert_eq!(end, undisturbed);
}

#[test]
fn a_fixed_body_that_was_inserted_since_stops_nothing() {
    let (mut world, ball) = shot();
    let put = |world: &mut BreakableWorld| {
        put_wall(world);
    };
    let [undisturbed, end] = end_after_going_back(&mut world, put, place(ball));
    assert!(undisturbed.z > 1.0, "nothing is in the ball's way");
    assert_eq!(end, undisturbed);
}

/// A world in which two balls swing on a post; the first joint is made here, the second one is for the test.
fn pendulums() -> (BreakableWorld, RigidBodyHandle, [RigidBodyHandle; 2]) {
    let mut world = world(true);
    let post = world.physics.insert_body(RigidBodyBuilder::fixed());
    let balls = [0.1, -0.1].map(|x| ball(&mut world, at(x, 0.0, 0.0), Vector::ZERO));
    (world, post, balls)
}

/// The joint of a ball to the post where the ball is.
fn arm(x: f32) -> SphericalJointBuilder {
    SphericalJointBuilder::new().local_anchor2(Vector::new(-x, 0.0, 0.0))
}

#[test]
fn a_joint_that_was_removed_since_holds() {
    let (mut world, post, [one, other]) = pendulums();
    let joint = world.physics.insert_impulse_joint(post, one, arm(0.1));
    world.physics.insert_impulse_joint(post, other, arm(-0.1));
    let release = |world: &mut BreakableWorld| {
        world.physics.remove_impulse_joint(joint).unwrap();
    };
    let places = |world: &BreakableWorld| [place(one)(world), place(other)(world)];
    let [undisturbed, end] = end_after_going_back(&mut world, release, places);
    let reach = undisturbed.map(|at| at.length());
    assert!(reach.iter().all(|r| (r - 0.1).abs() < 0.01), "{reach:?}");
    assert_eq!(end, undisturbed);
}

#[test]
fn a_joint_that_was_inserted_since_holds_nothing() {
    let (mut world, post, [one, _]) = pendulums();
    let hang = |world: &mut BreakableWorld| {
        world.physics.insert_impulse_joint(post, one, arm(0.1));
    };
    let [undisturbed, end] = end_after_going_back(&mut world, hang, place(one));
    assert_eq!(undisturbed.x, 0.1, "the ball falls straight down");
    assert_eq!(end, undisturbed);
}

/// Position of a ball after its joint was moved to each of these places, every time from the same restored state.
fn end_at_the_last_of(anchors: &[Vector]) -> Vector {
    let (mut world, post, [one, _]) = pendulums();
    let joint = world.physics.insert_impulse_joint(post, one, arm(0.1));
    steps(&mut world, 2);
    let saved = world.save();
    for &anchor in anchors {
        world.restore(&saved);
        let joint = world.physics.impulse_joints.get_mut(joint, true).unwrap();
        joint.data.set_local_anchor1(anchor);
        steps(&mut world, STEPS);
    }
    place(one)(&world)
}

#[test]
fn a_joint_that_is_changed_in_another_way_holds_as_it_is_then() {
    let (here, there) = (Vector::Y * 0.01, Vector::Y * -0.01);
    let undisturbed = end_at_the_last_of(&[there]);
    assert_ne!(end_at_the_last_of(&[here]), undisturbed);
    assert_eq!(end_at_the_last_of(&[here, there]), undisturbed);
}

#[test]
fn the_settings_of_the_pipeline_stay() {
    let (mut world, _) = shot();
    world.physics.physics_pipeline.counters.disable();
    #[cfg(feature = "parallel")]
    {
        let pipeline = &mut world.physics.physics_pipeline;
        pipeline.configure_thread_pool(3).unwrap();
    }
    let saved = world.save();
    steps(&mut world, 2);
    world.restore(&saved);
    let pipeline = &world.physics.physics_pipeline;
    assert!(!pipeline.counters.enabled);
    #[cfg(feature = "parallel")]
    assert_eq!(pipeline.num_threads(), Some(3));
}
