//! As much of binary glTF as it takes to check that a file is whole: header, chunks, and that buffers hold the range of each view.

use serde_json::Value;

use crate::command::Result;

const MAGIC: u32 = u32::from_le_bytes(*b"glTF");
const JSON: u32 = u32::from_le_bytes(*b"JSON");
const BINARY: u32 = u32::from_le_bytes(*b"BIN\0");

/// Counts of the things in a file.
pub(crate) struct Contents {
    pub(crate) meshes: usize,
    pub(crate) nodes: usize,
    pub(crate) animations: usize,
}

/// Reads a binary glTF 2.0 file.
pub(crate) fn parse(bytes: &[u8]) -> Result<Contents> {
    let word = |at: usize| -> Result<u32> {
        let four = bytes.get(at..at + 4).and_then(|four| four.try_into().ok());
        four.map(u32::from_le_bytes)
            .ok_or_else(|| format!("ends at byte {}, within a header", bytes.len()))
    };
    if word(0)? != MAGIC || word(4)? != 2 {
        return Err("does not start as binary glTF 2".to_owned());
    }
    if word(8)? as usize != bytes.len() {
        return Err(format!("claims {} bytes and has {}", word(8)?, bytes.len()));
    }
    let (mut json, mut binary, mut at) = (None, &[][..], 12);
    while at < bytes.len() {
        let (length, kind) = (word(at)? as usize, word(at + 4)?);
        let chunk = bytes.get(at + 8..at + 8 + length).ok_or_else(|| {
            format!("has a chunk of {length} bytes at byte {at} that goes past its end")
        })?;
        if length % 4 != 0 {
            return Err(format!(
                "has a chunk of {length} bytes, which is no multiple of four"
            ));
        }
        match kind {
            JSON => json = Some(chunk),
            BINARY => binary = chunk,
            _ => {}
        }
        at += 8 + length;
    }
    let json: Value = serde_json::from_slice(json.ok_or("has no JSON chunk")?)
        .map_err(|error| format!("has broken JSON: {error}"))?;
    let items = |name: &str| json[name].as_array().map_or(&[][..], Vec::as_slice);
    let number = |value: &Value| value.as_u64().unwrap_or(0);
    if items("buffers").iter().any(|buffer| {
        buffer["uri"].is_null() && number(&buffer["byteLength"]) > binary.len() as u64
    }) {
        return Err(format!(
            "has a binary chunk of {} bytes, shorter than its buffer",
            binary.len()
        ));
    }
    for (index, view) in items("bufferViews").iter().enumerate() {
        let buffer = &json["buffers"][number(&view["buffer"]) as usize];
        if number(&view["byteOffset"]).saturating_add(number(&view["byteLength"]))
            > number(&buffer["byteLength"])
        {
            return Err(format!(
                "has a buffer view, {index}, that goes past its buffer"
            ));
        }
    }
    Ok(Contents {
        meshes: items("meshes").len(),
        nodes: items("nodes").len(),
        animations: items("animations").len(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn file(json: &str, binary: &[u8]) -> Vec<u8> {
        let mut json = json.as_bytes().to_vec();
        json.resize(json.len().next_multiple_of(4), b' ');
        let mut bytes = Vec::new();
        for word in [
            MAGIC,
            2,
            (12 + 8 + json.len() + 8 + binary.len()) as u32,
            json.len() as u32,
            JSON,
        ] {
            bytes.extend(word.to_le_bytes());
        }
        bytes.extend(json);
        bytes.extend((binary.len() as u32).to_le_bytes());
        bytes.extend(BINARY.to_le_bytes());
        bytes.extend(binary);
        bytes
    }

    const WHOLE: &str = r#"{"asset":{"version":"2.0"},"buffers":[{"byteLength":8}],"bufferViews":[{"buffer":0,"byteOffset":4,"byteLength":4}],"meshes":[{},{}],"nodes":[{}]}"#;

    #[test]
    fn a_whole_file_is_counted() {
        let contents = parse(&file(WHOLE, &[0; 8])).unwrap();
        assert_eq!(
            (contents.meshes, contents.nodes, contents.animations),
            (2, 1, 0)
        );
    }

    #[test]
    fn a_file_cut_anywhere_is_refused() {
        let bytes = file(WHOLE, &[0; 8]);
        for length in 0..bytes.len() {
            assert!(parse(&bytes[..length]).is_err(), "cut at {length}");
        }
    }

    #[test]
    fn a_view_past_its_buffer_is_refused() {
        let json = WHOLE.replace(r#""byteOffset":4"#, r#""byteOffset":5"#);
        assert!(parse(&file(&json, &[0; 8])).is_err());
        assert!(parse(&file(WHOLE, &[0; 4])).is_err());
    }
}
