//! Why it broke: the last contact over time, its cracks, its energy.

use web_time::Instant;

use egui::{Color32, Grid, RichText, Slider, Ui};
use egui_plot::{HLine, Line, Plot, PlotPoints, VLine};
use frangible_draw::value_color;

use crate::analysis::Analysis;
use crate::blow::Blow;
use crate::command::{Command, Mark, Subject};
use crate::shown::{Compared, Shown};

pub(super) fn panel(
    ui: &mut Ui,
    shown: &Shown,
    playing: &mut Option<Instant>,
    commands: &mut Vec<Command>,
) {
    subjects(ui, shown, commands);
    marks(ui, shown, commands);
    if let Some(selection) = &shown.selection {
        ui.separator();
        ui.strong(&selection.name);
        let [a, b, c] = selection.size.map(|side| 1e3 * side);
        ui.label(format!(
            "{:.2} g, {:.3} cm³, {a:.1} × {b:.1} × {c:.1} mm, {:.2} m/s",
            1e3 * selection.mass,
            1e6 * selection.volume,
            selection.speed
        ));
    }
    ui.separator();
    if let (Subject::Compare, Some(compared)) = (shown.subject, &shown.compared) {
        compare(ui, compared);
        return;
    }
    if shown.subject == Subject::Methods {
        super::methods::panel(ui, shown, commands);
        return;
    }
    let Some(blow) = &shown.blow else {
        ui.label(
            "Nothing was hit yet: click into the scene to throw a ball, or let the body fall.",
        );
        return;
    };
    contact(ui, blow);
    let Some(analysis) = &shown.analysis else {
        if shown.analysing {
            ui.spinner();
        } else {
            ui.small("look at stress, cracks or modes for its course over time");
        }
        return;
    };
    color_bar(ui, shown, analysis);
    scrubber(ui, shown, analysis, commands);
    if matches!(shown.subject, Subject::Stress | Subject::Modes) {
        let mut plays = playing.is_some();
        if ui.checkbox(&mut plays, "play").changed() {
            *playing = plays.then(Instant::now);
        }
    }
    force(ui, shown, analysis);
    stresses(ui, shown, analysis);
    ui.separator();
    energy(ui, blow);
}

fn subjects(ui: &mut Ui, shown: &Shown, commands: &mut Vec<Command>) {
    ui.horizontal_wrapped(|ui| {
        for (subject, label, hint) in [
            (Subject::World, "scene", "1"),
            (
                Subject::Stress,
                "stress",
                "2: the body during the contact, coloured by its largest tension",
            ),
            (
                Subject::Cracks,
                "cracks",
                "3: coloured in the order in which they started",
            ),
            (Subject::Modes, "modes", "4: one vibration mode at a time"),
            (
                Subject::Compare,
                "compare",
                "5: the impact that was taken again, beside the old one",
            ),
            (
                Subject::Methods,
                "methods",
                "M: the last impact by other methods, side by side",
            ),
        ] {
            let there = match subject {
                Subject::World => true,
                Subject::Compare => shown.compared.is_some(),
                _ => shown.blow.is_some(),
            };
            let label = egui::Button::selectable(shown.subject == subject, label);
            if ui.add_enabled(there, label).on_hover_text(hint).clicked() {
                commands.push(match subject {
                    Subject::Methods => Command::CompareMethods(Vec::new()),
                    other => Command::Look(other),
                });
            }
        }
    });
}

fn marks(ui: &mut Ui, shown: &Shown, commands: &mut Vec<Command>) {
    ui.horizontal_wrapped(|ui| {
        for (mark, label) in [
            (Mark::Impulse, "impulse"),
            (Mark::Starts, "crack starts"),
            (Mark::WeakPoints, "weak points"),
            (Mark::Wireframe, "wireframe"),
            (Mark::FractureMesh, "fracture mesh"),
            (Mark::AnalysisMesh, "analysis mesh"),
        ] {
            let mut on = shown.shows(mark);
            if ui.checkbox(&mut on, label).changed() {
                commands.push(Command::Show(mark, on));
            }
        }
    });
    let mut explode = shown.explode;
    let slider = Slider::new(&mut explode, 0.0..=3.0).text("pieces apart");
    if ui.add(slider).changed() {
        commands.push(Command::Explode(explode));
    }
}

