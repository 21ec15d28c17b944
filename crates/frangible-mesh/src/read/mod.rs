//! Reading of mesh files to [`InputMesh`].
//!
//! OBJ, STL and PLY have their own readers, because existing crates lose error locations and double precision, mistake a binary STL whose header
//! begins with “solid” for text, or build a map of strings per vertex. The JSON of glTF is parsed by `gltf-json`; its buffers are decoded here
//! with every range checked.

mod error;
mod finish;
mod format;
mod gltf;
mod images;
mod nearest;
mod obj;
mod ply;
mod polygon;
mod runs;
mod stl;
pub(crate) mod text;

use std::io;
use std::path::Path;

pub use error::ReadError;
pub use format::MeshFormat;
pub use nearest::{did_you_mean, nearest_file, nearest_name};

use crate::InputMesh;

/// Largest number of triangles of a file.
pub const MOST_TRIANGLES: u64 = 20_000_000;

/// Most vertices of one file: three for each triangle.
pub(crate) const MOST_VERTICES: u64 = 3 * MOST_TRIANGLES;

/// Largest size of a file, and of each file that it refers to, bytes.
pub const MOST_BYTES: u64 = 2_000_000_000;

/// Reads a mesh file with its material library or buffers.
///
/// The format follows from the file extension, unless the first bytes clearly indicate another format; then that one is used and a warning is
/// logged.
///
/// # Errors
/// See [`ReadError`]. Only errors about the file itself include its path.
pub fn read_mesh(path: &Path) -> Result<InputMesh, ReadError> {
    parse_mesh_named(path, &read_file(path)?, path.parent())
}

/// Reads a mesh from memory. The format follows from the name and the first bytes as in [`read_mesh`]; see [`parse_mesh`].
///
/// # Errors
/// See [`ReadError`].
pub fn parse_mesh_named(
    name: &Path,
    bytes: &[u8],
    folder: Option<&Path>,
) -> Result<InputMesh, ReadError> {
    check_bytes(bytes.len() as u64)?;
    let bytes = &text::in_utf8(bytes)[..];
    let by_name = MeshFormat::from_extension(name);
    let by_content = MeshFormat::sniff(bytes);
    let format = match (by_name, by_content) {
        (Some(named), Some(found)) if named != found => {
            log::warn!(
                "{} contains {found:?} data and is read as such",
                name.display()
            );
            found
        }
        (Some(format), _) | (None, Some(format)) => format,
        (None, None) => {
            let name = name.display().to_string();
            return Err(ReadError::UnknownFormat { name });
        }
    };
    parse_mesh(format, bytes, folder)
}

/// Reads a mesh from memory. `folder` is the folder of referenced files; without it, a material library is ignored and an external buffer is an
/// error.
///
/// # Errors
/// See [`ReadError`].
pub fn parse_mesh(
    format: MeshFormat,
    bytes: &[u8],
    folder: Option<&Path>,
) -> Result<InputMesh, ReadError> {
    check_bytes(bytes.len() as u64)?;
    if bytes.is_empty() {
        return Err(ReadError::Empty);
    }
    let bytes = &text::in_utf8(bytes)[..];
    let mesh = match format {
        MeshFormat::Obj => obj::parse(bytes, folder),
        MeshFormat::Stl => stl::parse(bytes),
        MeshFormat::Ply => ply::parse(bytes, folder),
        MeshFormat::Gltf => gltf::parse(bytes, folder),
    }?;
    finish::finish(mesh)
}

/// Returns true for a URL, such as `https://example.org/a.glb`.
pub fn is_address(name: &str) -> bool {
    const SCHEMES: [&str; 4] = ["http", "https", "ftp", "s3"];
    // A scene's folder may have been put before it.
    let before = name.split_once(":/").map(|(before, _)| before);
    let scheme = before.and_then(|before| before.rsplit(['/', '\\']).next());
    scheme.is_some_and(|scheme| {
        SCHEMES
            .iter()
            .any(|known| known.eq_ignore_ascii_case(scheme))
    })
}

/// Reads a whole file of at most [`MOST_BYTES`].
pub(crate) fn read_file(path: &Path) -> Result<Vec<u8>, ReadError> {
    if is_address(&path.to_string_lossy()) {
        return Err(ReadError::Address(path.to_path_buf()));
    }
    let unreadable = |source: io::Error| match source.kind() {
        io::ErrorKind::NotFound => ReadError::Missing {
            path: path.to_path_buf(),
            nearest: nearest::nearest_file(path),
        },
        _ => ReadError::Unreadable {
            path: path.to_path_buf(),
            source,
        },
    };
    let about = std::fs::metadata(path).map_err(unreadable)?;
    if !about.is_file() {
        return Err(ReadError::NotAFile(path.to_path_buf()));
    }
    check_bytes(about.len())?;
    std::fs::read(path).map_err(unreadable)
}

pub(crate) fn check_bytes(found: u64) -> Result<(), ReadError> {
    check_limit("bytes", found, MOST_BYTES)
}

pub(crate) fn check_triangles(found: u64) -> Result<(), ReadError> {
    check_limit("triangles", found, MOST_TRIANGLES)
}

pub(crate) fn check_vertices(found: u64) -> Result<(), ReadError> {
    check_limit("vertices", found, MOST_VERTICES)
}

fn check_limit(what: &'static str, found: u64, limit: u64) -> Result<(), ReadError> {
    if found > limit {
        return Err(ReadError::TooLarge { what, found, limit });
    }
    Ok(())
}
