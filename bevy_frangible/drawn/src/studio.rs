//! Light, surroundings and the camera.

use std::f32::consts::PI;

use bevy::asset::AssetMetaCheck;
use bevy::camera::Exposure;
use bevy::core_pipeline::tonemapping::{DebandDither, Tonemapping};
use bevy::image::{Image, ImageSampler};
use bevy::light::{CascadeShadowConfigBuilder, DirectionalLightShadowMap};
use bevy::pbr::{ScreenSpaceTransmission, ScreenSpaceTransmissionQuality};
use bevy::prelude::*;
use bevy::render::render_resource::{
    Extent3d, TextureDimension, TextureFormat, TextureViewDescriptor, TextureViewDimension,
};
use bevy_frangible::Ears;
use half::f16;

use crate::View;

/// Pixels along an edge of the cube of the surroundings, and number of times that it is halved for rougher mirrors.
const EDGE: u32 = 128;
const LEVELS: u32 = 7;

/// Directions over which a level is blurred.
const SAMPLES: u32 = 96;

/// Bevy's plugins with a window.
pub(crate) fn window(app: &mut App, title: &str) {
    let window = Window {
        title: title.into(),
        // On a page, in its canvas.
        canvas: Some("#stage".into()),
        fit_canvas_to_parent: true,
        ..default()
    };
    let plugins = DefaultPlugins.set(WindowPlugin {
        primary_window: Some(window),
        ..default()
    });
    // Many servers answer with a page if there is no file, which would be misread as a file beside the body.
    let plugins = plugins.set(AssetPlugin {
        meta_check: AssetMetaCheck::Never,
        ..default()
    });
    app.add_plugins(plugins);
    #[cfg(target_family = "wasm")]
    {
        // Where a frame takes long, things fall slowly instead of being there at once.
        let mut time = app.world_mut().resource_mut::<Time<Virtual>>();
        time.set_max_delta(std::time::Duration::from_millis(33));
        app.add_systems(Last, tell_first_frame);
    }
}

/// Says when there is something to see.
#[cfg(target_family = "wasm")]
fn tell_first_frame(mut frames: Local<u32>) {
    *frames += 1;
    if *frames == FIRST {
        info!("the scene is drawn");
    }
}

/// Number of frames after which the first one is sure to be on the page.
#[cfg(target_family = "wasm")]
const FIRST: u32 = 4;

/// The camera of an example.
#[derive(Component)]
#[require(Camera3d)]
pub struct Camera;

/// Camera and light.
pub(crate) fn furnish(app: &mut App, view: &View) {
    let mut images = app.world_mut().resource_mut::<Assets<Image>>();
    let surroundings = EnvironmentMapLight {
        diffuse_map: images.add(cube(8, 1, |_| Some(1.0))),
        specular_map: images.add(cube(EDGE, LEVELS, blur)),
        intensity: 1000.0,
        ..default()
    };
    let haze = Color::srgb(0.20, 0.23, 0.26);
    let place = Transform::from_translation(view.eye).looking_at(view.target, Vec3::Y);
    let distance = view.eye.distance(view.target);
    app.insert_resource(ClearColor(haze))
        .insert_resource(GlobalAmbientLight::NONE)
        .insert_resource(DirectionalLightShadowMap { size: 4096 });
    app.world_mut().spawn((
        (Camera, Ears),
        Projection::from(PerspectiveProjection {
            fov: 0.6,
            near: 0.02,
            ..default()
        }),
        Exposure { ev100: 9.3 },
        Tonemapping::TonyMcMapface,
        DebandDither::Disabled,
        ScreenSpaceTransmission {
            steps: 3,
            quality: ScreenSpaceTransmissionQuality::Medium,
        },
        surroundings,
        DistanceFog {
            color: haze,
            falloff: FogFalloff::Linear {
                start: 2.5 * distance,
                end: 12.0 * distance,
            },
            ..default()
        },
        place,
    ));
    let sun = DirectionalLight {
        color: Color::srgb(1.0, 0.96, 0.90),
        illuminance: 7000.0,
        shadow_maps_enabled: true,
        ..default()
    };
    let shadows = CascadeShadowConfigBuilder {
        first_cascade_far_bound: 1.5 * distance,
        maximum_distance: 6.0 * distance,
        num_cascades: 2,
        minimum_distance: 0.05,
        ..default()
    };
    let from = Transform::from_xyz(-0.7, 1.6, 0.5).looking_at(Vec3::ZERO, Vec3::Y);
    app.world_mut().spawn((sun, shadows.build(), from));
}

