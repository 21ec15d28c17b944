//! Dispatch of contact searches for two shapes, to this crate or to Parry.

use rapier3d::geometry::{ContactData, ContactManifoldData};
use rapier3d::math::{Pose, Real, Vector};
use rapier3d::parry::query::details::{
    NormalConstraints, contact_manifolds_composite_shape_composite_shape,
    contact_manifolds_composite_shape_shape, contact_manifolds_heightfield_composite_shape,
    contact_manifolds_heightfield_shape_shapes, contact_manifolds_trimesh_shape_shapes,
};
use rapier3d::parry::query::{
    ClosestPoints, Contact, ContactManifold, ContactManifoldsWorkspace, DefaultQueryDispatcher,
    NonlinearRigidMotion, PersistentQueryDispatcher, QueryDispatcher, ShapeCastHit,
    ShapeCastOptions, Unsupported,
};
use rapier3d::parry::shape::Shape;

use crate::bodies::{floor, polyhedra};

type Manifold = ContactManifold<ContactManifoldData, ContactData>;

/// Contacts of jagged and of flat pieces, for the narrow phase of a Rapier world.
///
/// Rapier finds contacts by Parry, which goes wrong with broken pieces in two ways. It sets a jagged piece on a half-space with one of its
/// faces instead of its lowest corners, so that it sinks in and rocks for ever. And its tolerances suit bodies of a metre: of a piece of
/// some millimetres and another one, a ball or a cylinder it may tell that they overlap by as much as their thickness, or do not touch.
/// Here half-spaces touch polyhedra with their lowest corners, and contacts of polyhedra with other convex shapes, the parts of compounds and
/// the triangles of meshes and height fields among them, are searched in units that suit them. All else is Parry's: voxels, and shapes without a
/// polyhedron. Lengths are in m.
///
/// A [`BreakableWorld`](crate::BreakableWorld) has it. A world of your own gets it once, before its first step:
///
/// ```
/// use frangible_rapier::PieceContacts;
/// use frangible_rapier::rapier3d::pipeline::PhysicsWorld;
///
/// let mut game = PhysicsWorld::default();
/// game.narrow_phase.set_query_dispatcher(PieceContacts);
/// ```
#[derive(Clone, Copy, Debug, Default)]
pub struct PieceContacts;

impl PersistentQueryDispatcher<ContactManifoldData, ContactData> for PieceContacts {
    fn contact_manifolds(
        &self,
        pos12: &Pose,
        g1: &dyn Shape,
        g2: &dyn Shape,
        prediction: Real,
        manifolds: &mut Vec<Manifold>,
        workspace: &mut Option<ContactManifoldsWorkspace>,
    ) -> Result<(), Unsupported> {
        let done = match (g1.as_halfspace(), g2.as_halfspace()) {
            (Some(plane), None) => floor::touch(pos12, plane, g2, prediction, manifolds, false),
            (None, Some(plane)) => {
                floor::touch(&pos12.inverse(), plane, g1, prediction, manifolds, true)
            }
            _ => Err(Unsupported),
        };
        if done.is_ok() {
            return Ok(());
        }
        // Parts of compounds and triangles of surfaces come back to this dispatcher; Parry's own would keep them to itself.
        let flipped = &pos12.inverse();
        match (g1.as_composite_shape(), g2.as_composite_shape()) {
            (Some(a), Some(b)) => contact_manifolds_composite_shape_composite_shape(
                self, pos12, a, b, prediction, manifolds, workspace,
            ),
            _ if g1.as_trimesh().is_some() || g2.as_trimesh().is_some() => {
                contact_manifolds_trimesh_shape_shapes(
                    self, pos12, g1, g2, prediction, manifolds, workspace,
                );
            }
            (a, b) if g1.as_heightfield().is_some() || g2.as_heightfield().is_some() => {
                match (g1.as_heightfield(), a, g2.as_heightfield(), b) {
                    (Some(field), _, _, Some(b)) => contact_manifolds_heightfield_composite_shape(
                        self, pos12, flipped, field, b, prediction, manifolds, workspace, false,
                    ),
                    (_, Some(a), Some(field), _) => contact_manifolds_heightfield_composite_shape(
                        self, flipped, pos12, field, a, prediction, manifolds, workspace, true,
                    ),
                    _ => contact_manifolds_heightfield_shape_shapes(
                        self, pos12, g1, g2, prediction, manifolds, workspace,
                    ),
                }
            }
            _ if g1.as_voxels().is_some() || g2.as_voxels().is_some() => {
                return DefaultQueryDispatcher
                    .contact_manifolds(pos12, g1, g2, prediction, manifolds, workspace);
            }
            (Some(a), None) => contact_manifolds_composite_shape_shape(
                self, pos12, a, g2, prediction, manifolds, workspace, false,
            ),
            (None, Some(b)) => contact_manifolds_composite_shape_shape(
                self, flipped, b, g1, prediction, manifolds, workspace, true,
            ),
            (None, None) => {
                manifolds.truncate(1);
                // Contacts that were found of a compound before stand in the frames of its parts.
                manifolds.retain(|known| known.subshape_poses.is_none());
                if manifolds.is_empty() {
                    manifolds.push(Manifold::new());
                }
                let manifold = &mut manifolds[0];
                self.contact_manifold_convex_convex(
                    pos12, g1, g2, None, None, prediction, manifold,
                )?;
            }
        }
        Ok(())
    }

