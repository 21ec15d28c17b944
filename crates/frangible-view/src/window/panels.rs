//! The panels, and what keys mean beside what they show.

mod films;
mod gallery;
mod help;
mod inspect;
mod knobs;
mod methods;
mod performance;
mod play;
mod status;

use std::path::PathBuf;

use web_time::Instant;

use egui::{Align2, Color32, Context, FontId, LayerId, Visuals};
use frangible::glam::Vec2;
use frangible_draw::kiss3d::window::Window;
use frangible_scenes::SCENE_NAMES;

use crate::command::{Command, FilmOptions, Mark, Subject, Target, Tool};
use crate::shown::Shown;
use crate::window::input::{Said, Stroke};

use performance::FrameTimes;

/// Width of the panels at the sides, points.
const LEFT: f32 = 244.0;
const RIGHT: f32 = 330.0;

/// Distance from the window's edges, points.
const EDGE: f32 = 6.0;

/// A window in which both panels would leave too little to see, points.
const NARROW: f32 = 820.0;

/// Size of remarks, points.
const SMALL: f32 = 11.0;

/// How far a key draws pieces apart.
const APART: f64 = 0.6;

/// What the panel on the right shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Tab {
    Inspect,
    Knobs,
    Performance,
}

/// The panels, and what of them is open.
pub(super) struct Panels {
    /// Scenes to choose from.
    scenes: Vec<String>,
    /// Whether the window is a part of a page, without a disk.
    in_page: bool,
    tab: Option<Tab>,
    play: bool,
    help: bool,
    dark: bool,
    folder: PathBuf,
    saved: usize,
    note: Option<String>,
    drop_height: f64,
    times: FrameTimes,
    styled: Option<bool>,
    /// When the motion that plays was moved on last.
    playing: Option<Instant>,
    gallery: gallery::Gallery,
    film: FilmOptions,
}

/// How long one play of a motion takes, s.
const PLAY_TIME: f64 = 4.0;

impl Panels {
    pub(super) fn new(folder: PathBuf, script: bool) -> Self {
        Self {
            scenes: SCENE_NAMES.map(String::from).to_vec(),
            in_page: false,
            tab: None,
            play: true,
            help: false,
            dark: true,
            folder,
            saved: 0,
            // Whoever opens it for the first time must know what to do.
            note: (!script).then(|| "click to throw the ball; ? lists keys and mouse".into()),
            drop_height: 1.2,
            times: FrameTimes::default(),
            styled: None,
            playing: None,
            gallery: gallery::Gallery::default(),
            film: FilmOptions::default(),
        }
    }

    /// In a page there are these scenes only, and no disk.
    pub(super) fn in_page(scenes: Vec<String>) -> Self {
        Self {
            scenes,
            in_page: true,
            ..Self::new(PathBuf::new(), false)
        }
    }

    pub(super) fn set_open(&mut self, name: &str, open: bool) {
        let tab = match name {
            "inspect" => Tab::Inspect,
            "knobs" => Tab::Knobs,
            "performance" => Tab::Performance,
            "play" => {
                self.play = open;
                return;
            }
            "help" => {
                self.help = open;
                return;
            }
            other => {
                self.note = Some(format!(
                    "there is no panel `{other}`; panels: play, inspect, knobs, performance, help"
                ));
                return;
            }
        };
        if open {
            self.tab = Some(tab);
        } else if self.tab == Some(tab) {
            self.tab = None;
        }
    }

    pub(super) fn set_dark(&mut self, dark: bool) {
        self.dark = dark;
    }

    /// What was said last is no longer news.
    pub(super) fn hush(&mut self) {
        self.note = None;
    }

    /// Says something to the person.
    pub(super) fn tell(&mut self, note: String) {
        self.note = Some(note);
    }

    /// Times of the last frames.
    pub(super) fn times(&mut self) -> &mut FrameTimes {
        &mut self.times
    }

    /// How far the picture's middle is moved out of the panels' way, in shares of half the window.
    pub(super) fn shift(&self, window: &Window) -> [f32; 2] {
        let points = window.width() as f32 / window.scale_factor() as f32;
        let [left, right] = self.margins(points);
        [(left - right) / points.max(1.0), 0.0]
    }

