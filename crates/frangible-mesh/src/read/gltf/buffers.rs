//! The bytes that a glTF refers to.

use std::borrow::Cow;
use std::path::{Path, PathBuf};

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use gltf_json::buffer::{Buffer, View};
use gltf_json::{Index, Root};

use crate::read::images::is_inside;
use crate::read::{ReadError, is_address, read_file};

/// Contents of all buffers, in their order.
pub(super) struct Buffers<'a> {
    contents: Vec<Cow<'a, [u8]>>,
}

impl<'a> Buffers<'a> {
    pub(super) fn read(
        root: &Root,
        blob: Option<&'a [u8]>,
        folder: Option<&Path>,
    ) -> Result<Self, ReadError> {
        let contents = root
            .buffers
            .iter()
            .enumerate()
            .map(|(i, buffer)| content(i, buffer, blob, folder));
        let contents = contents.collect::<Result<Vec<_>, _>>()?;
        Ok(Self { contents })
    }

    /// Bytes of all buffers together.
    pub(super) fn bytes(&self) -> usize {
        self.contents.iter().map(|content| content.len()).sum()
    }

    /// The bytes of a buffer view.
    pub(super) fn view<'s>(
        &'s self,
        root: &'s Root,
        index: Index<View>,
    ) -> Result<(&'s [u8], &'s View), ReadError> {
        let place = || format!("buffer view {}", index.value());
        let view = root
            .get(index)
            .ok_or_else(|| ReadError::malformed(place(), "it does not exist"))?;
        let start = view.byte_offset.map_or(0, |offset| offset.0);
        let range = || {
            let end = start.checked_add(view.byte_length.0)?;
            let content = self.contents.get(view.buffer.value())?;
            content.get(usize::try_from(start).ok()?..usize::try_from(end).ok()?)
        };
        let bytes = range().ok_or_else(|| ReadError::truncated(place()))?;
        Ok((bytes, view))
    }
}

fn content<'a>(
    i: usize,
    buffer: &Buffer,
    blob: Option<&'a [u8]>,
    folder: Option<&Path>,
) -> Result<Cow<'a, [u8]>, ReadError> {
    let bad = |problem: &str| ReadError::malformed(format!("buffer {i}"), problem);
    let Some(uri) = &buffer.uri else {
        return blob
            .filter(|_| i == 0)
            .map(Cow::Borrowed)
            .ok_or_else(|| bad("it has neither a uri nor a binary chunk"));
    };
    referenced(&format!("buffer {i}"), uri, folder).map(Cow::Owned)
}

/// The bytes of a data URI or of a file in the folder; `place` names them in errors.
pub(super) fn referenced(
    place: &str,
    uri: &str,
    folder: Option<&Path>,
) -> Result<Vec<u8>, ReadError> {
    let bad = |problem: &str| ReadError::malformed(place, problem);
    if let Some(data) = uri.strip_prefix("data:") {
        let (_, code) = data
            .split_once(";base64,")
            .ok_or_else(|| bad("its data uri is not base64"))?;
        return STANDARD
            .decode(code)
            .map_err(|error| bad(&format!("its base64 is damaged: {error}")));
    }
    if is_address(uri) {
        return Err(bad(
            "it is a web address, not a file; download it into the folder of the glTF and refer to it by its file name",
        ));
    }
    let folder = folder.ok_or_else(|| {
        bad("it is a separate file, which is not available to a glTF read from memory; use .glb")
    })?;
    let path = PathBuf::from(percent_decoded(uri));
    if !is_inside(&path) {
        return Err(bad("it is outside the folder of the glTF"));
    }
    read_file(&folder.join(path))
}

fn percent_decoded(uri: &str) -> String {
    let mut bytes = Vec::with_capacity(uri.len());
    let mut rest = uri.as_bytes();
    while let Some((&first, after)) = rest.split_first() {
        let code = after
            .get(..2)
            .and_then(|digits| std::str::from_utf8(digits).ok());
        match code
            .and_then(|digits| u8::from_str_radix(digits, 16).ok())
            .filter(|_| first == b'%')
        {
            Some(byte) => {
                bytes.push(byte);
                rest = &after[2..];
            }
            None => {
                bytes.push(first);
                rest = after;
            }
        }
    }
    String::from_utf8_lossy(&bytes).into_owned()
}
