//! Files of tetrahedra to [`TetInput`].
//!
//! Gmsh's MSH, TetGen's three files and Medit's .mesh. The crates for them are stale, read one
//! version each, or reserve what a header asks for. Nothing here reserves memory that the file does not fill.

mod builder;
pub(crate) mod cursor;
mod medit;
mod msh;
mod msh2;
mod msh4;
mod tetgen;

use std::path::Path;

use crate::read::text::in_utf8;
use crate::read::{ReadError, check_bytes, read_file};
use crate::tet_input::TetInput;

/// A format of tetrahedra that can be read.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum TetFormat {
    /// Gmsh 2.2 and 4.1, text and binary.
    Msh,
    /// TetGen's .node, .ele and .face.
    TetGen,
    /// Medit's .mesh, text.
    Medit,
}

impl TetFormat {
    /// The format that the ending of the name stands for.
    #[must_use]
    pub fn from_extension(path: &Path) -> Option<Self> {
        match path.extension()?.to_str()?.to_ascii_lowercase().as_str() {
            "msh" => Some(Self::Msh),
            "node" | "ele" => Some(Self::TetGen),
            "mesh" => Some(Self::Medit),
            _ => None,
        }
    }
}

/// Reads a file of tetrahedra. Of TetGen's files the .node or the .ele is named; the other must lie beside it, and a
/// .face may.
///
/// # Errors
/// See [`ReadError`]; only those about the file itself name its path.
pub fn read_tets(path: &Path) -> Result<TetInput, ReadError> {
    match TetFormat::from_extension(path) {
        Some(TetFormat::TetGen) => {
            let node = read_file(&path.with_extension("node"))?;
            let ele = read_file(&path.with_extension("ele"))?;
            let face = path.with_extension("face");
            let face = face.is_file().then(|| read_file(&face)).transpose()?;
            parse_tetgen(&node, &ele, face.as_deref())
        }
        Some(format) => parse_tets(format, &read_file(path)?),
        None => Err(
            ReadError::of_vtk(path).unwrap_or_else(|| ReadError::UnknownTetFormat {
                name: path.display().to_string(),
            }),
        ),
    }
}

/// Reads tetrahedra from memory. TetGen's files are three: see [`parse_tetgen`].
///
/// # Errors
/// See [`ReadError`].
pub fn parse_tets(format: TetFormat, bytes: &[u8]) -> Result<TetInput, ReadError> {
    check_bytes(bytes.len() as u64)?;
    if bytes.is_empty() {
        return Err(ReadError::Empty);
    }
    let bytes = &in_utf8(bytes)[..];
    match format {
        TetFormat::Msh => msh::parse(bytes),
        TetFormat::Medit => medit::parse(bytes),
        TetFormat::TetGen => Err(ReadError::Unsupported(
            "its .node and its .ele together".into(),
        )),
    }
}

/// Reads TetGen's files from memory: nodes, tetrahedra, and faces with their markers.
///
/// # Errors
/// See [`ReadError`].
pub fn parse_tetgen(node: &[u8], ele: &[u8], face: Option<&[u8]>) -> Result<TetInput, ReadError> {
    let face = face.map(in_utf8);
    tetgen::parse(&in_utf8(node), &in_utf8(ele), face.as_deref())
}