    /// Width over height of what the panels leave free.
    pub(super) fn free_aspect(&self, window: &Window) -> f32 {
        let scale = window.scale_factor() as f32;
        let points = window.width() as f32 / scale;
        let [left, right] = self.margins(points);
        let free = points - left - right;
        free.max(1.0) * scale / window.height().max(1) as f32
    }

    /// Whether the panel on the left is there: in a narrow window it makes room for the other.
    fn shows_play(&self, window_points: f32) -> bool {
        self.play && (self.tab.is_none() || window_points >= NARROW)
    }

    /// Width that panels take at the left and the right, points.
    fn margins(&self, window_points: f32) -> [f32; 2] {
        let width = |there: bool, width: f32| if there { width + 2.0 * EDGE } else { 0.0 };
        [
            width(self.shows_play(window_points), LEFT),
            width(self.tab.is_some(), RIGHT),
        ]
    }

    /// Whether a motion plays.
    pub(super) fn plays(&self) -> bool {
        self.playing.is_some()
    }

    /// Moves the motion that plays on.
    fn play_on(&mut self, shown: &Shown, commands: &mut Vec<Command>) {
        let moves = matches!(shown.subject, Subject::Stress | Subject::Modes);
        let Some(last) = self.playing.filter(|_| moves && shown.analysis.is_some()) else {
            self.playing = None;
            return;
        };
        let now = Instant::now();
        self.playing = Some(now);
        let passed = now.duration_since(last).as_secs_f64() / PLAY_TIME;
        commands.push(Command::Scrub((shown.scrub + passed).fract()));
    }

    /// Draws the panels over the next frame; what was said with mouse, keys and panels comes back.
    pub(super) fn draw(
        &mut self,
        window: &mut Window,
        shown: &Shown,
        said: Said,
        words: &[(Vec2, String)],
    ) -> Vec<Command> {
        let mut commands = said.commands;
        for stroke in said.strokes {
            self.mean(stroke, shown, &mut commands);
        }
        if shown.message.is_some() {
            self.note = None;
        }
        self.play_on(shown, &mut commands);
        window.draw_ui(|ctx| {
            self.style(ctx);
            write_words(ctx, words);
            if self.shows_play(ctx.content_rect().width()) {
                side(ctx, "play", Align2::LEFT_TOP, LEFT, |ui| {
                    self.play_panel(ui, shown, &mut commands);
                });
            }
            if let Some(tab) = self.tab {
                side(ctx, "side", Align2::RIGHT_TOP, RIGHT, |ui| {
                    self.tabs(ui);
                    ui.separator();
                    match tab {
                        Tab::Inspect => inspect::panel(ui, shown, &mut self.playing, &mut commands),
                        Tab::Knobs => knobs::panel(ui, shown, &mut commands),
                        Tab::Performance => performance::panel(ui, shown, &self.times),
                    }
                });
            }
            self.status(ctx, shown, &mut commands);
            if self.help {
                help::show(ctx, &mut self.help);
            }
        });
        commands
    }

