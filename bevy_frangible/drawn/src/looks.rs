//! Looks of the props.

use bevy::light::NotShadowCaster;
use bevy::prelude::*;
use bevy_frangible::prelude::*;

/// The look of a body and of its crack faces.
pub type Look = Looks<MeshMaterial3d<StandardMaterial>>;

/// Looks of all props.
#[derive(Resource, Clone)]
pub struct Materials {
    /// Clear outside, a little green and rough where it broke.
    pub glass: Look,
    /// Glazed outside, matt where it broke.
    pub porcelain: Look,
    /// Fired clay.
    pub brick: Look,
    /// A polished ball.
    pub steel: MeshMaterial3d<StandardMaterial>,
    /// A floor, a stone.
    pub stone: MeshMaterial3d<StandardMaterial>,
    /// A board, a frame.
    pub wood: MeshMaterial3d<StandardMaterial>,
    /// A wall outside.
    pub plaster: MeshMaterial3d<StandardMaterial>,
    /// A wall inside.
    pub paint: MeshMaterial3d<StandardMaterial>,
}

/// The clear sides of glass cast next to no shadow, its edges do.
pub(crate) fn let_light_through(
    dressed: On<Insert, MeshMaterial3d<StandardMaterial>>,
    looks: Query<&MeshMaterial3d<StandardMaterial>>,
    materials: Res<Materials>,
    mut commands: Commands,
) {
    if looks.get(dressed.entity) == Ok(&materials.glass.outer) {
        commands.entity(dressed.entity).insert(NotShadowCaster);
    }
}

impl FromWorld for Materials {
    fn from_world(world: &mut World) -> Self {
        let mut known = world.resource_mut::<Assets<StandardMaterial>>();
        let mut add = |material| MeshMaterial3d(known.add(material));
        let clear = |base_color, perceptual_roughness| StandardMaterial {
            base_color,
            perceptual_roughness,
            specular_transmission: 1.0,
            ior: 1.5,
            thickness: 0.002,
            ..default()
        };
        // By WebGL 2 light that goes through glass is next to nothing to see: there its faces are seen one through the other.
        #[cfg(target_family = "wasm")]
        let clear = |base_color: Color, perceptual_roughness: f32| StandardMaterial {
            base_color: base_color.with_alpha(0.2 + perceptual_roughness),
            alpha_mode: AlphaMode::Blend,
            cull_mode: None,
            specular_transmission: 0.0,
            ..clear(base_color, 0.1)
        };
        let matt = |base_color, perceptual_roughness| StandardMaterial {
            base_color,
            perceptual_roughness,
            reflectance: 0.3,
            ..default()
        };
        Self {
            glass: Looks {
                outer: add(clear(Color::srgb(0.96, 0.985, 0.975), 0.02)),
                crack: add(clear(Color::srgb(0.72, 0.92, 0.86), 0.25)),
            },
            porcelain: Looks {
                outer: add(StandardMaterial {
                    base_color: Color::srgb(0.93, 0.93, 0.91),
                    perceptual_roughness: 0.12,
                    ..default()
                }),
                crack: add(matt(Color::srgb(0.86, 0.83, 0.77), 0.9)),
            },
            brick: Looks {
                outer: add(matt(Color::srgb(0.40, 0.20, 0.15), 0.95)),
                crack: add(matt(Color::srgb(0.56, 0.33, 0.25), 0.95)),
            },
            steel: add(StandardMaterial {
                base_color: Color::srgb(0.56, 0.57, 0.58),
                metallic: 1.0,
                perceptual_roughness: 0.15,
                ..default()
            }),
            stone: add(matt(Color::srgb(0.215, 0.215, 0.21), 0.33)),
            wood: add(matt(Color::srgb(0.45, 0.29, 0.17), 0.6)),
            paint: add(matt(Color::srgb(0.09, 0.10, 0.11), 0.9)),
            plaster: add(matt(Color::srgb(0.80, 0.77, 0.70), 0.95)),
        }
    }
}
