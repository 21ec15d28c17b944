//! The line at the lower edge: time, pieces, and the last message.

use egui::{Align2, Color32, RichText};

use super::Panels;
use super::layout::EDGE;
use crate::command::{Command, Subject};
use crate::shown::Shown;

impl Panels {
    pub(super) fn status(&self, ctx: &egui::Context, shown: &Shown, commands: &mut Vec<Command>) {
        let [left, right] = self.margins(ctx.content_rect().width());
        let shift = 0.5 * (left - right);
        egui::Window::new("status")
            .title_bar(false)
            .resizable(false)
            .anchor(Align2::CENTER_BOTTOM, [shift, -EDGE])
            .fade_in(false)
            .show(ctx, |ui| {
                ui.horizontal(|ui| {
                    ui.label(summary(shown));
                    if shown.subject != Subject::World
                        && ui.small_button("back to the scene").clicked()
                    {
                        commands.push(Command::Look(Subject::World));
                    }
                });
                let message = match (&self.note, &shown.message) {
                    (Some(note), _) => Some((note.clone(), false)),
                    (None, message) => message.clone(),
                };
                if let Some((text, complaint)) = message {
                    ui.set_max_width(420.0);
                    let text = RichText::new(text);
                    ui.label(match complaint {
                        true => text.color(Color32::from_rgb(235, 110, 80)),
                        false => text,
                    });
                }
                if shown.turned {
                    ui.small("knobs changed: H repeats the impact with them, R restarts the scene");
                }
            });
    }
}

fn summary(shown: &Shown) -> String {
    if shown.starts == 0 {
        return match &shown.bake {
            Some(_) => format!("baking {}", shown.scene),
            None => "no scene".into(),
        };
    }
    let mut parts = vec![format!("t = {:.3} s", shown.time)];
    if shown.paused {
        parts.push("paused".into());
    } else if shown.slow_motion < 0.999 {
        parts.push(format!("1/{:.0} of real time", 1.0 / shown.slow_motion));
    }
    parts.push(match (shown.whole, shown.pieces) {
        (whole, 0) => format!("{whole} whole"),
        (0, pieces) => format!("{pieces} pieces"),
        (whole, pieces) => format!("{whole} whole, {pieces} pieces"),
    });
    if shown.analysing {
        parts.push("computing …".into());
    }
    parts.join("  ·  ")
}
