//! Surroundings of the stage: backdrop, haze, reflections, shadow quality.

use image::{DynamicImage, Rgb32FImage};
use kiss3d::color::Color;
use kiss3d::light::Fog;
use kiss3d::window::Window;

/// The backdrop, linear; the floor fades into it.
const BACKDROP: [f32; 3] = [0.49; 3];

/// Sets up a fresh window, seen or not, once.
pub(crate) fn furnish(window: &mut Window) {
    let [red, green, blue] = BACKDROP;
    window.set_background_color(Color::new(red, green, blue, 1.0));
    window.set_shadow_resolution(1024);
    window.set_shadow_atlas_layers(1);
    window.set_shadow_softness(1.6);
    window.set_bloom_enabled(false);
    // Glass behind glass, one layer deep; a third step changes little.
    window.transmission_settings_mut().steps = 2;
}

/// Surroundings and the haze that the floor fades into, or the plain backdrop alone.
pub(crate) fn surround(window: &mut Window, wanted: bool) {
    if wanted && !window.has_skybox() {
        window.set_skybox_image(&surroundings());
    } else if !wanted && window.has_skybox() {
        window.clear_skybox();
    }
    // Beyond everything, where there is no floor.
    haze(window, if wanted { HAZE } else { [1e3, 1e4] });
}

/// Distances from the camera at which the haze begins and at which it hides all, stage units.
pub(crate) const HAZE: [f32; 2] = [4.5, 13.0];

/// Sets the distances from the camera at which the haze begins and at which it hides all, stage units.
pub(crate) fn haze(window: &mut Window, [near, far]: [f32; 2]) {
    let [red, green, blue] = BACKDROP;
    window.set_fog(Fog::linear(Color::new(red, green, blue, 1.0), near, far));
}

/// Surroundings that light the stage and mirror in it, as an equirectangular picture: the backdrop at the horizon, a pale ceiling with a soft box, a
/// dim ground.
fn surroundings() -> DynamicImage {
    const WIDTH: u32 = 128;
    const HEIGHT: u32 = 64;
    DynamicImage::ImageRgb32F(Rgb32FImage::from_fn(WIDTH, HEIGHT, |x, y| {
        let up = 1.0 - 2.0 * (y as f32 + 0.5) / HEIGHT as f32;
        let around = (x as f32 + 0.5) / WIDTH as f32;
        let soft_box = (0.35..0.8).contains(&up) && (around * 4.0).fract() < 0.4;
        let light = if soft_box {
            2.6
        } else if up > 0.0 {
            1.0 + 0.35 * up
        } else {
            1.0 + 0.6 * up
        };
        image::Rgb(BACKDROP.map(|part| 0.95 * part * light))
    }))
}
