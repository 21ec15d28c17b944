//! Errors of reading a mesh file.

use std::io;
use std::path::{Path, PathBuf};

use thiserror::Error;

/// Error of reading a mesh file. Faces, vertices and lines are counted from 1.
#[derive(Debug, Error)]
pub enum ReadError {
    /// The file does not exist.
    #[error("there is no file {}{}", path.display(), did_you_mean(nearest.as_deref()))]
    Missing {
        /// The requested path.
        path: PathBuf,
        /// The most similar name in the same folder.
        nearest: Option<String>,
    },
    /// A web address in place of a path.
    #[error("{} is a web address, not a file; download the file and give its path", .0.display())]
    Address(PathBuf),
    /// The path names a folder or a device.
    #[error("{} is not a file; give the path of a mesh file", .0.display())]
    NotAFile(PathBuf),
    /// The operating system cannot read the file.
    #[error("cannot read {}: {source}", path.display())]
    Unreadable {
        /// The requested path.
        path: PathBuf,
        /// Its reason.
        source: io::Error,
    },
    /// The file is empty.
    #[error("the file is empty")]
    Empty,
    /// Neither the name nor the content identifies the format.
    #[error(
        "cannot determine the format of {name}; known formats are .obj, .stl, .ply, .gltf and .glb"
    )]
    UnknownFormat {
        /// File name, or a description of the input.
        name: String,
    },
    /// The file is truncated.
    #[error("the file is truncated: it ends inside {inside}")]
    Truncated {
        /// Part of the file that was being read.
        inside: String,
    },
    /// The content violates its format.
    #[error("{place}: {problem}")]
    Malformed {
        /// Line, face or part of the file.
        place: String,
        /// Fault found there.
        problem: String,
    },
    /// A GLB of a break, written by this project.
    #[error(
        "the file is an exported break with {pieces} pieces; give the mesh of the whole body, or a file with one of the pieces"
    )]
    Pieces {
        /// Number of pieces in the file.
        pieces: usize,
    },
    /// A feature of the format that this reader does not support.
    #[error("the file uses {0}, which is not supported; export it without")]
    Unsupported(String),
    /// glTF of another version.
    #[error(
        "the file is glTF {version}, but only glTF 2.0 is supported; export it as 2.0, or convert it, for example with \
         `gltf-pipeline -i old.gltf -o new.glb`"
    )]
    GltfVersion {
        /// Version of the file.
        version: String,
    },
    /// A face refers to a vertex that does not exist.
    #[error(
        "face {face} refers to vertex {index}, but there are only {vertices} (index as in the file)"
    )]
    IndexOutOfRange {
        /// Number of the face, from 1.
        face: usize,
        /// The index as the file writes it.
        index: i64,
        /// Number of vertices in the file.
        vertices: usize,
    },
    /// A coordinate is NaN or infinite.
    #[error("vertex {vertex} has a coordinate that is not a finite number")]
    NotFinite {
        /// Number of the vertex, from 1.
        vertex: usize,
    },
    /// No triangles to make a solid of.
    #[error("the file has no triangles; a solid needs a surface, not points, lines or curves")]
    NoTriangles,
    /// The file exceeds a size limit.
    #[error(
        "the file has {found} {what}, but the limit is {limit}; simplify the mesh before reading it"
    )]
    TooLarge {
        /// Triangles, vertices or bytes.
        what: &'static str,
        /// Number found.
        found: u64,
        /// Largest number allowed.
        limit: u64,
    },
    /// A VTK file.
    #[error(
        "VTK files are not read; convert this one, for example with meshio: meshio convert {name} mesh.msh"
    )]
    Vtk {
        /// File name.
        name: String,
    },
    /// Neither a surface nor tetrahedra of a known format.
    #[error(
        "cannot determine the format of {name}; known formats for tetrahedra are .msh, .node with .ele, and .mesh"
    )]
    UnknownTetFormat {
        /// File name, or a description of the input.
        name: String,
    },
    /// No tetrahedra.
    #[error("the file has no tetrahedra; save the volume mesh, not only the surface")]
    NoTetrahedra,
    /// Solid elements of another shape.
    #[error(
        "the file has {kind}, but only tetrahedra are supported; let the mesher make tetrahedra, or split the {kind}"
    )]
    OtherCells {
        /// Hexahedra, prisms …
        kind: &'static str,
    },
}

impl ReadError {
    /// Returns the error for a VTK file, by its extension; `None` for other files.
    #[must_use]
    pub fn of_vtk(path: &Path) -> Option<Self> {
        let extension = path.extension()?.to_str()?;
        let is_vtk = ["vtk", "vtu"]
            .iter()
            .any(|e| extension.eq_ignore_ascii_case(e));
        is_vtk.then(|| Self::Vtk {
            name: path.display().to_string(),
        })
    }

    pub(crate) fn malformed(place: impl Into<String>, problem: impl Into<String>) -> Self {
        Self::Malformed {
            place: place.into(),
            problem: problem.into(),
        }
    }

    pub(crate) fn truncated(inside: impl Into<String>) -> Self {
        Self::Truncated {
            inside: inside.into(),
        }
    }
}

fn did_you_mean(nearest: Option<&str>) -> String {
    nearest.map_or_else(String::new, |name| format!("; did you mean {name}?"))
}
