//! Meanings of the keys: some always do the same, others toggle the current state.

use super::{Panels, Tab};
use crate::command::{Command, Mark, Subject, Target, Tool};
use crate::shown::Shown;
use crate::window::input::Stroke;

/// Spread of the pieces that a key sets.
const APART: f64 = 0.6;

impl Panels {
    /// Adds the command that a key means now.
    pub(super) fn mean(&mut self, stroke: Stroke, shown: &Shown, commands: &mut Vec<Command>) {
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
}
