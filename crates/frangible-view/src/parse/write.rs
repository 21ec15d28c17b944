//! Commands written as the lines that they are read from.

use std::fmt;

use frangible::glam::Vec3;

use super::films::{FILMS, write_film};
use super::words::{MARKS, SUBJECTS, TARGETS, TOOLS, name_of};
use crate::command::Command;

impl fmt::Display for Command {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let v = |p: &Vec3| format!("{},{},{}", p.x, p.y, p.z);
        match self {
            Self::Scene(name) => write!(f, "scene {name}"),
            Self::Open(path) => write!(f, "open {}", path.display()),
            Self::CancelBake => write!(f, "cancel-bake"),
            Self::Reset => write!(f, "reset"),
            Self::Pause => write!(f, "pause"),
            Self::Run => write!(f, "run"),
            Self::Step(n) => write!(f, "step {n}"),
            Self::Frames(n) => write!(f, "frames {n}"),
            Self::SlowMotion(x) => write!(f, "slow-motion {x}"),
            Self::Volume(x) => write!(f, "volume {x}"),
            Self::Sound(on) => write!(f, "sound {}", if *on { "on" } else { "off" }),
            Self::Ball(b) => write!(f, "ball {} {} {} {}", b.mass, b.radius, b.speed, b.material),
            Self::Hammer(h) => write!(f, "hammer {} {} {}", h.mass, h.speed, h.material),
            Self::Tool(tool) => write!(f, "tool {}", name_of(*tool, &TOOLS)),
            Self::Swing { from, through } => write!(f, "swing {} {}", v(from), v(through)),
            Self::Throw { from, through } => write!(f, "throw {} {}", v(from), v(through)),
            Self::Grab { from, through } => write!(f, "grab {} {}", v(from), v(through)),
            Self::Pull { from, through } => write!(f, "pull {} {}", v(from), v(through)),
            Self::LetGo => write!(f, "let-go"),
            Self::Drop(height) => write!(f, "drop {height}"),
            Self::Undo => write!(f, "undo"),
            Self::Look(subject) => write!(f, "look {}", name_of(*subject, &SUBJECTS)),
            Self::Scrub(x) => write!(f, "scrub {x}"),
            Self::Exaggerate(x) => write!(f, "exaggerate {x}"),
            Self::Explode(x) => write!(f, "explode {x}"),
            Self::Show(mark, true) => write!(f, "show {}", name_of(*mark, &MARKS)),
            Self::Show(mark, false) => write!(f, "hide {}", name_of(*mark, &MARKS)),
            Self::Mode(n) => write!(f, "mode {n}"),
            Self::Select { from, through } => write!(f, "select {} {}", v(from), v(through)),
            Self::Knob(name, value) => write!(f, "knob {name} {value}"),
            Self::ResetKnob(name) => write!(f, "reset-knob {name}"),
            Self::ResetKnobs => write!(f, "reset-knob all"),
            Self::Material(name) => write!(f, "material {name}"),
            Self::HitAgain => write!(f, "hit-again"),
            Self::Save(target, path) => {
                write!(f, "save {} {}", name_of(*target, &TARGETS), path.display())
            }
            Self::Film(kind, path, options) => {
                let (kind, options) = (name_of(*kind, &FILMS), write_film(options));
                write!(f, "save {kind} {}{options}", path.display())
            }
            Self::CancelSave => write!(f, "cancel-save"),
            Self::LookFrom { eye, target } => write!(f, "look-from {} {}", v(eye), v(target)),
            Self::Screenshot(path) => write!(f, "screenshot {}", path.display()),
            Self::Orbit(right, up) => write!(f, "orbit {right} {up}"),
            Self::Pan(right, up) => write!(f, "pan {right} {up}"),
            Self::Zoom(factor) => write!(f, "zoom {factor}"),
            Self::Home => write!(f, "home"),
            Self::Click(x, y) => write!(f, "click {x} {y}"),
            Self::Pick(x, y) => write!(f, "pick {x} {y}"),
            Self::GrabAt(x, y) => write!(f, "grab-at {x} {y}"),
            Self::PullTo(x, y) => write!(f, "pull-to {x} {y}"),
            Self::Panel(name, open) => {
                write!(f, "panel {name} {}", if *open { "open" } else { "closed" })
            }
            Self::Dark(dark) => write!(f, "theme {}", if *dark { "dark" } else { "light" }),
            Self::Quit => write!(f, "quit"),
        }
    }
}
