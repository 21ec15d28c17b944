//! Panel of computing times: frames, and the last break beside the paper's.

use std::path::Path;
use std::time::Duration;

use egui::{Grid, Ui};
use egui_plot::{Line, Plot, PlotPoints};
use frangible_draw::kiss3d::window::Window;

use crate::error::ViewError;
use crate::save::write_json;
use crate::shown::Shown;
use crate::times::{Laps, Spread};

/// Times of the last frames.
#[derive(Default)]
pub(in crate::window) struct FrameTimes {
    /// Time from frame to frame.
    wall: Laps,
    /// Processor time of the window's thread, without the wait for the screen.
    processor: Laps,
    /// Processor time before a frame was handed to the renderer.
    own: Laps,
    draw_calls: usize,
}

/// Times of the last frames, for a file.
#[derive(serde::Serialize)]
struct Times {
    /// Time from frame to frame, s.
    frame_s: Spread,
    /// Processor time of the window's thread for a frame, s; the driver's own threads are not in it.
    window_s: Spread,
    /// Processor time before a frame was handed to the renderer, s.
    window_own_s: Spread,
    /// Processor time of the session's thread for a picture, s.
    session_s: Spread,
    draw_calls: usize,
    triangles: usize,
    pieces: usize,
}

impl FrameTimes {
    /// Takes note of a frame: `all` and `own` are the thread's processor time for it, in total and before it was handed to the renderer.
    pub(in crate::window) fn note(
        &mut self,
        window: &Window,
        draw_calls: usize,
        [all, own]: [Duration; 2],
    ) {
        self.draw_calls = draw_calls;
        if let Some(timings) = window.render_timings() {
            self.wall.note(timings.frame_wall);
            self.processor.note(all);
            self.own.note(own);
        }
    }

    /// Writes the times of the last frames, and forgets them.
    pub(in crate::window) fn save(&mut self, shown: &Shown, path: &Path) -> Result<(), ViewError> {
        let times = Times {
            frame_s: self.wall.spread(),
            window_s: self.processor.spread(),
            window_own_s: self.own.spread(),
            session_s: shown.publishing,
            draw_calls: self.draw_calls,
            triangles: shown.picture.triangles(),
            pieces: shown.pieces,
        };
        *self = Self::default();
        write_json(path, &times)
    }
}

pub(super) fn panel(ui: &mut Ui, shown: &Shown, times: &FrameTimes) {
    // Not the mean: a break or a new scene costs one frame much, and says nothing of the others.
    ui.strong("Frames");
    let [wall, processor, own] = [&times.wall, &times.processor, &times.own].map(Laps::spread);
    let two = |spread: Spread| format!("{:.2} ({:.2})", 1e3 * spread.median, 1e3 * spread.p99);
    ui.label(format!("{:.1} ms per frame", 1e3 * wall.median));
    ui.label(format!(
        "CPU, ms, median (p99): window {}, of which ours {}; session {}",
        two(processor),
        two(own),
        two(shown.publishing)
    ));
    Plot::new("frames")
        .height(90.0)
        .show_x(false)
        .show_axes([false, true])
        .include_y(0.0)
        .allow_drag(false)
        .allow_zoom(false)
        .allow_scroll(false)
        .show(ui, |plot| {
            for (laps, name) in [(&times.wall, "frame, ms"), (&times.processor, "CPU, ms")] {
                let frames = laps.iter().enumerate();
                let points: Vec<[f64; 2]> = frames.map(|(i, t)| [i as f64, 1e3 * t]).collect();
                plot.line(Line::new(name, PlotPoints::from(points)));
            }
        });
    let triangles = shown.picture.triangles();
    ui.small(format!(
        "{} draw calls, {} triangles in the scene",
        times.draw_calls, triangles
    ));
    ui.separator();
    contacts(ui, shown);
    ui.separator();
    last_break(ui, shown);
}

fn contacts(ui: &mut Ui, shown: &Shown) {
    let counts = &shown.contacts;
    ui.strong("Contacts");
    if counts.asked == 0 {
        ui.label("none yet");
        return;
    }
    let refused = counts.asked - counts.by_stresses.min(counts.asked) - counts.broke;
    let share = 100.0 * refused as f64 / counts.asked as f64;
    ui.label(format!(
        "{} tested; {share:.0} % rejected by bounds, {} broke",
        counts.asked, counts.broke
    ));
    if shown.time > 0.0 {
        let rate = counts.asked as f64 / shown.time;
        ui.small(format!("{rate:.0} per simulated second"));
    }
}

/// The paper's Table 1 on one thread of a 2.3 GHz Core 2, ms: initiation (CPU), propagation, fragments; tetrahedra.
const PAPER: [(&str, [f64; 3], u32); 3] = [
    ("glass", [34.0, 5.1, 1.3], 24_410),
    ("piggy bank", [66.0, 6.6, 6.0], 20_777),
    ("slab, high", [25.0, 6.0, 17.0], 39_901),
];

fn last_break(ui: &mut Ui, shown: &Shown) {
    ui.strong("Last break, ms");
    let Some(blow) = shown.blow.as_ref().filter(|blow| blow.broke) else {
        ui.label("nothing has broken yet");
        return;
    };
    Grid::new("table 1")
        .num_columns(5)
        .striped(true)
        .show(ui, |ui| {
            for head in ["", "initiation", "cracks", "pieces", "tetrahedra"] {
                ui.small(head);
            }
            ui.end_row();
            ui.strong(&blow.name);
            for seconds in blow.seconds {
                ui.label(format!("{:.1}", 1e3 * seconds));
            }
            ui.label(blow.tetrahedra.to_string());
            ui.end_row();
            for (name, stages, tetrahedra) in PAPER {
                ui.label(format!("paper: {name}"));
                for milliseconds in stages {
                    ui.label(milliseconds.to_string());
                }
                ui.label(tetrahedra.to_string());
                ui.end_row();
            }
        });
    ui.small("paper: Table 1, one thread of a 2.3 GHz Core 2");
    let step = &shown.break_step;
    ui.small(format!(
        "whole step {:.1} ms: fracture {:.1}, adding pieces {:.1}, rigid bodies {:.1}",
        1e3 * (step.ours() + step.rigid),
        1e3 * step.fracture,
        1e3 * step.fragments,
        1e3 * (step.rigid + step.undone)
    ));
}
