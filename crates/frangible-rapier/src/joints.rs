//! Joints of a broken body move to the fragment that holds their anchor.

use rapier3d::dynamics::{ImpulseJointHandle, RigidBodyHandle};
use rapier3d::math::{Pose, Vector};
use rapier3d::pipeline::PhysicsWorld;

/// Moves the parent's impulse joints to the nearest fragments and removes those with none within `reach` m.
/// `fragments`: handle and centre in the parent's frame. Call while the parent is still in the world: joint
/// handles stay valid. Returns the joints that were removed.
pub(crate) fn hand_over_joints(
    physics: &mut PhysicsWorld,
    parent: RigidBodyHandle,
    fragments: &[(RigidBodyHandle, Vector)],
    reach: f32,
) -> Vec<ImpulseJointHandle> {
    let mut released = Vec::new();
    let attached: Vec<(RigidBodyHandle, RigidBodyHandle, ImpulseJointHandle, Pose)> = physics
        .impulse_joints
        .attached_joints(parent)
        .map(|(one, two, handle, joint)| {
            let frame = if one == parent {
                joint.data.local_frame1
            } else {
                joint.data.local_frame2
            };
            (one, two, handle, frame)
        })
        .collect();
    for (one, two, handle, frame) in attached {
        let holder = holder(physics, fragments, frame.translation, reach);
        let Some((fragment, centre)) = holder else {
            physics.impulse_joints.remove(handle, true);
            released.push(handle);
            continue;
        };
        // The fragment's axes are the parent's; only the origin moved to its centre of mass.
        let frame = Pose::from_parts(frame.translation - centre, frame.rotation);
        let (new_one, new_two) = if one == parent {
            (fragment, two)
        } else {
            (one, fragment)
        };
        if let Some(joint) = physics
            .impulse_joints
            .set_bodies(handle, new_one, new_two, true)
        {
            if one == parent {
                joint.data.local_frame1 = frame;
            } else {
                joint.data.local_frame2 = frame;
            }
        }
    }
    released
}

/// The fragment nearest to an anchor of the parent's frame, if any is within `reach`; ties go to the first.
fn holder(
    physics: &PhysicsWorld,
    fragments: &[(RigidBodyHandle, Vector)],
    anchor: Vector,
    reach: f32,
) -> Option<(RigidBodyHandle, Vector)> {
    let distance = |&(handle, centre): &(RigidBodyHandle, Vector)| {
        let colliders = physics.bodies.get(handle)?.colliders();
        let shapes = colliders.iter().filter_map(|&c| physics.colliders.get(c));
        shapes
            .map(|c| c.shape().distance_to_local_point(anchor - centre, true))
            .reduce(f32::min)
    };
    let mut best = None;
    for fragment in fragments {
        if let Some(d) = distance(fragment)
            && d <= reach
            && best.is_none_or(|(b, _)| d < b)
        {
            best = Some((d, *fragment));
        }
    }
    best.map(|(_, fragment)| fragment)
}
