//! Breaking bodies in a Rapier world that is the game's own.

use std::panic::{AssertUnwindSafe, catch_unwind};

use crate::common::{body, box_asset, slicer};
use frangible::glam::Vec3;
use frangible_rapier::rapier3d::dynamics::{RigidBodyBuilder, RigidBodyHandle};
use frangible_rapier::rapier3d::geometry::{
    ColliderBuilder, Group, InteractionGroups, SolverFlags,
};
use frangible_rapier::rapier3d::math::Vector;
use frangible_rapier::rapier3d::pipeline::{
    ActiveHooks, PairFilterContext, PhysicsHooks, PhysicsWorld,
};
use frangible_rapier::{BreakableWorld, Breaker, Sets, WorldConfig};

const HALF: Vec3 = Vec3::new(0.10, 0.02, 0.05);

/// A game's world without gravity, with a ball of its own on the way to where a plate will be.
fn game(speed: f32) -> (PhysicsWorld, RigidBodyHandle) {
    let mut game = PhysicsWorld {
        gravity: Vector::ZERO,
        ..PhysicsWorld::default()
    };
    game.integration_parameters.dt = 1.0 / 240.0;
    game.integration_parameters.length_unit = 0.1;
    let start = Vector::new(0.0, 0.6, 0.0);
    let ball = RigidBodyBuilder::dynamic().translation(start);
    let ball = ball.linvel(Vector::new(0.0, -speed, 0.0)).ccd_enabled(true);
    let ball = ball.user_data(5);
    let ball = game.bodies.insert(ball);
    let collider = ColliderBuilder::ball(0.01).density(24_000.0);
    let (bodies, colliders) = (&mut game.bodies, &mut game.colliders);
    colliders.insert_with_parent(collider, ball, bodies);
    (game, ball)
}

/// The plate: user data and groups are the game's.
fn insert(world: &mut BreakableWorld) -> RigidBodyHandle {
    let rigid = RigidBodyBuilder::dynamic().translation(Vector::new(0.0, 0.5, 0.0));
    let plate = body(&box_asset(HALF, [2, 1, 1]));
    let plate = world.insert_with(plate, rigid.user_data(42), |collider| {
        let groups = InteractionGroups::all().with_filter(Group::ALL);
        collider.user_data(43).collision_groups(groups)
    });
    world.set_break_function(slicer(HALF, [3, 1, 2], 0.0, 0.0));
    plate.unwrap()
}

#[test]
fn a_plate_breaks_in_a_games_sets_as_it_does_in_a_world_of_ours() {
    let (mut game, ball) = game(10.0);
    let mut breaker = Breaker::new();
    let plate = breaker.with(Sets::from(&mut game), insert);
    assert_eq!(game.bodies[plate].user_data, 42);
    let mut ours = BreakableWorld::new(WorldConfig::plain()).unwrap();
    ours.physics = self::game(10.0).0;
    assert_eq!(insert(&mut ours), plate);
    let mut pieces = Vec::new();
    for _ in 0..30 {
        let breaks = breaker.step(Sets::from(&mut game), &(), &()).unwrap();
        let of_ours = ours.step().unwrap();
        assert_eq!(breaks.len(), of_ours.len());
        for (a, b) in breaks.iter().zip(of_ours) {
            assert_eq!((a.parent, &a.fragments), (plate, &b.fragments));
            pieces.extend(a.fragments.clone());
        }
    }
    assert_eq!(pieces.len(), 6);
    for &handle in pieces.iter().chain(&[ball]) {
        let state = |physics: &PhysicsWorld| {
            let rigid = &physics.bodies[handle];
            format!("{:?} {:?}", rigid.position(), rigid.linvel())
        };
        assert_eq!(state(&game), state(&ours.physics));
    }
    for handle in pieces {
        let rigid = &game.bodies[handle];
        assert_eq!(rigid.user_data, 42);
        assert_eq!(game.colliders[rigid.colliders()[0]].user_data, 43);
    }
    assert_eq!(game.bodies[ball].user_data, 5);
    assert!(
        breaker.state().physics.bodies.is_empty(),
        "it keeps nothing of the game"
    );
}

/// A game whose hook has a bug.
struct Buggy;

impl PhysicsHooks for Buggy {
    fn filter_contact_pair(&self, _: &PairFilterContext<'_>) -> Option<SolverFlags> {
        panic!("a bug of the game")
    }
}

#[test]
fn the_sets_go_back_where_a_hook_panics() {
    let (mut game, ball) = game(10.0);
    let mut breaker = Breaker::new();
    let plate = breaker.with(Sets::from(&mut game), insert);
    let collider = game.bodies[plate].colliders()[0];
    game.colliders[collider].set_active_hooks(ActiveHooks::FILTER_CONTACT_PAIRS);
    let stepped = catch_unwind(AssertUnwindSafe(|| {
        for _ in 0..30 {
            breaker.step(Sets::from(&mut game), &Buggy, &()).unwrap();
        }
    }));
    assert!(stepped.is_err());
    assert!(game.bodies.contains(ball) && game.bodies.contains(plate));
    assert!(breaker.state().physics.bodies.is_empty());
}

#[test]
fn a_game_may_remove_a_breakable_body_whenever_it_likes() {
    let (mut game, _) = game(10.0);
    let mut breaker = Breaker::new();
    let plate = breaker.with(Sets::from(&mut game), insert);
    game.remove_body(plate);
    for _ in 0..30 {
        assert!(
            breaker
                .step(Sets::from(&mut game), &(), &())
                .unwrap()
                .is_empty()
        );
    }
    assert!(breaker.state().breakable(plate).is_none());
}

#[test]
fn a_game_goes_back_to_a_state_that_it_saved() {
    let (mut game, ball) = game(10.0);
    let mut breaker = Breaker::new();
    breaker.with(Sets::from(&mut game), insert);
    let saved = breaker.with(Sets::from(&mut game), |world| world.save());
    let mut ends = Vec::new();
    for _ in 0..2 {
        for _ in 0..30 {
            breaker.step(Sets::from(&mut game), &(), &()).unwrap();
        }
        ends.push(format!(
            "{:?} {}",
            game.bodies[ball].position(),
            game.bodies.len()
        ));
        breaker.with(Sets::from(&mut game), |world| world.restore(&saved));
    }
    assert_eq!(ends[0], ends[1]);
    assert_eq!(game.bodies.len(), 2, "the plate is whole again");
}
