//! Keys and mouse.

use egui::{Align2, Grid};

use crate::window::input::KEYS;

/// Width of the list, points.
const WIDTH: f32 = 470.0;

pub(super) fn show(ctx: &egui::Context, open: &mut bool) {
    let height = ctx.content_rect().height() - 60.0;
    egui::Window::new("Keys and mouse")
        .open(open)
        .collapsible(false)
        .resizable(false)
        .default_size([WIDTH, height])
        .anchor(Align2::CENTER_CENTER, [0.0, 0.0])
        .show(ctx, |ui| {
            egui::ScrollArea::vertical()
                .max_height(height)
                .auto_shrink([false, true])
                .show(ui, |ui| {
                    Grid::new("keys")
                        .num_columns(2)
                        .striped(true)
                        .show(ui, |ui| {
                            for (hand, does) in [
                                ("click", "throw the ball there, or swing the hammer"),
                                ("shift + click", "select a piece: mass, volume, size, speed"),
                                ("ctrl + drag", "take hold of a thing, and fling it"),
                                ("drag", "turn the camera"),
                                ("shift + drag", "move it (or drag with the wheel pressed)"),
                                ("wheel", "nearer or farther"),
                                ("drop a file", "a mesh, a baked body, a scene"),
                            ] {
                                ui.strong(hand);
                                ui.label(does);
                                ui.end_row();
                            }
                            for (_, name, _, does) in KEYS {
                                ui.strong(name);
                                ui.label(does);
                                ui.end_row();
                            }
                        });
                });
        });
}
