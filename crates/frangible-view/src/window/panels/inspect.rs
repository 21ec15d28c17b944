//! Panel that explains a break: the last contact over time, its cracks, its energy.

use web_time::Instant;

use egui::{Color32, Grid, RichText, Slider, Ui};
use egui_plot::{HLine, Line, Plot, PlotPoints, VLine};
use frangible_draw::value_color;

use crate::command::{Command, Mark, Subject};
use crate::numbers::{BlowNumbers, ComparedNumbers, Course};
use crate::shown::Shown;

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
    let Some(blow) = &shown.blow else {
        ui.label("No contact yet: click into the scene to throw a ball, or drop the body.");
        return;
    };
    contact(ui, blow);
    let Some(course) = &shown.course else {
        if shown.analysing {
            ui.spinner();
        } else {
            ui.small("choose stress, cracks or modes to see the contact over time");
        }
        return;
    };
    color_bar(ui, shown, course);
    scrubber(ui, shown, course, commands);
    if shown.subject.has_moments() {
        let mut plays = playing.is_some();
        if ui.checkbox(&mut plays, "play").changed() {
            *playing = plays.then(Instant::now);
        }
    }
    force(ui, shown, course);
    stresses(ui, shown, course);
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
                "2: the body during the contact, coloured by the largest tensile stress",
            ),
            (
                Subject::Cracks,
                "cracks",
                "3: the cracks, coloured by the order in which they started",
            ),
            (
                Subject::Modes,
                "modes",
                "4: the vibration modes, one at a time",
            ),
            (
                Subject::Compare,
                "compare",
                "5: the repeated impact beside the original",
            ),
        ] {
            let there = match subject {
                Subject::World => true,
                Subject::Compare => shown.compared.is_some(),
                _ => shown.blow.is_some(),
            };
            let label = egui::Button::selectable(shown.subject == subject, label);
            if ui.add_enabled(there, label).on_hover_text(hint).clicked() {
                commands.push(Command::Look(subject));
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

fn contact(ui: &mut Ui, blow: &BlowNumbers) {
    ui.strong(format!("{} at t = {:.4} s", blow.name, blow.time));
    ui.label(format!(
        "{:.3} N·s at {:.1} m/s in {:.0} µs; most excited mode {:.0} Hz",
        blow.impulse,
        blow.speed,
        1e6 * blow.contact_duration,
        blow.most_excited_frequency
    ));
    ui.label(match blow.pieces {
        1 => format!(
            "not broken: at most {:.0} % of its strength of {:.1} MPa",
            100.0 * blow.stress_bound / blow.strength,
            1e-6 * blow.strength
        ),
        pieces => format!(
            "{pieces} pieces, {} cracks, {:.1} cm² of crack area; first crack after {:.0} µs",
            blow.cracks,
            1e4 * blow.crack_area,
            1e6 * blow.first_crack_time
        ),
    });
}

/// The palette, with labels at its ends.
fn color_bar(ui: &mut Ui, shown: &Shown, course: &Course) {
    let ends = match shown.subject {
        Subject::Stress | Subject::Modes => {
            let largest = shown.largest_color.unwrap_or_default();
            ["0".to_string(), format!("{:.3} MPa", 1e-6 * largest)]
        }
        Subject::Cracks => {
            let [first, last] = course.cracking.map(|time| 1e6 * time);
            [
                format!("{first:.1} µs"),
                format!("{last:.1} µs, {} cracks", course.cracks),
            ]
        }
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
    if shown.subject == Subject::Stress && course.strength < course.peak_tension {
        let at = (course.strength / course.peak_tension) as f32;
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
            let strength = format!("red: strength {:.3} MPa", 1e-6 * course.strength);
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

fn scrubber(ui: &mut Ui, shown: &Shown, course: &Course, commands: &mut Vec<Command>) {
    match shown.subject {
        Subject::Cracks => moment_slider(ui, shown, course, commands),
        Subject::Stress => {
            moment_slider(ui, shown, course, commands);
            let mut factor = shown.exaggeration;
            let slider = Slider::new(&mut factor, 1.0..=1e5)
                .logarithmic(true)
                .text("× deformation");
            if ui.add(slider).changed() {
                commands.push(Command::Exaggerate(factor));
            }
        }
        Subject::Modes => modes(ui, shown, course, commands),
        _ => {}
    }
}

/// The timeline of the contact, wide where most happens: in its first microseconds.
fn moment_slider(ui: &mut Ui, shown: &Shown, course: &Course, commands: &mut Vec<Command>) {
    let mut share = shown.scrub;
    let text = format!("{:.1} µs", 1e6 * course.moment(shown.subject, share));
    let slider = Slider::new(&mut share, 0.0..=1.0)
        .logarithmic(true)
        .smallest_positive(1e-4)
        .show_value(false)
        .text(text);
    if ui.add(slider).changed() {
        commands.push(Command::Scrub(share));
    }
}

fn modes(ui: &mut Ui, shown: &Shown, course: &Course, commands: &mut Vec<Command>) {
    let count = course.swings.len().max(1);
    let mut mode = shown.mode.clamp(1, count);
    if ui
        .add(Slider::new(&mut mode, 1..=count).text("mode"))
        .changed()
    {
        commands.push(Command::Mode(mode));
    }
    let swing = course.swings.get(mode - 1).copied();
    let [frequency, damping] = swing.unwrap_or_default();
    let ratio = damping / (2.0 * std::f64::consts::TAU * frequency);
    ui.label(format!(
        "{frequency:.1} Hz, damping d = {damping:.2} 1/s (ζ = {ratio:.1e})"
    ));
    let mut share = shown.scrub;
    let slider = Slider::new(&mut share, 0.0..=1.0)
        .show_value(false)
        .text("phase");
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

fn moment(shown: &Shown, course: &Course) -> VLine {
    VLine::new("moment", 1e6 * course.moment(shown.subject, shown.scrub)).color(Color32::GRAY)
}

fn force(ui: &mut Ui, shown: &Shown, course: &Course) {
    ui.small("contact force (N) against time (µs)");
    let moment = moment(shown, course);
    plot("force", 70.0).show(ui, |plot| {
        plot.line(Line::new("force, N", points(&course.force.points, 1.0)).width(2.0));
        plot.vline(moment);
    });
}

fn stresses(ui: &mut Ui, shown: &Shown, course: &Course) {
    ui.small("largest tensile stress (thick), most strained modes, strength (red): MPa against time (µs)");
    let moment = moment(shown, course);
    plot("stress", 130.0).show(ui, |plot| {
        for mode in &course.modes {
            plot.line(Line::new(mode.name.clone(), points(&mode.points, 1e-6)).width(1.0));
        }
        let tension = Line::new("largest tension", points(&course.tension.points, 1e-6));
        plot.line(tension.width(2.5).color(Color32::from_rgb(90, 160, 230)));
        plot.hline(HLine::new("strength", 1e-6 * course.strength).color(Color32::RED));
        plot.vline(moment);
    });
}

fn energy(ui: &mut Ui, blow: &BlowNumbers) {
    ui.strong("Energy, J");
    let whole = blow
        .approach_energy
        .max(blow.peak_strain_energy)
        .max(f64::MIN_POSITIVE);
    for (label, joules) in [
        ("approach", blow.approach_energy),
        ("strain, peak", blow.peak_strain_energy),
        ("spent on cracks", blow.fracture_energy),
        ("taken from the rigid motion", blow.energy_paid),
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
type Row = (&'static str, fn(&BlowNumbers) -> f64, usize);

fn compare(ui: &mut Ui, compared: &ComparedNumbers) {
    ui.strong("The same impact");
    if compared.differences.is_empty() {
        ui.label("with unchanged knobs");
    }
    for (label, [old, new], unit) in &compared.differences {
        ui.label(format!("{label}: {old:.4} → {new:.4} {unit}"));
    }
    let [old, new] = &compared.blows;
    let rows: [Row; 7] = [
        ("pieces", |b| b.pieces as f64, 0),
        ("cracks", |b| b.cracks as f64, 0),
        ("crack area, cm²", |b| 1e4 * b.crack_area, 1),
        ("crack energy, mJ", |b| 1e3 * b.fracture_energy, 2),
        ("peak tension, MPa", |b| 1e-6 * b.peak_stress, 2),
        ("contact, µs", |b| 1e6 * b.contact_duration, 1),
        (
            "computing time, ms",
            |b| 1e3 * b.seconds.iter().sum::<f64>(),
            1,
        ),
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
