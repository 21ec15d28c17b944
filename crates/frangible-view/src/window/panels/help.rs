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
                                ("click", "throw the ball at this point, or swing the hammer"),
                                (
                                    "shift + click",
                                    "select a piece to show its mass, volume, size and speed",
                                ),
                                ("ctrl + drag", "grab an object and fling it"),
                                ("drag", "orbit the camera"),
                                (
                                    "shift + drag",
                                    "pan the camera (or drag with the middle button)",
                                ),
                                ("wheel", "zoom"),
                                ("drop a file", "load a mesh, a baked body or a scene"),
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
