//! Mesh formats, and how a file's format is told.

use std::path::Path;

use super::text::in_utf8;

/// A mesh format that can be read.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum MeshFormat {
    /// Wavefront OBJ, with its material library.
    Obj,
    /// Stereolithography, binary or text.
    Stl,
    /// Stanford polygons, binary or text.
    Ply,
    /// glTF 2.0, as `.gltf` or `.glb`.
    Gltf,
}

impl MeshFormat {
    /// The format that the ending of the name stands for.
    #[must_use]
    pub fn from_extension(path: &Path) -> Option<Self> {
        match path.extension()?.to_str()?.to_ascii_lowercase().as_str() {
            "obj" => Some(Self::Obj),
            "stl" => Some(Self::Stl),
            "ply" => Some(Self::Ply),
            "gltf" | "glb" => Some(Self::Gltf),
            _ => None,
        }
    }

    /// The format that the first bytes tell; binary STL is told by the length that its header announces.
    #[must_use]
    pub fn sniff(bytes: &[u8]) -> Option<Self> {
        if bytes.starts_with(b"glTF") {
            return Some(Self::Gltf);
        }
        if is_exactly_binary_stl(bytes) {
            return Some(Self::Stl);
        }
        let text = &in_utf8(bytes)[..];
        let text = text.trim_ascii_start();
        let first = text
            .split(|b| b.is_ascii_whitespace())
            .next()
            .unwrap_or_default();
        match first.to_ascii_lowercase().as_slice() {
            b"ply" => Some(Self::Ply),
            b"solid" => Some(Self::Stl),
            _ if text.starts_with(b"{") => Some(Self::Gltf),
            _ => starts_like_obj(text).then_some(Self::Obj),
        }
    }
}

/// Returns true if the triangle count at byte 80 explains the length to the byte.
pub(crate) fn is_exactly_binary_stl(bytes: &[u8]) -> bool {
    bytes
        .get(80..84)
        .and_then(|count| count.try_into().ok())
        .is_some_and(|count| bytes.len() as u64 == 84 + 50 * u64::from(u32::from_le_bytes(count)))
}

/// OBJ has no magic word: its first line that is no comment starts with one of its keywords.
fn starts_like_obj(text: &[u8]) -> bool {
    const KEYWORDS: [&[u8]; 10] = [
        b"v", b"vt", b"vn", b"f", b"o", b"g", b"s", b"mtllib", b"usemtl", b"vp",
    ];
    text.split(|&b| b == b'\n')
        .map(<[u8]>::trim_ascii)
        .find(|line| !line.is_empty() && !line.starts_with(b"#"))
        .and_then(|line| line.split(u8::is_ascii_whitespace).next())
        .is_some_and(|word| {
            KEYWORDS
                .iter()
                .any(|known| known.eq_ignore_ascii_case(word))
        })
}