fn contact(ui: &mut Ui, blow: &Blow) {
    let report = &blow.report;
    ui.strong(format!("{} at t = {:.4} s", blow.name, blow.time));
    let fastest = blow
        .contacts
        .iter()
        .map(|c| c.approach_speed)
        .fold(0.0, f32::max);
    ui.label(format!(
        "{:.3} N·s at {fastest:.1} m/s in {:.0} µs; most excited mode {:.0} Hz",
        blow.impulse(),
        1e6 * report.contact_duration,
        report.most_excited_frequency
    ));
    ui.label(match blow.pieces() {
        1 => format!(
            "held: {:.0} % of its strength of {:.1} MPa at most",
            100.0 * report.stress_bound / report.strength,
            1e-6 * report.strength
        ),
        pieces => format!(
            "{pieces} pieces by {} cracks, {:.1} cm² of crack; first crack after {:.0} µs",
            report.cracks,
            1e4 * report.crack_area,
            1e6 * report.first_crack_time.unwrap_or_default()
        ),
    });
}

/// The palette, with what its ends mean.
fn color_bar(ui: &mut Ui, shown: &Shown, analysis: &Analysis) {
    let ends = match shown.subject {
        Subject::Stress | Subject::Modes => {
            let largest = shown.largest_color.unwrap_or_default();
            ["0".to_string(), format!("{:.3} MPa", 1e-6 * largest)]
        }
        Subject::Cracks => [
            "first".into(),
            format!("last of {} cracks", analysis.cracks.len()),
        ],
        _ => return,
    };
    let width = ui.available_width();
    let (rect, _) = ui.allocate_exact_size(egui::vec2(width, 12.0), egui::Sense::hover());
    const STRIPES: u8 = 64;
    for i in 0..STRIPES {
        let share = |k: u8| f32::from(k) / f32::from(STRIPES);
        let [r, g, b] = value_color(share(i));
        let mut stripe = rect;
        stripe.set_left(rect.left() + share(i) * rect.width());
        stripe.set_right(rect.left() + share(i + 1) * rect.width() + 0.5);
        ui.painter()
            .rect_filled(stripe, 0.0, Color32::from_rgb(r, g, b));
    }
    if shown.subject == Subject::Stress && analysis.strength < analysis.peak_tension {
        let at = (analysis.strength / analysis.peak_tension) as f32;
        let x = rect.left() + at * rect.width();
        let line = [
            egui::pos2(x, rect.top() - 2.0),
            egui::pos2(x, rect.bottom() + 2.0),
        ];
        ui.painter()
            .line_segment(line, egui::Stroke::new(2.0, Color32::RED));
    }
    ui.horizontal(|ui| {
        let [low, high] = ends;
        ui.small(low);
        if shown.subject == Subject::Stress {
            let strength = format!("red: strength {:.3} MPa", 1e-6 * analysis.strength);
            ui.label(
                RichText::new(strength)
                    .small()
                    .color(Color32::from_rgb(230, 90, 80)),
            );
        }
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
            ui.small(high)
        });
    });
}

fn scrubber(ui: &mut Ui, shown: &Shown, analysis: &Analysis, commands: &mut Vec<Command>) {
    match shown.subject {
        Subject::Stress => {
            let mut share = shown.scrub;
            let text = format!("{:.1} µs", 1e6 * analysis.time(share));
            let slider = Slider::new(&mut share, 0.0..=1.0)
                .show_value(false)
                .text(text);
            if ui.add(slider).changed() {
                commands.push(Command::Scrub(share));
            }
            let mut factor = shown.exaggeration;
            let slider = Slider::new(&mut factor, 1.0..=1e5)
                .logarithmic(true)
                .text("× deformation");
            if ui.add(slider).changed() {
                commands.push(Command::Exaggerate(factor));
            }
        }
        Subject::Modes => modes(ui, shown, analysis, commands),
        _ => {}
    }
}

fn modes(ui: &mut Ui, shown: &Shown, analysis: &Analysis, commands: &mut Vec<Command>) {
    let basis = &analysis.asset.modes;
    let count = basis.count().max(1);
    let mut mode = shown.mode.clamp(1, count);
    if ui
        .add(Slider::new(&mut mode, 1..=count).text("mode"))
        .changed()
    {
        commands.push(Command::Mode(mode));
    }
    let damping = basis.damping(mode - 1, &analysis.asset.material);
    let frequency = basis.frequency(mode - 1);
    let ratio = damping / (2.0 * std::f64::consts::TAU * frequency);
    ui.label(format!(
        "{frequency:.1} Hz, damping d = {damping:.2} 1/s (ζ = {ratio:.1e})"
    ));
    let mut share = shown.scrub;
    let slider = Slider::new(&mut share, 0.0..=1.0)
        .show_value(false)
        .text("one swing");
    if ui.add(slider).changed() {
        commands.push(Command::Scrub(share));
    }
}

