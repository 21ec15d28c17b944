//! Commands as lines of text: a word, then its numbers and names.

mod films;

use std::fmt;
use std::path::PathBuf;
use std::str::FromStr;

use frangible::glam::Vec3;
use frangible_bake::frangible_mesh::nearest_name;

use crate::command::{BallSpec, Command, HammerSpec, Mark, Subject, Target, Tool};
use crate::error::ViewError;
use crate::methods::named_methods;

use films::{FILMS, film, write_film};

/// Each command's first word, and what comes after it.
const FORMS: [(&str, &str); 46] = [
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
    ("look", "world|stress|cracks|modes|compare|methods"),
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
    ("compare-methods", "first|METHOD,METHOD"),
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
];

/// Words of commands that are not in the table above for want of a person who would write them by hand often.
const MORE: [(&str, &str); 3] = [
    ("panel", "NAME open|closed"),
    ("theme", "dark|light"),
    ("quit", ""),
];

impl Command {
    /// Reads a command.
    ///
    /// # Errors
    /// A line that is none, with what was probably meant.
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

    /// How each command is written, one per line.
    #[must_use]
    pub fn forms() -> String {
        let forms = FORMS.iter().chain(&MORE);
        forms
            .map(|(word, after)| format!("{word} {after}\n"))
            .collect()
    }
}

fn read(first: &str, rest: &[&str], tail: &str) -> Result<Command, String> {
    let all = || FORMS.iter().chain(&MORE);
    let Some((_, form)) = all().find(|(word, _)| *word == first) else {
        let known: Vec<&str> = all().map(|(word, _)| *word).collect();
        let hint = nearest_name(first, known.iter().copied())
            .map_or(String::new(), |n| format!(", did you mean `{n}`?"));
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
            from: vector(rest[0])?,
            through: vector(rest[1])?,
        },
        "throw" => Command::Throw {
            from: vector(rest[0])?,
            through: vector(rest[1])?,
        },
        "grab" => Command::Grab {
            from: vector(rest[0])?,
            through: vector(rest[1])?,
        },
        "pull" => Command::Pull {
            from: vector(rest[0])?,
            through: vector(rest[1])?,
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
            from: vector(rest[0])?,
            through: vector(rest[1])?,
        },
        "knob" => Command::Knob(rest[0].into(), number(1)?),
        "reset-knob" if rest[0] == "all" => Command::ResetKnobs,
        "reset-knob" => Command::ResetKnob(rest[0].into()),
        "material" => Command::Material(tail.into()),
        "hit-again" => Command::HitAgain,
        "compare-methods" => Command::CompareMethods(named_methods(rest[0])?),
        "save" if FILMS.iter().any(|(name, _)| *name == rest[0]) => film(rest[0], tail)?,
        "save" => Command::Save(one_of(rest[0], &TARGETS)?, file(tail)),
        "cancel-save" => Command::CancelSave,
        "look-from" => Command::LookFrom {
            eye: vector(rest[0])?,
            target: vector(rest[1])?,
        },
        "screenshot" => Command::Screenshot(tail.into()),
        "orbit" => Command::Orbit(number(0)? as f32, number(1)? as f32),
        "pan" => Command::Pan(number(0)? as f32, number(1)? as f32),
        "zoom" => Command::Zoom(number(0)? as f32),
        "home" => Command::Home,
        "click" => Command::Click(number(0)? as f32, number(1)? as f32),
        "pick" => Command::Pick(number(0)? as f32, number(1)? as f32),
        "grab-at" => Command::GrabAt(number(0)? as f32, number(1)? as f32),
        "pull-to" => Command::PullTo(number(0)? as f32, number(1)? as f32),
        "panel" => Command::Panel(
            rest[0].into(),
            one_of(rest[1], &[("open", true), ("closed", false)])?,
        ),
        "theme" => Command::Dark(one_of(rest[0], &[("dark", true), ("light", false)])?),
        "quit" => Command::Quit,
        _ => return Err(wrong()),
    })
}

const SUBJECTS: [(&str, Subject); 6] = [
    ("world", Subject::World),
    ("stress", Subject::Stress),
    ("cracks", Subject::Cracks),
    ("modes", Subject::Modes),
    ("compare", Subject::Compare),
    ("methods", Subject::Methods),
];

const TOOLS: [(&str, Tool); 2] = [("ball", Tool::Ball), ("hammer", Tool::Hammer)];

const MARKS: [(&str, Mark); 6] = [
    ("wireframe", Mark::Wireframe),
    ("fracture-mesh", Mark::FractureMesh),
    ("analysis-mesh", Mark::AnalysisMesh),
    ("weak-points", Mark::WeakPoints),
    ("starts", Mark::Starts),
    ("impulse", Mark::Impulse),
];

