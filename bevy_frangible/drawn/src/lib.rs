//! Parts that the examples with a window share: a studio with light, props, looks, and pictures drawn without a window.
//!
//! Each example takes `--picture FILE` to draw one picture after a number of steps and end, `--steps N` for another number of them, and
//! `--gizmos` to show weak points and the last contacts, which the key G does in the window.

mod arguments;
mod looks;
mod picture;
mod props;
#[cfg(any(not(target_os = "linux"), feature = "speaker"))]
mod speaker;
mod studio;

use std::error::Error;

use avian3d::prelude::*;
use bevy::input::common_conditions::input_just_pressed;
use bevy::prelude::*;
use bevy_frangible::prelude::*;
use bevy_frangible::{FrangibleGizmos, FrangibleGizmosPlugin, FrangibleSoundPlugin};
use frangible_bake::{Shape, Support};

use arguments::Arguments;
pub use looks::Materials;
pub use props::Props;
pub use studio::Camera;

/// Camera and window of an example.
#[derive(Clone, Debug)]
pub struct View {
    /// Title of the window, with the keys that it knows.
    pub title: &'static str,
    /// Position of the camera, m.
    pub eye: Vec3,
    /// Point that the camera looks at, m.
    pub target: Vec3,
    /// Steps of physics per second, 1/s.
    pub rate: f64,
    /// Number of steps after which a picture is drawn.
    pub steps: u32,
}

/// An app with Bevy's plugins, Avian, bodies that break, and a studio; with a window, or for one picture where the program's arguments ask
/// for it.
///
/// # Errors
/// An argument that is not known, with the ones that are.
pub fn app(view: &View) -> Result<App, Box<dyn Error>> {
    let arguments = Arguments::read(std::env::args().skip(1))?;
    let mut app = App::new();
    app.insert_resource(Time::<Fixed>::from_hz(view.rate));
    match &arguments.picture {
        Some(file) => picture::plugins(
            &mut app,
            file.clone(),
            arguments.steps.unwrap_or(view.steps),
        ),
        None => {
            studio::window(&mut app, view.title);
            app.add_plugins(FrangibleSoundPlugin::default());
            #[cfg(any(not(target_os = "linux"), feature = "speaker"))]
            speaker::play(&mut app);
        }
    }
    app.add_plugins((
        PhysicsPlugins::default().with_collision_hooks::<FrangibleHooks>(),
        FrangiblePlugin::default(),
        LooksPlugin::<MeshMaterial3d<StandardMaterial>>::default(),
        FrangibleGizmosPlugin,
    ))
    .init_resource::<Materials>()
    .add_observer(looks::let_light_through)
    .add_observer(|broke: On<Broke>| info!("{} pieces", broke.fragments.len()))
    .add_observer(|failed: On<BreakFailed>| error!("{}", failed.reason))
    .add_systems(
        Update,
        switch_gizmos.run_if(input_just_pressed(KeyCode::KeyG)),
    );
    app.world_mut()
        .resource_mut::<GizmoConfigStore>()
        .config_mut::<FrangibleGizmos>()
        .0
        .enabled = arguments.gizmos;
    studio::furnish(&mut app, view);
    Ok(app)
}

fn switch_gizmos(mut store: ResMut<GizmoConfigStore>) {
    let (config, _) = store.config_mut::<FrangibleGizmos>();
    config.enabled = !config.enabled;
}

/// Bakes a kind of body of about so many tetrahedra and gives it to the app. A page fetches it instead, baked, as a game loads it from a
/// file: `assets/MATERIAL.frangible` beside the page.
///
/// # Errors
/// A material or a shape that cannot be baked.
#[cfg(not(target_family = "wasm"))]
pub fn kind(
    app: &mut App,
    shape: Shape,
    material: &str,
    tets: f64,
    supports: Vec<Support>,
) -> Result<Handle<FrangibleAsset>, Box<dyn Error>> {
    use bevy_frangible::frangible::Material;
    use frangible_bake::{BakeSpec, bake};
    let spec = BakeSpec {
        fracture: Some(shape.size_for(tets)?),
        supports,
        ..BakeSpec::for_games(material, shape, Material::preset(material)?)?
    };
    let asset = FrangibleAsset::new(bake(&spec)?)?;
    Ok(app
        .world_mut()
        .resource_mut::<Assets<FrangibleAsset>>()
        .add(asset))
}

/// Fetches a kind of body that was baked before: `assets/MATERIAL.frangible` beside the page.
///
/// # Errors
/// None here: a body that cannot be fetched is reported on the console.
#[cfg(target_family = "wasm")]
pub fn kind(
    app: &mut App,
    _: Shape,
    material: &str,
    _: f64,
    _: Vec<Support>,
) -> Result<Handle<FrangibleAsset>, Box<dyn Error>> {
    let server = app.world().resource::<AssetServer>();
    Ok(server.load(format!("{material}.frangible")))
}
