//! Films and path-traced stills, and their progress.

use egui::{DragValue, Ui};

use super::Panels;
use crate::command::{Command, FilmKind};
use crate::shown::Shown;

impl Panels {
    pub(super) fn films(&mut self, ui: &mut Ui, shown: &Shown, commands: &mut Vec<Command>) {
        if let Some(film) = &shown.filming {
            ui.add(egui::ProgressBar::new(film.share as f32).text(film.what.clone()));
            if ui.button("Cancel").clicked() {
                commands.push(Command::CancelSave);
            }
            return;
        }
        ui.horizontal_wrapped(|ui| {
            ui.label("last");
            let seconds = DragValue::new(&mut self.film.seconds)
                .range(0.5..=20.0)
                .speed(0.1)
                .max_decimals(1);
            ui.add(seconds.suffix(" s")).on_hover_text(format!(
                "length of the film; the last {:.1} s are available",
                shown.reel
            ));
            for (label, kind, ending, hint) in [
                (
                    "GIF",
                    FilmKind::Gif,
                    "gif",
                    "the last seconds as shown in the window",
                ),
                (
                    "MP4",
                    FilmKind::Mp4,
                    "mp4",
                    "as shown in the window; requires the program ffmpeg",
                ),
                (
                    "frames",
                    FilmKind::Frames,
                    "frames",
                    "as shown in the window, as a folder of PNG files",
                ),
            ] {
                if ui.small_button(label).on_hover_text(hint).clicked() {
                    commands.push(self.film(shown, kind, ending));
                }
            }
        });
        ui.horizontal_wrapped(|ui| {
            let hint = "path-traced still, with refraction and indirect light; takes seconds to minutes on the CPU";
            if ui.small_button("still").on_hover_text(hint).clicked() {
                commands.push(self.film(shown, FilmKind::Still, "png"));
            }
            let samples = DragValue::new(&mut self.film.samples).range(1..=65_536);
            ui.add(samples.suffix(" samples"))
                .on_hover_text("samples per pixel of a still; noise falls with the square root of the number");
        });
        ui.horizontal(|ui| {
            ui.label("size");
            let [width, height] = &mut self.film.size;
            ui.add(DragValue::new(width).range(16..=4096));
            ui.label("×");
            ui.add(DragValue::new(height).range(16..=4096));
        });
    }

    fn film(&mut self, shown: &Shown, kind: FilmKind, ending: &str) -> Command {
        Command::Film(kind, self.file(shown, ending), self.film.clone())
    }
}
