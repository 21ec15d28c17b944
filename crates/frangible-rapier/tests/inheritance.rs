//! Fragments inherit from their parent: surface, groups, joints, neighbours.

use crate::common::{at, body, box_asset, slicer, step_to_break, world};
use frangible::glam::Vec3;
use frangible_rapier::rapier3d::dynamics::{RigidBodyBuilder, SphericalJointBuilder};
use frangible_rapier::rapier3d::geometry::{Group, InteractionGroups, InteractionTestMode};
use frangible_rapier::rapier3d::math::Vector;
use frangible_rapier::{Ball, SurfaceProperties};

const HALF: Vec3 = Vec3::new(0.10, 0.02, 0.05);

#[test]
fn fragments_inherit_surface_groups_gravity_and_user_data() {
    let mut world = world(true);
    let parent = world
        .insert(
            body(&box_asset(HALF, [2, 1, 1])),
            RigidBodyBuilder::dynamic().pose(at(0.0, 0.5, 0.0)),
        )
        .unwrap();
    let groups = InteractionGroups::new(
        Group::GROUP_1,
        Group::GROUP_1 | Group::GROUP_2,
        InteractionTestMode::And,
    );
    let rigid = &mut world.physics.bodies[parent];
    rigid.user_data = 42;
    rigid.set_gravity_scale(0.25, true);
    let collider = rigid.colliders()[0];
    let collider = &mut world.physics.colliders[collider];
    collider.set_friction(0.77);
    collider.set_restitution(0.11);
    collider.set_collision_groups(groups);
    collider.set_solver_groups(groups);
    collider.user_data = 43;
    let ball = Ball {
        mass: 0.1,
        radius: 0.01,
    };
    let start = at(0.0, 0.6, 0.0);
    world
        .insert_ball(
            ball,
            SurfaceProperties::STEEL,
            start,
            Vector::new(0.0, -10.0, 0.0),
        )
        .unwrap();
    world.set_break_function(slicer(HALF, [3, 1, 2], 0.0, 0.0));
    let event = step_to_break(&mut world, 30).unwrap();
    for handle in event.fragments {
        let rigid = &world.physics.bodies[handle];
        assert_eq!((rigid.user_data, rigid.gravity_scale()), (42, 0.25));
        let collider = &world.physics.colliders[rigid.colliders()[0]];
        assert_eq!((collider.friction(), collider.restitution()), (0.77, 0.11));
        assert_eq!(
            (collider.collision_groups(), collider.solver_groups()),
            (groups, groups)
        );
        assert_eq!(collider.user_data, 43);
        assert!(rigid.is_dynamic());
    }
}

#[test]
fn joints_move_to_the_fragment_that_holds_them_or_are_released() {
    let mut world = world(false);
    let parent = world
        .insert(
            body(&box_asset(HALF, [2, 1, 1])),
            RigidBodyBuilder::dynamic().pose(at(0.0, 0.0, 0.0)),
        )
        .unwrap();
    let anchor = |world: &mut frangible_rapier::BreakableWorld, x: f32, y: f32| {
        let post = world
            .physics
            .insert_body(RigidBodyBuilder::fixed().translation(Vector::new(x, y, 0.0)));
        let joint = SphericalJointBuilder::new()
            .local_anchor1(Vector::ZERO)
            .local_anchor2(Vector::new(x, y, 0.0));
        world.physics.insert_impulse_joint(post, parent, joint)
    };
    let held = [
        anchor(&mut world, -0.1, 0.02),
        anchor(&mut world, 0.1, 0.02),
    ];
    let loose = anchor(&mut world, 0.0, 0.3);
    let ball = Ball {
        mass: 0.1,
        radius: 0.01,
    };
    world
        .insert_ball(
            ball,
            SurfaceProperties::STEEL,
            at(0.0, 0.1, 0.0),
            Vector::new(0.0, -10.0, 0.0),
        )
        .unwrap();
    world.set_break_function(slicer(HALF, [4, 1, 1], 0.0, 0.0));
    let event = step_to_break(&mut world, 30).unwrap();
    assert!(
        world.physics.impulse_joints.get(loose).is_none(),
        "an anchor in the air holds nothing"
    );
    assert_eq!(event.released_joints, [loose], "and the game hears of it");
    for (joint, x) in held.into_iter().zip([-0.1_f32, 0.1]) {
        let joint = world
            .physics
            .impulse_joints
            .get(joint)
            .expect("the joint is kept");
        assert!(event.fragments.contains(&joint.body2()));
        let place =
            world.physics.bodies[joint.body2()].position() * joint.data.local_frame2.translation;
        assert!(
            (place - Vector::new(x, 0.02, 0.0)).length() < 1e-2,
            "the anchor moved to {place}"
        );
        let index = event
            .fragments
            .iter()
            .position(|&f| f == joint.body2())
            .unwrap();
        let centre = event.fracture.fragments[index].mass.centre.x as f32;
        assert!(
            centre * x > 0.0 && centre.abs() > 0.05,
            "the end piece holds it, not the one at {centre}"
        );
    }
}

#[test]
fn what_leaned_on_the_broken_body_wakes() {
    let mut world = world(true);
    world
        .insert_fixed_half_space(Vector::ZERO, Vector::Y, SurfaceProperties::STONE)
        .unwrap();
    let table = box_asset(HALF, [2, 1, 1]);
    world
        .insert(
            body(&table),
            RigidBodyBuilder::dynamic().pose(at(0.0, 0.02, 0.0)),
        )
        .unwrap();
    let load = Ball {
        mass: 0.05,
        radius: 0.02,
    };
    let load = world
        .insert_ball(
            load,
            SurfaceProperties::WOOD,
            at(0.06, 0.0601, 0.0),
            Vector::ZERO,
        )
        .unwrap();
    world.physics.bodies[load].set_linear_damping(2.0);
    world.physics.bodies[load].set_angular_damping(5.0);
    for _ in 0..2000 {
        world.step().unwrap();
        if world.at_rest() {
            break;
        }
    }
    assert!(world.at_rest(), "table and load come to rest");
    let ball = Ball {
        mass: 0.05,
        radius: 0.005,
    };
    let start = at(-0.08, 0.3, 0.0);
    world
        .insert_ball(
            ball,
            SurfaceProperties::STEEL,
            start,
            Vector::new(0.0, -20.0, 0.0),
        )
        .unwrap();
    world.set_break_function(slicer(HALF, [6, 1, 3], 0.0, 0.0));
    step_to_break(&mut world, 60).expect("the ball hits the sleeping table");
    assert!(!world.physics.bodies[load].is_sleeping());
}
