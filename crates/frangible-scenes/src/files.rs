//! Scenes from files: a scene file, or a mesh or baked body that is dropped.

use std::path::Path;

use frangible::Material;
use frangible_mesh::PartChoice;

use crate::body::BodySpec;
use crate::builtin::{SCENE_NAMES, scene};
use crate::check::tame;
use crate::error::SceneError;
use crate::read::Files;
use crate::scene::Scene;
use crate::source::{Axis, BodySource, FileKind};
use crate::text::parse_named;

/// Height from which a body of a file is dropped, m.
const DROP: f64 = 1.5;

/// Material of a body of a mesh file unless something else is asked for.
const MATERIAL: &str = "porcelain";

/// Makes a scene from a file: a scene file is read; a mesh, as porcelain, or a baked body is dropped from 1.5 m.
///
/// # Errors
/// A file that is missing, empty or of unknown kind, or an error in a scene file, with its line.
pub fn scene_of_file(path: &Path) -> Result<Scene, SceneError> {
    scene_of_file_from(path, &Files::Disk)
}

/// Like [`scene_of_file`], with the given files.
///
/// # Errors
/// The errors of [`scene_of_file`].
pub fn scene_of_file_from(path: &Path, files: &Files) -> Result<Scene, SceneError> {
    // A folder or a missing file is said to be so, whatever its ending.
    let kind = match FileKind::of(path) {
        Err(error) if files.has(path) => return Err(error),
        kind => kind.unwrap_or(FileKind::Mesh),
    };
    files.check(path, kind)?;
    let source = match kind {
        FileKind::Scene => return read_scene_from(path, files),
        FileKind::Asset => BodySource::Asset(path.to_path_buf()),
        FileKind::Mesh => BodySource::Mesh {
            path: path.to_path_buf(),
            size: None,
            up: Axis::up_in(path),
            resolution: None,
            wall: None,
            parts: PartChoice::Auto,
        },
    };
    let mut body = BodySpec::new(stem(path), source, Material::preset(MATERIAL)?);
    body.drop_from(DROP);
    let mut scene = Scene::one_body(body);
    scene.summary = format!("{} dropped", path.display());
    Ok(scene)
}

/// Returns the scene of a file if one is given, otherwise the built-in scene of this name, or the first built-in scene.
///
/// # Errors
/// The errors of [`scene_of_file`] and [`scene()`](crate::scene()).
pub fn scene_of(file: Option<&Path>, name: Option<&str>) -> Result<Scene, SceneError> {
    match file {
        Some(file) => scene_of_file(file),
        None => scene(name.unwrap_or(SCENE_NAMES[0])),
    }
}

/// Reads a scene file. Paths in it are relative to its folder.
///
/// # Errors
/// A file that cannot be read, or the first error in it, with its line.
pub fn read_scene(path: &Path) -> Result<Scene, SceneError> {
    read_scene_from(path, &Files::Disk)
}

fn read_scene_from(path: &Path, files: &Files) -> Result<Scene, SceneError> {
    let text = files.scene(path)?;
    let folder = path.parent().unwrap_or(Path::new(""));
    parse_named(&text, folder, &path.display().to_string(), &stem(path))
}

/// Name of the file without its ending, as far as a scene may have it.
fn stem(path: &Path) -> String {
    let stem = path.file_stem().unwrap_or_default();
    tame(&stem.to_string_lossy())
}