    fn contact_manifold_convex_convex(
        &self,
        pos12: &Pose,
        g1: &dyn Shape,
        g2: &dyn Shape,
        normal_constraints1: Option<&dyn NormalConstraints>,
        normal_constraints2: Option<&dyn NormalConstraints>,
        prediction: Real,
        manifold: &mut Manifold,
    ) -> Result<(), Unsupported> {
        let constraints = [normal_constraints1, normal_constraints2];
        polyhedra::touch(pos12, [g1, g2], constraints, prediction, manifold)
    }
}

impl QueryDispatcher for PieceContacts {
    fn intersection_test(
        &self,
        pos12: &Pose,
        g1: &dyn Shape,
        g2: &dyn Shape,
    ) -> Result<rapier3d::parry::query::ShapeIntersection, Unsupported> {
        DefaultQueryDispatcher.intersection_test(pos12, g1, g2)
    }

    fn distance(
        &self,
        pos12: &Pose,
        g1: &dyn Shape,
        g2: &dyn Shape,
    ) -> Result<rapier3d::parry::query::ShapeDistance, Unsupported> {
        DefaultQueryDispatcher.distance(pos12, g1, g2)
    }

    fn contact(
        &self,
        pos12: &Pose,
        g1: &dyn Shape,
        g2: &dyn Shape,
        prediction: Real,
    ) -> Result<Option<Contact>, Unsupported> {
        DefaultQueryDispatcher.contact(pos12, g1, g2, prediction)
    }

    fn closest_points(
        &self,
        pos12: &Pose,
        g1: &dyn Shape,
        g2: &dyn Shape,
        max_dist: Real,
    ) -> Result<ClosestPoints, Unsupported> {
        DefaultQueryDispatcher.closest_points(pos12, g1, g2, max_dist)
    }

    fn cast_shapes(
        &self,
        pos12: &Pose,
        local_vel12: Vector,
        g1: &dyn Shape,
        g2: &dyn Shape,
        options: ShapeCastOptions,
    ) -> Result<Option<ShapeCastHit>, Unsupported> {
        DefaultQueryDispatcher.cast_shapes(pos12, local_vel12, g1, g2, options)
    }

    fn cast_shapes_nonlinear(
        &self,
        motion1: &NonlinearRigidMotion,
        g1: &dyn Shape,
        motion2: &NonlinearRigidMotion,
        g2: &dyn Shape,
        start_time: Real,
        end_time: Real,
        stop_at_penetration: bool,
    ) -> Result<Option<ShapeCastHit>, Unsupported> {
        DefaultQueryDispatcher.cast_shapes_nonlinear(
            motion1,
            g1,
            motion2,
            g2,
            start_time,
            end_time,
            stop_at_penetration,
        )
    }
}
