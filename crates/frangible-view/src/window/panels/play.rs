//! Scenes, the clock, ball and hammer.

use egui::{ComboBox, Slider, Ui};
use frangible::Material;

use super::{Panels, Tab};
use crate::command::{Command, Target, Tool};
use crate::shown::Shown;

/// Size of a scene's picture, points.
const PICTURE: egui::Vec2 = egui::vec2(58.0, 36.0);

/// Materials of balls and hammers.
const MATERIALS: [&str; 6] = ["steel", "stone", "glass", "wood", "rubber", "porcelain"];

impl Panels {
    pub(super) fn play_panel(&mut self, ui: &mut Ui, shown: &Shown, commands: &mut Vec<Command>) {
        ui.horizontal(|ui| {
            ui.heading("Frangible");
            ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                if ui
                    .small_button("?")
                    .on_hover_text("keys and mouse")
                    .clicked()
                {
                    self.help = !self.help;
                }
            });
        });
        self.choose_scene(ui, shown, commands);
        if let Some(bake) = &shown.bake {
            ui.add(egui::ProgressBar::new(bake.share as f32).text(bake.what.clone()));
            if ui.button("Cancel").clicked() {
                commands.push(Command::CancelBake);
            }
        }
        ui.separator();
        clock(ui, shown, commands);
        if let Some((mut volume, muted)) = shown.sound {
            ui.horizontal(|ui| {
                let mut on = !muted;
                if ui.checkbox(&mut on, "sound").changed() {
                    commands.push(Command::Sound(on));
                }
                let slider = Slider::new(&mut volume, 0.0..=1.0).show_value(false);
                if ui.add_enabled(on, slider.text("volume")).changed() {
                    commands.push(Command::Volume(volume));
                }
            });
        }
        ui.separator();
        tool(ui, shown, commands);
        ui.separator();
        ui.horizontal(|ui| {
            if ui
                .button("Drop")
                .on_hover_text("drop the bodies from this height")
                .clicked()
            {
                commands.push(Command::Drop(self.drop_height));
            }
            ui.add(
                Slider::new(&mut self.drop_height, 0.05..=5.0)
                    .logarithmic(true)
                    .suffix(" m"),
            );
        });
        ui.separator();
        self.files(ui, shown, commands);
        // A page makes none.
        if !self.in_page {
            self.films(ui, shown, commands);
        }
        ui.separator();
        ui.horizontal(|ui| {
            for (tab, label) in [
                (Tab::Inspect, "Inspect"),
                (Tab::Knobs, "Knobs"),
                (Tab::Performance, "Times"),
            ] {
                if ui.selectable_label(self.tab == Some(tab), label).clicked() {
                    self.flip(tab);
                }
            }
        });
    }

    fn files(&mut self, ui: &mut Ui, shown: &Shown, commands: &mut Vec<Command>) {
        ui.label("Save").on_hover_text(match self.in_page {
            true => "files are downloaded".into(),
            false => format!("files are saved in the folder {}", self.folder.display()),
        });
        ui.horizontal_wrapped(|ui| {
            for (label, target, ending, hint) in [
                (
                    "scene",
                    Target::Scene,
                    "toml",
                    "the scene with the current knobs",
                ),
                (
                    "GLB",
                    Target::Glb,
                    "glb",
                    "the current state, for Blender and glTF viewers",
                ),
                (
                    "script",
                    Target::Script,
                    "txt",
                    "a script that replays this session",
                ),
                (
                    "numbers",
                    Target::Report,
                    "json",
                    "the numbers of the last contact",
                ),
            ] {
                if ui.small_button(label).on_hover_text(hint).clicked() {
                    commands.push(Command::Save(target, self.file(shown, ending)));
                }
            }
            let picture = (!self.in_page).then(|| ui.small_button("picture"));
            if picture
                .is_some_and(|button| button.on_hover_text("screenshot of the window").clicked())
            {
                commands.push(Command::Screenshot(self.file(shown, "png")));
            }
        });
    }

    fn choose_scene(&mut self, ui: &mut Ui, shown: &Shown, commands: &mut Vec<Command>) {
        let chosen = match shown.scene.as_str() {
            "" => "choose a scene",
            name => name,
        };
        ComboBox::from_id_salt("scenes")
            .selected_text(chosen)
            .width(ui.available_width() - 8.0)
            .height(400.0)
            .show_ui(ui, |ui| {
                for name in &self.scenes {
                    let chosen = shown.scene == *name;
                    let button = match self.gallery.picture(ui.ctx(), name) {
                        Some(picture) => {
                            let image = egui::Image::new(picture).fit_to_exact_size(PICTURE);
                            egui::Button::image_and_text(image, name)
                        }
                        None => egui::Button::new(name),
                    };
                    if ui.add(button.selected(chosen).frame(chosen)).clicked() {
                        commands.push(Command::Scene(name.clone()));
                        ui.close();
                    }
                }
            });
        if !shown.summary.is_empty() {
            ui.small(&shown.summary);
        }
        ui.small(match self.in_page {
            true => "or drop a mesh, a baked body or a scene file onto the page",
            false => "or drop a mesh, a baked body or a scene file onto the window",
        });
    }
}

