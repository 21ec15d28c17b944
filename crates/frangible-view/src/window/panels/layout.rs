//! Positions of the panels, and the space that they leave free for the picture.

use egui::{Align2, Context};
use frangible_draw::kiss3d::window::Window;

use super::Panels;

/// Width of the panels at the sides, points.
pub(super) const LEFT: f32 = 244.0;
pub(super) const RIGHT: f32 = 330.0;

/// Distance from the window's edges, points.
pub(super) const EDGE: f32 = 6.0;

/// A window in which both panels would leave too little to see, points.
const NARROW: f32 = 820.0;

impl Panels {
    /// Shift of the picture's middle out of the panels' way, in shares of half the window.
    pub(in crate::window) fn shift(&self, window: &Window) -> [f32; 2] {
        let points = window.width() as f32 / window.scale_factor() as f32;
        let [left, right] = self.margins(points);
        [(left - right) / points.max(1.0), 0.0]
    }

    /// Width over height of the space that the panels leave free.
    pub(in crate::window) fn free_aspect(&self, window: &Window) -> f32 {
        let scale = window.scale_factor() as f32;
        let points = window.width() as f32 / scale;
        let [left, right] = self.margins(points);
        let free = points - left - right;
        free.max(1.0) * scale / window.height().max(1) as f32
    }

    /// Returns true if the panel on the left is there: in a narrow window it makes room for the other.
    pub(super) fn shows_play(&self, window_points: f32) -> bool {
        self.play && (self.tab.is_none() || window_points >= NARROW)
    }

    /// Width that panels take at the left and the right, points.
    pub(super) fn margins(&self, window_points: f32) -> [f32; 2] {
        let width = |there: bool, width: f32| if there { width + 2.0 * EDGE } else { 0.0 };
        [
            width(self.shows_play(window_points), LEFT),
            width(self.tab.is_some(), RIGHT),
        ]
    }
}

/// A panel at a side of the window, as high as it is.
pub(super) fn side(
    ctx: &Context,
    id: &str,
    at: Align2,
    width: f32,
    contents: impl FnOnce(&mut egui::Ui),
) {
    let height = ctx.content_rect().height() - 2.0 * EDGE;
    let toward = if at == Align2::LEFT_TOP { EDGE } else { -EDGE };
    egui::Window::new(id)
        .title_bar(false)
        .resizable(false)
        .anchor(at, [toward, EDGE])
        .fade_in(false)
        .show(ctx, |ui| {
            ui.set_width(width - 16.0);
            ui.set_max_height(height - 44.0);
            egui::ScrollArea::vertical()
                .max_height(height - 44.0)
                .auto_shrink([false, true])
                .show(ui, contents);
        });
}
