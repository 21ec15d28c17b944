//! The caller's own hooks and event handler.

use std::sync::Mutex;

use crate::common::{at, body, box_asset, slicer, world};
use frangible::glam::Vec3;
use frangible_rapier::rapier3d::dynamics::{
    RigidBodyBuilder, RigidBodyHandle, RigidBodySet, SoftBodySet, SoftBodyTearEvent,
};
use frangible_rapier::rapier3d::geometry::{
    ColliderBuilder, ColliderSet, CollisionEvent, ContactPair, SolverFlags,
};
use frangible_rapier::rapier3d::math::Vector;
use frangible_rapier::rapier3d::pipeline::{
    ActiveEvents, ActiveHooks, EventHandler, PairFilterContext, PhysicsHooks, PhysicsWorld,
};
use frangible_rapier::{Ball, BreakableWorld, Breaker, Sets, SurfaceProperties, WorldConfig};

const HALF: Vec3 = Vec3::new(0.10, 0.02, 0.05);

/// Writes down what it hears.
#[derive(Default)]
struct Log(Mutex<Vec<String>>);

impl Log {
    fn lines(&self) -> Vec<String> {
        self.0.lock().unwrap().clone()
    }
}

impl EventHandler for Log {
    fn handle_collision_event(
        &self,
        _: &RigidBodySet,
        colliders: &ColliderSet,
        event: CollisionEvent,
        _: Option<&ContactPair>,
    ) {
        let there = |handle| colliders.get(handle).is_some();
        let [a, b] = [event.collider1(), event.collider2()];
        let what = if event.started() { "start" } else { "stop" };
        let alive = [there(a), there(b)];
        let line = format!("{what} {a:?} {b:?} {alive:?}");
        self.0.lock().unwrap().push(line);
    }

    fn handle_contact_force_event(
        &self,
        _: f32,
        _: &RigidBodySet,
        _: &ColliderSet,
        pair: &ContactPair,
        force: f32,
    ) {
        let line = format!("force {:?} {:?} {force}", pair.collider1, pair.collider2);
        self.0.lock().unwrap().push(line);
    }

    fn handle_soft_body_tear_event(&self, _: &SoftBodySet, _: &SoftBodyTearEvent) {}
}

/// Nothing touches this body.
struct Ghost(RigidBodyHandle);

impl PhysicsHooks for Ghost {
    fn filter_contact_pair(&self, context: &PairFilterContext<'_>) -> Option<SolverFlags> {
        let touches = [context.rigid_body1, context.rigid_body2].contains(&Some(self.0));
        (!touches).then_some(SolverFlags::default())
    }
}

/// Three balls and a floor of a game, whose colliders want to be heard of.
fn furnish(physics: &mut PhysicsWorld) -> Vec<RigidBodyHandle> {
    let floor = ColliderBuilder::cuboid(1.0, 0.05, 1.0).active_events(ActiveEvents::all());
    physics.colliders.insert(floor);
    (0..3)
        .map(|i| {
            let start = Vector::new(0.01 * i as f32, 0.3 + 0.2 * i as f32, 0.0);
            let rigid = RigidBodyBuilder::dynamic().translation(start);
            let rigid = physics.bodies.insert(rigid);
            let ball = ColliderBuilder::ball(0.05).active_events(ActiveEvents::all());
            let (bodies, colliders) = (&mut physics.bodies, &mut physics.colliders);
            colliders.insert_with_parent(ball, rigid, bodies);
            rigid
        })
        .collect()
}

