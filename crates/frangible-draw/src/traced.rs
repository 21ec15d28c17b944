//! Path-traced pictures: glass refracts, and shadows are what light does not reach.

use std::sync::Arc;

use frangible_export::glam::Vec3;
use frangible_export::{Recording, SurfaceMaterial, View};
use image::RgbImage;
use kiss3d::color::Color;
use kiss3d::context::Context;
use kiss3d::light::Light;
use kiss3d::renderer::RayTracer;
use kiss3d::scene::{Bsdf, SceneNode3d};
use kiss3d::window::OffscreenSurface;
use wgpu::PollType;

use crate::camera::StillCamera;
use crate::floor::{Laid, add_floor, texels};
use crate::floor_shadow::{Fineness, FloorShadow};
use crate::stage::{
    FLOOR, GLASS_DEPTH, StageUnits, THINGS, add_faces, bunches, casters, clarity, dress, key_light,
};

/// Told after each sample how many there are per pixel; says whether to go on.
pub type GoOn = Arc<dyn Fn(u32) -> bool + Send + Sync>;

/// Faces that a ray of light may meet: a shard has two, and there are shards behind shards.
const BOUNCES: u32 = 14;

/// Below so many samples the picture is smoothed, with an eye to its edges.
const CLEAN: u32 = 256;

/// How a picture is traced.
pub(crate) struct Tracing {
    /// Samples per pixel.
    pub(crate) samples: u32,
    pub(crate) go_on: GoOn,
}

/// Builds the scene of a recording's first frame for the path tracer: one lamp as large as the pictures say, and the
/// surroundings for the rest.
pub(crate) fn traced_stage(recording: &Recording, view: &View) -> SceneNode3d {
    let units = StageUnits::of(view);
    let mut scene = SceneNode3d::empty();
    let key = key_light(&units.view(view));
    scene
        .add_light(
            Light::spot(0.55, 0.85, 60.0)
                .with_color(Color::new(1.0, 0.97, 0.93, 1.0))
                .with_intensity(1.45)
                .with_radius(1.0)
                .with_layers(THINGS | FLOOR),
        )
        .reorient(key, 2.0 * key, key.cross(Vec3::Y).normalize());
    if let Some(floor) = &recording.floor {
        let height = (floor.height - units.origin.y) * units.scale;
        // The lamp shines through clear things, so their share of the shadow is painted, as in the other pictures.
        let mut clear = casters(recording, units);
        clear.retain(|caster| caster.clarity > 0.0);
        let shadow = FloorShadow::cast(&clear, height, key, Fineness::STILL);
        let laid = Laid {
            height,
            color: floor.base_color,
            texels: &texels(&shadow),
            shadow: &shadow,
            mipmaps: true,
        };
        add_floor(&mut scene, laid).set_casts_shadows(true);
    }
    for bunch in bunches(recording, units) {
        let surface = &recording.surfaces[bunch.surface];
        let mut node = add_faces(&mut scene, bunch);
        dress(&mut node, surface);
        if clarity(surface) > 0.0 {
            dress_in_glass(&mut node, surface);
        }
    }
    scene
}

/// Clear things bend light. Their colour lies in their depth, and the lamp shines through them: a lamp behind glass is found by
/// no path but a lucky one.
fn dress_in_glass(node: &mut SceneNode3d, surface: &SurfaceMaterial) {
    let [red, green, blue, _] = surface.base_color;
    node.set_color(Color::new(1.0, 1.0, 1.0, 1.0));
    node.set_bsdf(Bsdf::Glass);
    node.set_transmission(1.0);
    node.set_ior(surface.ior);
    // The outside is polished; a crack face is as it broke.
    node.set_roughness(if surface.roughness < 0.1 { 0.0 } else { 0.12 });
    node.set_attenuation(Color::new(red, green, blue, 1.0), 0.5 * GLASS_DEPTH);
    node.enable_backface_culling(false);
    node.set_casts_shadows(false);
}

/// Traces sample after sample, each waited for so that it can be told; none if nobody wants it any more.
pub(crate) fn trace(
    surface: &mut OffscreenSurface,
    tracer: &mut RayTracer,
    scene: &mut SceneNode3d,
    camera: &mut StillCamera,
    tracing: &Tracing,
) -> Option<RgbImage> {
    tracer.mark_dirty();
    tracer.set_max_bounces(BOUNCES);
    tracer.set_interactive_scale(1.0);
    tracer.set_denoise(tracing.samples < CLEAN);
    for sample in 1..=tracing.samples.max(1) {
        pollster::block_on(surface.raytrace_3d(scene, camera, tracer));
        // A driver that is lost is noticed by whoever reads the picture.
        let _ = Context::get().device.poll(PollType::wait_indefinitely());
        if !(tracing.go_on)(sample) {
            return None;
        }
    }
    Some(surface.snap_image())
}
