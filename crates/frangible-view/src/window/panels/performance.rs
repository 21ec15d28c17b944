//! Where the time goes: frames, and the last break beside the paper's.

use std::collections::VecDeque;
use std::time::Duration;

use egui::{Grid, Ui};
use egui_plot::{Line, Plot, PlotPoints};
use frangible_draw::kiss3d::window::Window;

use crate::shown::Shown;

/// Frames on the graph.
const KEPT: usize = 180;

/// Times of the last frames.
#[derive(Default)]
pub(super) struct FrameTimes {
    /// From frame to frame, what the processor did of it, and what of that was not the renderer's, ms.
    frames: VecDeque<[f64; 3]>,
    draw_calls: usize,
}

impl FrameTimes {
    pub(super) fn note(&mut self, window: &Window, draw_calls: usize, own: Duration) {
        self.draw_calls = draw_calls;
        let Some(timings) = window.render_timings() else {
            return;
        };
        let milliseconds = |time: Duration| 1e3 * time.as_secs_f64();
        // To present is to wait for the screen.
        let drawing = timings.total.saturating_sub(timings.cpu_present);
        self.frames.push_back([
            milliseconds(timings.frame_wall),
            milliseconds(own + drawing),
            milliseconds(own),
        ]);
        if self.frames.len() > KEPT {
            self.frames.pop_front();
        }
    }
}

pub(super) fn panel(ui: &mut Ui, shown: &Shown, times: &FrameTimes) {
    // Not the mean: a break or a new scene costs one frame much, and says nothing of the others.
    let median = |of: usize| {
        let mut sorted: Vec<f64> = times.frames.iter().map(|frame| frame[of]).collect();
        sorted.sort_by(f64::total_cmp);
        sorted.get(sorted.len() / 2).copied().unwrap_or_default()
    };
    ui.strong("Frames");
    ui.label(format!(
        "{:.1} ms a frame, {:.1} ms of it on the processor: ours {:.2}, the renderer {:.2}",
        median(0),
        median(1),
        median(2),
        (median(1) - median(2)).max(0.0)
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
            for (of, name) in [(0, "frame, ms"), (1, "processor, ms")] {
                let frames = times.frames.iter().enumerate();
                let points: Vec<[f64; 2]> = frames.map(|(i, t)| [i as f64, t[of]]).collect();
                plot.line(Line::new(name, PlotPoints::from(points)));
            }
        });
    let triangles = shown.picture.triangles();
    ui.small(format!(
        "{} draw calls for {} triangles of the scene",
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
        "{} asked; {share:.0} % refused by bounds, {} broke",
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
    let Some(blow) = shown.blow.as_ref().filter(|blow| blow.fracture.is_some()) else {
        ui.label("nothing has broken yet");
        return;
    };
    let t = &blow.report.timings;
    let ours = [
        t.response + t.stress,
        t.cracks,
        t.labels + t.fragments + t.drawing,
    ];
    let tetrahedra = blow.body.asset().fracture.tets.len();
    Grid::new("table 1")
        .num_columns(5)
        .striped(true)
        .show(ui, |ui| {
            for head in ["", "initiation", "cracks", "pieces", "tetrahedra"] {
                ui.small(head);
            }
            ui.end_row();
            ui.strong(&blow.name);
            for seconds in ours {
                ui.label(format!("{:.1}", 1e3 * seconds));
            }
            ui.label(tetrahedra.to_string());
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
        "the whole step {:.1} ms: fracture {:.1}, pieces into the world {:.1}, rigid bodies {:.1}",
        1e3 * (step.ours() + step.rigid),
        1e3 * step.fracture,
        1e3 * step.fragments,
        1e3 * (step.rigid + step.undone)
    ));
}
