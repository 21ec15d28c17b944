//! The panels over the picture: tools to play with at the left, analysis at the right, a line of news below.
//!
//! Panels show the session's state and answer with commands, as keys do (`strokes.rs`); they keep only their open parts, and settings that a person
//! has not yet applied. Each panel is a module of its own; `layout.rs` has their positions, `style.rs` their style.

mod films;
mod gallery;
mod help;
mod inspect;
mod knobs;
mod layout;
mod performance;
mod play;
mod status;
mod strokes;
mod style;

use std::path::PathBuf;

use web_time::Instant;

use egui::Align2;
use frangible::glam::Vec2;
use frangible_draw::kiss3d::window::Window;
use frangible_scenes::SCENE_NAMES;

use crate::command::{Command, FilmOptions, Subject};
use crate::shown::Shown;
use crate::window::input::Said;

use layout::{LEFT, RIGHT, side};
use performance::FrameTimes;
use style::write_words;

/// Duration of one play of a motion, s.
const PLAY_TIME: f64 = 4.0;

/// Contents of the panel on the right.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Tab {
    Inspect,
    Knobs,
    Performance,
}

/// The panels and their state.
pub(super) struct Panels {
    /// Scenes to choose from.
    scenes: Vec<String>,
    /// True if the window is a part of a page, without a disk.
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
    /// Time at which the motion that plays was last moved on.
    playing: Option<Instant>,
    gallery: gallery::Gallery,
    film: FilmOptions,
}

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
            // A first-time user must know how to begin.
            note: (!script).then(|| "click to throw the ball; press ? for keys and mouse".into()),
            drop_height: 1.2,
            times: FrameTimes::default(),
            styled: None,
            playing: None,
            gallery: gallery::Gallery::default(),
            film: FilmOptions::default(),
        }
    }

    /// Panels in a page, which has these scenes only, and no disk.
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

    /// Removes the last note.
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

    /// Returns true if a motion plays.
    pub(super) fn plays(&self) -> bool {
        self.playing.is_some()
    }

    /// Moves the motion that plays on.
    fn play_on(&mut self, shown: &Shown, commands: &mut Vec<Command>) {
        let moves = shown.subject.has_moments();
        let Some(last) = self.playing.filter(|_| moves && shown.course.is_some()) else {
            self.playing = None;
            return;
        };
        let now = Instant::now();
        self.playing = Some(now);
        let passed = now.duration_since(last).as_secs_f64() / PLAY_TIME;
        let next = match shown.subject {
            Subject::Modes => (shown.scrub + passed).fract(),
            // The first microseconds, in which most happens, pass more slowly.
            _ => (shown.scrub.cbrt() + passed).fract().powi(3),
        };
        commands.push(Command::Scrub(next));
    }

    /// Draws the panels over the next frame. Returns the commands of mouse, keys and panels.
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

    /// Opens a tab on the right, or closes it.
    fn flip(&mut self, tab: Tab) {
        self.tab = (self.tab != Some(tab)).then_some(tab);
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
