//! Words and numbers in a line, and their values.

use std::path::PathBuf;
use std::str::FromStr;

use frangible::glam::Vec3;

use crate::command::{Mark, Subject, Target, Tool};

pub(crate) const SUBJECTS: [(&str, Subject); 5] = [
    ("world", Subject::World),
    ("stress", Subject::Stress),
    ("cracks", Subject::Cracks),
    ("modes", Subject::Modes),
    ("compare", Subject::Compare),
];

pub(crate) const TOOLS: [(&str, Tool); 2] = [("ball", Tool::Ball), ("hammer", Tool::Hammer)];

pub(crate) const MARKS: [(&str, Mark); 6] = [
    ("wireframe", Mark::Wireframe),
    ("fracture-mesh", Mark::FractureMesh),
    ("analysis-mesh", Mark::AnalysisMesh),
    ("weak-points", Mark::WeakPoints),
    ("starts", Mark::Starts),
    ("impulse", Mark::Impulse),
];

pub(super) const TARGETS: [(&str, Target); 5] = [
    ("scene", Target::Scene),
    ("glb", Target::Glb),
    ("script", Target::Script),
    ("report", Target::Report),
    ("times", Target::Times),
];

/// A file's name: the rest of the line after the first word, which may have blanks in it.
pub(super) fn file(tail: &str) -> PathBuf {
    let (_, path) = tail.split_once(char::is_whitespace).unwrap_or_default();
    path.trim().into()
}

pub(super) fn one_of<T: Copy>(word: &str, known: &[(&str, T)]) -> Result<T, String> {
    let found = known.iter().find(|(name, _)| *name == word);
    found.map(|(_, value)| *value).ok_or_else(|| {
        let names: Vec<&str> = known.iter().map(|(name, _)| *name).collect();
        format!("`{word}` is not one of {}", names.join(", "))
    })
}

pub(super) fn number(word: &str) -> Result<f64, String> {
    let read = f64::from_str(word).ok().filter(|x| x.is_finite());
    read.ok_or_else(|| format!("`{word}` is not a number"))
}

pub(super) fn whole(word: &str) -> Result<u32, String> {
    word.parse()
        .map_err(|_| format!("`{word}` is not a whole number"))
}

pub(super) fn vector(word: &str) -> Result<Vec3, String> {
    let numbers: Result<Vec<f64>, String> = word.split(',').map(number).collect();
    match numbers?[..] {
        [x, y, z] => Ok(Vec3::new(x as f32, y as f32, z as f32)),
        _ => Err(format!("`{word}` is not a point; write x,y,z in metres")),
    }
}

pub(super) fn name_of<T: PartialEq>(value: T, known: &[(&'static str, T)]) -> &'static str {
    let found = known.iter().find(|(_, known)| *known == value);
    found.map_or("", |(name, _)| name)
}
