//! Style of the panels and of the words over the picture.

use egui::{Align2, Color32, Context, FontId, LayerId, TextStyle, Theme, Visuals};
use frangible::glam::Vec2;

use super::Panels;

/// Size of remarks, points.
const SMALL: f32 = 11.0;

impl Panels {
    /// Gives all panels their colours and sizes, where these are others than before.
    pub(super) fn style(&mut self, ctx: &Context) {
        if self.styled == Some(self.dark) {
            return;
        }
        self.styled = Some(self.dark);
        let (theme, mut visuals, [r, g, b], text) = if self.dark {
            (Theme::Dark, Visuals::dark(), [24, 26, 29], 228)
        } else {
            (Theme::Light, Visuals::light(), [250; 3], 20)
        };
        visuals.window_fill = Color32::from_rgba_unmultiplied(r, g, b, 238);
        visuals.override_text_color = Some(Color32::from_gray(text));
        ctx.set_theme(theme);
        ctx.set_visuals(visuals);
        // The usual small size is hard to read on a plain screen.
        ctx.all_styles_mut(|style| {
            if let Some(font) = style.text_styles.get_mut(&TextStyle::Small) {
                font.size = SMALL;
            }
        });
    }
}

/// Words over the picture and under the panels, each in the middle above its place.
pub(super) fn write_words(ctx: &Context, words: &[(Vec2, String)]) {
    let painter = ctx.layer_painter(LayerId::background());
    let size = ctx.content_rect().size();
    for (at, text) in words {
        let at = egui::pos2(at.x * size.x, at.y * size.y);
        let font = FontId::proportional(15.0);
        let color = Color32::from_gray(20);
        let galley = painter.layout_no_wrap(text.clone(), font, color);
        let place = Align2::CENTER_BOTTOM.anchor_size(at, galley.size());
        let paper = Color32::from_rgba_unmultiplied(255, 255, 255, 170);
        painter.rect_filled(place.expand(3.0), 3.0, paper);
        painter.galley(place.min, galley, color);
    }
}
