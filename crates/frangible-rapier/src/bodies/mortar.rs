//! Mortar: a weak bond between two bodies, which fails under tension, shear or bending.
//!
//! A fixed impulse joint over the face where they meet. Bodies that are bonded do not collide with each other; when the bond is
//! gone they do.
//!
//! Its area and strength ride in the joint's user data, so that a piece of a broken brick keeps its bond.

use rapier3d::dynamics::{
    FixedJointBuilder, GenericJoint, ImpulseJoint, ImpulseJointHandle, RigidBodyHandle,
};
use rapier3d::math::{Pose, Rotation, Vector};

use crate::error::{WorldError, finite, positive};
use crate::world::BreakableWorld;

/// Marks the joints that are mortar: the upper half of their user data.
const MARK: u128 = 0x6d6f_7274_6172_0001 << 64;

/// Bond between two bodies at a face: its place and strength.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mortar {
    /// Centre of the face, m, world coordinates.
    pub centre: Vector,
    /// Normal of the face, from the first body to the second; motion of the second body along it is tension.
    pub normal: Vector,
    /// Area of the face, m².
    pub area: f32,
    /// Strength, Pa: of tension and bending along the normal, and of shear across it. Lime mortar 0.1 to 0.5 MPa.
    pub strength: f32,
}

impl BreakableWorld {
    /// Bonds two bodies. When one of them breaks, the piece at the bond keeps it.
    ///
    /// # Errors
    /// An invalid number, or an unknown body.
    pub fn insert_mortar(
        &mut self,
        one: RigidBodyHandle,
        two: RigidBodyHandle,
        mortar: Mortar,
    ) -> Result<ImpulseJointHandle, WorldError> {
        finite("centre of the mortar", mortar.centre)?;
        finite("normal of the mortar", mortar.normal)?;
        positive("area of the mortar (m²)", mortar.area)?;
        positive("strength of the mortar (Pa)", mortar.strength)?;
        let normal = mortar.normal.try_normalize();
        let normal = normal.ok_or(WorldError::NoNormal(mortar.normal))?;
        // Axis x of the joint's frame from the first body to the second, so that a pull has one sign.
        let face = Pose::from_parts(
            mortar.centre,
            Rotation::from_rotation_arc(Vector::X, normal),
        );
        let local = |handle: RigidBodyHandle| {
            let (index, generation) = handle.into_raw_parts();
            let body = self.physics.bodies.get(handle);
            let body = body.ok_or(WorldError::NoBody { index, generation })?;
            Ok::<Pose, WorldError>(body.position().inverse() * face)
        };
        let (first, second) = (local(one)?, local(two)?);
        let joint = FixedJointBuilder::new()
            .local_frame1(first)
            .local_frame2(second);
        let mut joint = GenericJoint::from(joint);
        joint.contacts_enabled = false;
        joint.user_data =
            MARK | u128::from(mortar.area.to_bits()) << 32 | u128::from(mortar.strength.to_bits());
        Ok(self.physics.impulse_joints.insert(one, two, joint, true))
    }

    /// Number of intact bonds.
    #[must_use]
    pub fn mortar(&self) -> usize {
        let joints = self.physics.impulse_joints.iter();
        joints.filter(|(_, joint)| bond(joint).is_some()).count()
    }

    /// Removes the bonds that the step has overloaded.
    pub(crate) fn part_mortar(&mut self) {
        let parameters = &self.physics.integration_parameters;
        let substep = parameters.dt / parameters.num_solver_iterations as f32;
        let joints = self.physics.impulse_joints.iter();
        let parted: Vec<ImpulseJointHandle> = joints
            .filter(|(_, joint)| is_overloaded(joint, substep))
            .map(|(handle, _)| handle)
            .collect();
        for handle in parted {
            self.physics.impulse_joints.remove(handle, true);
        }
    }
}

/// Area and strength of a joint that is mortar.
fn bond(joint: &ImpulseJoint) -> Option<[f32; 2]> {
    let data = joint.data.user_data;
    let marked = data >> 64 == MARK >> 64;
    marked.then(|| [data >> 32, data].map(|bits| f32::from_bits(bits as u32)))
}

fn is_overloaded(joint: &ImpulseJoint, substep: f32) -> bool {
    let Some([area, strength]) = bond(joint) else {
        return false;
    };
    let load = joint.impulses.map(|impulse| impulse / substep);
    let [pull, shear @ ..] = [load[0], load[1], load[2]];
    let moment = Vector::new(load[3], load[4], load[5]).length();
    // Section modulus of a square face.
    let bending = 6.0 * moment / (area * area.sqrt());
    let shear = Vector::new(0.0, shear[0], shear[1]).length() / area;
    // A press parts nothing.
    let tension = bending + (pull / area).max(0.0);
    tension.max(shear) > strength
}
