//! The films between the pieces of a laminated wall: hinges that yield and tear.
//!
//! A bond is a joint that locks nothing. Motors draw its two places together along three axes, with no more force than the film carries, and resist
//! turning about the crack with no more moment than the film has at the arm of half the wall, as the plies press upon each other at a face.
//! So a bond is stiff at first, then gives way at a constant force, and takes up energy as the film does. Where the places have moved apart by
//! its stretch, it tears, and the pieces meet each other as any others. Pieces on a film are not parted by the blow that cracked them: the striker
//! meets them as contacts of the engine, and they give way together.

use frangible::Fracture;
use frangible::glam::Mat3;
use frangible::internals::outcome::FilmBond;
use rapier3d::dynamics::{
    GenericJoint, ImpulseJoint, ImpulseJointHandle, JointAxesMask, JointAxis, MotorModel,
    RigidBodyBuilder, RigidBodyHandle,
};
use rapier3d::math::{Pose, Rotation, Vector};

use crate::world::BreakableWorld;

/// Marks the joints that are film: the upper half of their user data.
const MARK: u128 = 0x6669_6c6d_0000_0001 << 64;

/// Opening at which a film yields, m: it stretches about so far before it carries its whole tension.
const YIELDS: f32 = 3e-4;

/// Share of the critical damping of a piece on its film.
const DAMPING: f32 = 0.7;

impl BreakableWorld {
    /// Bonds the pieces of a laminated wall that have just taken its place.
    pub(crate) fn bind_film(&mut self, fracture: &Fracture, fragments: &[RigidBodyHandle]) {
        let mut frame = None;
        for bond in fracture.film() {
            let [one, two] = bond.pieces.map(|piece| match piece {
                FilmBond::FRAME => self.frame(fracture, fragments, &mut frame),
                piece => fragments.get(piece as usize).copied(),
            });
            if let (Some(one), Some(two)) = (one, two) {
                self.bind(fracture, bond, [one, two]);
            }
        }
    }

    /// A fixed body without a shape in the place of what held the wall.
    fn frame(
        &mut self,
        fracture: &Fracture,
        fragments: &[RigidBodyHandle],
        frame: &mut Option<RigidBodyHandle>,
    ) -> Option<RigidBodyHandle> {
        if frame.is_none() {
            let first = self.physics.bodies.get(*fragments.first()?)?;
            let centre = fracture.fragments.first()?.mass.centre.as_vec3();
            let pose = *first.position() * Pose::from_parts(-centre, Rotation::IDENTITY);
            let body = RigidBodyBuilder::fixed().pose(pose);
            *frame = Some(self.physics.bodies.insert(body));
        }
        *frame
    }

    fn bind(&mut self, fracture: &Fracture, bond: &FilmBond, ends: [RigidBodyHandle; 2]) {
        let bodies = ends.map(|handle| self.physics.bodies.get(handle));
        let [Some(one), Some(two)] = bodies else {
            return;
        };
        if one.is_fixed() && two.is_fixed() {
            return;
        }
        let lighter = match (one.is_fixed(), two.is_fixed()) {
            (true, _) => two.mass(),
            (_, true) => one.mass(),
            _ => one.mass().min(two.mass()),
        };
        // The axes of the pieces are those of the body that broke, and the origins their centres.
        let frame = |piece: u32| {
            let fragment = fracture.fragments.get(piece as usize);
            let centre = fragment.map_or(Vector::ZERO, |f| f.mass.centre.as_vec3());
            let turn = Rotation::from_mat3(&axes(bond));
            Pose::from_parts(bond.place - centre, turn)
        };
        let force = (bond.strength * bond.section) as f32;
        let mut joint = GenericJoint::new(JointAxesMask::empty());
        (joint.local_frame1, joint.local_frame2) = (frame(bond.pieces[0]), frame(bond.pieces[1]));
        joint.contacts_enabled = false;
        joint.user_data = MARK | u128::from((bond.stretch as f32).to_bits());
        let stiffness = force / YIELDS;
        let damping = DAMPING * 2.0 * (stiffness * lighter).sqrt();
        for axis in [JointAxis::LinX, JointAxis::LinY, JointAxis::LinZ] {
            joint.set_motor_model(axis, MotorModel::ForceBased);
            joint.set_motor(axis, 0.0, 0.0, stiffness, damping);
            joint.set_motor_max_force(axis, force);
        }
        let moment = force * bond.arm as f32;
        joint.set_motor_model(JointAxis::AngX, MotorModel::ForceBased);
        joint.set_motor(JointAxis::AngX, 0.0, 0.0, 0.0, damping * bond.arm as f32);
        joint.set_motor_max_force(JointAxis::AngX, moment);
        self.physics
            .impulse_joints
            .insert(ends[0], ends[1], joint, true);
    }

    /// Number of bonds of film that hold.
    #[must_use]
    pub fn film_bonds(&self) -> usize {
        let joints = self.physics.impulse_joints.iter();
        joints.filter(|(_, joint)| stretch(joint).is_some()).count()
    }

    /// Tears the films that the step has drawn out too far.
    pub(crate) fn tear_film(&mut self) {
        let bodies = &self.physics.bodies;
        let joints = self.physics.impulse_joints.iter();
        let torn = joints.filter(|(_, joint)| {
            let Some(stretch) = stretch(joint) else {
                return false;
            };
            let place = |handle: RigidBodyHandle, frame: &Pose| {
                Some(*bodies.get(handle)?.position() * frame.translation)
            };
            let ends = (
                place(joint.body1(), &joint.data.local_frame1),
                place(joint.body2(), &joint.data.local_frame2),
            );
            match ends {
                (Some(a), Some(b)) => (a - b).length() > stretch,
                _ => false,
            }
        });
        let torn: Vec<ImpulseJointHandle> = torn.map(|(handle, _)| handle).collect();
        for handle in torn {
            self.physics.impulse_joints.remove(handle, true);
        }
    }
}

/// Axes of a bond: along the crack, across it, and through the wall.
fn axes(bond: &FilmBond) -> Mat3 {
    Mat3::from_cols(bond.along, bond.across, bond.along.cross(bond.across))
}

/// Stretch of a joint that is film, m.
fn stretch(joint: &ImpulseJoint) -> Option<f32> {
    let data = joint.data.user_data;
    (data >> 64 == MARK >> 64).then(|| f32::from_bits(data as u32))
}