/// Light from a direction: a pale room with a dark floor, a soft box overhead, one to the left and a narrow one behind to the right.
fn radiance(direction: Vec3) -> Vec3 {
    let sky = Vec3::new(0.34, 0.40, 0.48);
    let wall = Vec3::new(0.16, 0.17, 0.18);
    let ground = Vec3::new(0.07, 0.065, 0.06);
    let up = direction.y;
    let room = match up > 0.0 {
        true => wall.lerp(sky, up.sqrt()),
        false => wall.lerp(ground, (-4.0 * up).min(1.0)),
    };
    // The middle of a box, its half width and height there, and how bright it is.
    let boxes = [
        (Vec3::new(-0.2, 1.0, 0.1), [0.55, 0.35], 6.0),
        (Vec3::new(-1.0, 0.35, 0.2), [0.28, 0.45], 10.0),
        (Vec3::new(0.9, 0.3, -0.6), [0.12, 0.5], 12.0),
    ];
    let lit = boxes.iter().map(|&(at, [width, height], bright)| {
        let at = at.normalize();
        let side = at.any_orthonormal_vector();
        let side = if at.y > 0.9 {
            side
        } else {
            at.cross(Vec3::Y).normalize()
        };
        let depth = direction.dot(at);
        let across = (direction.dot(side) / depth.max(1e-3)).abs() / width;
        let along = (direction.dot(side.cross(at)) / depth.max(1e-3)).abs() / height;
        let edge = (8.0 * (1.0 - across.max(along))).clamp(0.0, 1.0);
        if depth > 0.0 { bright * edge } else { 0.0 }
    });
    room + Vec3::splat(lit.sum())
}

/// Roughness of the mirrors that use a mip level. The first level is sharp.
fn blur(level: u32) -> Option<f32> {
    (level > 0).then(|| level as f32 / (LEVELS - 1) as f32)
}

/// The surroundings as an image of six faces with levels, each blurred for a mirror of its roughness, 1 as a matt surface sees them.
fn cube(edge: u32, levels: u32, roughness: impl Fn(u32) -> Option<f32>) -> Image {
    let mut bytes = Vec::new();
    for face in 0..6 {
        for level in 0..levels {
            let size = edge >> level;
            let blurred = roughness(level);
            for (row, column) in (0..size).flat_map(|r| (0..size).map(move |c| (r, c))) {
                let at = |k: u32| 2.0 * (k as f32 + 0.5) / size as f32 - 1.0;
                let seen = direction(face, at(column), at(row));
                let light = blurred.map_or_else(|| radiance(seen), |r| mean_radiance(seen, r));
                for number in [light.x, light.y, light.z, 1.0] {
                    bytes.extend(f16::from_f32(number).to_le_bytes());
                }
            }
        }
    }
    let size = Extent3d {
        width: edge,
        height: edge,
        depth_or_array_layers: 6,
    };
    let format = TextureFormat::Rgba16Float;
    let mut image = Image::new_uninit(size, TextureDimension::D2, format, default());
    image.data = Some(bytes);
    image.texture_descriptor.mip_level_count = levels;
    image.sampler = ImageSampler::linear();
    image.texture_view_descriptor = Some(TextureViewDescriptor {
        dimension: Some(TextureViewDimension::Cube),
        ..default()
    });
    image
}

/// Direction of a point on a face of the cube. Bevy looks at cubes from the other side.
fn direction(face: u32, u: f32, v: f32) -> Vec3 {
    let seen = match face {
        0 => Vec3::new(1.0, -v, -u),
        1 => Vec3::new(-1.0, -v, u),
        2 => Vec3::new(u, 1.0, v),
        3 => Vec3::new(u, -1.0, -v),
        4 => Vec3::new(u, -v, 1.0),
        _ => Vec3::new(-u, -v, -1.0),
    };
    (seen * Vec3::new(1.0, 1.0, -1.0)).normalize()
}

/// The mean over a lobe about a direction, whose width grows with the roughness to that of a matt surface.
fn mean_radiance(about: Vec3, roughness: f32) -> Vec3 {
    let exponent = 2.0 / roughness.powi(4) - 1.0;
    let (side, other) = about.any_orthonormal_pair();
    let golden = PI * (3.0 - 5.0_f32.sqrt());
    let sum: Vec3 = (0..SAMPLES)
        .map(|k| {
            // Spread evenly over the lobe.
            let share = (k as f32 + 0.5) / SAMPLES as f32;
            let cosine = (1.0 - share).powf(1.0 / (exponent + 1.0));
            let sine = (1.0 - cosine * cosine).max(0.0).sqrt();
            let (turned, raised) = (golden * k as f32).sin_cos();
            radiance(about * cosine + (side * raised + other * turned) * sine)
        })
        .sum();
    sum / SAMPLES as f32
}
