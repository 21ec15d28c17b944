//! Last impact with several methods: which of them, and their numbers.

use egui::{Grid, Ui};
use frangible_compare::Method;

use crate::command::{Command, Subject};
use crate::methods::{FIRST, PANES};
use crate::numbers::OutcomeNumbers;
use crate::shown::Shown;

/// Label, and text of a method's cell.
type Row = (&'static str, fn(&OutcomeNumbers) -> String);

/// Numbers of each method, a line each.
const ROWS: [Row; 5] = [
    ("pieces", |o| match o.pieces {
        1 => "held".into(),
        pieces => pieces.to_string(),
    }),
    ("largest, %", |o| format!("{:.1}", 100.0 * o.largest_share)),
    ("area, cm²", |o| format!("{:.1}", 1e4 * o.crack_area)),
    ("energy, mJ", |o| format!("{:.1}", 1e3 * o.energy)),
    ("ms", |o| format!("{:.0}", 1e3 * o.seconds)),
];

/// Methods to choose, and the table of those that are shown.
pub(super) fn panel(ui: &mut Ui, shown: &Shown, commands: &mut Vec<Command>) {
    choice(ui, shown, commands);
    if shown.subject != Subject::Methods {
        return;
    }
    ui.separator();
    let columns = 1 + ROWS.len();
    Grid::new("methods")
        .num_columns(columns)
        .spacing([9.0, 4.0])
        .striped(true)
        .show(ui, |ui| {
            for head in std::iter::once("").chain(ROWS.map(|(head, _)| head)) {
                ui.small(head);
            }
            ui.end_row();
            for outcome in &shown.methods {
                ui.small(short(outcome.method))
                    .on_hover_text(hint(outcome.method));
                for (_, text) in ROWS {
                    ui.label(text(outcome));
                }
                ui.end_row();
            }
        });
    ui.small("area: one side of all cracks; energy: G_c times the area, even for methods that do not use G_c");
}

fn choice(ui: &mut Ui, shown: &Shown, commands: &mut Vec<Command>) {
    ui.strong("Last impact with");
    let chosen = shown.chosen.as_deref().unwrap_or(&FIRST);
    for method in Method::ALL {
        let mut on = chosen.contains(&method);
        let free = if on {
            chosen.len() > 1
        } else {
            chosen.len() < PANES
        };
        let checkbox = egui::Checkbox::new(&mut on, method.title());
        let answer = ui.add_enabled(free && shown.blow.is_some(), checkbox);
        let answer = answer.on_hover_text(hint(method));
        if answer
            .on_disabled_hover_text("choose one to four methods")
            .changed()
        {
            let now = Method::ALL.into_iter();
            let now = now.filter(|m| if *m == method { on } else { chosen.contains(m) });
            commands.push(Command::CompareMethods(now.collect()));
        }
    }
}

fn short(method: Method) -> &'static str {
    match method {
        Method::Ours => "ours",
        Method::QuasiStatic => "static",
        Method::Elements => "faces",
        Method::EnergyVoronoi => "cells, energy",
        Method::Voronoi => "cells, impact",
    }
}

/// Description of a method, in a sentence.
fn hint(method: Method) -> &'static str {
    match method {
        Method::Ours => "cracks start and run under the stress of the vibration",
        Method::QuasiStatic => {
            "static stress instead of vibration: the impulse acts as a constant force over 0.26 ms (Müller et al. 2001)"
        }
        Method::Elements => {
            "cracks along mesh faces, at the moment of the largest stress (Müller et al. 2001, Smith et al. 2001)"
        }
        Method::EnergyVoronoi => {
            "Voronoi cells sampled by strain energy, separated where the energy suffices (Zheng and James 2010)"
        }
        Method::Voronoi => {
            "Voronoi cells around the impact point, as many as our method has pieces; ignores stress and energy"
        }
    }
}