#[test]
fn without_breakables_a_step_is_rapiers_own_bit_for_bit() {
    let mut ours = BreakableWorld::new(WorldConfig::plain()).unwrap();
    let mut breaker = Breaker::new();
    let [mut theirs, mut shared] = [(); 2].map(|()| PhysicsWorld {
        gravity: ours.physics.gravity,
        integration_parameters: ours.physics.integration_parameters,
        ..PhysicsWorld::default()
    });
    let balls = furnish(&mut ours.physics);
    let ghost = Ghost(balls[1]);
    assert_eq!(
        [&mut theirs, &mut shared].map(furnish),
        [(); 2].map(|()| balls.clone())
    );
    for physics in [&mut ours.physics, &mut theirs, &mut shared] {
        let collider = physics.bodies[balls[1]].colliders()[0];
        physics.colliders[collider].set_active_hooks(ActiveHooks::FILTER_CONTACT_PAIRS);
    }
    let [our_log, their_log, shared_log] = [(); 3].map(|()| Log::default());
    for _ in 0..120 {
        ours.step_with(&ghost, &our_log).unwrap();
        theirs.step_with_events(&ghost, &their_log);
        let sets = Sets::from(&mut shared);
        assert!(breaker.step(sets, &ghost, &shared_log).unwrap().is_empty());
    }
    for &ball in &balls {
        let state = |physics: &PhysicsWorld| {
            let rigid = &physics.bodies[ball];
            format!("{:?} {:?}", rigid.position(), rigid.linvel())
        };
        assert_eq!(state(&ours.physics), state(&theirs));
        assert_eq!(state(&shared), state(&theirs));
    }
    assert!(our_log.lines().iter().any(|line| line.starts_with("force")));
    assert_eq!(our_log.lines(), their_log.lines());
    assert_eq!(shared_log.lines(), their_log.lines());
    assert!(
        ours.physics.bodies[balls[1]].translation().y < -0.1,
        "the ghost fell through"
    );
}

/// A plate at rest in the air and a ball on its way to it.
fn plate_and_ball() -> (BreakableWorld, RigidBodyHandle) {
    let mut world = world(true);
    world.physics.gravity = Vector::ZERO;
    let plate = body(&box_asset(HALF, [2, 1, 1]));
    let plate = world.insert(plate, RigidBodyBuilder::dynamic().pose(at(0.0, 0.5, 0.0)));
    let plate = plate.unwrap();
    let ball = Ball {
        mass: 0.1,
        radius: 0.01,
    };
    let down = Vector::new(0.0, -10.0, 0.0);
    let start = at(0.0, 0.6, 0.0);
    world
        .insert_ball(ball, SurfaceProperties::STEEL, start, down)
        .unwrap();
    world.set_break_function(slicer(HALF, [3, 1, 2], 0.0, 0.0));
    let collider = world.physics.bodies[plate].colliders()[0];
    let collider = &mut world.physics.colliders[collider];
    collider.set_active_events(ActiveEvents::COLLISION_EVENTS);
    collider.set_active_hooks(ActiveHooks::FILTER_CONTACT_PAIRS);
    (world, plate)
}

#[test]
fn events_of_an_undone_step_are_dropped_and_fragments_are_heard_of() {
    let (mut world, plate) = plate_and_ball();
    let parent = world.physics.bodies[plate].colliders()[0];
    let log = Log::default();
    let mut fragments = Vec::new();
    for _ in 0..30 {
        for event in world.step_with(&(), &log).unwrap() {
            fragments.extend(event.fragments.clone());
        }
    }
    assert_eq!(fragments.len(), 6);
    let lines = log.lines();
    let of_parent = format!("{parent:?} ");
    let met = |line: &&String| line.starts_with("start") && line.contains(&of_parent);
    assert_eq!(
        lines.iter().find(met),
        None,
        "the plate that the ball met is gone"
    );
    let colliders = fragments.iter();
    let colliders = colliders.map(|&h| world.physics.bodies[h].colliders()[0]);
    let heard = |c| lines.iter().any(|line| line.contains(&format!("{c:?} ")));
    assert!(colliders.into_iter().any(heard), "{lines:?}");
}

#[test]
fn a_ball_that_the_callers_hook_lets_through_breaks_nothing() {
    let (mut world, plate) = plate_and_ball();
    for _ in 0..30 {
        assert!(world.step_with(&Ghost(plate), &()).unwrap().is_empty());
    }
    assert!(world.breakable(plate).is_some());
}
