//! Guesses the kind of a file that is no asset, so that the error can name it.

/// Bytes at the start of a file that are looked at.
const LOOK: usize = 512;

/// A guess at the kind of file, from its first bytes.
pub(super) fn looks_like(bytes: &[u8]) -> &'static str {
    let start = bytes.get(..LOOK).unwrap_or(bytes);
    let text = start.trim_ascii_start();
    match () {
        () if bytes.is_empty() => "an empty file",
        () if start.starts_with(b"glTF") => "a binary glTF scene (.glb)",
        () if text.starts_with(b"{") => "JSON, perhaps a glTF scene (.gltf)",
        () if start.starts_with(b"ply\n") || start.starts_with(b"ply\r") => "a PLY mesh",
        () if text.starts_with(b"solid") || is_binary_stl(bytes) => "an STL mesh",
        () if start.starts_with(b"$MeshFormat") => "a Gmsh mesh",
        () if start.starts_with(b"PK\x03\x04") => "a zip archive",
        () if start.starts_with(b"\x1f\x8b") => "a gzip archive",
        () if start.starts_with(b"version https://git-lfs") => "a Git LFS pointer, not yet pulled",
        () if is_obj(text) => "an OBJ mesh",
        () => "another kind of file",
    }
}

/// 80 bytes of anything, the number of triangles, 50 bytes each.
fn is_binary_stl(bytes: &[u8]) -> bool {
    let count = bytes.get(80..).and_then(|rest| rest.first_chunk());
    count.is_some_and(|n| bytes.len() as u64 == 84 + 50 * u64::from(u32::from_le_bytes(*n)))
}

/// The first line that is no comment starts with a word of the format.
fn is_obj(text: &[u8]) -> bool {
    let lines = text.split(|&b| b == b'\n').map(<[u8]>::trim_ascii);
    let words: [&[u8]; 7] = [b"v ", b"vn ", b"vt ", b"o ", b"g ", b"mtllib ", b"usemtl "];
    lines
        .filter(|line| !line.is_empty() && !line.starts_with(b"#"))
        .take(1)
        .any(|line| words.iter().any(|word| line.starts_with(word)))
}