const TARGETS: [(&str, Target); 5] = [
    ("scene", Target::Scene),
    ("glb", Target::Glb),
    ("script", Target::Script),
    ("report", Target::Report),
    ("times", Target::Times),
];

/// What follows the first word.
fn file(tail: &str) -> PathBuf {
    let (_, path) = tail.split_once(char::is_whitespace).unwrap_or_default();
    path.trim().into()
}

fn one_of<T: Copy>(word: &str, known: &[(&str, T)]) -> Result<T, String> {
    let found = known.iter().find(|(name, _)| *name == word);
    found.map(|(_, value)| *value).ok_or_else(|| {
        let names: Vec<&str> = known.iter().map(|(name, _)| *name).collect();
        format!("`{word}` is not one of {}", names.join(", "))
    })
}

fn number(word: &str) -> Result<f64, String> {
    let read = f64::from_str(word).ok().filter(|x| x.is_finite());
    read.ok_or_else(|| format!("`{word}` is no number"))
}

fn whole(word: &str) -> Result<u32, String> {
    word.parse()
        .map_err(|_| format!("`{word}` is no whole number"))
}

fn vector(word: &str) -> Result<Vec3, String> {
    let numbers: Result<Vec<f64>, String> = word.split(',').map(number).collect();
    match numbers?[..] {
        [x, y, z] => Ok(Vec3::new(x as f32, y as f32, z as f32)),
        _ => Err(format!("`{word}` is no point; write x,y,z in metres")),
    }
}

fn name_of<T: PartialEq>(value: T, known: &[(&'static str, T)]) -> &'static str {
    let found = known.iter().find(|(_, known)| *known == value);
    found.map_or("", |(name, _)| name)
}

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
            Self::CompareMethods(methods) => {
                let names: Vec<&str> = methods.iter().map(|method| method.name()).collect();
                match names.is_empty() {
                    true => write!(f, "compare-methods first"),
                    false => write!(f, "compare-methods {}", names.join(",")),
                }
            }
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_command_reads_what_it_writes() {
        let sample = |word: &str| match word {
            "NAME" | "MATERIAL" | "NAME|all" => "steel".to_string(),
            "FILE" | "FILE.png" => "a folder/x.png".into(),
            "N" | "NUMBER" => "7".into(),
            "first|METHOD,METHOD" => "ours,voronoi".into(),
            _ if word.ends_with("X,Y,Z") => "0.1,-2,0.0003".into(),
            _ if word.contains('|') => word.split('|').next().unwrap_or_default().into(),
            _ => "0.25".into(),
        };
        for (word, form) in FORMS.iter().chain(&MORE) {
            let after: Vec<String> = form.split_whitespace().map(sample).collect();
            let line = format!("{word} {}", after.join(" "));
            let command = Command::parse(&line).unwrap();
            assert_eq!(command.to_string(), line.trim());
            assert_eq!(Command::parse(&command.to_string()).unwrap(), command);
        }
    }

    #[test]
    fn a_film_has_its_options_behind_its_file() {
        for (line, written) in [
            ("save gif a b.gif", "save gif a b.gif"),
            (
                "save gif a.gif 2s 15fps 320x200",
                "save gif a.gif 2s 15fps 320x200",
            ),
            (
                "save still x.png 8spp 320x200",
                "save still x.png 320x200 8spp",
            ),
            ("save mp4 3s.mp4 20fps 3s", "save mp4 3s.mp4"),
        ] {
            assert_eq!(Command::parse(line).unwrap().to_string(), written);
        }
        let error = Command::parse("save gif a.gif 320x200 1").unwrap_err();
        assert!(error.to_string().contains("`1`"), "{error}");
        let error = Command::parse("save gif 3s").unwrap_err().to_string();
        assert!(error.contains("`save gif FILE`"), "{error}");
    }

    #[test]
    fn mistakes_say_what_would_do() {
        for (line, hint) in [
            ("scen glass", "did you mean `scene`?"),
            ("step many", "`many` is no whole number"),
            ("throw 0,0 1,2,3", "write x,y,z"),
            ("look inside", "world, stress, cracks"),
            ("ball 1 2", "write it as `ball KG"),
            ("slow-motion NaN", "is no number"),
            ("reset now", "write it as `reset "),
            ("", "there is no command"),
        ] {
            let error = Command::parse(line).unwrap_err().to_string();
            assert!(error.contains(hint), "{line}: {error}");
        }
    }
}
