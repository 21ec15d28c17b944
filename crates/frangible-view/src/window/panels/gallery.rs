//! Small pictures of the built-in scenes.

use egui::{ColorImage, Context, TextureHandle, TextureOptions};

macro_rules! picture {
    ($name:literal) => {
        ($name, include_bytes!(concat!("../thumbs/", $name, ".png")))
    };
}

/// Scene and PNG; just after the break, from the pictures of the gallery.
const PICTURES: [(&str, &[u8]); 32] = [
    picture!("bottle"),
    picture!("bowl"),
    picture!("brick"),
    picture!("bulb"),
    picture!("cantilever"),
    picture!("chandelier"),
    picture!("chocolate"),
    picture!("crockery"),
    picture!("five-blows"),
    picture!("glass"),
    picture!("hammer"),
    picture!("ice-sheet"),
    picture!("pane"),
    picture!("phone"),
    picture!("piggy-bank"),
    picture!("plate"),
    picture!("rabbit"),
    picture!("shards"),
    picture!("shelf"),
    picture!("shop-front"),
    picture!("shower-door"),
    picture!("side-window"),
    picture!("statue"),
    picture!("table-top"),
    picture!("tiles"),
    picture!("vase"),
    picture!("wall"),
    picture!("window"),
    picture!("windscreen"),
    picture!("windscreen-hole"),
    picture!("windscreen-web"),
    picture!("wine-glass"),
];

/// The pictures, on the graphics card from the first time they are asked for.
#[derive(Default)]
pub(super) struct Gallery(Vec<(&'static str, TextureHandle)>);

impl Gallery {
    /// The picture of a scene, if there is one.
    pub(super) fn picture(&mut self, ctx: &Context, scene: &str) -> Option<&TextureHandle> {
        if self.0.is_empty() {
            self.0 = PICTURES
                .into_iter()
                .filter_map(|(name, png)| Some((name, load(ctx, name, png)?)))
                .collect();
        }
        let found = self.0.iter().find(|(name, _)| *name == scene);
        found.map(|(_, texture)| texture)
    }
}

fn load(ctx: &Context, name: &str, png: &[u8]) -> Option<TextureHandle> {
    let picture = image::load_from_memory(png).ok()?.to_rgb8();
    let size = [picture.width() as usize, picture.height() as usize];
    let pixels = ColorImage::from_rgb(size, &picture);
    Some(ctx.load_texture(name, pixels, TextureOptions::LINEAR))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_scene_has_a_picture_that_can_be_read() {
        for scene in frangible_scenes::SCENE_NAMES {
            let (_, png) = PICTURES
                .iter()
                .find(|(name, _)| *name == scene)
                .expect(scene);
            let picture = image::load_from_memory(png).expect(scene);
            assert_eq!((picture.width(), picture.height()), (96, 60));
        }
    }
}