fn plot<'a>(name: &'static str, height: f32) -> Plot<'a> {
    Plot::new(name)
        .height(height)
        .allow_drag(false)
        .allow_zoom(false)
        .allow_scroll(false)
        .allow_boxed_zoom(false)
        .show_x(true)
}

/// Time in µs, values times `factor`.
fn points(series: &[[f64; 2]], factor: f64) -> PlotPoints<'static> {
    let scaled = series.iter().map(|[t, y]| [1e6 * t, factor * y]);
    PlotPoints::from(scaled.collect::<Vec<[f64; 2]>>())
}

fn moment(shown: &Shown, analysis: &Analysis) -> VLine {
    VLine::new("moment", 1e6 * analysis.time(shown.scrub)).color(Color32::GRAY)
}

fn force(ui: &mut Ui, shown: &Shown, analysis: &Analysis) {
    ui.small("force of the contact, N, over µs");
    let moment = moment(shown, analysis);
    plot("force", 70.0).show(ui, |plot| {
        plot.line(Line::new("force, N", points(&analysis.force.points, 1.0)).width(2.0));
        plot.vline(moment);
    });
}

fn stresses(ui: &mut Ui, shown: &Shown, analysis: &Analysis) {
    ui.small("largest tension (thick), modes that strain most, strength (red), MPa over µs");
    let moment = moment(shown, analysis);
    plot("stress", 130.0).show(ui, |plot| {
        for mode in &analysis.modes {
            plot.line(Line::new(mode.name.clone(), points(&mode.points, 1e-6)).width(1.0));
        }
        let tension = Line::new("largest tension", points(&analysis.tension.points, 1e-6));
        plot.line(tension.width(2.5).color(Color32::from_rgb(90, 160, 230)));
        plot.hline(HLine::new("strength", 1e-6 * analysis.strength).color(Color32::RED));
        plot.vline(moment);
    });
}

fn energy(ui: &mut Ui, blow: &Blow) {
    let report = &blow.report;
    ui.strong("Energy, J");
    let whole = report
        .approach_energy
        .max(report.peak_strain_energy)
        .max(f64::MIN_POSITIVE);
    for (label, joules) in [
        ("of the approach", report.approach_energy),
        ("strain, at its peak", report.peak_strain_energy),
        ("spent on cracks", report.fracture_energy),
        ("taken from the motion", blow.energy_paid),
    ] {
        let share = (joules / whole) as f32;
        let text = format!("{label}: {joules:.4}");
        ui.add(
            egui::ProgressBar::new(share)
                .desired_height(14.0)
                .text(RichText::new(text).small()),
        );
    }
}

/// Label, value and decimals of a row.
type Row = (&'static str, fn(&Blow) -> f64, usize);

fn compare(ui: &mut Ui, compared: &Compared) {
    ui.strong("The same impact");
    if compared.differences.is_empty() {
        ui.label("with the same knobs");
    }
    for (label, [old, new], unit) in &compared.differences {
        ui.label(format!("{label}: {old:.4} → {new:.4} {unit}"));
    }
    let [old, new] = &compared.blows;
    let rows: [Row; 7] = [
        ("pieces", |b| b.pieces() as f64, 0),
        ("cracks", |b| b.report.cracks as f64, 0),
        ("crack area, cm²", |b| 1e4 * b.report.crack_area, 1),
        ("crack energy, mJ", |b| 1e3 * b.report.fracture_energy, 2),
        ("peak tension, MPa", |b| 1e-6 * b.report.peak_stress, 2),
        ("contact, µs", |b| 1e6 * b.report.contact_duration, 1),
        ("computed in, ms", |b| 1e3 * b.report.timings.total(), 1),
    ];
    Grid::new("compare")
        .num_columns(3)
        .striped(true)
        .show(ui, |ui| {
            for head in ["", "old (left)", "new (right)"] {
                ui.small(head);
            }
            ui.end_row();
            for (label, value, decimals) in rows {
                ui.label(label);
                for blow in [old, new] {
                    ui.label(format!("{:.decimals$}", value(blow)));
                }
                ui.end_row();
            }
        });
}