    fn tabs(&mut self, ui: &mut egui::Ui) {
        ui.horizontal(|ui| {
            for (tab, label) in [
                (Tab::Inspect, "Inspect"),
                (Tab::Knobs, "Knobs"),
                (Tab::Performance, "Performance"),
            ] {
                if ui.selectable_label(self.tab == Some(tab), label).clicked() {
                    self.tab = Some(tab);
                }
            }
            ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                if ui.small_button("×").on_hover_text("close").clicked() {
                    self.tab = None;
                }
            });
        });
    }

    fn style(&mut self, ctx: &Context) {
        if self.styled == Some(self.dark) {
            return;
        }
        self.styled = Some(self.dark);
        ctx.set_theme(if self.dark {
            egui::Theme::Dark
        } else {
            egui::Theme::Light
        });
        let mut visuals = if self.dark {
            Visuals::dark()
        } else {
            Visuals::light()
        };
        visuals.window_fill = match self.dark {
            true => egui::Color32::from_rgba_unmultiplied(24, 26, 29, 238),
            false => egui::Color32::from_rgba_unmultiplied(250, 250, 250, 238),
        };
        visuals.override_text_color = Some(match self.dark {
            true => egui::Color32::from_gray(228),
            false => egui::Color32::from_gray(20),
        });
        ctx.set_visuals(visuals);
        // Of the usual sizes the small one is hard to read on a plain screen.
        ctx.all_styles_mut(|style| {
            if let Some(font) = style.text_styles.get_mut(&egui::TextStyle::Small) {
                font.size = SMALL;
            }
        });
    }

    /// What a key means now.
    fn mean(&mut self, stroke: Stroke, shown: &Shown, commands: &mut Vec<Command>) {
        let toggle = |mark| Command::Show(mark, !shown.shows(mark));
        commands.push(match stroke {
            Stroke::PauseOrRun if shown.paused => Command::Run,
            Stroke::PauseOrRun => Command::Pause,
            Stroke::Step => Command::Step(1),
            Stroke::Reset => Command::Reset,
            Stroke::Undo => Command::Undo,
            Stroke::HitAgain => Command::HitAgain,
            Stroke::Slower => Command::SlowMotion(shown.slow_motion * 0.5),
            Stroke::Faster => Command::SlowMotion((shown.slow_motion * 2.0).min(1.0)),
            Stroke::World => Command::Look(Subject::World),
            Stroke::Stress | Stroke::Cracks | Stroke::Modes => {
                self.tab = Some(Tab::Inspect);
                Command::Look(match stroke {
                    Stroke::Stress => Subject::Stress,
                    Stroke::Cracks => Subject::Cracks,
                    _ => Subject::Modes,
                })
            }
            Stroke::Compare => Command::Look(Subject::Compare),
            Stroke::Methods => {
                self.tab = Some(Tab::Inspect);
                Command::CompareMethods(Vec::new())
            }
            Stroke::Wireframe => toggle(Mark::Wireframe),
            Stroke::Explode if shown.explode > 0.0 => Command::Explode(0.0),
            Stroke::Explode => Command::Explode(APART),
            Stroke::Home => Command::Home,
            Stroke::Screenshot => Command::Screenshot(self.file(shown, "png")),
            Stroke::Glb => Command::Save(Target::Glb, self.file(shown, "glb")),
            Stroke::Tool => Command::Tool(match shown.tool {
                Tool::Ball => Tool::Hammer,
                Tool::Hammer => Tool::Ball,
            }),
            Stroke::Help => return self.help = !self.help,
            Stroke::Theme => return self.dark = !self.dark,
            Stroke::Inspect => return self.flip(Tab::Inspect),
            Stroke::Knobs => return self.flip(Tab::Knobs),
            Stroke::Performance => return self.flip(Tab::Performance),
        });
    }

    fn flip(&mut self, tab: Tab) {
        self.tab = (self.tab != Some(tab)).then_some(tab);
    }

    /// A name for a file that is not taken.
    fn file(&mut self, shown: &Shown, ending: &str) -> PathBuf {
        let scene = if shown.scene.is_empty() {
            "view"
        } else {
            &shown.scene
        };
        loop {
            self.saved += 1;
            let path = self.folder.join(format!("{scene}-{}.{ending}", self.saved));
            if !path.exists() {
                return path;
            }
        }
    }
}

/// Words over the picture and under the panels, each in the middle above its place.
fn write_words(ctx: &Context, words: &[(Vec2, String)]) {
    let painter = ctx.layer_painter(LayerId::background());
    let size = ctx.content_rect().size();
    for (at, text) in words {
        let at = egui::pos2(at.x * size.x, at.y * size.y);
        let font = FontId::proportional(15.0);
        let color = Color32::from_gray(20);
        let galley = painter.layout_no_wrap(text.clone(), font, color);
        let place = Align2::CENTER_BOTTOM.anchor_size(at, galley.size());
        let paper = Color32::from_rgba_unmultiplied(255, 255, 255, 170);
        painter.rect_filled(place.expand(3.0), 3.0, paper);
        painter.galley(place.min, galley, color);
    }
}

/// A panel at a side of the window, as high as it is.
fn side(ctx: &Context, id: &str, at: Align2, width: f32, contents: impl FnOnce(&mut egui::Ui)) {
    let height = ctx.content_rect().height() - 2.0 * EDGE;
    let toward = if at == Align2::LEFT_TOP { EDGE } else { -EDGE };
    egui::Window::new(id)
        .title_bar(false)
        .resizable(false)
        .anchor(at, [toward, EDGE])
        .fade_in(false)
        .show(ctx, |ui| {
            ui.set_width(width - 16.0);
            ui.set_max_height(height - 44.0);
            egui::ScrollArea::vertical()
                .max_height(height - 44.0)
                .auto_shrink([false, true])
                .show(ui, contents);
        });
}
