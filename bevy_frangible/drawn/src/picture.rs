//! One picture, drawn without a window: the scene runs for a number of steps, stands still, and is drawn into an image.

use std::path::{Path, PathBuf};
use std::time::Duration;

use bevy::app::ScheduleRunnerPlugin;
use bevy::camera::RenderTarget;
use bevy::prelude::*;
use bevy::render::RenderPlugin;
use bevy::render::render_resource::TextureFormat;
use bevy::render::view::screenshot::{Screenshot, ScreenshotCaptured};
use bevy::time::TimeUpdateStrategy;
use bevy::window::ExitCondition;
use bevy::winit::WinitPlugin;

/// Width and height, pixels.
const SIZE: [u32; 2] = [880, 550];

/// Frames that are drawn before the one that is kept, so that all that it needs is on the device.
const WARM_UP: u32 = 4;

/// Picture to draw, and the time to draw it.
#[derive(Resource)]
struct Picture {
    file: PathBuf,
    /// Frames left: the scene runs, then stands and is drawn.
    left: u32,
    target: Handle<Image>,
}

/// Bevy's plugins without a window; each frame is one step of physics.
pub(crate) fn plugins(app: &mut App, file: PathBuf, steps: u32) {
    let no_window = WindowPlugin {
        primary_window: None,
        exit_condition: ExitCondition::DontExit,
        ..default()
    };
    let patient = RenderPlugin {
        synchronous_pipeline_compilation: true,
        ..default()
    };
    let plugins = DefaultPlugins.set(no_window).set(patient);
    app.add_plugins(plugins.disable::<WinitPlugin>())
        .add_plugins(ScheduleRunnerPlugin::run_loop(Duration::ZERO));
    let [width, height] = SIZE;
    let target = Image::new_target_texture(width, height, TextureFormat::Rgba8UnormSrgb, None);
    let target = app.world_mut().resource_mut::<Assets<Image>>().add(target);
    let step = app.world().resource::<Time<Fixed>>().timestep();
    let left = steps + WARM_UP;
    app.insert_resource(TimeUpdateStrategy::ManualDuration(step))
        .insert_resource(Picture { file, left, target })
        .add_systems(PostStartup, aim)
        .add_systems(Last, count);
}

/// The camera looks at the image, and sleeps while the scene runs.
fn aim(picture: Res<Picture>, camera: Single<(Entity, &mut Camera)>, mut commands: Commands) {
    let (entity, mut camera) = camera.into_inner();
    camera.is_active = false;
    let target = RenderTarget::Image(picture.target.clone().into());
    commands.entity(entity).insert(target);
}

fn count(
    mut picture: ResMut<Picture>,
    mut time: ResMut<Time<Virtual>>,
    mut camera: Single<&mut Camera>,
    mut commands: Commands,
) {
    if picture.left == 0 {
        return;
    }
    picture.left -= 1;
    if picture.left == WARM_UP {
        time.pause();
        camera.is_active = true;
    }
    if picture.left == 0 {
        let shot = Screenshot::image(picture.target.clone());
        commands.spawn(shot).observe(keep);
    }
}

/// Writes the picture and ends the app.
fn keep(shot: On<ScreenshotCaptured>, picture: Res<Picture>, mut exit: MessageWriter<AppExit>) {
    exit.write(match save(&shot.image, &picture.file) {
        Ok(()) => AppExit::Success,
        Err(reason) => {
            error!("{}: {reason}", picture.file.display());
            AppExit::error()
        }
    });
}

/// The file is whole under its name, or not there.
fn save(image: &Image, file: &Path) -> Result<(), Box<dyn std::error::Error>> {
    let pixels = image.clone().try_into_dynamic()?.to_rgb8();
    let name = file.file_name().ok_or("it does not name a file")?;
    let part = file.with_file_name(format!("part-{}", name.to_string_lossy()));
    pixels.save(&part)?;
    Ok(std::fs::rename(part, file)?)
}
