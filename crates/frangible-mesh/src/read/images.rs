//! Image files beside a mesh.

use std::path::{Component, Path};

use super::read_file;
use super::text::shown;
use crate::{Image, ImageKind};

/// Reads an image by the name that a file in the folder has for it, or says in words what is left out.
pub(crate) fn read_image(name: &str, folder: &Path) -> Result<Image, String> {
    let called = format!("image {}", shown(name.as_bytes()));
    if !is_inside(Path::new(name)) {
        return Err(format!("{called}, which is outside the folder of the mesh"));
    }
    let bytes = read_file(&folder.join(name)).map_err(|error| format!("{called} ({error})"))?;
    image_of(name, &called, &bytes)
}

/// An image from the bytes of its file; `called` names it in words.
pub(crate) fn image_of(name: &str, called: &str, bytes: &[u8]) -> Result<Image, String> {
    let kind = ImageKind::of(bytes);
    let kind = kind.ok_or_else(|| format!("{called}, which is neither PNG nor JPEG"))?;
    Ok(Image {
        name: name.to_owned(),
        kind,
        bytes: bytes.into(),
    })
}

/// Returns true if a path leads to the folder or below it.
pub(crate) fn is_inside(path: &Path) -> bool {
    path.components()
        .all(|part| matches!(part, Component::Normal(_) | Component::CurDir))
}
