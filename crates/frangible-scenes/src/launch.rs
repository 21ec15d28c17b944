//! Projectiles on their way to a body.

use frangible::Material;
use frangible::glam::{Quat, Vec3};
use frangible_rapier::rapier3d::dynamics::RigidBodyHandle;
use frangible_rapier::rapier3d::geometry::SharedShape;
use frangible_rapier::rapier3d::math::{Pose, Rotation, Vector};
use frangible_rapier::{Ball, BreakableWorld, SurfaceProperties};
use frangible_recording::RecordedMesh;

use crate::error::SceneError;
use crate::hammer::Head;
use crate::meshes::ball;
use crate::projectile::{Projectile, ProjectileKind};

/// A sphere that holds the target: centre and radius, m.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Target {
    pub(crate) centre: Vec3,
    pub(crate) reach: f32,
}

/// A projectile that flies.
pub(crate) struct Launched {
    pub(crate) handle: RigidBodyHandle,
    pub(crate) mesh: RecordedMesh,
    /// Time until it is where it is aimed at, s.
    pub(crate) flight: f64,
}

/// Starts the projectile a twentieth of a second of flight outside the target; its look has this surface.
pub(crate) fn launch(
    world: &mut BreakableWorld,
    projectile: &Projectile,
    target: Target,
    floor: bool,
    surface: usize,
) -> Result<Launched, SceneError> {
    let material = Material::preset(&projectile.material)?;
    match projectile.kind {
        ProjectileKind::Ball => {
            let radius = projectile.radius as f32;
            let (start, velocity, flight) = flight(world, projectile, target, [radius; 2], floor)?;
            let properties = SurfaceProperties::of(&material, radius);
            let pose = Pose::from_translation(vector(start));
            let mass = projectile.mass as f32;
            let solid = Ball { mass, radius };
            let handle = world.insert_ball(solid, properties, pose, vector(velocity))?;
            Ok(Launched {
                handle,
                mesh: ball(radius, surface),
                flight,
            })
        }
        ProjectileKind::Hammer { crown } => {
            let mut head = Head::new(projectile.radius, crown, projectile.mass, material.density);
            let hull = hull(&head, projectile.radius)?;
            // The centre of mass becomes the origin.
            head.shift(-hull.mass_properties(1.0).local_com.z);
            let q = Quat::from_rotation_arc(Vec3::Z, projectile.toward.normalize());
            let depths = head.points().into_iter().map(|p| -(q * p).y);
            let extents = [head.reach(), depths.fold(0.0, f32::max)];
            let (start, velocity, flight) = flight(world, projectile, target, extents, floor)?;
            let properties = SurfaceProperties::of(&material, crown as f32);
            let pose = Pose::from_parts(vector(start), Rotation::from_xyzw(q.x, q.y, q.z, q.w));
            let mass = projectile.mass as f32;
            let shape = self::hull(&head, projectile.radius)?;
            let handle = world.insert_rigid(shape, mass, properties, pose, vector(velocity))?;
            Ok(Launched {
                handle,
                mesh: head.mesh(surface),
                flight,
            })
        }
    }
}

pub(crate) fn hull(head: &Head, radius: f64) -> Result<SharedShape, SceneError> {
    let points: Vec<Vector> = head.points().into_iter().map(vector).collect();
    SharedShape::convex_hull(&points).ok_or_else(|| SceneError::Quantity {
        what: "the hammer's radius",
        value: radius.to_string(),
        must: "large enough for a shape of any volume",
    })
}

/// Start, velocity and time of flight, s, of something of these extents (m: in any direction, and downwards), outside the target's sphere, so that it cannot start inside the
/// body; and back in time along the parabola that arrives with the speed and direction asked for.
fn flight(
    world: &BreakableWorld,
    projectile: &Projectile,
    target: Target,
    [radius, below]: [f32; 2],
    floor: bool,
) -> Result<(Vec3, Vec3, f64), SceneError> {
    let direction = projectile.toward.normalize();
    let speed = projectile.speed as f32;
    let distance = (0.05 * speed).clamp(0.1, 1.0);
    let flight = (target.reach + radius + distance) / speed;
    let gravity = Vec3::from(world.physics.gravity.to_array());
    let start = target.centre + projectile.at - direction * (speed * flight)
        + 0.5 * gravity * flight * flight;
    let velocity = direction * speed - gravity * flight;
    if floor && start.y < below {
        return Err(SceneError::BallBelowFloor {
            what: projectile.kind.name(),
            depth_mm: 1e3 * (below - start.y),
        });
    }
    Ok((start, velocity, f64::from(flight)))
}

pub(crate) fn vector(v: Vec3) -> Vector {
    Vector::new(v.x, v.y, v.z)
}