fn clock(ui: &mut Ui, shown: &Shown, commands: &mut Vec<Command>) {
    ui.horizontal_wrapped(|ui| {
        let run = if shown.paused { "▶ run" } else { "⏸ pause" };
        if ui.button(run).on_hover_text("space").clicked() {
            commands.push(if shown.paused {
                Command::Run
            } else {
                Command::Pause
            });
        }
        if ui.button("step").on_hover_text(".").clicked() {
            commands.push(Command::Step(1));
        }
        if ui.button("reset").on_hover_text("R").clicked() {
            commands.push(Command::Reset);
        }
        let undo = ui.add_enabled(shown.undoable > 0, egui::Button::new("undo"));
        if undo
            .on_hover_text("Z: back to just before the last break")
            .clicked()
        {
            commands.push(Command::Undo);
        }
    });
    let mut speed = shown.slow_motion;
    let slider = Slider::new(&mut speed, 0.001..=1.0)
        .logarithmic(true)
        .text("× time");
    if ui
        .add(slider)
        .on_hover_text("simulated seconds per second")
        .changed()
    {
        commands.push(Command::SlowMotion(speed));
    }
}

/// Tool that a click uses, and its numbers.
fn tool(ui: &mut Ui, shown: &Shown, commands: &mut Vec<Command>) {
    ui.horizontal(|ui| {
        for (tool, label, hint) in [
            (Tool::Ball, "Ball", "click into the scene to throw it (B)"),
            (Tool::Hammer, "Hammer", "click an object to strike it (B)"),
        ] {
            let button = ui.selectable_label(shown.tool == tool, label);
            if button.on_hover_text(hint).clicked() && shown.tool != tool {
                commands.push(Command::Tool(tool));
            }
        }
    });
    match shown.tool {
        Tool::Ball => ball(ui, shown, commands),
        Tool::Hammer => hammer(ui, shown, commands),
    }
}

fn ball(ui: &mut Ui, shown: &Shown, commands: &mut Vec<Command>) {
    let mut ball = shown.ball.clone();
    material(ui, &mut ball.material);
    let (mut grams, mut millimetres) = (1e3 * ball.mass, 1e3 * ball.radius);
    let turned = sliders(
        ui,
        [
            (&mut grams, 1.0..=5000.0, " g", "mass"),
            (&mut millimetres, 2.0..=100.0, " mm", "radius"),
            (&mut ball.speed, 0.5..=100.0, " m/s", "speed"),
        ],
    );
    if turned {
        // Only then, as kilograms and back is not exact.
        (ball.mass, ball.radius) = (1e-3 * grams, 1e-3 * millimetres);
    }
    if ball != shown.ball {
        commands.push(Command::Ball(ball));
    }
}

fn hammer(ui: &mut Ui, shown: &Shown, commands: &mut Vec<Command>) {
    let mut hammer = shown.hammer.clone();
    material(ui, &mut hammer.material);
    let mut grams = 1e3 * hammer.mass;
    let turned = sliders(
        ui,
        [
            (&mut grams, 20.0..=10_000.0, " g", "mass"),
            (&mut hammer.speed, 0.5..=20.0, " m/s", "speed"),
        ],
    );
    if turned {
        hammer.mass = 1e-3 * grams;
    }
    if hammer != shown.hammer {
        commands.push(Command::Hammer(hammer));
    }
}

fn material(ui: &mut Ui, chosen: &mut String) {
    ComboBox::from_id_salt("tool material")
        .selected_text(chosen.clone())
        .show_ui(ui, |ui| {
            for name in MATERIALS {
                if Material::preset(name).is_ok() {
                    ui.selectable_value(chosen, name.to_string(), name);
                }
            }
        });
}

/// Sliders of a logarithmic scale: value, range, unit, label. Whether one was turned.
fn sliders<const N: usize>(
    ui: &mut Ui,
    all: [(&mut f64, std::ops::RangeInclusive<f64>, &str, &str); N],
) -> bool {
    let mut turned = false;
    ui.spacing_mut().slider_width = 84.0;
    for (value, range, unit, label) in all {
        let slider = Slider::new(value, range)
            .logarithmic(true)
            .suffix(unit)
            .text(label);
        turned |= ui.add(slider.max_decimals(1)).changed();
    }
    turned
}
