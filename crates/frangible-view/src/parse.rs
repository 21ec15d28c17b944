//! Commands as lines of text: a word, then its numbers and names.
//!
//! A script is written by hand and by the session alike, so a command reads its own text (`write.rs`), and the error of a line that is no command
//! says what was probably meant. [`FORMS`] is the table of all of them; it makes the help, and the messages.

mod films;
#[cfg(test)]
mod tests;
pub(crate) mod words;
mod write;

use frangible_bake::frangible_mesh::did_you_mean;

use crate::command::{BallSpec, Command, HammerSpec};
use crate::error::ViewError;

use films::{FILMS, film};
use words::{MARKS, SUBJECTS, TARGETS, TOOLS, file, number, one_of, vector, whole};

/// First word of each command, and its arguments.
const FORMS: [(&str, &str); 48] = [
    ("scene", "NAME"),
    ("open", "FILE"),
    ("cancel-bake", ""),
    ("reset", ""),
    ("pause", ""),
    ("run", ""),
    ("step", "N"),
    ("frames", "N"),
    ("slow-motion", "FACTOR"),
    ("volume", "SHARE"),
    ("sound", "on|off"),
    ("ball", "KG METRES METRES/SECOND MATERIAL"),
    ("hammer", "KG METRES/SECOND MATERIAL"),
    ("tool", "ball|hammer"),
    ("throw", "FROM-X,Y,Z THROUGH-X,Y,Z"),
    ("swing", "FROM-X,Y,Z THROUGH-X,Y,Z"),
    ("grab", "FROM-X,Y,Z THROUGH-X,Y,Z"),
    ("pull", "FROM-X,Y,Z THROUGH-X,Y,Z"),
    ("let-go", ""),
    ("drop", "METRES"),
    ("undo", ""),
    ("look", "world|stress|cracks|modes|compare"),
    ("scrub", "SHARE"),
    ("exaggerate", "FACTOR"),
    ("explode", "FACTOR"),
    (
        "show",
        "wireframe|fracture-mesh|analysis-mesh|weak-points|starts|impulse",
    ),
    (
        "hide",
        "wireframe|fracture-mesh|analysis-mesh|weak-points|starts|impulse",
    ),
    ("mode", "NUMBER"),
    ("select", "FROM-X,Y,Z THROUGH-X,Y,Z"),
    ("knob", "NAME VALUE"),
    ("reset-knob", "NAME|all"),
    ("material", "NAME"),
    ("hit-again", ""),
    (
        "save",
        "scene|glb|script|report|times|still|gif|frames|mp4 FILE",
    ),
    ("cancel-save", ""),
    ("look-from", "EYE-X,Y,Z TARGET-X,Y,Z"),
    ("screenshot", "FILE.png"),
    ("orbit", "DEGREES-RIGHT DEGREES-UP"),
    ("pan", "RIGHT UP"),
    ("zoom", "FACTOR"),
    ("home", ""),
    ("click", "X Y"),
    ("pick", "X Y"),
    ("grab-at", "X Y"),
    ("pull-to", "X Y"),
    ("panel", "NAME open|closed"),
    ("theme", "dark|light"),
    ("quit", ""),
];

impl Command {
    /// Reads a command.
    ///
    /// # Errors
    /// A line that is no command; the message says what was probably meant.
    pub fn parse(line: &str) -> Result<Self, ViewError> {
        let mut words = line.split_whitespace();
        let first = words.next().unwrap_or_default();
        let rest: Vec<&str> = words.collect();
        let tail = line.trim().strip_prefix(first).unwrap_or_default().trim();
        read(first, &rest, tail).map_err(|problem| ViewError::Command {
            line: line.trim().into(),
            problem,
        })
    }

    /// Written form of each command, one per line.
    #[must_use]
    pub fn forms() -> String {
        FORMS
            .iter()
            .map(|(word, after)| format!("{word} {after}\n"))
            .collect()
    }
}

