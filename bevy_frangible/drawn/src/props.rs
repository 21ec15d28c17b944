//! Things about a body: floor, blocks, balls.

use avian3d::prelude::*;
use bevy::ecs::system::SystemParam;
use bevy::prelude::*;
use bevy_frangible::frangible::Material;
use bevy_frangible::prelude::*;

use crate::Materials;

/// Side of the floor that is drawn, m.
const FLOOR: f32 = 60.0;

/// Puts things into the scene.
#[derive(SystemParam)]
pub struct Props<'w, 's> {
    /// Commands for things that have no method here.
    pub commands: Commands<'w, 's>,
    /// Looks of all things.
    pub materials: Res<'w, Materials>,
    meshes: ResMut<'w, Assets<Mesh>>,
}

impl Props<'_, '_> {
    /// A floor of stone at y = 0.
    pub fn floor(&mut self) {
        let mesh = Plane3d::default().mesh().size(FLOOR, FLOOR);
        self.commands.spawn((
            RigidBody::Static,
            Collider::half_space(Vec3::Y),
            surface("stone"),
            Mesh3d(self.meshes.add(mesh)),
            self.materials.stone.clone(),
        ));
    }

    /// A block that nothing moves, with its middle at a place; sides in m.
    pub fn block(&mut self, size: Vec3, middle: Vec3, look: &MeshMaterial3d<StandardMaterial>) {
        self.commands.spawn((
            RigidBody::Static,
            Collider::cuboid(size.x, size.y, size.z),
            surface("wood"),
            Mesh3d(self.meshes.add(Cuboid::from_size(size))),
            look.clone(),
            Transform::from_translation(middle),
        ));
    }

    /// A lath that is only seen: the thing behind it holds.
    pub fn lath(&mut self, size: Vec3, middle: Vec3, look: &MeshMaterial3d<StandardMaterial>) {
        self.commands.spawn((
            Mesh3d(self.meshes.add(Cuboid::from_size(size))),
            look.clone(),
            Transform::from_translation(middle),
        ));
    }

    /// A ball of steel or stone that flies: radius in m, velocity in m/s.
    pub fn ball(
        &mut self,
        material: &'static str,
        radius: f32,
        at: Vec3,
        velocity: Vec3,
    ) -> Entity {
        let look = match material {
            "steel" => self.materials.steel.clone(),
            _ => self.materials.stone.clone(),
        };
        let mesh = Sphere::new(radius).mesh().uv(48, 32);
        let body = (
            RigidBody::Dynamic,
            Collider::sphere(radius),
            LinearVelocity(velocity),
            // Without a bound Avian lets a fast ball bounce off pieces that it passes.
            SweptCcd::default(),
            SpeculativeMargin(0.02),
        );
        let seen = (
            Mesh3d(self.meshes.add(mesh)),
            look,
            Transform::from_translation(at),
        );
        self.commands.spawn((body, surface(material), seen)).id()
    }
}

/// Friction, restitution, density and striker material of a preset.
fn surface(preset: &str) -> impl Bundle {
    let material = Material::preset(preset).expect("the props are of materials that are known");
    (
        Friction::new(material.friction as f32),
        Restitution::new(material.restitution as f32),
        ColliderDensity(material.density as f32),
        MadeOf(material),
    )
}
