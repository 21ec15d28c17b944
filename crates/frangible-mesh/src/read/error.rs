//! Errors of reading a mesh file.

use std::io;
use std::path::PathBuf;

use thiserror::Error;

/// Error of reading a mesh file. Faces, vertices and lines are counted from 1.
#[derive(Debug, Error)]
pub enum ReadError {
    /// No file of this name.
    #[error("there is no file {}{}", path.display(), did_you_mean(nearest.as_deref()))]
    Missing {
        /// The path asked for.
        path: PathBuf,
        /// The most similar name in the same folder.
        nearest: Option<String>,
    },
    /// An address of the web in place of a path.
    #[error("{} is an address, not a file; download it first and name the file", .0.display())]
    Address(PathBuf),
    /// The path names a folder or a device.
    #[error("{} is not a file; name a mesh file inside it", .0.display())]
    NotAFile(PathBuf),
    /// The operating system refuses.
    #[error("cannot read {}: {source}", path.display())]
    Unreadable {
        /// The path asked for.
        path: PathBuf,
        /// Its reason.
        source: io::Error,
    },
    /// No bytes.
    #[error("the file is empty")]
    Empty,
    /// Neither the name nor the content tells the format.
    #[error("cannot tell the format of {name}: known are .obj, .stl, .ply, .gltf and .glb")]
    UnknownFormat {
        /// File name, or a text in its place.
        name: String,
    },
    /// The content ends too soon.
    #[error("the file is cut off: it ends inside {inside}")]
    Truncated {
        /// Part of the file that was being read.
        inside: String,
    },
    /// The content breaks the rules of its format.
    #[error("{place}: {problem}")]
    Malformed {
        /// Line, face or part of the file.
        place: String,
        /// Fault found there.
        problem: String,
    },
    /// A film of a break, which this project wrote.
    #[error(
        "the file shows a break and holds {pieces} of its pieces; give the mesh that broke, or one of the pieces as a file of its own"
    )]
    Pieces {
        /// Pieces in it.
        pieces: usize,
    },
    /// The format allows it, this reader does not know it.
    #[error("the file needs {0}, which is not supported; export it without")]
    Unsupported(String),
    /// glTF of another version.
    #[error(
        "the file is glTF {version}, and only glTF 2.0 can be read; export it as 2.0, or convert it, for example with \
         `gltf-pipeline -i old.gltf -o new.glb`"
    )]
    GltfVersion {
        /// Version that the file names or shows.
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
    /// More than is sensible to read.
    #[error(
        "the file has {found} {what}, the limit is {limit}; simplify the mesh before reading it"
    )]
    TooLarge {
        /// Triangles, vertices or bytes.
        what: &'static str,
        /// Number found.
        found: u64,
        /// Largest number allowed.
        limit: u64,
    },
    /// Neither a surface nor tetrahedra of a known format.
    #[error(
        "cannot tell the format of {name}: known for tetrahedra are .msh, .node with .ele, .vtk, .vtu and .mesh"
    )]
    UnknownTetFormat {
        /// File name, or a text in its place.
        name: String,
    },
    /// No tetrahedra.
    #[error("the file has no tetrahedra; save the volume mesh as well, not the surface alone")]
    NoTetrahedra,
    /// Solid elements of another shape.
    #[error(
        "the file has {kind}; only tetrahedra can be broken: have the mesher make tetrahedra, or split the {kind}"
    )]
    OtherCells {
        /// Hexahedra, prisms …
        kind: &'static str,
    },
}

impl ReadError {
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
