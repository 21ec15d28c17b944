//! Mouse and keys into commands.

use frangible::glam::Vec2;
use frangible_draw::kiss3d::event::{Action, Key, Modifiers, MouseButton, WindowEvent};
use frangible_draw::kiss3d::window::Window;

use crate::command::Command;

/// A press that moves farther than this is a drag, pixels.
const STILL: f32 = 5.0;

/// Degrees for a drag over the height of the window.
const TURN: f32 = 180.0;

/// Meaning of a key. Some depend on the current state, which the panels know.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Stroke {
    PauseOrRun,
    Step,
    Reset,
    Undo,
    HitAgain,
    Help,
    Slower,
    Faster,
    World,
    Stress,
    Cracks,
    Modes,
    Compare,
    Wireframe,
    Explode,
    Home,
    Inspect,
    Knobs,
    Performance,
    Screenshot,
    Glb,
    Tool,
    Theme,
}

/// Keys, their names, and their meanings, in the order of the help.
pub(super) const KEYS: [(Key, &str, Stroke, &str); 23] = [
    (
        Key::Space,
        "space",
        Stroke::PauseOrRun,
        "pause or run the simulation",
    ),
    (Key::Period, ".", Stroke::Step, "advance by one step"),
    (
        Key::R,
        "R",
        Stroke::Reset,
        "restart the scene with the current knobs",
    ),
    (
        Key::Z,
        "Z",
        Stroke::Undo,
        "go back to just before the last break",
    ),
    (
        Key::H,
        "H",
        Stroke::HitAgain,
        "repeat the last impact with the current knobs and compare",
    ),
    (
        Key::B,
        "B",
        Stroke::Tool,
        "switch the click between ball and hammer",
    ),
    (Key::LBracket, "[", Stroke::Slower, "slower"),
    (Key::RBracket, "]", Stroke::Faster, "faster"),
    (Key::Key1, "1", Stroke::World, "show the scene"),
    (
        Key::Key2,
        "2",
        Stroke::Stress,
        "show the last contact: deformation and stress over time",
    ),
    (
        Key::Key3,
        "3",
        Stroke::Cracks,
        "show its cracks, coloured by the order in which they started",
    ),
    (
        Key::Key4,
        "4",
        Stroke::Modes,
        "show the vibration modes one at a time",
    ),
    (
        Key::Key5,
        "5",
        Stroke::Compare,
        "show both outcomes of the repeated impact",
    ),
    (
        Key::X,
        "X",
        Stroke::Explode,
        "toggle drawing the pieces apart",
    ),
    (Key::W, "W", Stroke::Wireframe, "toggle wireframe"),
    (Key::F, "F", Stroke::Home, "reset the camera"),
    (Key::I, "I", Stroke::Inspect, "open or close the inspector"),
    (Key::K, "K", Stroke::Knobs, "open or close the knobs"),
    (
        Key::P,
        "P",
        Stroke::Performance,
        "open or close the timings",
    ),
    (Key::S, "S", Stroke::Screenshot, "save a screenshot"),
    (Key::G, "G", Stroke::Glb, "save the current state as GLB"),
    (
        Key::T,
        "T",
        Stroke::Theme,
        "switch between dark and light theme",
    ),
    (Key::Slash, "?", Stroke::Help, "show this list"),
];

/// Input from mouse and keys since the last frame.
#[derive(Default)]
pub(super) struct Said {
    pub(super) commands: Vec<Command>,
    pub(super) strokes: Vec<Stroke>,
    /// True if there was any input, also to a panel.
    pub(super) anything: bool,
}

/// State of the mouse: its position, and the thing that it holds.
#[derive(Default)]
pub(super) struct Hands {
    at: Vec2,
    /// The button that is down, and where it went down.
    held: Option<(MouseButton, Vec2)>,
    dragged: bool,
    /// True if the drag holds a thing of the scene.
    holds: bool,
}

impl Hands {
    /// Returns the input since the last frame, without that to a panel.
    pub(super) fn read(&mut self, window: &mut Window) -> Said {
        let mut said = Said::default();
        let size = Vec2::new(window.width() as f32, window.height() as f32).max(Vec2::ONE);
        // Tested at the place of each event: the answer of egui itself is as old as the last frame.
        let (panels, scale) = (window.egui_context().clone(), window.scale_factor() as f32);
        let over_panel = |at: Vec2| {
            let place = egui::pos2(at.x / scale, at.y / scale);
            let layer = panels.layer_id_at(place);
            layer.is_some_and(|layer| layer.order != egui::Order::Background)
        };
        let typing = window.is_egui_capturing_keyboard();
        for event in window.events().iter() {
            said.anything = true;
            match event.value {
                WindowEvent::CursorPos(x, y, modifiers) => {
                    let to = Vec2::new(x as f32, y as f32);
                    self.drag(to, size, modifiers, &mut said.commands);
                    self.at = to;
                }
                WindowEvent::MouseButton(button, Action::Press, modifiers)
                    if !over_panel(self.at) =>
                {
                    self.held = Some((button, self.at));
                    self.dragged = false;
                    self.holds = modifiers.contains(Modifiers::Control);
                    if self.holds {
                        let at = self.at / size;
                        said.commands.push(Command::GrabAt(at.x, at.y));
                    }
                }
                WindowEvent::MouseButton(button, Action::Release, modifiers) => {
                    let Some((held, _)) = self.held.take_if(|(held, _)| *held == button) else {
                        continue;
                    };
                    if std::mem::take(&mut self.holds) {
                        said.commands.push(Command::LetGo);
                    } else if held == MouseButton::Button1 && !self.dragged {
                        let at = self.at / size;
                        said.commands
                            .push(match modifiers.contains(Modifiers::Shift) {
                                true => Command::Pick(at.x, at.y),
                                false => Command::Click(at.x, at.y),
                            });
                    }
                }
                WindowEvent::Scroll(_, y, _) if !over_panel(self.at) => {
                    said.commands
                        .push(Command::Zoom((0.01 * y as f32).clamp(-0.5, 0.5).exp()));
                }
                WindowEvent::Key(key, Action::Press, _) if !typing => {
                    let known = KEYS.iter().find(|(known, ..)| *known == key);
                    said.strokes.extend(known.map(|(_, _, stroke, _)| *stroke));
                }
                _ => {}
            }
        }
        for path in window.dropped_files() {
            said.commands.push(Command::Open(path));
        }
        said
    }

    fn drag(&mut self, to: Vec2, size: Vec2, modifiers: Modifiers, commands: &mut Vec<Command>) {
        let Some((button, from)) = self.held else {
            return;
        };
        if to.distance(from) > STILL {
            self.dragged = true;
        }
        if self.holds {
            let at = to / size;
            commands.push(Command::PullTo(at.x, at.y));
            return;
        }
        if !self.dragged {
            return;
        }
        let by = (to - self.at) / size.y;
        let pans = button == MouseButton::Button3 || modifiers.contains(Modifiers::Shift);
        commands.push(match pans {
            true => Command::Pan(-by.x, by.y),
            false => Command::Orbit(-TURN * by.x, TURN * by.y),
        });
    }
}
