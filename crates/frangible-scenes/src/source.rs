//! Sources of a body's geometry: a built-in shape, a mesh file, a baked body.

mod asset;
mod extent;
mod fit;
mod parts;
mod ready;
mod tets;

use std::path::{Path, PathBuf};
use std::sync::Arc;

use frangible::Asset;
use frangible::internals::asset::RenderSurface;
use frangible_bake::{Group, Shape};
use frangible_mesh::PartChoice;

use crate::error::SceneError;
use crate::read::Files;

pub use asset::{compacted, save_asset, save_compact_asset};
pub(crate) use extent::bounds;
pub(crate) use parts::{OpenedPart, open_parts};

/// Source of a body's geometry.
#[derive(Clone, Debug, PartialEq)]
pub enum BodySource {
    /// A built-in shape, in its own axes.
    Shape(Shape),
    /// A ready solid of [`frangible_bake::READY_SHAPES`], z up.
    Ready {
        /// Its name.
        name: String,
        /// Tetrahedra of the fracture mesh, about; without it the bake's default.
        resolution: Option<usize>,
    },
    /// A mesh file.
    Mesh {
        /// The file: .obj, .stl, .ply, .gltf or .glb; or tetrahedra, .msh, .node with .ele, or .mesh.
        path: PathBuf,
        /// Longest side, m; without it the file's unit is the metre.
        size: Option<f64>,
        /// Axis of the file that is up; it becomes y.
        up: Axis,
        /// Tetrahedra of the fracture mesh, about; without it the bake's default.
        resolution: Option<usize>,
        /// Thickness of a wall along the surface, m; without it the inside is filled.
        wall: Option<f64>,
        /// What becomes of several parts.
        parts: PartChoice,
    },
    /// A baked body (.frangible).
    Asset(PathBuf),
}

/// An axis of coordinates.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Axis {
    /// The first.
    X,
    /// The second.
    Y,
    /// The third.
    Z,
}

impl Axis {
    /// Axis that is up in files of this ending: z in STL and PLY (printing, scanning) and in tetrahedra (simulation), else y
    /// (OBJ, glTF).
    #[must_use]
    pub fn up_in(path: &Path) -> Self {
        match ending(path).as_deref() {
            Some("stl" | "ply") => Self::Z,
            _ if frangible_mesh::TetFormat::from_extension(path).is_some() => Self::Z,
            _ => Self::Y,
        }
    }

    /// The axis of this letter.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        match name {
            "x" => Some(Self::X),
            "y" => Some(Self::Y),
            "z" => Some(Self::Z),
            _ => None,
        }
    }

    /// Its letter.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::X => "x",
            Self::Y => "y",
            Self::Z => "z",
        }
    }
}

/// The axes of these letters, each of x, y and z once, as flags; at least one.
#[must_use]
pub fn axes_of(letters: &str) -> Option<[bool; 3]> {
    let mut axes = [false; 3];
    for letter in letters.chars() {
        let axis = "xyz".find(letter)?;
        if std::mem::replace(&mut axes[axis], true) {
            return None;
        }
    }
    (axes != [false; 3]).then_some(axes)
}

/// Kinds of files that can be broken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FileKind {
    /// A surface mesh or tetrahedra.
    Mesh,
    /// A baked body.
    Asset,
    /// A scene.
    Scene,
}

impl FileKind {
    /// Kind of a file by its ending.
    ///
    /// # Errors
    /// An ending that is not known, with those that are.
    pub fn of(path: &Path) -> Result<Self, SceneError> {
        if frangible_mesh::TetFormat::from_extension(path).is_some() {
            return Ok(Self::Mesh);
        }
        match ending(path).as_deref() {
            Some("obj" | "stl" | "ply" | "gltf" | "glb") => Ok(Self::Mesh),
            Some("frangible") => Ok(Self::Asset),
            Some("toml") => Ok(Self::Scene),
            _ => Err(match frangible_mesh::ReadError::of_vtk(path) {
                Some(error) => SceneError::File {
                    path: path.to_path_buf(),
                    problem: error.to_string(),
                },
                None => SceneError::UnknownKind(path.to_path_buf()),
            }),
        }
    }
}

fn ending(path: &Path) -> Option<String> {
    Some(path.extension()?.to_str()?.to_ascii_lowercase())
}

/// A source that has been read: all faults of its file are known.
#[derive(Clone, Debug)]
pub enum Opened {
    /// A body to be baked.
    Shape {
        /// Its geometry.
        shape: Shape,
        /// The surface as its author drew it, for a mesh.
        render: Option<Box<RenderSurface>>,
        /// Its named parts, which supports may name.
        groups: Vec<Group>,
        /// Notes for the user.
        notes: Vec<String>,
        /// True if its surface is open, so that it was closed and filled.
        open: bool,
    },
    /// Baked.
    Asset(Arc<Asset>),
}

impl Opened {
    /// Returns notes for the user.
    #[must_use]
    pub fn notes(&self) -> &[String] {
        match self {
            Self::Shape { notes, .. } => notes,
            Self::Asset(_) => &[],
        }
    }

    /// Returns true if its surface is open, so that it was closed and filled: it may have been meant as the skin of a thin wall.
    #[must_use]
    pub const fn is_open(&self) -> bool {
        matches!(self, Self::Shape { open: true, .. })
    }
}

/// Reads a body's source from the disk.
///
/// # Errors
/// A file that is missing, empty, of another kind or damaged; a mesh whose size cannot be meant.
pub fn open_source(source: &BodySource) -> Result<Opened, SceneError> {
    open_source_from(source, &Files::Disk)
}

/// Reads a body's source.
pub(crate) fn open_source_from(source: &BodySource, files: &Files) -> Result<Opened, SceneError> {
    match source {
        BodySource::Shape(shape) => Ok(plain(shape.clone())),
        BodySource::Ready { name, resolution } => Ok(plain(ready::shape(name, *resolution)?)),
        BodySource::Mesh { path, .. } => {
            let (mut parts, notes) = open_parts(source, files)?;
            match (parts.pop(), parts.is_empty()) {
                (Some(only), true) => Ok(only.opened),
                _ => Err(SceneError::SeveralParts {
                    path: path.clone(),
                    found: notes.join("; "),
                }),
            }
        }
        BodySource::Asset(path) => {
            files.check(path, FileKind::Asset)?;
            Ok(Opened::Asset(Arc::new(files.asset(path)?)))
        }
    }
}

/// A shape that no one drew.
const fn plain(shape: Shape) -> Opened {
    Opened::Shape {
        shape,
        render: None,
        groups: Vec::new(),
        notes: Vec::new(),
        open: false,
    }
}
