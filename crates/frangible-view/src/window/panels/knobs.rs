//! The panel of the model's parameters.

use egui::{ComboBox, Slider, Ui};
use frangible::Material;

use crate::command::Command;
use crate::knobs::{KNOBS, Kind, Knob};
use crate::shown::Shown;

pub(super) fn panel(ui: &mut Ui, shown: &Shown, commands: &mut Vec<Command>) {
    let Some(knobs) = &shown.knobs else {
        ui.label("load a scene first");
        return;
    };
    let ([material, own_material], [now, own]) = (&knobs.materials, &knobs.values);
    ui.horizontal_wrapped(|ui| {
        let again = ui.add_enabled(shown.blow.is_some(), egui::Button::new("hit again"));
        if again
            .on_hover_text(
                "H: repeat the last impact on the intact body with these knobs and compare",
            )
            .clicked()
        {
            commands.push(Command::HitAgain);
        }
        if ui
            .button("restart")
            .on_hover_text("R: restart the scene with these knobs")
            .clicked()
        {
            commands.push(Command::Reset);
        }
        if ui
            .add_enabled(
                now != own || material != own_material,
                egui::Button::new("reset all"),
            )
            .clicked()
        {
            commands.push(Command::ResetKnobs);
        }
    });
    ComboBox::from_label("material")
        .selected_text(material.as_str())
        .height(300.0)
        .show_ui(ui, |ui| {
            for preset in Material::presets() {
                let label = ui.selectable_label(material == preset.name, preset.name);
                if label.on_hover_text(preset.source).clicked() {
                    commands.push(Command::Material(preset.name.into()));
                }
            }
        });
    ui.separator();
    for (knob, (now, own)) in KNOBS.iter().zip(now.iter().zip(own)) {
        row(ui, knob, [*now, *own], commands);
    }
}

fn row(ui: &mut Ui, knob: &Knob, [value, own]: [f64; 2], commands: &mut Vec<Command>) {
    let mut wanted = value;
    ui.horizontal(|ui| {
        let back = ui.add_enabled(value != own, egui::Button::new("↺").small());
        if back
            .on_hover_text(format!("reset to {own} {}", knob.unit))
            .clicked()
        {
            commands.push(Command::ResetKnob(knob.name.into()));
        }
        let [least, most] = knob.range;
        let answer = match knob.kind {
            Kind::Switch => {
                let mut on = value > 0.5;
                let answer = ui.checkbox(&mut on, knob.label);
                wanted = f64::from(u8::from(on));
                answer
            }
            Kind::Choice(names) => {
                let mut chosen = value as usize;
                let combo = ComboBox::from_label(knob.label)
                    .selected_text(names[chosen.min(names.len() - 1)]);
                let inner = combo.show_ui(ui, |ui| {
                    for (number, name) in names.iter().enumerate() {
                        ui.selectable_value(&mut chosen, number, *name);
                    }
                });
                wanted = chosen as f64;
                inner.response
            }
            _ => {
                let logarithmic = knob.kind == Kind::Factor;
                let mut slider = Slider::new(&mut wanted, least..=most)
                    .logarithmic(logarithmic)
                    .text(knob.label);
                if !knob.unit.is_empty() {
                    slider = slider.suffix(format!(" {}", knob.unit));
                }
                if knob.kind == Kind::Whole {
                    slider = slider.integer();
                }
                // While it is dragged every value would bake again.
                if knob.rebakes {
                    slider = slider.update_while_editing(false);
                }
                ui.add(slider)
            }
        };
        answer.on_hover_text(format!(
            "{}\n{} to {} {}",
            knob.help, least, most, knob.unit
        ));
    });
    if wanted != value {
        commands.push(Command::Knob(knob.name.into(), wanted));
    }
}