fn read(first: &str, rest: &[&str], tail: &str) -> Result<Command, String> {
    let Some((_, form)) = FORMS.iter().find(|(word, _)| *word == first) else {
        let hint = did_you_mean(first, FORMS.iter().map(|(word, _)| *word));
        return Err(format!("there is no command `{first}`{hint}"));
    };
    let wrong = || format!("write it as `{first} {form}`");
    let counts = form.split_whitespace().count();
    // A file's name may have blanks in it.
    let named = matches!(first, "open" | "save" | "screenshot");
    if rest.len() < counts || !named && rest.len() > counts {
        return Err(wrong());
    }
    let number = |i: usize| number(rest[i]);
    let share = |i: usize| number(i).map(|x| x as f32);
    let point = |i: usize| vector(rest[i]);
    Ok(match first {
        "scene" => Command::Scene(tail.into()),
        "open" => Command::Open(tail.into()),
        "cancel-bake" => Command::CancelBake,
        "reset" => Command::Reset,
        "pause" => Command::Pause,
        "run" => Command::Run,
        "step" => Command::Step(whole(rest[0])?),
        "frames" => Command::Frames(whole(rest[0])?),
        "slow-motion" => Command::SlowMotion(number(0)?),
        "volume" => Command::Volume(number(0)?),
        "sound" => Command::Sound(one_of(rest[0], &[("on", true), ("off", false)])?),
        "ball" => Command::Ball(BallSpec {
            mass: number(0)?,
            radius: number(1)?,
            speed: number(2)?,
            material: rest[3].into(),
        }),
        "hammer" => Command::Hammer(HammerSpec {
            mass: number(0)?,
            speed: number(1)?,
            material: rest[2].into(),
        }),
        "tool" => Command::Tool(one_of(rest[0], &TOOLS)?),
        "swing" => Command::Swing {
            from: point(0)?,
            through: point(1)?,
        },
        "throw" => Command::Throw {
            from: point(0)?,
            through: point(1)?,
        },
        "grab" => Command::Grab {
            from: point(0)?,
            through: point(1)?,
        },
        "pull" => Command::Pull {
            from: point(0)?,
            through: point(1)?,
        },
        "let-go" => Command::LetGo,
        "drop" => Command::Drop(number(0)?),
        "undo" => Command::Undo,
        "look" => Command::Look(one_of(rest[0], &SUBJECTS)?),
        "scrub" => Command::Scrub(number(0)?),
        "exaggerate" => Command::Exaggerate(number(0)?),
        "explode" => Command::Explode(number(0)?),
        "show" | "hide" => Command::Show(one_of(rest[0], &MARKS)?, first == "show"),
        "mode" => Command::Mode(whole(rest[0])? as usize),
        "select" => Command::Select {
            from: point(0)?,
            through: point(1)?,
        },
        "knob" => Command::Knob(rest[0].into(), number(1)?),
        "reset-knob" if rest[0] == "all" => Command::ResetKnobs,
        "reset-knob" => Command::ResetKnob(rest[0].into()),
        "material" => Command::Material(tail.into()),
        "hit-again" => Command::HitAgain,
        "save" if FILMS.iter().any(|(name, _)| *name == rest[0]) => film(rest[0], tail)?,
        "save" => Command::Save(one_of(rest[0], &TARGETS)?, file(tail)),
        "cancel-save" => Command::CancelSave,
        "look-from" => Command::LookFrom {
            eye: point(0)?,
            target: point(1)?,
        },
        "screenshot" => Command::Screenshot(tail.into()),
        "orbit" => Command::Orbit(share(0)?, share(1)?),
        "pan" => Command::Pan(share(0)?, share(1)?),
        "zoom" => Command::Zoom(share(0)?),
        "home" => Command::Home,
        "click" => Command::Click(share(0)?, share(1)?),
        "pick" => Command::Pick(share(0)?, share(1)?),
        "grab-at" => Command::GrabAt(share(0)?, share(1)?),
        "pull-to" => Command::PullTo(share(0)?, share(1)?),
        "panel" => Command::Panel(
            rest[0].into(),
            one_of(rest[1], &[("open", true), ("closed", false)])?,
        ),
        "theme" => Command::Dark(one_of(rest[0], &[("dark", true), ("light", false)])?),
        "quit" => Command::Quit,
        _ => return Err(wrong()),
    })
}
