//! Scenes as TOML text.
//!
//! Visitors are hand-written, because serde's untagged enums lose the line of a mistake.

mod body;
mod convert;
mod either;
mod message;
mod schema;
pub(crate) mod support;
mod values;
mod weakness;
mod write;

use std::path::Path;

use crate::error::SceneError;
use crate::scene::Scene;
use message::{fault_line, parse_error};
use schema::SceneTable;

pub use write::scene_to_toml;

/// Reads a scene from TOML text and checks every number; no file is looked at. Paths in it are relative to `folder`.
///
/// # Errors
/// The first mistake, with its line.
pub fn parse_scene(text: &str, folder: &Path) -> Result<Scene, SceneError> {
    parse_named(text, folder, "scene", "scene")
}

/// Reads what [`parse_scene`] reads, with a name for the file in messages, and for a scene that has none.
pub(crate) fn parse_named(
    text: &str,
    folder: &Path,
    file: &str,
    name: &str,
) -> Result<Scene, SceneError> {
    let mistake = |line, problem| SceneError::Toml {
        file: file.into(),
        line,
        problem,
    };
    let table: SceneTable = toml::from_str(text).map_err(|error| {
        let (line, problem) = parse_error(text, &error);
        mistake(line, problem)
    })?;
    let scene = convert::scene(table, folder, name).and_then(|scene| {
        scene.check()?;
        Ok(scene)
    });
    scene.map_err(|fault| mistake(fault_line(text, &fault), fault.error.to_string()))
}
